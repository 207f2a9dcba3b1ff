// The volumes a picture is made of: the material of the first, the light of all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "medium/medium.h"
#include "medium/objects.h"
#include "volume/volume.h"

#include <string>
#include <vector>

namespace eikonal::view {

/// Several files of one scene on one transform. A grid is taken from the first file that has it,
/// but light adds up: fluence is the sum over all files, light_direction its weighted mean. So
/// lights can be simulated apart, on as many machines, and switched off by leaving out a file.
class Scene {
public:
    /// Throws DataError if the files' transforms differ.
    explicit Scene(std::vector<volume::Volume> volumes);

    const volume::IndexBox& domain() const { return mDomain; }
    const volume::Frame& frame() const { return mVolumes.front().frame(); }
    const std::string& path() const { return mVolumes.front().path(); }
    bool has(const std::string& grid) const;
    /// The first file's own history, one command a line.
    std::string history() const { return mVolumes.front().metadata("eikonal:command"); }
    /// A coefficient of the medium, from the first file that has it.
    medium::Coefficient coefficient(const std::string& grid) const;
    medium::Index index() const;
    /// Whether some file has signed distances.
    bool hasObjects() const { return objectsHolder() != nullptr; }
    /// The objects of the first file that has some. Throws DataError if none has.
    medium::Objects objects() const;
    /// [W/m²], from all files.
    medium::Coefficient fluence() const;
    /// World space, weighted by the files' fluence.
    medium::Coefficient lightDirection() const;

private:
    const volume::Volume* holder(const std::string& grid) const;
    const volume::Volume* objectsHolder() const;
    std::vector<volume::Volume> mVolumes;
    volume::IndexBox mDomain;
};

} // namespace eikonal::view
