// Objects' boundaries on the device, as shaders/transport/level_set.glsl reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/boundaries.h"

#include "scene/block_table.h"
#include "scene/clearance.h"
#include "scene/lattice.h"
#include "scene/shared.h"
#include "scene/voxel_textures.h"

#include <algorithm>
#include <glm/vec4.hpp>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec3;

/// Pages of voxels, one behind the other along z, of the regions whose coefficients vary:
/// `pack(region, along, voxel, out)` fills a texel, `along` on a crystal's page of light that is
/// polarised along its axis.
template<typename PackOf>
gpu::Texture makePages(gpu::Device& device, const Scene& scene, bool floorAtZero,
                       const PackOf& pack) {
    const ivec3 page = scene.layout.texels();
    const gpu::TexelFormat format = gpu::TexelFormat::rgba32f;
    gpu::Texture texture(device, {page.x, page.y, page.z * scene.coefficientPages()}, format,
                         gpu::Filter::linear);
    int slice = 0;
    for (const Region& region : scene.regions) {
        for (int i = 0; i < region.coefficientPages(); ++i, slice += page.z)
            fillVoxels(texture, slice, scene.layout, format, floorAtZero,
                       [&](const ivec3& voxel, float* out) { pack(region, i > 0, voxel, out); });
    }
    return texture;
}

} // namespace

Boundaries::Boundaries(gpu::Device& device, const Scene& scene) {
    SceneParams values{};
    mDistances = DistanceAtlas(device, scene.objects);
    values.texel = vec4(1.0f / vec3(mDistances.texels()), 0);
    const BoundaryTable table = tabulate(scene.objects, scene.size());
    const auto edge = static_cast<float>(table.edge);
    values.clearance = vec4(1.0f / (edge * vec3(table.size)), edge);
    values.reach = vec4(vec3(scene.size()) - 1e-3f, cellBlocks(scene.size()).z);
    volume::IndexBox bounds;
    for (const Object& object : scene.objects) bounds.include(object.inside);
    if (bounds.empty()) bounds = {scene.size(), ivec3(-1)}; // which no ray meets
    // So that a boundary on a face of it is within.
    values.low = vec4(vec3(bounds.min) - 0.6f, 0);
    values.high = vec4(vec3(bounds.max) + 0.6f, 0);
    const auto h = static_cast<float>(scene.voxelSize());
    const ivec3 page = scene.layout.texels();
    int pages = 0;
    values.page =
        vec4(1.0f / vec3(page.x, page.y, page.z * std::max(scene.coefficientPages(), 1)), 0);
    for (size_t r = 0; r < scene.regions.size(); ++r) {
        const Region& region = scene.regions[r];
        values.regions[r] = paramsOf(region, h, scene.worldFromVoxelTurn(), page.z * pages, page.z);
        pages += region.coefficientPages();
    }
    if (areMany(scene.objects)) {
        const BlockTable blocks(scene.objects);
        for (size_t k = 0; k < scene.objects.size(); ++k)
            values.boxes[k] = {ivec4(blocks.boxes[k].low, blocks.boxes[k].begin),
                               ivec4(blocks.boxes[k].size, 0)};
    }
    if (scene.anyVaryingCrystal()) values.crystals = vec4(vec3(crystalBox(scene).min), 0);
    mParams = gpu::Buffer(device, sizeof values, &values);
    if (pages > 0) makeCoefficients(device, scene, h);
    if (scene.anyVaryingCrystal()) mCrystals = CrystalField(device, scene);
    mClearance = gpu::Texture(device, table.size, gpu::TexelFormat::r32f, gpu::Filter::linear);
    mClearance.upload(table.clearance.data());
    if (scene.objects.size() == 1) return;
    mNearby = gpu::Texture(device, table.size, gpu::TexelFormat::r32ui, gpu::Filter::nearest);
    mNearby.upload(table.objects.data());
    if (table.sets.empty()) return;
    const ivec3 rows = rowsFor(table.sets.size());
    std::vector<uvec4> sets(placeOf(rows, 0, 0, rows.z), uvec4(0));
    std::transform(table.sets.begin(), table.sets.end(), sets.begin(), [](const ObjectSets& s) {
        return uvec4(s.near, s.near >> 32, s.inside, s.inside >> 32);
    });
    mSets = gpu::Texture(device, rows, gpu::TexelFormat::rgba32ui, gpu::Filter::nearest);
    mSets.upload(sets.data());
}

void Boundaries::makeCoefficients(gpu::Device& device, const Scene& scene, float h) {
    const auto rgb = [h](const Values& values, const ivec3& voxel, float* out) {
        for (int c = 0; c < 3; ++c) out[c] = values.at(voxel, c) * h;
    };
    mCoefficients[0] = makePages(device, scene, false,
                                 [&](const Region& r, bool along, const ivec3& i, float* out) {
                                     rgb(along ? r.absorptionExtraordinary : r.absorption, i, out);
                                     out[3] = r.anisotropy.at(i, 0);
                                 });
    mCoefficients[1] =
        makePages(device, scene, true, [&](const Region& r, bool, const ivec3& i, float* out) {
            rgb(r.scattering, i, out);
        });
    mCoefficients[2] =
        makePages(device, scene, true, [&](const Region& r, bool, const ivec3& i, float* out) {
            rgb(r.emission, i, out);
        });
}

void Boundaries::bind() const {
    mParams.bindUniform(kSceneBlock);
    mDistances.bind();
    mClearance.bindSampler(kClearanceUnit);
    for (unsigned i = 0; i < 3; ++i)
        if (mCoefficients[i].name() != 0) mCoefficients[i].bindSampler(kAbsorptionsUnit + i);
    if (mNearby.name() != 0) mNearby.bindSampler(kNearbyUnit);
    if (mSets.name() != 0) mSets.bindSampler(kSetsUnit);
    mCrystals.bind();
}

std::vector<gpu::Need> boundaryNeeds(const Scene& scene) {
    const ivec3 page = scene.layout.texels();
    const std::int64_t pages = scene.coefficientPages();
    const int edge = tableEdge(scene.size());
    const ivec3 cubes = (scene.size() + edge - 1) / edge;
    std::vector<gpu::Need> needs = atlasNeeds(scene.objects);
    needs.push_back({"coefficients that vary", std::int64_t{page.x} * page.y * page.z * pages * 48,
                     false, page.z * static_cast<int>(pages)});
    needs.push_back(
        {"the table of boundaries",
         std::int64_t{cubes.x} * cubes.y * cubes.z * (scene.objects.size() == 1 ? 4 : 8), false,
         std::max({cubes.x, cubes.y, cubes.z})});
    if (scene.anyVaryingCrystal()) needs.push_back(crystalNeed(scene));
    return needs;
}

} // namespace eikonal::scene
