// Several domains in one picture: rays go from one to the next.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/domains.h"

#include "base/error.h"
#include "base/text.h"
#include "view/picture.h"
#include "view/shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace eikonal::view {

namespace {

using glm::dvec3;

// On their way at once, for each pixel of a strip.
constexpr std::int64_t kDepartures = 8;

std::int64_t pixelsOf(const Params& params) {
    return std::int64_t{params.camera.width} * rowsPerStrip(params, true);
}

/// A domain as a box in the world: its middle, and half its edges.
struct WorldBox {
    dvec3 middle;
    std::array<dvec3, 3> half;
};

WorldBox boxOf(const scene::Scene& scene) {
    const glm::dmat4 worldFromVoxel = glm::inverse(scene.voxelFromWorld());
    const dvec3 size(scene.size());
    WorldBox box;
    box.middle = dvec3(worldFromVoxel * glm::dvec4(0.5 * size - 0.5, 1));
    for (int i = 0; i < 3; ++i)
        box.half[static_cast<size_t>(i)] = 0.5 * size[i] * dvec3(worldFromVoxel[i]);
    return box;
}

double reachAlong(const WorldBox& box, const dvec3& axis) {
    double reach = 0;
    for (const dvec3& half : box.half) reach += std::abs(glm::dot(half, axis));
    return reach;
}

/// Whether some plane has one on either side (the theorem of separating axes).
bool areApart(const WorldBox& a, const WorldBox& b) {
    std::vector<dvec3> axes(a.half.begin(), a.half.end());
    axes.insert(axes.end(), b.half.begin(), b.half.end());
    for (const dvec3& one : a.half)
        for (const dvec3& other : b.half) axes.push_back(glm::cross(one, other));
    return std::any_of(axes.begin(), axes.end(), [&](const dvec3& axis) {
        const double length = glm::length(axis);
        if (length < 1e-12 * glm::length(a.half[0]) * glm::length(a.half[0])) return false;
        const dvec3 unit = axis / length;
        const double reach = reachAlong(a, unit) + reachAlong(b, unit);
        return std::abs(glm::dot(b.middle - a.middle, unit)) >= reach * (1 - 1e-9);
    });
}

} // namespace

Domains::Domains(gpu::Device& device, const std::vector<Plan>& plans, const Params& params) {
    const std::int64_t pixels = pixelsOf(params);
    mDepartures = gpu::Buffer(device, 16 + kDepartures * pixels *
                                               static_cast<std::int64_t>(sizeof(Departure)));
    mPending = gpu::Buffer(device, pixels * 4);
    mPending.clear();
    for (size_t own = 0; own < plans.size(); ++own) {
        DomainParams values{};
        const glm::dmat4 worldFromVoxel = glm::inverse(plans[own].scene.voxelFromWorld());
        for (size_t i = 0; i < plans.size(); ++i) {
            values.otherFromVoxel[i] = plans[i].scene.voxelFromWorld() * worldFromVoxel;
            values.size[i] = vec4(glm::vec3(plans[i].scene.size()), 0);
        }
        values.numbers = ivec4(static_cast<int>(own), static_cast<int>(plans.size()), 0,
                               static_cast<int>(kDepartures * pixels));
        values.scale = vec4(static_cast<float>(plans[own].scene.voxelSize()), 0, 0, 0);
        std::vector<std::byte> bytes(sizeof values);
        std::memcpy(bytes.data(), &values, sizeof values);
        mBlocks.emplace_back(device, static_cast<std::int64_t>(sizeof values), bytes.data());
        mValues.push_back(std::move(bytes));
    }
}

void Domains::clear() {
    const std::array<std::uint32_t, 4> none{};
    mDepartures.upload(none.data(), sizeof none);
}

void Domains::bind(size_t domain, bool arrivals) {
    DomainParams values{};
    std::memcpy(&values, mValues[domain].data(), sizeof values);
    values.numbers.z = arrivals;
    mBlocks[domain].upload(&values, sizeof values);
    mBlocks[domain].bindUniform(kDomainsBlock);
    mDepartures.bindStorage(kDeparturesBuffer);
    mPending.bindStorage(kPendingBuffer);
}

std::uint32_t Domains::waiting() const {
    std::array<std::uint32_t, 2> counts{}; // begun, taken up
    mDepartures.download(counts.data(), sizeof counts);
    return counts[0] - counts[1];
}

std::vector<gpu::Need> domainNeeds(const Params& params) {
    return {{"rays between domains",
             kDepartures * pixelsOf(params) * static_cast<std::int64_t>(sizeof(Departure)), true,
             0}};
}

void requireApart(const std::vector<Plan>& plans) {
    if (plans.size() > static_cast<size_t>(kMostDomains))
        throw DataError(std::to_string(plans.size()) +
                        " volumes in places of their own, expected " +
                        std::to_string(kMostDomains) + " at most");
    const scene::Scene& first = plans.front().scene;
    for (size_t i = 0; i < plans.size(); ++i) {
        const scene::Scene& scene = plans[i].scene;
        const scene::Index &a = first.index, &b = scene.index;
        if (a.background != b.background || a.backgroundDispersion != b.backgroundDispersion)
            throw DataError(scene.path + ": is surrounded by an index of " + toText(b.background) +
                            ", expected the " + toText(a.background) + " round " + first.path);
        for (size_t k = 0; k < i; ++k)
            if (!areApart(boxOf(plans[k].scene), boxOf(scene)))
                throw DataError(scene.path + ": its domain overlaps that of " +
                                plans[k].scene.path +
                                ", expected them apart (mesh2vol takes several meshes)");
    }
}

void shareDispersion(std::vector<Plan>& plans) {
    const bool any = std::any_of(plans.begin(), plans.end(),
                                 [](const Plan& plan) { return plan.scene.disperses; });
    for (Plan& plan : plans) {
        scene::Scene& scene = plan.scene;
        if (any && !scene.disperses && scene.index.varies())
            scene.index.dispersed = scene.index.grid;
        scene.disperses = any;
    }
}

} // namespace eikonal::view
