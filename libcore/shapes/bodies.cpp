// The bodies of meshgen implicit.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/implicit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace eikonal::shapes {

namespace {

using glm::dvec3;
using std::numbers::pi;
using Values = ImplicitBody::Values;
using Function = ImplicitBody::Function;

mesh::Box boxOf(const dvec3& half) {
    return {-half, half};
}

/// Signed distance to a box about the origin whose edges are rounded by `round` [unit].
double toBox(const dvec3& x, const dvec3& half, double round) {
    const dvec3 q = glm::abs(x) - half + round;
    return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) - round;
}

/// The smaller of two distances, gone over into each other within `k` (a polynomial, so that what
/// is farther apart stays as it is).
double smoothMin(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * k / 4;
}

/// The larger of two, rounded in the same way.
double smoothMax(double a, double b, double k) {
    return -smoothMin(-a, -b, k);
}

/// A number from 0 to 1, the same from every standard library.
double draw(std::mt19937& random) {
    return static_cast<double>(random()) / 4294967296.0;
}

Function torus(const Values& v) {
    const double tube = v.at("tube");
    return
        [=](const dvec3& x) { return std::hypot(std::hypot(x.x, x.z) - (1 - tube), x.y) - tube; };
}

/// Schoen's gyroid, a sheet of some thickness about it, cut by a rounded cube, with round edges.
/// The function's gradient on the gyroid is 1.53 k long in the mean (from 1.41 to 1.73).
Function gyroid(const Values& v) {
    const double k = pi * v.at("cells"), half = v.at("thickness") / 2, round = v.at("round");
    return [=](const dvec3& x) {
        const dvec3 s = glm::sin(k * x), c = glm::cos(k * x);
        const double sheet = std::abs(s.x * c.y + s.y * c.z + s.z * c.x) / (1.53 * k) - half;
        return smoothMax(sheet, toBox(x, dvec3(1), round), half);
    };
}

/// A bowl with two handles: the zeros of an algebraic surface of genus 2.
Function genus2(const Values&) {
    return [](const dvec3& p) {
        const dvec3 x = 2.2 * dvec3(p.x, p.z, p.y); // its axis, z, is upright
        const double r2 = x.x * x.x + x.y * x.y;
        return 2 * x.y * (x.y * x.y - 3 * x.x * x.x) * (1 - x.z * x.z) + r2 * r2 -
               (9 * x.z * x.z - 1) * (1 - x.z * x.z);
    };
}

/// Balls of finite reach, whose fields add up (Wyvill's polynomial).
Function metaballs(const Values& v, std::uint32_t seed) {
    struct Ball {
        dvec3 centre;
        double reach;
    };
    std::mt19937 random(seed);
    std::vector<Ball> balls;
    const double reach = v.at("reach");
    for (int k = 0; k < static_cast<int>(v.at("count")); ++k) {
        const double r = reach * (0.6 + 0.4 * draw(random)), most = 1 - r;
        dvec3 centre;
        do
            for (int axis = 0; axis < 3; ++axis) centre[axis] = 2 * draw(random) - 1;
        while (glm::length(centre) > 1);
        balls.push_back({most * centre, r});
    }
    return [balls](const dvec3& x) {
        double sum = 0;
        for (const Ball& ball : balls) {
            const dvec3 d = (x - ball.centre) / ball.reach;
            const double q = 1 - std::min(glm::dot(d, d), 1.0);
            sum += q * q * q;
        }
        return 0.3 - sum;
    };
}

/// A drop falls into a pool: a cavity, a ring of waves, a jet that throws a drop of its own. A
/// sketch, no simulation; the jet and the waves are laid out by hand, drops fall by g.
Function splash(const Values& v) {
    constexpr double g = 9.81, drop = 0.13, hit = 0.25; // [unit/s²], [unit], [s]
    const double t = v.at("time"), after = std::max(t - hit, 0.0);
    const double fallen = 0.05 + 0.5 * g * (hit * hit - t * t); // the drop's height until it hits
    const double cavity = 0.3 * std::exp(-after / 0.08) * (1 - std::exp(-after / 0.02));
    const double rise = after - 0.15; // the jet's own time
    const double jet = rise > 0 ? 0.75 * std::sin(std::min(rise / 0.5, 1.0) * pi) : 0;
    const double thrown = rise > 0.15
                              ? 0.62 + 1.5 * (rise - 0.15) - g / 2 * std::pow(rise - 0.15, 2)
                              : -1;    // the height of the jet's drop
    const double crest = 0.75 * after; // how far the ring has come
    const double swell = 0.05 * (1 - std::exp(-after / 0.06)) / (1 + 4 * after);
    return [=](const dvec3& x) {
        const double r = std::hypot(x.x, x.z);
        const double surface =
            -cavity * std::exp(-std::pow(r / 0.2, 2)) +
            jet * std::exp(-std::pow(r / (0.05 + 0.15 * std::exp(-4 * jet)), 2)) +
            swell * std::cos(24 * (r - crest)) * std::exp(-std::pow((r - crest) / 0.22, 2));
        double water = (x.y - surface) * 0.7; // where it is steep it is no distance
        const double first = glm::length(x - dvec3(0, fallen, 0)) - drop;
        if (after < 0.05) water = smoothMin(water, first + 4 * after, 0.12);
        const double second = glm::length(x - dvec3(0, thrown, 0)) - 0.075;
        if (thrown > -0.2) water = smoothMin(water, second, 0.06);
        const dvec3 side = glm::abs(x - dvec3(0, 0.35, 0)) - dvec3(1, 0.95, 1);
        return std::max(water, std::max({side.x, side.y, side.z}));
    };
}

} // namespace

const std::vector<ImplicitBody>& implicitBodies() {
    static const std::vector<ImplicitBody> bodies = {
        {"torus",
         "a ring of outer radius 1 about the y axis",
         {{"tube", "the tube's radius [unit]", 0.3, 0.02, 0.48}},
         [](const Values& v) {
             return boxOf({1, v.at("tube"), 1});
         },
         [](const Values& v, std::uint32_t) { return torus(v); }},
        {"rounded-cube",
         "a cube from -1 to 1 with rounded edges",
         {{"round", "radius of the edges [unit]", 0.25, 0.02, 1}},
         [](const Values&) { return boxOf(dvec3(1)); },
         [](const Values& v, std::uint32_t) -> Function {
             return [round = v.at("round")](const dvec3& x) { return toBox(x, dvec3(1), round); };
         }},
        {"gyroid",
         "a sheet about a gyroid, cut by a rounded cube from -1 to 1",
         {{"cells", "periods across the cube", 2, 0.5, 8},
          {"thickness", "of the sheet [unit]", 0.15, 0.03, 0.5},
          {"round", "radius of the cube's edges [unit]", 0.25, 0.02, 1}},
         [](const Values&) { return boxOf(dvec3(1)); },
         [](const Values& v, std::uint32_t) { return gyroid(v); }},
        {"genus2",
         "a smooth body with two holes, its axis along y",
         {},
         [](const Values&) {
             return boxOf({1, 0.5, 1});
         },
         [](const Values& v, std::uint32_t) { return genus2(v); }},
        {"metaballs",
         "balls placed at random that flow into each other, within radius 1",
         {{"count", "how many", 12, 1, 400}, {"reach", "of the largest ball [unit]", 0.5, 0.1, 1}},
         [](const Values&) { return boxOf(dvec3(1)); },
         [](const Values& v, std::uint32_t seed) { return metaballs(v, seed); }},
        {"splash",
         "a drop that falls into a pool, a sketch: from -1 to 1, water to y = 0, its bottom "
         "at -0.6",
         {{"time", "[s]; it hits at 0.25", 0, 0, 4}},
         [](const Values&) {
             return mesh::Box{{-1, -0.6, -1}, {1, 1.3, 1}};
         },
         [](const Values& v, std::uint32_t) { return splash(v); }},
    };
    return bodies;
}

} // namespace eikonal::shapes
