// Holds a picture's exit directions and positions against rays traced through the exact surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "wineglass/compare.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <stdexcept>
#include <string>

namespace wineglass {

namespace {

judge::Ray rayOf(const eikonal::camera::Camera& camera, int x, int y) {
    const eikonal::camera::CameraAxes axes = eikonal::camera::axesOf(camera);
    const double height =
        camera.parallel ? camera.height : 2 * std::tan(glm::radians(camera.fov) / 2);
    const double pixel = height / camera.rows;
    const dvec3 off = pixel * (x + 0.5 - 0.5 * camera.width) * axes.right +
                      pixel * (0.5 * camera.rows - y - 0.5) * axes.up;
    if (camera.parallel) return {camera.eye + off, axes.forward};
    return {camera.eye, glm::normalize(axes.forward + off)};
}

/// Whether x is in the domain, or no further than `margin` from it; negative: well within.
bool isIn(const Setting& setting, const dvec3& x, double margin) {
    return glm::all(glm::greaterThan(x, setting.low - margin)) &&
           glm::all(glm::lessThan(x, setting.high + margin));
}

/// What a ray meets within the domain; nothing where it would meet glass near the domain's faces,
/// is in glass there, or does not leave.
std::optional<judge::Path> pathWithin(const Setting& setting, const judge::Ray& ray) {
    judge::Path path = judge::followTransmitted(setting.glass, ray, setting.mostMet);
    const double margin = 3 * setting.voxel;
    for (size_t i = 0; i < path.met.size(); ++i) {
        const dvec3& x = path.met[i].x;
        if (isIn(setting, x, -margin)) continue;
        // It has left the domain on its way here, unless that was in glass.
        if (i == 0 || path.met[i].from != judge::kAround || isIn(setting, x, margin)) return {};
        path.ray = {path.met[i - 1].x, glm::normalize(x - path.met[i - 1].x)};
        path.met.resize(i);
        return path;
    }
    if (!path.left) return {};
    return path;
}

double degreesBetween(const dvec3& a, const dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

double across(const dvec3& apart, const dvec3& direction) {
    return glm::length(apart - glm::dot(apart, direction) * direction);
}

bool tellable(const Setting& setting, const judge::Ray& ray, const judge::Path& path) {
    const dvec3 u = glm::normalize(glm::cross(ray.direction, setting.camera.up));
    const dvec3 v = glm::cross(u, ray.direction);
    for (const dvec3& aside : {u, -u, v, -v}) {
        const auto other =
            pathWithin(setting, {ray.x + 1e-3 * setting.voxel * aside, ray.direction});
        if (!other || other->met.size() != path.met.size() ||
            degreesBetween(other->ray.direction, path.ray.direction) > 0.011)
            return false;
    }
    return true;
}

int reflectionsOf(const judge::Path& path) {
    return static_cast<int>(std::ranges::count(path.met, 1.0, &judge::Met::reflected));
}

constexpr double kTight = 10, kReach = 4; // [voxel]

bool atEdge(const Setting& setting, const judge::Met& met) {
    const judge::dvec2 at(std::hypot(met.x.x, met.x.z), met.x.y);
    return std::ranges::any_of(setting.glass.pieces, [&](const judge::ProfilePiece& piece) {
        if (!piece.curved || piece.radius > kTight * setting.voxel) return false;
        const double off = std::min(glm::length(at - piece.from), glm::length(at - piece.to));
        return off < kReach * setting.voxel ||
               (std::abs(piece.distance(at)) < setting.voxel && piece.reaches(at));
    });
}

Course courseOf(const Setting& setting, const judge::Path& path) {
    for (const judge::Met& met : path.met)
        if (atEdge(setting, met)) return Course::edge;
    if (reflectionsOf(path) > 0) return Course::total;
    const bool low = std::ranges::any_of(
        path.met, [&](const judge::Met& met) { return met.x.y < setting.bowl; });
    return low ? Course::thick : Course::wall;
}

class Exits {
public:
    explicit Exits(const eikonal::image::Image& aovs) : mAovs(aovs) {
        for (int k = 0; k < 3; ++k) {
            const std::string axis(1, "XYZ"[k]);
            mDirection[k] = channel("exit_direction." + axis);
            mPosition[k] = channel("exit_position." + axis);
        }
    }
    dvec3 direction(size_t i) const { return glm::normalize(at(mDirection, i)); }
    dvec3 position(size_t i) const { return at(mPosition, i); }

private:
    size_t channel(const std::string& name) const {
        const auto found = mAovs.find(name);
        if (!found) throw std::invalid_argument("the picture has no channel " + name);
        return *found;
    }
    dvec3 at(const std::array<size_t, 3>& channels, size_t i) const {
        return {mAovs.plane(channels[0])[i], mAovs.plane(channels[1])[i],
                mAovs.plane(channels[2])[i]};
    }
    const eikonal::image::Image& mAovs;
    std::array<size_t, 3> mDirection, mPosition;
};

} // namespace

std::array<Errors, 4> compare(const Setting& setting, const eikonal::image::Image& aovs) {
    if (aovs.width != setting.camera.width || aovs.height != setting.camera.rows)
        throw std::invalid_argument("the picture is not of the camera's size");
    const Exits exits(aovs);
    std::array<Errors, 4> all;
    for (int y = 0; y < aovs.height; ++y)
        for (int x = 0; x < aovs.width; ++x) {
            const judge::Ray ray = rayOf(setting.camera, x, y);
            const auto path = pathWithin(setting, ray);
            if (!path || path->met.empty()) continue;
            Errors& errors = all[static_cast<size_t>(courseOf(setting, *path))];
            if (!tellable(setting, ray, *path)) {
                ++errors.leftOut;
                continue;
            }
            const size_t i = static_cast<size_t>(y) * aovs.width + x;
            const dvec3 d = path->ray.direction;
            const double degrees = degreesBetween(exits.direction(i), d);
            const double apart = across(exits.position(i) - path->ray.x, d) / setting.voxel;
            ++errors.rays;
            errors.degrees.push_back(degrees);
            errors.apart.push_back(apart);
            errors.close += degrees < kCloseDegrees && apart < kCloseVoxels;
            errors.set = std::max(errors.set, across(path->ray.x - ray.x, ray.direction));
            errors.reflections = std::max(errors.reflections, reflectionsOf(*path));
        }
    for (Errors& errors : all) {
        std::ranges::sort(errors.degrees);
        std::ranges::sort(errors.apart);
    }
    return all;
}

double quantile(const std::vector<double>& sorted, double share) {
    if (sorted.empty()) return 0;
    return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

} // namespace wineglass
