// Objects' boundaries on the device, as shaders/transport/level_set.glsl reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "scene/scene.h"

namespace eikonal::scene {

class Boundaries {
public:
    Boundaries() = default;
    /// Throws MemoryError if the device can't hold it.
    Boundaries(gpu::Device& device, const Scene& scene);

    /// At the units and the binding of shaders/shared/bindings.h.
    void bind() const;

private:
    void makeCoefficients(gpu::Device& device, const Scene& scene, float voxelSize);
    gpu::Texture mDistances, mClearance, mNearby, mCoefficients[3];
    gpu::Buffer mParams;
};

/// What the boundaries take on the device.
std::vector<gpu::Need> boundaryNeeds(const Scene& scene);

/// What is known of boundaries in every voxel of the domain, x fastest.
struct BoundaryTable {
    /// How far its centre is from any boundary at least [voxel]: exact up to 4 voxels where the
    /// level sets are, of one object alone negative inside.
    std::vector<float> clearance;
    /// Of several objects: those that hold its centre (low 16 bits), those near it (high 16).
    std::vector<std::uint32_t> objects;
};
BoundaryTable tabulate(const Scene& scene);

/// The coefficients of a cubic B-spline of an object's distances, from one voxel before its box to
/// two behind along x, y and z, x fastest [voxel]. Each is made from its neighbours alone: they
/// make a spline that follows any cubic exactly, and a crease or the band's edge is felt no further
/// off. The kink between the faces of a thin wall is kept out of their bend.
std::vector<float> coefficientsOf(const Object& object);

} // namespace eikonal::scene
