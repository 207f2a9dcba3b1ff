// The ground beyond the domain, as the view kernel reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/ground.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::view {

namespace {

using glm::dvec3;
using scene::Light;
using Kind = Light::Kind;

constexpr double kPi = 3.14159265358979323846;

// From so many times its half diagonal on a rectangle counts as a point: that is off by the square
// of the inverse at most, 0.1 %, and edges' parts in floats would be.
constexpr double kFarOff = 32;

/// What of a disc of even radiance is above the horizon, by rings of it.
double discIrradiance(const dvec3& towards, double halfAngle) {
    const int kRings = 256, kParts = 512; // midpoints; the horizon cuts few of the cells
    const double edge = std::sin(halfAngle);
    const double flat = std::sqrt(std::max(1 - towards.y * towards.y, 0.0));
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
        const double off = (i + 0.5) / kRings * halfAngle;
        for (int k = 0; k < kParts; ++k) {
            const double turn = 2 * kPi * (k + 0.5) / kParts;
            const double height = std::cos(off) * towards.y + std::sin(off) * std::cos(turn) * flat;
            sum += std::sin(off) * std::max(height, 0.0);
        }
    }
    return sum * (halfAngle / kRings) * (2 * kPi / kParts) / (kPi * edge * edge);
}

/// The corners of a rectangle above the plane, in their order round it.
std::vector<dvec3> cornersAbove(const Light& rect, double y) {
    std::vector<dvec3> corners, above;
    for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        corners.push_back(rect.vector + u * rect.edges[0] + v * rect.edges[1]);
    for (size_t i = 0; i < corners.size(); ++i) {
        const dvec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if (a.y > y) above.push_back(a);
        if ((a.y > y) != (b.y > y)) above.push_back(glm::mix(a, b, (y - a.y) / (b.y - a.y)));
    }
    return above;
}

/// World to the kernel's terms.
struct Frame {
    glm::dmat4 voxelFromWorld;
    double voxelSize; ///< [unit]

    dvec3 place(const dvec3& p) const { return dvec3(voxelFromWorld * glm::dvec4(p, 1)); }
    dvec3 direction(const dvec3& d) const {
        return glm::normalize(dvec3(voxelFromWorld * glm::dvec4(d, 0)));
    }
};

/// False if nothing of it is above the plane.
bool describeRect(const Light& light, double y, const Frame& frame, GroundLight& out) {
    const std::vector<dvec3> corners = cornersAbove(light, y);
    if (corners.size() < 3) return false;
    dvec3 middle(0), area(0);
    double reach = 0;
    for (size_t i = 0; i < corners.size(); ++i) { // a fan of triangles
        if (i > 1) {
            const dvec3 part =
                0.5 * glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
            area += part;
            middle += glm::length(part) * (corners[0] + corners[i - 1] + corners[i]) / 3.0;
        }
        out.corners[i] = vec4(frame.place(corners[i]), 0);
    }
    const double size = glm::length(area), h = frame.voxelSize;
    if (!(size > 0)) return false;
    middle /= size;
    for (const dvec3& corner : corners) reach = std::max(reach, glm::length(corner - middle));
    out.kind = ivec4(kPolygonLight, static_cast<int>(corners.size()), 0, 0);
    out.place = vec4(frame.place(middle), size / (h * h));
    out.rgb = vec4(light.rgb, kFarOff * reach / h);
    out.axis = vec4(frame.direction(area), 0);
    return true;
}

/// False if nothing of it falls on the plane.
bool describe(const Light& light, double y, const Frame& frame, GroundLight& out) {
    const double h = frame.voxelSize;
    if (light.kind == Kind::rect) return describeRect(light, y, frame, out);
    out.place = vec4(frame.place(light.vector), light.radius / h);
    const bool isSphere = light.kind == Kind::sphere;
    out.rgb = vec4(light.rgb / (isSphere ? 1 : h * h), 0);
    out.kind.x = isSphere ? kSphereLight : light.kind == Kind::spot ? kConeLight : kPointLight;
    if (light.kind == Kind::spot) {
        out.axis = vec4(frame.direction(light.axis), 0);
        out.cone = vec4(glm::radians(light.angle - light.soft),
                        glm::radians(light.angle + light.soft), 0, 0);
    }
    return light.vector.y + light.radius > y;
}

/// Squares along an axis of the world; the number at the domain's own origin is told modulo 2,
/// which is all that counts and is exact in floats.
vec4 squaresAlong(const dvec3& axis, double square, const scene::Scene& scene) {
    if (square <= 0) return vec4(0);
    const glm::dmat4 worldFromVoxel = glm::inverse(scene.voxelFromWorld());
    const double first = glm::dot(axis, dvec3(worldFromVoxel[3])) / square;
    const dvec3 along = glm::transpose(glm::dmat3(worldFromVoxel)) * axis / square;
    return vec4(along, first - 2 * std::floor(0.5 * first));
}

} // namespace

glm::dvec3 evenIrradiance(const scene::Light& light) {
    const dvec3 towards = -light.vector;
    const double half = glm::radians(0.5 * light.angle);
    const bool whole = std::asin(std::clamp(towards.y, -1.0, 1.0)) >= half;
    return light.rgb *
           (whole || half == 0 ? std::max(towards.y, 0.0) : discIrradiance(towards, half));
}

GroundParams groundParams(const scene::Ground& ground, const scene::Scene& scene) {
    GroundParams params{};
    const Frame frame{scene.voxelFromWorld(), scene.voxelSize()};
    const dvec3 up = frame.direction({0, 1, 0});
    const dvec3 foot = frame.place({0, ground.plane.y, 0});
    params.plane = vec4(up, -glm::dot(up, foot));
    params.right = squaresAlong({1, 0, 0}, ground.plane.square, scene);
    params.front = squaresAlong({0, 0, 1}, ground.plane.square, scene);
    params.albedo = vec4(ground.plane.albedo, volume::Ground::kDark);
    dvec3 constant = ground.lights.upward;
    int count = 0;
    for (const Light& light : ground.lights.lights) {
        if (!light.hasPlace()) {
            constant += evenIrradiance(light);
            continue;
        }
        if (count == kMostGroundLights)
            throw DataError(scene.path + ": more than " + std::to_string(kMostGroundLights) +
                            " lights that stand somewhere fall on the ground, by metadata '" +
                            scene::kLightsKey + "'");
        if (describe(light, ground.plane.y, frame, params.lights[count])) ++count;
    }
    params.constant = vec4(constant, 0);
    params.low = vec4(ground.low, 0);
    params.high = vec4(ground.high, 0);
    params.numbers = ivec4(count, ground.region, 0, 0);
    return params;
}

} // namespace eikonal::view
