// Scenes with sharp boundaries whose domains overlap, made one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/merge.h"

#include "base/error.h"
#include "base/text.h"
#include "scene/index.h"
#include "scene/merge_light.h"
#include "scene/resample.h"
#include "scene/shared.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace eikonal::scene {

namespace {

using glm::dvec3;
using glm::ivec3;

/// Voxels of a domain, whose places are counted by 32 bits elsewhere.
constexpr double kMostVoxels = 4294967295.0;

void requireMergeable(const std::vector<Part>& parts) {
    for (size_t i = parts.size(); i-- > 0;) {
        const Scene &scene = *parts[i].scene, &other = *parts[i == 0 ? 1 : 0].scene;
        const std::string overlaps =
            scene.path + ": its domain overlaps that of " + other.path + ", expected them apart: ";
        if (!scene.sharp) throw DataError(overlaps + "its boundaries are blurred");
        if (scene.anyVaryingCrystal())
            throw DataError(overlaps + "it has a crystal that varies within");
        if (!scene.isClearAround())
            throw DataError(overlaps + "what surrounds its objects is no clear, even medium");
    }
}

/// The place of the part whose lattice the merged scene has, but for its fineness.
size_t leadingPart(const std::vector<Part>& parts) {
    size_t finest = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].ground) return i;
        if (parts[i].scene->voxelSize() < parts[finest].scene->voxelSize()) finest = i;
    }
    return finest;
}

double finestOf(const std::vector<Part>& parts) {
    double finest = std::numeric_limits<double>::max();
    for (const Part& part : parts) finest = std::min(finest, part.scene->voxelSize());
    return finest;
}

/// A scene without objects that holds all parts' domains.
Scene frameRound(const std::vector<Part>& parts) {
    const Scene& leader = *parts[leadingPart(parts)].scene;
    Scene scene;
    scene.path = parts.front().scene->path;
    scene.sharp = true;
    scene.frame = leader.frame;
    const double finest = finestOf(parts), scale = finest / leader.voxelSize();
    for (int axis = 0; axis < 3; ++axis) scene.frame.worldFromIndex[axis] *= scale;
    scene.frame.voxelSize = finest;
    const glm::dmat4 indexFromWorld = scene.frame.indexFromWorld();
    dvec3 low(std::numeric_limits<double>::max()), high = -low;
    for (const Part& part : parts) {
        const glm::dmat4 onto = indexFromWorld * glm::inverse(part.scene->voxelFromWorld());
        for (int i = 0; i < 8; ++i) {
            const dvec3 corner = dvec3(part.scene->size()) * dvec3(i & 1, i >> 1 & 1, i >> 2) - 0.5;
            const dvec3 place(onto * glm::dvec4(corner, 1));
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    }
    const double kRounding = 1e-6; // [voxel]
    const dvec3 first = glm::floor(low + 0.5 + kRounding), last = glm::ceil(high - 0.5 - kRounding);
    const dvec3 size = last - first + 1.0;
    if (size.x * size.y * size.z > kMostVoxels)
        throw MemoryError(scene.path + ": the domains that overlap it make one of " +
                          toText(size.x) + " x " + toText(size.y) + " x " + toText(size.z) +
                          " voxels of " + toText(finest) + ", expected 2^32 at most");
    scene.domain = {ivec3(first), ivec3(last)};
    return scene;
}

/// An object of a part, by that part's number and its own.
struct Source {
    size_t part, object;
};

/// Those that win where they overlap first.
std::vector<Source> inPrecedence(const std::vector<Part>& parts, size_t leader) {
    std::vector<Source> sources;
    for (size_t p = parts.size(); p-- > 0;)
        for (size_t k = 0; k < parts[p].scene->objects.size(); ++k) {
            // Of one plane that several parts have, one is enough.
            const bool again =
                parts[p].ground && p != leader && parts[p].ground->region == static_cast<int>(k);
            if (!again) sources.push_back({p, k});
        }
    std::stable_sort(sources.begin(), sources.end(), [&](const Source& a, const Source& b) {
        return parts[a.part].scene->regions[a.object].priority >
               parts[b.part].scene->regions[b.object].priority;
    });
    if (sources.size() > static_cast<size_t>(kMostObjects))
        throw DataError(parts.front().scene->path + ": " + std::to_string(sources.size()) +
                        " objects in domains that overlap, expected at most " +
                        std::to_string(kMostObjects));
    return sources;
}

Region resampledRegion(const Region& region, const Resampler& resampler, const Object& object) {
    Region result = region;
    for (const RegionValues values : {&Region::index, &Region::dispersion, &Region::absorption,
                                      &Region::scattering, &Region::anisotropy, &Region::emission})
        result.*values = resampler.values(region.*values, object);
    return result;
}

} // namespace

Merged merge(const std::vector<Part>& parts) {
    requireMergeable(parts);
    Merged merged{frameRound(parts), {}};
    Scene& scene = merged.scene;
    std::vector<Resampler> resamplers;
    for (const Part& part : parts) resamplers.emplace_back(*part.scene, scene);
    const size_t leader = leadingPart(parts);
    std::vector<size_t> origins;
    for (const auto& [p, k] : inPrecedence(parts, leader)) {
        const Scene& from = *parts[p].scene;
        const bool isGround = parts[p].ground && parts[p].ground->region == static_cast<int>(k);
        scene.objects.push_back(makeObject(resamplers[p].distances(from.objects[k], isGround)));
        scene.regions.push_back(
            resampledRegion(from.regions[k], resamplers[p], scene.objects.back()));
        origins.push_back(p);
        if (!isGround) continue;
        merged.ground = parts[p].ground;
        merged.ground->region = static_cast<int>(scene.regions.size()) - 1;
        merged.ground->low = resamplers[p].placeOnto(parts[p].ground->low);
        merged.ground->high = resamplers[p].placeOnto(parts[p].ground->high);
    }
    scene.regions.push_back(parts.front().scene->medium());
    for (const Part& part : parts) {
        scene.disperses |= part.scene->disperses;
        if (part.ground && !merged.ground) merged.ground = part.ground;
    }
    scene.index = varyingIndex(scene);
    for (const Part& part : parts) scene.index.inHalf |= part.scene->index.inHalf;
    scene.light = mergedLight(scene, parts, resamplers, origins);
    scene.layout = layoutOf(scene);
    return merged;
}

} // namespace eikonal::scene
