// Objects' boundaries on the device, as shaders/medium/surface.glsl reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"
#include "medium/objects.h"

namespace eikonal::medium {

/// The switches SOLIDS and VARIES of the kernels that include surface.glsl and region.glsl.
gpu::Switches surfaceSwitches(const Objects& objects);

class Surfaces {
public:
    Surfaces() = default;
    /// Lengths become voxels by `voxelSize` [unit]. Throws MemoryError if the device can't hold it.
    Surfaces(gpu::Device& device, const Objects& objects, double voxelSize);

    /// At the units and the binding that shaders/medium/surface.glsl names.
    void bind() const;

private:
    void makeCoefficients(gpu::Device& device, const Objects& objects, float voxelSize);
    gpu::Texture mDistances, mClearance, mNearby, mCoefficients[3];
    gpu::Buffer mParams;
};

/// What the boundaries take on the device.
std::vector<gpu::Need> surfaceNeeds(const Objects& objects);

/// What is known of boundaries in every voxel of the domain, x fastest.
struct BoundaryTable {
    /// How far its centre is from any boundary at least [voxel]: exact up to 4 voxels where the
    /// level sets are, of one solid alone negative inside.
    std::vector<float> clearance;
    /// Of several solids: those that hold its centre (low 16 bits), those near it (high 16).
    std::vector<std::uint32_t> solids;
};
BoundaryTable tabulate(const Objects& objects);

/// The coefficients of a cubic B-spline of a solid's distances, from one voxel before its box to
/// two behind along x, y and z, x fastest [voxel]. Each is made from its neighbours alone: they
/// make a spline that follows any cubic exactly, and a crease or the band's edge is felt no further
/// off. The kink between the faces of a thin wall is kept out of their bend.
std::vector<float> coefficientsOf(const Solid& solid);

} // namespace eikonal::medium
