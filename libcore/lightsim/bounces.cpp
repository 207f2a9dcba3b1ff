// Light that opaque surfaces have reflected: power by voxels, spread over the surface they are on.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/bounces.h"

#include "scene/lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;
using glm::vec3;

// How far patches share their light at most [voxel].
constexpr int kReach = 2;
// Photons that a patch wants, its neighbours' included: a noise of 5 %, which interpolation halves.
constexpr double kEnough = 400;
// The cosine between normals of one patch, and of one surface.
constexpr float kSamePatch = 0.8F;
constexpr float kSameSide = 0.7F;

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

/// What falls to 0 that far off along any axis.
float tentOf(const vec3& off, float reach) {
    const vec3 tent = glm::max(reach - glm::abs(off), 0.0F);
    return tent.x * tent.y * tent.z;
}

std::uint32_t placeIn(const ivec3& size, const ivec3& voxel) {
    return static_cast<std::uint32_t>(scene::placeOf(size, voxel.x, voxel.y, voxel.z));
}

} // namespace

void gather(std::vector<SurfacePatch>& patches, const SurfacePatch& part) {
    for (auto patch = patches.rbegin(); patch != patches.rend() && patch->voxel == part.voxel;
         ++patch) {
        if (glm::dot(patch->normal, part.normal) < kSamePatch) continue;
        return add(*patch, part, 1);
    }
    patches.push_back(part);
}

SoftLight::SoftLight(const ivec3& size, std::vector<SurfacePatch> patches, double photon)
    : mSize(size), mPatches(std::move(patches)) {
    mPlaces.reserve(mPatches.size());
    for (const SurfacePatch& patch : mPatches) mPlaces.push_back(placeIn(mSize, patch.voxel));
    std::vector<SurfacePatch> soft(mPatches.size());
    tbb::parallel_for(size_t{0}, soft.size(),
                      [&](size_t i) { soft[i] = smoothed(mPatches[i], photon); });
    mPatches = std::move(soft);
}

template<typename Visit> void SoftLight::forEachIn(const ivec3& voxel, const Visit& visit) const {
    if (voxel != glm::clamp(voxel, ivec3(0), mSize - 1)) return;
    const std::uint32_t place = placeIn(mSize, voxel);
    const auto first = std::lower_bound(mPlaces.begin(), mPlaces.end(), place);
    for (auto at = first; at != mPlaces.end() && *at == place; ++at)
        visit(mPatches[static_cast<size_t>(at - mPlaces.begin())]);
}

SurfacePatch SoftLight::smoothed(const SurfacePatch& patch, double photon) const {
    const auto summed = [&](float reach) {
        SurfacePatch sum = patch;
        sum.power = sum.flow = vec3(0);
        sum.area = 0;
        const int most = static_cast<int>(std::ceil(reach)) - 1;
        float row = 0; // so that what is shared out widely counts no more than the rest
        for (int i = -most; i <= most; ++i) row += reach - static_cast<float>(std::abs(i));
        forEachNear(most, [&](const ivec3& off) {
            forEachIn(patch.voxel + off, [&](const SurfacePatch& other) {
                if (glm::dot(other.normal, patch.normal) < kSameSide) return;
                add(sum, other, tentOf(vec3(off), reach) / (reach * row * row));
            });
        });
        return sum;
    };
    const SurfacePatch wide = summed(kReach + 1);
    const double power = (wide.power.x + wide.power.y + wide.power.z) / 3;
    if (!(power > 0)) return wide;
    // Over a plane a tent has the noise of a square whose edge is 1½ times its reach.
    const double reach = std::sqrt(kEnough * photon * wide.area / power) / 1.5;
    if (reach >= kReach + 1) return wide;
    return summed(static_cast<float>(std::max(reach, 1.0)));
}

SoftLight::Near SoftLight::near(const ivec3& voxel) const {
    Near found{voxel, {}};
    forEachNear(1, [&](const ivec3& off) {
        forEachIn(voxel + off, [&](const SurfacePatch& patch) { found.patches.push_back(&patch); });
    });
    return found;
}

LightAtPoint SoftLight::at(const Near& near, const vec3& x, const vec3& normal) {
    // Those of the point's own surface, or where it bends too much, of what faces its way at all.
    for (const float least : {kSameSide, 0.0F}) {
        SurfacePatch sum;
        for (const SurfacePatch* patch : near.patches)
            // Falls to 0 where it leaves the voxels that are near.
            if (glm::dot(patch->normal, normal) > least)
                add(sum, *patch, tentOf(x - vec3(patch->voxel), 1.5F));
        if (sum.area > 0) return {sum.power / sum.area, sum.flow / sum.area};
    }
    return {};
}

} // namespace eikonal::lightsim
