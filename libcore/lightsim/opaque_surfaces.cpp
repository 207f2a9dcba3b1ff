// Where opaque surfaces are, and how finely they receive light.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/opaque_surfaces.h"

#include "base/error.h"
#include "scene/lattice.h"
#include "scene/surface_voxels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;
using scene::Scene;
using volume::kBrick;

// A boundary in a voxel is no farther from its middle [voxel]: half its diagonal, times how much
// faster than by 1 a voxel distances may grow, and some more for the roundness of fine voxels.
constexpr float kReach = 1.3f;

// What `auto` takes of fine voxels: as many as a light's map has points by default, and some.
constexpr double kEnough = 2 << 20;
constexpr int kMostAutomatic = 8;

// A slanting plane passes through so many fine voxels per face of one, in the mean of its poses.
constexpr double kPerFace = 1.8;

bool isAtFace(const ivec3& voxel, const ivec3& size) {
    for (int axis = 0; axis < 3; ++axis)
        if (voxel[axis] == 0 || voxel[axis] == size[axis] - 1) return true;
    return false;
}

bool mayReceive(const Scene& scene, const ivec3& voxel) {
    bool boundary = false, opaque = false;
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        const float distance = scene.objects[k].distance.at(voxel);
        boundary |= std::abs(distance) < kReach;
        opaque |= scene.regions[k].opaque && !scene.regions[k].metal && distance < kReach;
    }
    return opaque && (boundary || isAtFace(voxel, scene.size()));
}

bool mayReceiveBlurred(const Scene& scene, const ivec3& voxel) {
    const scene::Values& opacity = scene.medium().opacity;
    const ivec3 size = scene.size();
    bool clear = isAtFace(voxel, size), opaque = false;
    for (int i = 0; i < 27 && !(clear && opaque); ++i) {
        const ivec3 at = glm::clamp(voxel + ivec3(i % 3, i / 3 % 3, i / 9) - 1, ivec3(0), size - 1);
        const bool stops = opacity.at(at, 0) > 0.5f;
        clear |= !stops;
        opaque |= stops;
    }
    return clear && opaque;
}

/// Whether nothing in a brick, nor next to it, can receive: every object is even there, or blurred,
/// the opacity of it and of its neighbours is one value.
bool isIdle(const Scene& scene, const volume::BrickGrid& bricks, size_t brick) {
    const ivec3 low = bricks.voxelOf(brick);
    for (int axis = 0; axis < 3; ++axis)
        if (low[axis] <= 0 || low[axis] + kBrick >= bricks.size[axis]) return false;
    if (scene.sharp)
        return std::all_of(scene.objects.begin(), scene.objects.end(),
                           [&](const scene::Object& o) { return o.distance.page[brick] < 0; });
    const scene::Values& opacity = scene.medium().opacity;
    if (!opacity.varies()) return true;
    const float first = opacity.grid.even[brick];
    for (int i = 0; i < 27; ++i) {
        const ivec3 at = low + kBrick * (ivec3(i % 3, i / 3 % 3, i / 9) - 1);
        const size_t other = opacity.grid.brickOf(glm::clamp(at, ivec3(0), bricks.size - 1));
        if (opacity.grid.page[other] >= 0 || opacity.grid.even[other] != first) return false;
    }
    return true;
}

} // namespace

int detailFor(size_t voxels) {
    const double perVoxel = kEnough / (kPerFace * static_cast<double>(std::max<size_t>(voxels, 1)));
    return std::clamp(static_cast<int>(std::sqrt(perVoxel)), 2, kMostAutomatic);
}

std::int64_t OpaqueSurfaces::about() const {
    // Of the voxels that may have some, about half do.
    return static_cast<std::int64_t>(0.6 * kPerFace * detail * detail *
                                     static_cast<double>(voxels.size()));
}

OpaqueSurfaces findSurfaces(const Scene& scene, int detail) {
    OpaqueSurfaces found;
    if (!scene.anyMatt()) return found;
    if (scene.voxels() >= std::int64_t{1} << 31)
        throw MemoryError("more than 2^31 voxels hold opaque surfaces that receive light");
    const ivec3 size = scene.size(), first = scene.domain.firstBrick();
    const volume::BrickGrid bricks(size, first, 0);
    std::vector<std::vector<std::uint32_t>> parts(bricks.page.size());
    tbb::parallel_for(size_t{0}, parts.size(), [&](size_t brick) {
        if (isIdle(scene, bricks, brick)) return;
        const ivec3 low = bricks.voxelOf(brick);
        const ivec3 from = glm::max(low, ivec3(0)), to = glm::min(low + kBrick, size);
        for (int z = from.z; z < to.z; ++z)
            for (int y = from.y; y < to.y; ++y)
                for (int x = from.x; x < to.x; ++x)
                    if (scene.sharp ? mayReceive(scene, {x, y, z})
                                    : mayReceiveBlurred(scene, {x, y, z}))
                        parts[brick].push_back(
                            static_cast<std::uint32_t>(scene::placeOf(size, x, y, z)));
    });
    for (const auto& part : parts)
        found.voxels.insert(found.voxels.end(), part.begin(), part.end());
    std::sort(found.voxels.begin(), found.voxels.end());
    found.detail = detail > 0 ? detail : detailFor(found.voxels.size() / 2);
    return found;
}

} // namespace eikonal::lightsim
