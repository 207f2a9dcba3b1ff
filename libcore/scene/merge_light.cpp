// The light that was stored in scenes that are made one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/merge_light.h"

#include "scene/lattice.h"
#include "volume/make_bricks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <tbb/parallel_sort.h>

namespace eikonal::scene {

namespace {

using glm::dvec3;
using glm::ivec3;
using glm::vec3;

/// Light is looked up so far outside of what scatters it [voxel].
constexpr float kReach = 3;

/// Where a fine voxel's middle is [voxel].
dvec3 middleOf(const ivec3& fine, int detail) {
    return (dvec3(fine) + 0.5) / static_cast<double>(detail) - 0.5;
}

/// Which part's light a voxel has: that of the nearest object which scatters; −1 where none is
/// near.
class LightOwners {
public:
    LightOwners(const Scene& scene, const std::vector<size_t>& origins)
        : mScene(scene), mOrigins(origins) {
        for (size_t k = 0; k < scene.objects.size(); ++k)
            if (!scene.regions[k].scattering.isZero()) mObjects.push_back(k);
    }

    bool any() const { return !mObjects.empty(); }

    bool isFar(size_t brick, const volume::BrickGrid& shape) const {
        const ivec3 low = shape.voxelOf(brick);
        return std::all_of(mObjects.begin(), mObjects.end(), [&](size_t k) {
            const volume::IndexBox& box = mScene.objects[k].box;
            const volume::IndexBox shared{glm::max(low, box.min),
                                          glm::min(low + volume::kBrick - 1, box.max)};
            return shared.empty();
        });
    }

    int at(const ivec3& voxel) const {
        int owner = -1;
        float least = kReach;
        for (const size_t k : mObjects) {
            const float distance = mScene.objects[k].distance.at(voxel);
            if (distance >= least) continue;
            least = distance;
            owner = static_cast<int>(mOrigins[k]);
            if (distance < 0) break; // the first that holds it
        }
        return owner;
    }

private:
    const Scene& mScene;
    const std::vector<size_t>& mOrigins;
    std::vector<size_t> mObjects;
};

vec3 valueAt(const Values& values, const dvec3& place) {
    if (!values.varies()) return values.value;
    vec3 value;
    for (int c = 0; c < 3; ++c)
        value[c] = linearAt(values.grid, place, values.grid.components == 1 ? 0 : c);
    return value;
}

/// Values of media by voxel, `value(part, place in it)`.
template<typename Value>
Values byOwner(const Scene& scene, const LightOwners& owners,
               const std::vector<Resampler>& resamplers, const Value& value) {
    Values result;
    const volume::IndexBox& domain = scene.domain;
    const volume::BrickGrid shape(domain.size(), domain.firstBrick(), 0);
    result.grid = volume::makeBricks(
        domain.size(), domain.firstBrick(), 3,
        [&](size_t brick) { return owners.isFar(brick, shape); },
        [&](const ivec3& voxel, float* out) {
            const int owner = owners.at(voxel);
            vec3 found(0);
            if (owner >= 0) {
                const auto part = static_cast<size_t>(owner);
                found = value(part, resamplers[part].placeOf(dvec3(voxel)));
            }
            for (int c = 0; c < 3; ++c) out[c] = found[c];
        });
    return result;
}

/// What a part's fine voxel gives one of the merged scene.
struct Share {
    std::uint32_t place, within; ///< the voxel's place in the domain, the fine one's in that
    float weight;
    size_t order; ///< in which it was given
    vec3 weighed;

    bool isOf(const Share& other) const { return place == other.place && within == other.within; }
};

class SurfaceMerger {
public:
    SurfaceMerger(const Scene& scene, int detail) : mScene(scene), mDetail(detail) {
        for (size_t k = 0; k < scene.objects.size(); ++k)
            if (scene.regions[k].opaque) mOpaque.push_back(k);
    }

    /// Adds a part's light: each of its fine voxels weighs by how near it is, none beyond its
    /// neighbours.
    void add(const SurfaceLight& light, const Resampler& resampler) {
        const int detail = light.voxels.detail;
        const double reach = resampler.scale() / detail * mDetail * std::sqrt(3.0);
        light.voxels.forEach([&](std::uint32_t number, const ivec3& fine) {
            const dvec3 middle = resampler.placeOnto(middleOf(fine, detail));
            const dvec3 at = (middle + 0.5) * static_cast<double>(mDetail) - 0.5;
            const ivec3 low = glm::max(ivec3(glm::ceil(at - reach)), ivec3(0));
            const ivec3 high = glm::min(ivec3(glm::floor(at + reach)), mScene.size() * mDetail - 1);
            for (int z = low.z; z <= high.z; ++z)
                for (int y = low.y; y <= high.y; ++y)
                    for (int x = low.x; x <= high.x; ++x) {
                        const dvec3 place = resampler.placeOf(middleOf({x, y, z}, mDetail));
                        const dvec3 off = glm::abs((place + 0.5) * static_cast<double>(detail) -
                                                   0.5 - dvec3(fine));
                        const dvec3 weights = glm::max(1.0 - off, dvec3(0));
                        const auto weight = static_cast<float>(weights.x * weights.y * weights.z);
                        if (weight > 1e-6F && isOnSurface({x, y, z}))
                            give({x, y, z}, weight, light.values[number]);
                    }
        });
    }

    SurfaceLight finish() {
        tbb::parallel_sort(mShares.begin(), mShares.end(), [](const Share& a, const Share& b) {
            return a.place != b.place     ? a.place < b.place
                   : a.within != b.within ? a.within < b.within
                   : a.weight != b.weight ? a.weight < b.weight
                                          : a.order < b.order;
        });
        SurfaceLight light;
        const auto words = static_cast<size_t>(maskWords(mDetail));
        std::vector<std::uint32_t> places, masks;
        for (size_t i = 0; i < mShares.size();) {
            const Share& first = mShares[i];
            if (places.empty() || places.back() != first.place) {
                places.push_back(first.place);
                masks.resize(masks.size() + words);
            }
            masks[masks.size() - words + first.within / 32] |= 1u << (first.within & 31u);
            float weight = 0;
            vec3 sum(0);
            for (; i < mShares.size() && mShares[i].isOf(first); ++i) {
                weight += mShares[i].weight;
                sum += mShares[i].weighed;
            }
            light.values.push_back(sum / weight);
        }
        if (!places.empty()) light.voxels = SurfaceVoxels(mScene.size(), mDetail, places, masks);
        return light;
    }

private:
    /// Whether an opaque boundary passes it or one beside it.
    bool isOnSurface(const ivec3& fine) const {
        const dvec3 place = middleOf(fine, mDetail);
        const float near = 2.6F / static_cast<float>(mDetail); // 1½ diagonals
        return std::any_of(mOpaque.begin(), mOpaque.end(), [&](size_t k) {
            return std::abs(linearAt(mScene.objects[k].distance, place, 0)) < near;
        });
    }

    void give(const ivec3& fine, float weight, const vec3& value) {
        const ivec3 voxel = fine / mDetail, in = fine - voxel * mDetail;
        mShares.push_back(
            {static_cast<std::uint32_t>(placeOf(mScene.size(), voxel.x, voxel.y, voxel.z)),
             static_cast<std::uint32_t>((in.z * mDetail + in.y) * mDetail + in.x), weight,
             mShares.size(), weight * value});
    }

    const Scene& mScene;
    int mDetail;
    std::vector<size_t> mOpaque;
    std::vector<Share> mShares;
};

SurfaceLight mergedSurfaces(const Scene& scene, const std::vector<Part>& parts,
                            const std::vector<Resampler>& resamplers) {
    double wanted = 1;
    for (size_t p = 0; p < parts.size(); ++p)
        if (const SurfaceLight& light = parts[p].scene->light.surfaces; !light.empty())
            wanted = std::max(wanted, light.voxels.detail / resamplers[p].scale());
    const double kRounding = 1e-6;
    SurfaceMerger merger(scene,
                         std::min(static_cast<int>(std::ceil(wanted - kRounding)), kMostDetail));
    for (size_t p = 0; p < parts.size(); ++p)
        if (const SurfaceLight& light = parts[p].scene->light.surfaces; !light.empty())
            merger.add(light, resamplers[p]);
    return merger.finish();
}

} // namespace

StoredLight mergedLight(const Scene& scene, const std::vector<Part>& parts,
                        const std::vector<Resampler>& resamplers,
                        const std::vector<size_t>& origins) {
    StoredLight light;
    light.surfaces = mergedSurfaces(scene, parts, resamplers);
    const LightOwners owners(scene, origins);
    const auto anyHas = [&](Values StoredLight::*values) {
        return std::any_of(parts.begin(), parts.end(),
                           [&](const Part& part) { return !(part.scene->light.*values).isZero(); });
    };
    if (!owners.any() || !anyHas(&StoredLight::fluence)) return light;
    light.fluence = byOwner(scene, owners, resamplers, [&](size_t part, const dvec3& place) {
        return valueAt(parts[part].scene->light.fluence, place);
    });
    if (!anyHas(&StoredLight::direction)) return light;
    // In the world as it is, not as their files were lit.
    light.direction = byOwner(scene, owners, resamplers, [&](size_t part, const dvec3& place) {
        const Scene& from = *parts[part].scene;
        return vec3(from.turned * dvec3(valueAt(from.light.direction, place)));
    });
    return light;
}

} // namespace eikonal::scene
