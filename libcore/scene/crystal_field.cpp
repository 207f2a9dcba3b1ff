// Crystals that vary within, on the device as shaders/transport/varying_crystal.glsl reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/crystal_field.h"

#include "base/error.h"
#include "scene/lattice.h"
#include "scene/samples.h"
#include "scene/shared.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace eikonal::scene {

namespace {

using glm::ivec3;

// Look-ups on a crystal's behalf reach this far beyond its boundary: a step and a spline [voxel].
constexpr float kLookUps = 4;
constexpr ivec3 kBeyond(2); // coefficients beyond the box on either side

/// D_xx, D_yy, D_zz, n_o, D_yz, D_zx, D_xy in voxel space.
constexpr size_t kParts = 7;
using Parts = std::array<float, kParts>;

Parts partsOf(const Region& region, const ivec3& voxel, const glm::dmat3& voxelFromFile) {
    const auto o = static_cast<double>(region.index.at(voxel, 0));
    const auto e = static_cast<double>(region.indexExtraordinary.at(voxel, 0));
    glm::dvec3 axis(region.axis.at(voxel, 0), region.axis.at(voxel, 1), region.axis.at(voxel, 2));
    const double length = glm::length(axis);
    axis = length > 0 ? voxelFromFile * (axis / length) : glm::dvec3(0);
    const double d = (e - o) * (e + o);
    Parts parts{};
    for (int i = 0; i < 3; ++i) {
        parts[static_cast<size_t>(i)] = static_cast<float>(d * axis[i] * axis[i]);
        parts[static_cast<size_t>(4 + i)] =
            static_cast<float>(d * axis[(i + 1) % 3] * axis[(i + 2) % 3]);
    }
    parts[3] = static_cast<float>(o);
    return parts;
}

/// The crystal that varies and is nearest to a voxel.
size_t nearestTo(const Scene& scene, const ivec3& voxel) {
    size_t nearest = 0;
    float least = 1e9f;
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        if (!scene.regions[k].crystalVaries()) continue;
        const float distance = scene.objects[k].distance.at(voxel);
        if (std::max(distance, least) < kLookUps)
            throw DataError(scene.path + ": crystal '" + scene.regions[k].name +
                            "' varies within, and another less than " +
                            std::to_string(static_cast<int>(2 * kLookUps)) +
                            " voxels off, expected one of them, or more room");
        if (distance >= least) continue;
        least = distance;
        nearest = k;
    }
    return nearest;
}

} // namespace

volume::IndexBox crystalBox(const Scene& scene) {
    volume::IndexBox box;
    for (size_t k = 0; k < scene.objects.size(); ++k)
        if (scene.regions[k].crystalVaries()) box.include(scene.objects[k].inside);
    const ivec3 reach(static_cast<int>(kLookUps));
    return {glm::max(box.min - reach, ivec3(0)), glm::min(box.max + reach, scene.size() - 1)};
}

CrystalField::CrystalField(gpu::Device& device, const Scene& scene) {
    const volume::IndexBox box = crystalBox(scene);
    const glm::dmat3 voxelFromFile = glm::transpose(scene.worldFromVoxelTurn()) * scene.turned;
    std::array<Potential, kParts> splines;
    for (Potential& spline : splines) {
        spline.size = box.size();
        const ivec3 outer = spline.outer();
        spline.values.resize(placeOf(outer, 0, 0, outer.z));
    }
    const ivec3 outer = splines[0].outer();
    for (int z = 0; z < outer.z; ++z)
        for (int y = 0; y < outer.y; ++y)
            for (int x = 0; x < outer.x; ++x) {
                const ivec3 voxel =
                    glm::clamp(box.min + ivec3(x, y, z) - kMargin, ivec3(0), scene.size() - 1);
                const Parts parts =
                    partsOf(scene.regions[nearestTo(scene, voxel)], voxel, voxelFromFile);
                for (size_t i = 0; i < kParts; ++i)
                    splines[i].values[placeOf(outer, x, y, z)] = parts[i];
            }
    for (Potential& spline : splines) makeSpline(spline);
    const ivec3 size = box.size() + 2 * kBeyond;
    mPure = gpu::Texture(device, size, gpu::TexelFormat::rgba32f, gpu::Filter::nearest);
    mMixed = gpu::Texture(device, size, gpu::TexelFormat::rgba32f, gpu::Filter::nearest);
    std::vector<float> pure(4 * placeOf(size, 0, 0, 1)), mixed(pure.size());
    const int skipped = kMargin - kBeyond.x;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const size_t from = placeOf(outer, x + skipped, y + skipped, z + skipped);
                const size_t to = 4 * placeOf(size, x, y, 0);
                for (size_t i = 0; i < 4; ++i) pure[to + i] = splines[i].values[from];
                for (size_t i = 0; i < 3; ++i) mixed[to + i] = splines[4 + i].values[from];
            }
        mPure.uploadSlices(z, 1, pure.data());
        mMixed.uploadSlices(z, 1, mixed.data());
    }
}

void CrystalField::bind() const {
    if (mPure.name() == 0) return;
    mPure.bindSampler(kCrystalsUnit);
    mMixed.bindSampler(kMixedCrystalsUnit);
}

gpu::Need crystalNeed(const Scene& scene) {
    const ivec3 size = crystalBox(scene).size() + 2 * kBeyond;
    return {"crystals that vary", std::int64_t{size.x} * size.y * size.z * 32, false,
            std::max({size.x, size.y, size.z})};
}

} // namespace eikonal::scene
