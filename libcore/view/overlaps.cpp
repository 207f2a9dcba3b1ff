// Domains that overlap are traced as one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/overlaps.h"

#include "base/error.h"
#include "base/text.h"
#include "scene/merge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace eikonal::view {

namespace {

using glm::dvec3;

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

void requireOneMedium(const std::vector<Plan>& plans) {
    const scene::Scene& first = plans.front().scene;
    for (const Plan& plan : plans) {
        const scene::Index &a = first.index, &b = plan.scene.index;
        if (a.background != b.background || a.backgroundDispersion != b.backgroundDispersion)
            throw DataError(plan.scene.path + ": is surrounded by an index of " +
                            toText(b.background) + ", expected the " + toText(a.background) +
                            " round " + first.path);
    }
}

void requireOneGround(const std::vector<Plan>& plans) {
    const Plan* first = nullptr;
    for (const Plan& plan : plans) {
        if (!plan.ground) continue;
        if (first && !(first->ground->plane == plan.ground->plane))
            throw DataError(plan.scene.path + ": its ground is " +
                            volume::textOf(plan.ground->plane) + ", expected that of " +
                            first->scene.path + ", " + volume::textOf(first->ground->plane));
        if (!first) first = &plan;
    }
}

/// The places of those whose domains overlap that of the first, directly or by way of others.
std::vector<size_t> overlapping(const std::vector<Plan>& plans, size_t first) {
    std::vector<size_t> group{first};
    for (size_t i = 0; i < group.size(); ++i)
        for (size_t k = 0; k < plans.size(); ++k)
            if (std::find(group.begin(), group.end(), k) == group.end() &&
                !areApart(boxOf(plans[group[i]].scene), boxOf(plans[k].scene)))
                group.push_back(k);
    std::sort(group.begin(), group.end());
    return group;
}

Plan mergedPlan(const std::vector<Plan>& plans, const std::vector<size_t>& group,
                const Params& params) {
    std::vector<Plan> own;
    std::vector<scene::Part> parts;
    for (const size_t i : group) {
        own.push_back(plans[i]);
        parts.push_back({&plans[i].scene, plans[i].ground});
    }
    joinEffects(own);
    Plan plan;
    plan.effects = std::move(own.front().effects);
    plan.warnings = std::move(own.front().warnings);
    scene::Merged merged = scene::merge(parts);
    const bool lit = std::any_of(parts.begin(), parts.end(), [](const scene::Part& part) {
        return !part.scene->light.fluence.isZero() || !part.scene->light.surfaces.empty();
    });
    if (lit)
        plan.warnings.push_back("domains of " + parts[0].scene->path + " and " +
                                parts[1].scene->path +
                                " overlap: the light in each knows nothing of the other");
    plan.scene = std::move(merged.scene);
    plan.ground = std::move(merged.ground);
    plan.map = own.front().map;
    tellEffects(plan, params);
    return plan;
}

} // namespace

void mergeOverlapping(std::vector<Plan>& plans, const Params& params) {
    requireOneMedium(plans);
    requireOneGround(plans);
    for (size_t first = 0; first < plans.size();) {
        const std::vector<size_t> group = overlapping(plans, first);
        if (group.size() == 1) {
            ++first;
            continue;
        }
        Plan plan = mergedPlan(plans, group, params);
        for (size_t i = group.size(); i-- > 0;)
            plans.erase(plans.begin() + static_cast<std::ptrdiff_t>(group[i]));
        plans.insert(plans.begin(), std::move(plan));
        first = 0; // what is larger now may overlap others
    }
}

} // namespace eikonal::view
