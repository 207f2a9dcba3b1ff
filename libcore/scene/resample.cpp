// What one scene's grids hold, on the voxels of another one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/resample.h"

#include "volume/make_bricks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

namespace eikonal::scene {

namespace {

using glm::dvec3;
using glm::ivec3;
using volume::BrickGrid;
using volume::IndexBox;
using volume::kBrick;

/// From a brick's middle to its corner, rounded up [voxel].
constexpr double kBrickReach = 7;

/// Distances are made this far out of a boundary [voxel]: what splines and steps look up.
constexpr float kMade = 6;

/// What four neighbours count for at a share of the way from the second to the third.
std::array<double, 4> cubicWeights(double t) {
    const double s = 1 - t;
    return {-0.5 * t * s * s, 1 - t * t * (2.5 - 1.5 * t), 1 - s * s * (2.5 - 1.5 * s),
            -0.5 * s * t * t};
}

float cubicAt(const BrickGrid& grid, const dvec3& place) {
    const dvec3 low = glm::floor(place);
    const ivec3 base(low);
    std::array<std::array<double, 4>, 3> weights;
    for (int axis = 0; axis < 3; ++axis)
        weights[static_cast<size_t>(axis)] = cubicWeights(place[axis] - low[axis]);
    double sum = 0;
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 4; ++y) {
            const double yz =
                weights[1][static_cast<size_t>(y)] * weights[2][static_cast<size_t>(z)];
            for (int x = 0; x < 4; ++x) {
                const ivec3 voxel = glm::clamp(base + ivec3(x, y, z) - 1, ivec3(0), grid.size - 1);
                sum += weights[0][static_cast<size_t>(x)] * yz * double{grid.at(voxel)};
            }
        }
    return static_cast<float>(sum);
}

/// How far out of a domain's faces a place is, negative within.
double wayOut(const dvec3& place, const ivec3& size) {
    const dvec3 half = 0.5 * dvec3(size);
    const dvec3 off = glm::abs(place - (half - 0.5)) - half;
    return glm::length(glm::max(off, dvec3(0))) + std::min(std::max({off.x, off.y, off.z}), 0.0);
}

/// Whether an object reaches the faces of its domain.
bool isCut(const Object& object) {
    const ivec3 last = object.distance.size - 1;
    return !object.inside.empty() && (glm::any(glm::lessThanEqual(object.inside.min, ivec3(0))) ||
                                      glm::any(glm::greaterThanEqual(object.inside.max, last)));
}

} // namespace

float linearAt(const BrickGrid& grid, const dvec3& place, int component) {
    const dvec3 within = glm::clamp(place, dvec3(0), dvec3(grid.size - 1));
    const ivec3 base = glm::min(ivec3(within), glm::max(grid.size - 2, ivec3(0)));
    const dvec3 t = within - dvec3(base);
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner(i & 1, i >> 1 & 1, i >> 2);
        const dvec3 weight = glm::mix(1.0 - t, t, dvec3(corner));
        const ivec3 voxel = glm::min(base + corner, grid.size - 1);
        sum += weight.x * weight.y * weight.z * double{grid.at(voxel, component)};
    }
    return static_cast<float>(sum);
}

Resampler::Resampler(const Scene& from, const Scene& onto)
    : mFrom(from), mOnto(onto),
      mFromOnto(from.voxelFromWorld() * glm::inverse(onto.voxelFromWorld())),
      mOntoFrom(glm::inverse(mFromOnto)), mScale(from.voxelSize() / onto.voxelSize()) {}

IndexBox Resampler::boxOnto(const IndexBox& voxels, int margin) const {
    dvec3 low(std::numeric_limits<double>::max()), high = -low;
    for (int i = 0; i < 8; ++i) {
        const dvec3 corner = glm::mix(dvec3(voxels.min - margin), dvec3(voxels.max + margin),
                                      dvec3(i & 1, i >> 1 & 1, i >> 2));
        low = glm::min(low, placeOnto(corner));
        high = glm::max(high, placeOnto(corner));
    }
    return {glm::max(ivec3(glm::floor(low)), ivec3(0)),
            glm::min(ivec3(glm::ceil(high)), mOnto.size() - 1)};
}

BrickGrid Resampler::distances(const Object& object, bool goesOn) const {
    const BrickGrid& grid = object.distance;
    const ivec3 size = grid.size;
    const bool cut = !goesOn && isCut(object);
    const auto band = std::min(object.band * static_cast<float>(mScale), kMade);
    const auto far = band / static_cast<float>(mScale) + 1; // [its voxel]
    // The object is within its domain, so that what is beyond is no nearer than by Pythagoras.
    const auto distanceAt = [&](const ivec3& voxel) {
        const dvec3 place = placeOf(dvec3(voxel));
        const dvec3 within = glm::clamp(place, dvec3(0), dvec3(size - 1));
        // Distances differ by no more than places do: most are beyond the band.
        const float nearest = grid.at(ivec3(glm::round(within)));
        double distance = std::abs(nearest) > far ? double{nearest} : double{cubicAt(grid, within)};
        const double beyond = glm::length(place - within);
        if (cut)
            distance = std::max(distance, wayOut(place, size));
        else if (!goesOn && beyond > 0)
            distance = std::hypot(std::max(distance, 0.0), beyond);
        return std::clamp(static_cast<float>(distance * mScale), -band, band);
    };
    const IndexBox& domain = mOnto.domain;
    const BrickGrid shape(domain.size(), domain.firstBrick(), 0);
    std::vector<bool> uneven(shape.page.size());
    for (size_t brick = 0; brick < grid.page.size(); ++brick) {
        if (grid.page[brick] < 0) continue;
        const ivec3 low = grid.voxelOf(brick);
        const IndexBox box = boxOnto({low, low + kBrick - 1}, 2);
        if (box.empty()) continue;
        const ivec3 first = (box.min - shape.first) / kBrick,
                    last = (box.max - shape.first) / kBrick;
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x)
                    uneven[(static_cast<size_t>(z) * shape.bricks.y + y) * shape.bricks.x + x] =
                        true;
    }
    // Beyond the domain's faces, and where they cut.
    const auto isUneven = [&](size_t brick) {
        const ivec3 low = shape.voxelOf(brick);
        const double out = wayOut(placeOf(dvec3(low) + 0.5 * (kBrick - 1)), size) * mScale;
        const double reach = kBrickReach + double{band};
        if (!goesOn)
            return cut ? std::abs(out) < reach
                       : std::abs(out) < kBrickReach || (out > 0 && out < reach);
        if (out < -kBrickReach) return false;
        const float first = distanceAt(low); // a plane's: corners tell
        for (int i = 0; i < 8; ++i)
            if (const float d = distanceAt(low + (kBrick - 1) * ivec3(i & 1, i >> 1 & 1, i >> 2));
                std::abs(d) < band || d != first)
                return true;
        return false;
    };
    for (size_t brick = 0; brick < uneven.size(); ++brick)
        if (!uneven[brick] && isUneven(brick)) uneven[brick] = true;
    return volume::makeBricks(
        domain.size(), domain.firstBrick(), 1, [&](size_t brick) { return !uneven[brick]; },
        [&](const ivec3& voxel, float* out) { *out = distanceAt(voxel); });
}

Values Resampler::values(const Values& from, const Object& about) const {
    if (!from.varies()) return from;
    Values result;
    result.value = from.value;
    const int components = from.grid.components;
    const IndexBox& domain = mOnto.domain;
    const BrickGrid shape(domain.size(), domain.firstBrick(), 0);
    const auto isFar = [&](size_t brick) {
        const ivec3 low = shape.voxelOf(brick);
        const IndexBox shared{glm::max(low, about.box.min),
                              glm::min(low + kBrick - 1, about.box.max)};
        return shared.empty();
    };
    result.grid = volume::makeBricks(domain.size(), domain.firstBrick(), components, isFar,
                                     [&](const ivec3& voxel, float* out) {
                                         const dvec3 place = placeOf(dvec3(voxel));
                                         for (int c = 0; c < components; ++c)
                                             out[c] = linearAt(from.grid, place, c);
                                     });
    return result;
}

} // namespace eikonal::scene
