// Light that opaque surfaces have reflected: power by voxels, spread over the surface they are on.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/bounces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;
using glm::vec3;

// How far patches share their light [voxel], and the cosine between normals of one surface.
constexpr int kReach = 2;
constexpr float kSameSide = 0.7F;

std::int64_t placeOf(const ivec3& size, const ivec3& voxel) {
    return voxel.x + std::int64_t{size.x} * (voxel.y + std::int64_t{size.y} * voxel.z);
}

/// Calls `visit(offset)` for every voxel of a cube about one.
template<typename Visit> void forEachNear(int reach, const Visit& visit) {
    for (int z = -reach; z <= reach; ++z)
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) visit(ivec3(x, y, z));
}

void add(SurfacePatch& sum, const SurfacePatch& patch, float weight) {
    sum.power += weight * patch.power;
    sum.flow += weight * patch.flow;
    sum.area += weight * patch.area;
}

} // namespace

SoftLight::SoftLight(const ivec3& size, std::vector<SurfacePatch> patches)
    : mSize(size), mPatches(std::move(patches)) {
    std::vector<SurfacePatch> soft(mPatches.size());
    tbb::parallel_for(size_t{0}, soft.size(), [&](size_t i) { soft[i] = smoothed(mPatches[i]); });
    mPatches = std::move(soft);
}

const SurfacePatch* SoftLight::patchOf(const ivec3& voxel) const {
    if (voxel != glm::clamp(voxel, ivec3(0), mSize - 1)) return nullptr;
    const auto before = [&](const SurfacePatch& patch, std::int64_t place) {
        return placeOf(mSize, patch.voxel) < place;
    };
    const std::int64_t place = placeOf(mSize, voxel);
    const auto found = std::lower_bound(mPatches.begin(), mPatches.end(), place, before);
    return found != mPatches.end() && found->voxel == voxel ? &*found : nullptr;
}

SurfacePatch SoftLight::smoothed(const SurfacePatch& patch) const {
    SurfacePatch sum = patch;
    sum.power = sum.flow = vec3(0);
    sum.area = 0;
    forEachNear(kReach, [&](const ivec3& off) {
        const SurfacePatch* other = patchOf(patch.voxel + off);
        if (!other || glm::dot(other->normal, patch.normal) < kSameSide) return;
        const ivec3 tent = kReach + 1 - glm::abs(off);
        add(sum, *other, static_cast<float>(tent.x * tent.y * tent.z));
    });
    return sum;
}

LightAtPoint SoftLight::at(const vec3& x, const vec3& normal) const {
    const vec3 middle = glm::floor(x + 0.5F);
    SurfacePatch sum;
    forEachNear(1, [&](const ivec3& off) {
        const SurfacePatch* patch = patchOf(ivec3(middle) + off);
        if (!patch || glm::dot(patch->normal, normal) < kSameSide) return;
        // Falls to 0 where it leaves the cube of voxels that are looked at.
        const vec3 tent = glm::max(1.5F - glm::abs(x - vec3(patch->voxel)), 0.0F);
        add(sum, *patch, tent.x * tent.y * tent.z);
    });
    if (!(sum.area > 0)) return {};
    return {sum.power / sum.area, sum.flow / sum.area};
}

} // namespace eikonal::lightsim
