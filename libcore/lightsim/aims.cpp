// Where a light's map is aimed at: the parts of it through which something is seen that light
// meets. SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/aims.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;

// A boundary is near a brick if distances say so [voxel].
constexpr float kNear = 2;

/// Whether light may meet an object in a brick: its boundary passes there, or the domain's face
/// cuts it open.
bool isMet(const scene::Object& object, size_t brick) {
    const float near = std::min(kNear, 0.9F * object.band);
    float least = near, most = -near;
    object.distance.forEachValue(brick, [&](const float* value) {
        least = std::min(least, *value);
        most = std::max(most, *value);
    });
    if (least >= near) return false;
    const glm::ivec3 low = object.distance.voxelOf(brick), high = low + volume::kBrick;
    const bool isOuter = glm::any(glm::lessThanEqual(low, glm::ivec3(0))) ||
                         glm::any(glm::greaterThanEqual(high, object.distance.size));
    return most > -near || isOuter;
}

/// Whether a point's window surely does not see a box: it lies behind one of the planes of 45°.
bool isBeside(const Window& window, const VoxelBox& box) {
    if (!window.point) return false;
    const dvec3 middle = 0.5 * (box.low + box.high) - window.origin;
    const double reach = 0.5 * glm::length(box.high - box.low);
    for (const dvec3& across : {window.right, -window.right, window.up, -window.up})
        if (glm::dot(middle, glm::normalize(window.forward + across)) < -reach) return true;
    return false;
}

} // namespace

Aims::Aims(const Plan& plan) : mEverywhere(!plan.isPlainBetween()) {
    if (mEverywhere) return;
    for (const scene::Object& object : plan.scene.objects)
        for (size_t brick = 0; brick < object.distance.page.size(); ++brick) {
            if (!isMet(object, brick)) continue;
            const dvec3 low(object.distance.voxelOf(brick));
            mBoxes.push_back({low - 1.0, low + static_cast<double>(volume::kBrick)});
        }
}

AimedMap Aims::mapOf(const Window& window, int edge) const {
    const ivec2 size = (window.pixels + edge - 1) / edge;
    AimedMap map{window, size.x, {}};
    map.tiles.resize(static_cast<size_t>(size.x) * size.y);
    const auto mark = [&](const ivec2& low, const ivec2& high) {
        for (int y = std::max(low.y, 0); y <= std::min(high.y, size.y - 1); ++y)
            for (int x = std::max(low.x, 0); x <= std::min(high.x, size.x - 1); ++x)
                map.tiles[static_cast<size_t>(y) * size.x + x] = 1;
    };
    const dvec2 scale = dvec2(window.pixels) / (static_cast<double>(edge) * window.extent);
    const auto tileAt = [&](const dvec2& at) {
        return ivec2(
            glm::floor(glm::clamp((at - window.low) * scale, dvec2(-1), dvec2(size) + 1.0)));
    };
    for (const VoxelBox& box : mBoxes) {
        if (isBeside(window, box)) continue;
        const std::optional<glm::dvec4> seen = window.rectangleOf(box);
        if (seen)
            mark(tileAt({seen->x, seen->y}), tileAt({seen->z, seen->w}));
        else
            mark(ivec2(0), size);
    }
    return map;
}

} // namespace eikonal::lightsim
