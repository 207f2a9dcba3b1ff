// Volumes in places of their own, and one picture of them all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/look.h"

#include <glm/gtc/matrix_transform.hpp>

namespace eikonal::view {

/// A ball in voxels of size 1.
inline volume::Volume ballAt(const glm::ivec3& size, const glm::dvec3& middle, double radius,
                             double index, double around = 1) {
    TestVolume scene(size);
    scene.add("sdf", [=](glm::dvec3 p) { return glm::length(p - middle) - radius; });
    scene.add(
        "ior", [=](glm::dvec3) { return index; }, around);
    scene.constantVector("absorption", {0.01, 0.03, 0.002});
    return scene.take();
}

inline glm::dmat4 shift(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1), by);
}

struct Placed {
    volume::Volume volume;
    glm::dmat4 worldFromFile{1};
};

inline std::vector<scene::Files> filesOf(std::vector<Placed> placed) {
    std::vector<scene::Files> files;
    for (Placed& one : placed) {
        std::vector<volume::Volume> volumes;
        volumes.push_back(std::move(one.volume));
        files.emplace_back(std::move(volumes));
        files.back().place(one.worldFromFile);
    }
    return files;
}

template<typename... Each> std::vector<Placed> list(Each... each) {
    std::vector<Placed> all;
    (all.push_back(std::move(each)), ...);
    return all;
}

struct Seen {
    Seen(std::vector<Placed> placed, const Params& params,
         const std::optional<image::Image>& map = {}) {
        std::vector<scene::Files> files = filesOf(std::move(placed));
        plans = makePlans(files, params, map.has_value());
        picture = render(device(), plans, params, map, stats, {});
    }
    double at(const std::string& channel, int x, int y) const {
        const auto c = picture.find(channel);
        return c ? double{picture.plane(*c)[static_cast<size_t>(y) * picture.width + x]} : NAN;
    }
    glm::dvec3 vector(const std::string& name, const char* parts, int x, int y) const {
        return {at(name + parts[0], x, y), at(name + parts[1], x, y), at(name + parts[2], x, y)};
    }

    std::vector<Plan> plans;
    image::Image picture;
    Stats stats;
};

} // namespace eikonal::view
