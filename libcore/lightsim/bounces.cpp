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

// Rounds in which patches share their light with those next to them: k of them spread it as far as
// a Gauss curve of variance k/2 does [voxel²], over about 1 + 2πk patches.
constexpr int kMostRounds = 8;
// Photons that a patch wants, shares of others included: a noise of 5 %, which interpolation
// halves.
constexpr double kEnough = 400;
// The least cosine between normals of one surface.
constexpr float kSameSide = 0.8F;

void add(SurfacePatch& sum, const SurfacePatch& patch, float weight) {
    sum.power += weight * patch.power;
    sum.flow += weight * patch.flow;
    sum.area += weight * patch.area;
}

/// Falls to 0 that far off along any axis.
float tentOf(const vec3& off, float reach) {
    const vec3 tent = glm::max(reach - glm::abs(off), 0.0F);
    return tent.x * tent.y * tent.z;
}

std::uint32_t placeIn(const ivec3& size, const ivec3& voxel) {
    return static_cast<std::uint32_t>(scene::placeOf(size, voxel.x, voxel.y, voxel.z));
}

/// Of what one patch draws from another that is next to it: 1 in all over voxels of a plane along
/// the axes.
float shareOf(const SurfacePatch& patch, const SurfacePatch& other) {
    return tentOf(vec3(other.voxel - patch.voxel), 2) / 32;
}

constexpr std::uint32_t kNoPatch = 0xFFFFFFFFU;

/// Rounds after which a patch that then has so much has enough photons.
double roundsFor(const SurfacePatch& patch, double photon) {
    const double power = (patch.power.x + patch.power.y + patch.power.z) / 3;
    if (!(power > 0)) return kMostRounds;
    const double patches = kEnough * photon * static_cast<double>(patch.area) / power;
    return std::clamp((patches - 1) / (2 * 3.14159265358979), 0.0, double{kMostRounds});
}

} // namespace

bool areOne(const vec3& normal, const vec3& other) {
    return glm::dot(normal, other) >= kSameSide;
}

void gather(SurfacePatches& patches, const SurfacePatch& part) {
    size_t i = patches.all.size();
    while (i > 0 && patches.all[i - 1].voxel == part.voxel &&
           !areOne(patches.all[i - 1].normal, part.normal))
        --i;
    if (i > 0 && patches.all[i - 1].voxel == part.voxel) {
        add(patches.all[--i], part, 1);
    } else {
        i = patches.all.size();
        patches.all.push_back(part);
    }
    patches.ofFine.push_back(static_cast<std::uint32_t>(i));
}

BouncedLight::BouncedLight(const ivec3& size, SurfacePatches patches, double photon)
    : mSize(size), mPatches(std::move(patches)), mFirst(mPatches.all.size() + 1) {
    for (const auto& link : mPatches.links) ++mFirst[link.first + 1];
    for (size_t i = 1; i < mFirst.size(); ++i) mFirst[i] += mFirst[i - 1];
    share(photon);
}

void BouncedLight::share(double photon) {
    using Patches = std::vector<SurfacePatch>;
    const auto shared = [&](const Patches& patches) {
        Patches sums = patches;
        tbb::parallel_for(size_t{0}, sums.size(), [&](size_t i) {
            SurfacePatch& sum = sums[i];
            sum.power = sum.flow = vec3(0);
            sum.area = 0;
            add(sum, patches[i], shareOf(sum, sum));
            for (size_t k = mFirst[i]; k < mFirst[i + 1]; ++k) {
                const SurfacePatch& other = patches[mPatches.links[k].second];
                add(sum, other, shareOf(sum, other));
            }
        });
        return sums;
    };
    Patches wide = mPatches.all;
    for (int round = 0; round < kMostRounds; ++round) wide = shared(wide);
    Patches level = mPatches.all;
    for (int round = 0; round <= kMostRounds; ++round) {
        if (round > 0) level = shared(level);
        tbb::parallel_for(size_t{0}, level.size(), [&](size_t i) {
            SurfacePatch& sum = mPatches.all[i];
            if (round == 0) {
                sum.power = sum.flow = vec3(0);
                sum.area = 0;
            }
            const double off = std::abs(roundsFor(wide[i], photon) - round);
            if (off < 1) add(sum, level[i], static_cast<float>(1 - off));
        });
    }
}

LightAtPoint BouncedLight::about(std::uint32_t patch, const vec3& x) const {
    // Falls to 0 where it leaves the voxels next to the patch's.
    SurfacePatch sum;
    const auto take = [&](const SurfacePatch& one) {
        add(sum, one, tentOf(x - vec3(one.voxel), 1.5F));
    };
    take(mPatches.all[patch]);
    for (size_t k = mFirst[patch]; k < mFirst[patch + 1]; ++k)
        take(mPatches.all[mPatches.links[k].second]);
    if (!(sum.area > 0)) return {};
    return {sum.power / sum.area, sum.flow / sum.area};
}

LightAtPoint BouncedLight::ofFine(std::uint32_t number, const vec3& x) const {
    return about(mPatches.ofFine[number], x);
}

/// That which faces the point's way best, of the voxels next to it.
std::uint32_t BouncedLight::patchNear(const vec3& x, const vec3& normal) const {
    // As floats: whole numbers may not hold a place far off.
    const vec3 far = glm::floor(x + 0.5F);
    if (far != glm::clamp(far, vec3(-1), vec3(mSize))) return kNoPatch;
    const ivec3 voxel(far);
    const ivec3 low = glm::max(voxel - 1, ivec3(0)), high = glm::min(voxel + 1, mSize - 1);
    const auto before = [&](const SurfacePatch& patch, std::uint32_t place) {
        return placeIn(mSize, patch.voxel) < place;
    };
    std::uint32_t best = kNoPatch;
    float most = 0;
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y) { // those of a row follow one another
            const std::uint32_t last = placeIn(mSize, {high.x, y, z});
            auto at = std::lower_bound(mPatches.all.begin(), mPatches.all.end(),
                                       placeIn(mSize, {low.x, y, z}), before);
            for (; at != mPatches.all.end() && placeIn(mSize, at->voxel) <= last; ++at) {
                const float faces =
                    glm::dot(at->normal, normal) * tentOf(x - vec3(at->voxel), 1.5F);
                if (faces <= most) continue;
                most = faces;
                best = static_cast<std::uint32_t>(at - mPatches.all.begin());
            }
        }
    return best;
}

LightAtPoint BouncedLight::at(const vec3& x, const vec3& normal) const {
    const std::uint32_t patch = patchNear(x, normal);
    return patch == kNoPatch ? LightAtPoint{} : about(patch, x);
}

} // namespace eikonal::lightsim
