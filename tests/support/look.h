// One picture of a scene, its numbers at hand.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/test_volume.h"
#include "view/view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace eikonal::view {

/// Parallel rays; the picture is `height` high, its pixels square.
inline Params parallel(const glm::dvec3& eye, const glm::dvec3& target, double height,
                       const glm::ivec2& size = {1, 1}, const glm::dvec3& up = {0, 1, 0}) {
    Params params;
    params.camera = {eye, target, up, true, 0, height, size.x, size.y};
    params.aovs = allAovs();
    return params;
}

inline Params perspective(const glm::dvec3& eye, const glm::dvec3& target, double fov,
                          const glm::ivec2& size = {1, 1}, const glm::dvec3& up = {0, 1, 0}) {
    Params params;
    params.camera = {eye, target, up, false, fov, 0, size.x, size.y};
    params.aovs = allAovs();
    return params;
}

struct Look {
    Look(const scene::Files& files, const Params& params,
         const std::optional<image::Image>& map = {}) {
        params.check();
        plan = makePlan(files, params, map.has_value());
        picture = render(device(), plan, params, map, stats, {});
        for (const float value : picture.pixels) EXPECT_TRUE(std::isfinite(value));
    }
    Look(std::vector<volume::Volume> volumes, const Params& params,
         const std::optional<image::Image>& map = {})
        : Look(scene::Files(std::move(volumes)), params, map) {}
    Look(volume::Volume volume, const Params& params, const std::optional<image::Image>& map = {})
        : Look(one(std::move(volume)), params, map) {}

    double at(const std::string& channel, int x = 0, int y = 0) const {
        const auto c = picture.find(channel);
        if (!c) {
            ADD_FAILURE() << "no channel " << channel;
            return NAN;
        }
        return picture.plane(*c)[static_cast<size_t>(y) * picture.width + x];
    }
    glm::dvec3 colour(int x = 0, int y = 0) const {
        return {at("R", x, y), at("G", x, y), at("B", x, y)};
    }
    glm::dvec3 place(int x = 0, int y = 0) const { return vector("exit_position", x, y); }
    glm::dvec3 direction(int x = 0, int y = 0) const { return vector("exit_direction", x, y); }
    glm::dvec3 position(int x, int y) const { return vector("position", x, y); }
    glm::dvec3 normal(int x, int y) const { return vector("normal", x, y); }
    double counter(const std::string& name) const {
        for (const auto& [known, value] : stats.counters)
            if (known == name) return value;
        return 0;
    }

    Plan plan;
    image::Image picture;
    Stats stats;

private:
    static std::vector<volume::Volume> one(volume::Volume volume) {
        std::vector<volume::Volume> volumes;
        volumes.push_back(std::move(volume));
        return volumes;
    }
    glm::dvec3 vector(const std::string& name, int x, int y) const {
        return {at(name + ".X", x, y), at(name + ".Y", x, y), at(name + ".Z", x, y)};
    }
};

/// Fails unless every component is that near.
inline void expectNear(const glm::dvec3& found, const glm::dvec3& wanted, double tolerance) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], wanted[c], tolerance)
            << "component " << c << " of " << found.x << " " << found.y << " " << found.z;
}

} // namespace eikonal::view
