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

// On their way at once, for each pixel of a strip.
constexpr std::int64_t kDepartures = 8;

std::int64_t pixelsOf(const Params& params) {
    return std::int64_t{params.camera.width} * rowsPerStrip(params, true);
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

void shareDispersion(std::vector<Plan>& plans) {
    const bool any = std::any_of(plans.begin(), plans.end(),
                                 [](const Plan& plan) { return plan.scene.disperses; });
    for (Plan& plan : plans) {
        scene::Scene& scene = plan.scene;
        if (any && !scene.disperses && scene.index.varies()) {
            scene.index.dispersed = scene.index.grid;
            scene.index.dispersedRest = scene.index.rest;
        }
        scene.disperses = any;
    }
}

} // namespace eikonal::view
