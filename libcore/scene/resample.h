// What one scene's grids hold, on the voxels of another one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace eikonal::scene {

/// A scene as it lies in another one's voxels, which are none larger than its own.
class Resampler {
public:
    Resampler(const Scene& from, const Scene& onto);

    /// An object's distances, by cubic convolution (Keys 1981), which errs by the third power of a
    /// voxel. An object that the domain's faces cut open ends there, unless it
    /// is a plane that `goesOn`.
    volume::BrickGrid distances(const Object& object, bool goesOn) const;

    /// Values about an object, linearly; beyond the domain they go on as at its faces. `about` is
    /// the object on the voxels of the scene that is made.
    Values values(const Values& from, const Object& about) const;

    /// A place of the scene that is made, in this one's voxels.
    glm::dvec3 placeOf(const glm::dvec3& voxel) const {
        return glm::dvec3(mFromOnto * glm::dvec4(voxel, 1));
    }
    /// And the other way round.
    glm::dvec3 placeOnto(const glm::dvec3& voxel) const {
        return glm::dvec3(mOntoFrom * glm::dvec4(voxel, 1));
    }
    /// How many voxels of the scene that is made one of this one's is long, 1 at least.
    double scale() const { return mScale; }

private:
    volume::IndexBox boxOnto(const volume::IndexBox& voxels, int margin) const;

    const Scene &mFrom, &mOnto;
    glm::dmat4 mFromOnto, mOntoFrom;
    double mScale;
};

/// The value at a place between voxels, linearly; beyond the box as at its faces.
float linearAt(const volume::BrickGrid& grid, const glm::dvec3& place, int component);

} // namespace eikonal::scene
