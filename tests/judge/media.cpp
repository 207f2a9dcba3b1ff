// Refractive index as closed formulas: what the judge traces rays through, with no voxel anywhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/media.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace judge {

namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

/// √ of what is positive on every ray, but may be a little below 0 at a trial point beside one.
double rootOf(double square) {
    return std::sqrt(std::max(square, 0.0));
}

/// Density of the normal distribution of standard deviation sigma.
double normalDensity(double x, double sigma) {
    return std::exp(-x * x / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * pi));
}

} // namespace

Medium linearSquared(double n0sq, dvec3 a) {
    return {.name = "linear n²",
            .index = [=](dvec3 x) { return rootOf(n0sq + 2 * glm::dot(a, x)); },
            .force = [=](dvec3) { return a; },
            .parts = {}};
}

Medium grinRod(double n0, double g, dvec3 centre) {
    return {.name = "GRIN rod",
            .index =
                [=](dvec3 x) {
                    const dvec3 r = x - centre;
                    return n0 * rootOf(1 - g * g * (r.x * r.x + r.y * r.y));
                },
            .force =
                [=](dvec3 x) {
                    const dvec3 r = x - centre;
                    return -n0 * n0 * g * g * dvec3(r.x, r.y, 0);
                },
            .parts = {}};
}

Medium luneburgCore(dvec3 centre, double radius) {
    const double square = radius * radius;
    return {.name = "Luneburg core",
            .index =
                [=](dvec3 x) {
                    const dvec3 r = x - centre;
                    return rootOf(2 - glm::dot(r, r) / square);
                },
            .force = [=](dvec3 x) { return (centre - x) / square; },
            .parts = {}};
}

Medium luneburg(dvec3 centre, double radius) {
    const Medium core = luneburgCore(centre, radius);
    const Scalar where = [=](dvec3 x) { return glm::length(x - centre) - radius; };
    const Part lens{where, core.index, core.force};
    const Part around{{}, [](dvec3) { return 1.0; }, [](dvec3) { return dvec3(0); }};
    return {.name = "Luneburg lens",
            .index = [=](dvec3 x) { return where(x) < 0 ? lens.index(x) : 1.0; },
            .force = [=](dvec3 x) { return where(x) < 0 ? lens.force(x) : dvec3(0); },
            .parts = {lens, around}};
}

Medium maxwellFishEye(dvec3 centre, double radius) {
    const double square = radius * radius;
    const Scalar index = [=](dvec3 x) {
        const dvec3 r = x - centre;
        return 2 / (1 + glm::dot(r, r) / square);
    };
    // ∇n = −n² r/R², so ½∇(n²) = n∇n = −n³ r/R².
    return {.name = "Maxwell fish-eye",
            .index = index,
            .force =
                [=](dvec3 x) {
                    const double n = index(x);
                    return n * n * n / square * (centre - x);
                },
            .parts = {}};
}

Medium layeredExponential(double n0sq, double gain, double y0, double scale) {
    return {.name = "exponential layers",
            .index = [=](dvec3 x) { return rootOf(n0sq - gain * std::expm1(-(x.y - y0) / scale)); },
            .force =
                [=](dvec3 x) {
                    return dvec3(0, gain / (2 * scale) * std::exp(-(x.y - y0) / scale), 0);
                },
            .parts = {}};
}

Medium layered(std::string name, Profile n, Profile slope, double longestStep) {
    return {.name = std::move(name),
            .index = [n](dvec3 x) { return n(x.y); },
            .force = [n, slope](dvec3 x) { return dvec3(0, n(x.y) * slope(x.y), 0); },
            .parts = {},
            .longestStep = longestStep};
}

Medium radial(std::string name, dvec3 centre, Profile n, Profile slope, double longestStep) {
    return {.name = std::move(name),
            .index = [=](dvec3 x) { return n(glm::length(x - centre)); },
            .force =
                [=](dvec3 x) {
                    const double r = glm::length(x - centre);
                    // At the centre the slope of a smooth index is 0, whatever the direction.
                    return r > 0 ? n(r) * slope(r) / r * (x - centre) : dvec3(0);
                },
            .parts = {},
            .longestStep = longestStep};
}

Profile blobIndex(double radius, double sigma, double n) {
    return [=](double r) { return 1 + (n - 1) / 2 * std::erfc((r - radius) / (sigma * sqrt2)); };
}

Profile blobSlope(double radius, double sigma, double n) {
    return [=](double r) { return -(n - 1) * normalDensity(r - radius, sigma); };
}

Medium blob(dvec3 centre, double radius, double sigma, double n) {
    // Steps of 2σ: none can cross the edge, some 8σ wide before it fades into rounding, unseen.
    return radial("blob", centre, blobIndex(radius, sigma, n), blobSlope(radius, sigma, n),
                  2 * sigma);
}

Medium step(dvec3 point, dvec3 normal, double behind, double ahead, double sigma) {
    const dvec3 up = glm::normalize(normal);
    const Scalar index = [=](dvec3 x) {
        const double d = glm::dot(up, x - point);
        return behind + (ahead - behind) / 2 * std::erfc(-d / (sigma * sqrt2));
    };
    return {.name = "step",
            .index = index,
            .force =
                [=](dvec3 x) {
                    const double d = glm::dot(up, x - point);
                    return index(x) * (ahead - behind) * normalDensity(d, sigma) * up;
                },
            .parts = {},
            .longestStep = 2 * sigma};
}

} // namespace judge
