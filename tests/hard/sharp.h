// What the hard cases of sharp boundaries share: objects by formula, and the books of a picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hard.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace eikonal::hard {

/// An object: where it is by signed distances [voxel], what is in it by its index.
struct Body {
    std::function<double(glm::dvec3)> distance;
    double index = 1.5;
    int priority = 0;
};

inline Body ballBody(const glm::dvec3& centre, double radius, double index = 1.5,
                     int priority = 0) {
    return {[=](glm::dvec3 x) { return glm::length(x - centre) - radius; }, index, priority};
}

/// What lies below a plane through `point`; `up` points out of it.
inline Body halfSpace(const glm::dvec3& point, const glm::dvec3& up, double index = 1.5,
                      int priority = 0) {
    const glm::dvec3 n = glm::normalize(up);
    return {[=](glm::dvec3 x) { return glm::dot(x - point, n); }, index, priority};
}

/// The exact distance, round edges and corners outside.
inline Body boxBody(const glm::dvec3& low, const glm::dvec3& high, double index = 1.5,
                    int priority = 0) {
    return {[=](glm::dvec3 x) {
                const glm::dvec3 q = glm::max(low - x, x - high);
                return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
            },
            index, priority};
}

/// Bodies in a box of voxels, lengths measured from its low corner.
struct Bodies {
    std::vector<Body> all;
    double around = 1;
    glm::ivec3 size{32};
    double voxelSize = 1; ///< [unit]
    glm::dmat4 placed{1};
    double halfWidth = 4;                       ///< of the bands [voxel]
    double scale = 1;                           ///< of the distances: 1 is what they should be
    std::function<double(glm::dvec3)> graded{}; ///< the index of the only body, where it varies

    /// One as `sdf` and a one-sided `ior`, several as `sdf.B0`, `ior.B0` and so on. What `more`
    /// adds comes with them.
    volume::Volume volume(const std::function<void(TestVolume&)>& more = {}) const {
        const double h = voxelSize;
        const bool one = all.size() == 1;
        TestVolume scene(size, h, placed);
        scene.index(
            [&](glm::dvec3 p) { return !one     ? around
                                       : graded ? graded(p / h)
                                                : all[0].index; },
            around);
        if (more) more(scene);
        volume::Volume made = scene.take();
        for (size_t i = 0; i < all.size(); ++i) {
            const std::string name = one ? "" : "B" + std::to_string(i);
            volume::DenseGrid distances{size, 1, {}};
            forEachVoxel(size, [&](glm::ivec3 p) {
                distances.values.push_back(
                    static_cast<float>(h * scale * all[i].distance(glm::dvec3(p) + 0.5)));
            });
            made.putLevelSet(
                {name, one ? "sdf" : "sdf." + name, all[i].priority, static_cast<int>(i)},
                {glm::ivec3(0), size - 1}, distances, halfWidth);
            if (!one)
                made.putConstant(volume::ownGrid("ior", name),
                                 glm::vec3(static_cast<float>(all[i].index)));
        }
        return made;
    }
};

/// The view with boundaries that are sharp, under a sky of 1.
inline view::Params sharply(view::Params params, int maxDepth = 8) {
    params.boundary = optics::Boundary::sharp;
    params.maxDepth = maxDepth;
    params.background = glm::dvec3(1);
    return params;
}

/// Parallel rays along `d` round the one through `target`.
inline view::Params alongTo(const glm::dvec3& d, const glm::dvec3& target, double height,
                            const glm::ivec2& size = {1, 1}) {
    const glm::dvec3 unit = glm::normalize(d);
    return sharply(view::parallel(target - 500.0 * unit, target, height, size, across(unit)));
}

/// One ray from where it says, within a domain or before it.
inline view::Params rayFrom(const glm::dvec3& x, const glm::dvec3& d) {
    return sharply(
        view::parallel(x, x + glm::normalize(d), 1e-6, {1, 1}, across(glm::normalize(d))));
}

/// Fails unless all pixels are a sky of 1, since what is dropped sees what is straight ahead, and
/// no ray was trapped. `eye` is the index at the eye over that around. Where rays may be trapped,
/// some of their light may be missing.
inline void expectSky(const view::Look& look, double eye = 1, bool mayTrap = false) {
    double missing = 0, most = 0;
    for (int y = 0; y < look.picture.height; ++y)
        for (int x = 0; x < look.picture.width; ++x) {
            const double seen = look.at("R", x, y) / (eye * eye);
            most = std::max(most, seen);
            missing += 1 - seen;
        }
    // Shares of a few dozen branches, each rounded to a float.
    EXPECT_LT(most, 1 + 1e-5);
    const double rays = look.counter("rays");
    const double trapped = look.counter("trapped");
    if (!mayTrap) {
        EXPECT_EQ(trapped, 0);
    }
    if (rays == 0) {
        EXPECT_NEAR(missing, 0, 1e-6); // floats of the sky
        return;
    }
    // The bar of the requirements for a ray is 1e-4; the mean of many is held to it, too.
    EXPECT_GT(missing / rays, -1e-4) << "of " << rays << " rays";
    EXPECT_LT((missing - trapped) / rays, 1e-4) << "of " << rays << " rays";
}

/// The angle between two directions.
inline double radiansBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Fresnel's share of unpolarised light that a boundary lets through, from n0 at cosine c to n1.
inline double fresnelThrough(double n0, double n1, double c) {
    const double square = n1 * n1 - n0 * n0 * (1 - c * c);
    if (square <= 0) return 0;
    const double a = n0 * c, b = std::sqrt(square);
    const double s = (a - b) / (a + b);
    const double p = (n1 * n1 * a - n0 * n0 * b) / (n1 * n1 * a + n0 * n0 * b);
    return 1 - 0.5 * (s * s + p * p);
}

} // namespace eikonal::hard
