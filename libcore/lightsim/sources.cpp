// What stands for a light: parallel rays, or those of a point.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/sources.h"

#include "lightsim/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;
using Kind = Light::Kind;
using Spread = Source::Spread;

constexpr double kPi = 3.14159265358979323846;

/// The fraction of k golden ratios.
double goldenOf(int k) {
    return glm::fract(k * 0.6180339887498949);
}

/// The k-th of points that fill the unit square evenly.
dvec2 inSquare(int k, int count) {
    return {(k + 0.5) / count, glm::fract(goldenOf(k) + 0.5 / count)};
}

/// Two directions across one, all of length 1.
struct Across {
    dvec3 right, up;
};
Across across(const dvec3& axis) {
    const dvec3 helper = std::abs(axis.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    const dvec3 right = glm::normalize(glm::cross(axis, helper));
    return {right, glm::cross(right, axis)};
}

/// Directions of a disc of even radiance: they fill its projection across the axis evenly, and each
/// adds the same to the irradiance there.
std::vector<Source> discSources(const Light& light, int count) {
    const Across frame = across(light.vector);
    const double edge = std::sin(glm::radians(0.5 * light.angle));
    std::vector<Source> sources;
    for (int k = 0; k < count; ++k) {
        const double off = edge * std::sqrt((k + 0.5) / count), turns = 2 * kPi * goldenOf(k);
        const double along = std::sqrt(1 - off * off);
        Source source;
        source.vector = along * light.vector +
                        off * (std::cos(turns) * frame.right + std::sin(turns) * frame.up);
        source.rgb = light.rgb / (count * along);
        sources.push_back(source);
    }
    return sources;
}

std::vector<Source> rectSources(const Light& light, int count) {
    const dvec3 side = glm::cross(light.edges[0], light.edges[1]);
    const double area = glm::length(side);
    std::vector<Source> sources;
    for (int k = 0; k < count; ++k) {
        const dvec2 at = inSquare(k, count) - 0.5;
        Source source;
        source.spread = Spread::cosine;
        source.vector = light.vector + at.x * light.edges[0] + at.y * light.edges[1];
        source.axis = side / area;
        source.rgb = light.rgb * (area / count);
        sources.push_back(source);
    }
    return sources;
}

std::vector<Source> sphereSources(const Light& light, int count) {
    std::vector<Source> sources;
    for (int k = 0; k < count; ++k) {
        const double height = 1 - (2 * k + 1.0) / count, turns = 2 * kPi * goldenOf(k);
        const double flat = std::sqrt(1 - height * height);
        Source source;
        source.spread = Spread::cosine;
        source.axis = {flat * std::cos(turns), height, flat * std::sin(turns)};
        source.vector = light.vector + light.radius * source.axis;
        source.rgb = light.rgb * (4 * kPi * light.radius * light.radius / count);
        sources.push_back(source);
    }
    return sources;
}

Source sourceOf(const Light& light) {
    Source source;
    source.vector = light.vector;
    source.rgb = light.rgb;
    if (light.kind == Kind::directional) return source;
    source.spread = Spread::even;
    if (light.kind != Kind::spot) return source;
    source.spread = Spread::cone;
    source.axis = light.axis;
    source.inner = glm::radians(light.angle - light.soft);
    source.outer = glm::radians(light.angle + light.soft);
    return source;
}

std::vector<Source> inWorld(const Light& light, int count, Keep keep) {
    switch (light.kind) {
    case Kind::rect:
        return rectSources(light, count);
    case Kind::sphere:
        return sphereSources(light, count);
    case Kind::environment:
        return environmentSources(light, count, keep);
    case Kind::directional:
        if (light.isExtended()) return discSources(light, count);
        break;
    case Kind::point:
    case Kind::spot:
        break;
    }
    return {sourceOf(light)};
}

} // namespace

double shareTowards(const Source& source, const dvec3& direction) {
    const double along = glm::dot(source.axis, direction);
    if (source.spread == Spread::cosine) return std::max(along, 0.0);
    if (source.spread != Spread::cone) return 1;
    const double angle = std::atan2(glm::length(glm::cross(source.axis, direction)), along);
    const double fades = std::max(source.outer - source.inner, 1e-6);
    const double t = std::clamp((source.outer - angle) / fades, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

std::vector<Source> sourcesOf(const Light& light, int count, Keep keep,
                              const glm::dmat4& voxelFromWorld) {
    std::vector<Source> sources = inWorld(light, count, keep);
    const auto turned = [&](const dvec3& direction) {
        return glm::normalize(dvec3(voxelFromWorld * glm::dvec4(direction, 0.0)));
    };
    for (Source& source : sources) {
        source.vector = source.isPoint() ? dvec3(voxelFromWorld * glm::dvec4(source.vector, 1.0))
                                         : turned(source.vector);
        source.axis = turned(source.axis);
        if (light.polarizer != dvec3(0)) source.polarizer = turned(light.polarizer);
    }
    return sources;
}

} // namespace eikonal::lightsim
