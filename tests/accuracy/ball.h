// A ball of glass on its way from mesh to voxels, and how far its rays are from Snell's.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"
#include "rays.h"

namespace accuracy {

/// In the box of kBox units.
struct Ball {
    dvec3 centre{kBox / 2}; ///< [unit]
    double radius = 32;     ///< [unit]
    double index = 1.5;     ///< [1]
};

/// 327,680 facets, their corners on the sphere: they cut off 3e-5 of the volume.
eikonal::mesh::TriangleMesh meshOf(const Ball& ball);

/// The ball as `mesh2vol` makes it of its mesh: `sharp` with signed distances, else without.
eikonal::volume::Volume voxelised(Bench& bench, const Ball& ball, int voxels, int supersample,
                                  bool sharp, eikonal::Stats& stats);

/// Its index as `volsmooth` blurs it, σ in voxels.
eikonal::volume::Volume blurred(Bench& bench, const eikonal::volume::Volume& volume, double sigma,
                                eikonal::Stats& stats);

eikonal::scene::Files sceneWith(eikonal::volume::Volume volume);

/// Parallel rays along no axis, the ball in the middle of a square picture so high [unit].
eikonal::view::Camera cameraAt(const Ball& ball, int pixels, double height);

/// Rays whose impact is so many radii: rms of the angle between where they go and where Snell's law
/// sends the ray of their own impact [degree].
double deflectionError(const Ball& ball, const std::vector<judge::Ray>& rays, const Ends& ends,
                       double from, double to);

} // namespace accuracy
