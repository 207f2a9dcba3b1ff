// Light for single points of opaque surfaces, those that a picture shows.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/points.h"

#include "lightsim/dispatch.h"
#include "lightsim/shared.h"
#include "scene/lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;

// A point's light comes from columns next to its own, and those go so far [fine voxel].
constexpr int kReach = 5;

// Points read at a time.
constexpr size_t kPart = 1 << 20;

bool isPoint(const PointOnSurface& point) {
    return point.normal != glm::vec3(0);
}

/// The middle one of the distances between neighbours on one surface [voxel]; 0 where there are
/// none.
float spacingOf(const std::vector<PointOnSurface>& points, int width) {
    std::vector<float> all;
    const auto measure = [&](const PointOnSurface& a, const PointOnSurface& b) {
        if (glm::dot(a.normal, b.normal) > 0.9f) all.push_back(glm::distance(a.place, b.place));
    };
    const auto row = static_cast<size_t>(width);
    for (size_t i = 0; i < points.size(); ++i) {
        if (!isPoint(points[i])) continue;
        if ((i + 1) % row != 0) measure(points[i], points[i + 1]);
        if (i + row < points.size()) measure(points[i], points[i + row]);
    }
    if (all.empty()) return 0;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

void sortOnce(std::vector<std::uint32_t>& places) {
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
}

/// Places of the voxels that are up to so many from one that holds a point.
std::vector<std::uint32_t> voxelsNear(const std::vector<PointOnSurface>& points, const ivec3& size,
                                      int reach) {
    std::vector<std::uint32_t> held, near;
    for (const PointOnSurface& point : points) {
        // As floats: whole numbers may not hold a place far off.
        const glm::vec3 at = glm::floor(point.place + 0.5f);
        if (!isPoint(point) || at != glm::clamp(at, glm::vec3(-1), glm::vec3(size))) continue;
        const ivec3 in = glm::clamp(ivec3(at), ivec3(0), size - 1);
        const auto place = static_cast<std::uint32_t>(scene::placeOf(size, in.x, in.y, in.z));
        if (held.empty() || held.back() != place) held.push_back(place);
    }
    sortOnce(held);
    for (const std::uint32_t place : held) {
        const ivec3 voxel = scene::atPlace(size, place);
        const ivec3 low = glm::max(voxel - reach, ivec3(0));
        const ivec3 high = glm::min(voxel + reach, size - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    near.push_back(static_cast<std::uint32_t>(scene::placeOf(size, x, y, z)));
    }
    sortOnce(near);
    return near;
}

int reachOf(int detail) {
    return (kReach + detail - 1) / detail;
}

} // namespace

std::vector<PointOnSurface> pointsInVoxels(const Points& points, const scene::Scene& scene) {
    const glm::dmat4 voxelFromWorld = scene.voxelFromWorld();
    const glm::dmat3 turn = glm::transpose(scene.worldFromVoxelTurn());
    std::vector<PointOnSurface> found(points.places.size());
    for (size_t i = 0; i < found.size(); ++i) {
        if (points.normals[i] == glm::vec3(0)) continue;
        found[i].place = glm::vec3(voxelFromWorld * glm::dvec4(points.places[i], 1));
        found[i].normal = glm::vec3(glm::normalize(turn * glm::dvec3(points.normals[i])));
    }
    return found;
}

OpaqueSurfaces surfacesNear(const OpaqueSurfaces& surfaces,
                            const std::vector<PointOnSurface>& points, int width, const ivec3& size,
                            int detail) {
    const auto keep = [&](int edge) {
        OpaqueSurfaces kept;
        kept.detail = edge;
        const std::vector<std::uint32_t> near = voxelsNear(points, size, reachOf(edge));
        std::set_intersection(surfaces.voxels.begin(), surfaces.voxels.end(), near.begin(),
                              near.end(), std::back_inserter(kept.voxels));
        return kept;
    };
    if (detail > 0) return keep(detail);
    const float spacing = spacingOf(points, width);
    const int wanted = spacing > 0 ? static_cast<int>(std::ceil(1 / std::max(spacing, 0.01f))) : 1;
    const OpaqueSurfaces kept = keep(std::clamp(wanted, 1, scene::kMostDetail));
    const int most = detailFor(kept.voxels.size() / 2);
    return most < kept.detail ? keep(most) : kept;
}

std::vector<gpu::Need> pointNeeds(const std::vector<PointOnSurface>& points) {
    const auto part = static_cast<std::int64_t>(std::min(points.size(), kPart));
    return {{"a picture's points", part * static_cast<std::int64_t>(sizeof(SurfacePoint)), true, 0},
            {"a picture's light", part * static_cast<std::int64_t>(sizeof(PointLight)), true, 0}};
}

PointReader::PointReader(gpu::Device& device, int channels)
    : mProgram(device, "lightsim/points.comp.glsl", {{"FLUENCE", channels}}),
      mBlock(device, sizeof(LayoutParams)) {}

std::vector<LightAtPoint> PointReader::read(gpu::Device& device,
                                            const std::vector<PointOnSurface>& points,
                                            const scene::SurfaceTable& table,
                                            const gpu::Texture& irradiance,
                                            std::int64_t surfaceVoxels) {
    std::vector<LightAtPoint> found(points.size());
    const auto part = static_cast<std::int64_t>(std::min(points.size(), kPart));
    const gpu::Buffer lights(device, part * static_cast<std::int64_t>(sizeof(PointLight)));
    for (size_t first = 0; first < points.size(); first += kPart) {
        const size_t count = std::min(kPart, points.size() - first);
        std::vector<SurfacePoint> asked(count);
        for (size_t i = 0; i < count; ++i)
            asked[i] = {vec4(points[first + i].place, 0), vec4(points[first + i].normal, 0)};
        const gpu::Buffer list(device, static_cast<std::int64_t>(count * sizeof(SurfacePoint)),
                               asked.data());
        LayoutParams values{};
        values.list = ivec4(static_cast<int>(count), 0, static_cast<int>(surfaceVoxels), 0);
        mBlock.upload(&values, sizeof values);
        mBlock.bindUniform(kParamsBlock);
        table.bind();
        list.bindStorage(kSurfacePointsBuffer);
        lights.bindStorage(kPointLightsBuffer);
        irradiance.bindImage(kIrradianceImage);
        dispatchList(mProgram, static_cast<std::int64_t>(count));
        std::vector<PointLight> read(count);
        lights.download(read.data(), static_cast<std::int64_t>(count * sizeof(PointLight)));
        for (size_t i = 0; i < count; ++i)
            found[first + i] = {glm::vec3(read[i].irradiance), glm::vec3(read[i].flow)};
    }
    device.check("the light of points");
    return found;
}

} // namespace eikonal::lightsim
