// The files a scene is made of: the material of the first that has it, the light of all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <string>
#include <vector>

namespace eikonal::scene {

/// Several files of one scene on one transform. So lights can be simulated apart, on as many
/// machines, and switched off by leaving out a file.
class Files {
public:
    /// Throws DataError if the files' transforms differ.
    explicit Files(std::vector<volume::Volume> volumes);
    /// One file, which stays the caller's.
    explicit Files(const volume::Volume& volume);

    const volume::IndexBox& domain() const { return mDomain; }
    const volume::Frame& frame() const { return mFrame; }
    /// Moves the scene, its light with it: `worldFromFile` turns, shifts and scales evenly.
    void place(const glm::dmat4& worldFromFile);
    bool isMoved() const { return mMoved; }
    /// How it has been turned so.
    const glm::dmat3& turn() const { return mTurn; }
    /// Leaves out what is beyond a part of the domain.
    void crop(const volume::IndexBox& part) { mDomain = part; }
    const std::string& path() const { return first().path(); }
    /// The first file's own history, one command a line.
    std::string history() const { return first().metadata("eikonal:command"); }

    const std::vector<const volume::Volume*>& all() const { return mAll; }
    const volume::Volume& first() const { return *mAll.front(); }
    /// The first file that has the grid, or null.
    const volume::Volume* withGrid(const std::string& grid) const;
    /// The names of all grids, in words.
    std::string foundNames() const;
    /// The first file that has signed distances, or null.
    const volume::Volume* withObjects() const;

private:
    std::vector<volume::Volume> mOwn;
    std::vector<const volume::Volume*> mAll;
    volume::IndexBox mDomain;
    volume::Frame mFrame;
    glm::dmat3 mTurn{1};
    bool mMoved = false;
};

/// Whether two volumes' voxels lie on one lattice.
bool areOnOneTransform(const volume::Volume& a, const volume::Volume& b);

} // namespace eikonal::scene
