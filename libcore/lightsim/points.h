// Light for single points of opaque surfaces, those that a picture shows.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Barczak and Olano gather caustics in a buffer of the screen's size. Here the points say which
// surface voxels receive light, and how fine those are; each point then reads them as render does.
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"
#include "lightsim/opaque_surfaces.h"
#include "lightsim/params.h"
#include "lightsim/result.h"
#include "scene/surface_voxels.h"

#include <vector>

namespace eikonal::lightsim {

/// A picture's points in voxel space.
std::vector<PointOnSurface> pointsInVoxels(const Points& points, const scene::Scene& scene);

/// Of surfaces what is so near a point that its light depends on it. `detail` 0: fine voxels as
/// large as what lies between neighbouring points, if memory allows.
OpaqueSurfaces surfacesNear(const OpaqueSurfaces& surfaces,
                            const std::vector<PointOnSurface>& points, int width,
                            const glm::ivec3& size, int detail);

/// What they take on the device.
std::vector<gpu::Need> pointNeeds(const std::vector<PointOnSurface>& points);

class PointReader {
public:
    /// `channels` of irradiance are stored, 1 or 3.
    PointReader(gpu::Device& device, int channels);

    /// `irradiance` is by surface voxels' numbers, its planes followed by three of flow.
    std::vector<LightAtPoint> read(gpu::Device& device, const std::vector<PointOnSurface>& points,
                                   const scene::SurfaceTable& table, const gpu::Texture& irradiance,
                                   std::int64_t surfaceVoxels);

private:
    gpu::Program mProgram;
    gpu::Buffer mBlock;
};

} // namespace eikonal::lightsim
