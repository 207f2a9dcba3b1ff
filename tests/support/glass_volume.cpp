// Scenes of glass twice over, as the judge's solids and as voxels, and what a picture makes of
// them. SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace eikonal::sharp {

namespace {

/// The index of the solid that holds x, as files mix it for blurred tracing.
double mixedIndex(const judge::Glass& glass, const dvec3& x) {
    const judge::Solid* found = nullptr;
    for (const judge::Solid& solid : glass.solids)
        if (distanceTo(solid, x) < 0 && (!found || solid.priority >= found->priority))
            found = &solid;
    return found ? found->index : glass.around;
}

volume::DenseGrid dense(const ivec3& size, const std::function<double(dvec3)>& value) {
    volume::DenseGrid grid;
    grid.size = size;
    forEachVoxel(
        size, [&](ivec3 p) { grid.values.push_back(static_cast<float>(value(dvec3(p) + 0.5))); });
    return grid;
}

/// The index of a graded ball, which goes on beyond the boundary as a file's one-sided values do;
/// from 0.15 radii off n² falls exponentially with the same slope, so that it stays positive.
double continued(const judge::Solid& solid, const dvec3& x) {
    const dvec3 r = x - solid.centre;
    const double off = glm::length(r), reach = 1.15 * solid.radius;
    if (off <= reach) return solid.graded->index(x);
    const dvec3 out = r / off, edge = solid.centre + reach * out;
    const double n = solid.graded->index(edge);
    return n * std::exp(glm::dot(solid.graded->force(edge), out) / (n * n) * (off - reach));
}

/// Whether x, on a boundary, is near an edge of a hull.
bool nearEdge(const judge::Glass& glass, const dvec3& x) {
    for (const judge::Solid& solid : glass.solids) {
        int faces = 0;
        for (const judge::Plane& plane : solid.planes)
            faces += std::abs(glm::dot(plane.normal, x) - plane.offset) < kEdge;
        if (faces > 1 && distanceTo(solid, x) < kEdge) return true;
    }
    return false;
}

/// Four rays beside one.
std::array<judge::Ray, 4> raysAside(const judge::Ray& ray, double off) {
    const dvec3 d = glm::normalize(ray.direction);
    const dvec3 least = std::abs(d.y) > 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 u = glm::normalize(glm::cross(d, least)), v = glm::cross(d, u);
    return {judge::Ray{ray.x + off * u, d},
            {ray.x - off * u, d},
            {ray.x + off * v, d},
            {ray.x - off * v, d}};
}

/// Whether the power that leaves is told by the ray and not by rounding: 2e-5 is a fifth of the
/// bar.
bool tellableTree(const judge::Glass& glass, const judge::Ray& ray, const judge::Limits& limits) {
    const judge::Tree tree = judge::followAll(glass, ray, limits);
    for (const dvec3& x : tree.met)
        if (nearEdge(glass, x)) return false;
    for (const judge::Ray& aside : raysAside(ray, 0.01))
        if (std::abs(judge::followAll(glass, aside, limits).sum() - tree.sum()) > 2e-5)
            return false;
    return true;
}

} // namespace

double distanceTo(const judge::Solid& solid, const dvec3& x) {
    if (solid.planes.empty()) return glm::length(x - solid.centre) - solid.radius;
    double farthest = -1e300;
    for (const judge::Plane& plane : solid.planes)
        farthest = std::max(farthest, glm::dot(plane.normal, x) - plane.offset);
    return farthest;
}

volume::Volume volumeOf(const judge::Glass& glass, const Voxels& voxels) {
    const double h = voxels.voxelSize;
    const bool one = glass.solids.size() == 1;
    TestVolume scene(voxels.size, h);
    scene.index(
        [&](dvec3 p) {
            if (!one) return mixedIndex(glass, p / h);
            const judge::Solid& solid = glass.solids[0];
            return solid.graded ? continued(solid, p / h) : solid.index;
        },
        glass.around);
    volume::Volume volume = scene.take();
    for (size_t i = 0; i < glass.solids.size(); ++i) {
        const judge::Solid& solid = glass.solids[i];
        const std::string name = one ? "" : "S" + std::to_string(i);
        const bool own = i < voxels.distances.size() && voxels.distances[i];
        const volume::DenseGrid distances = dense(voxels.size, [&](dvec3 p) {
            return h * (own ? voxels.distances[i](p) : distanceTo(solid, p));
        });
        volume.putLevelSet({name, one ? "sdf" : "sdf." + name, solid.priority, static_cast<int>(i)},
                           {ivec3(0), voxels.size - 1}, distances, voxels.halfWidth);
        if (!one)
            volume.putConstant(volume::ownGrid("ior", name),
                               glm::vec3(static_cast<float>(solid.index)));
    }
    return volume;
}

// Of branches below it the judge drops the light that a ray takes along: far below every bar.
constexpr double kCutoff = 1e-6;

view::Params sharply(view::Params params) {
    params.boundary = optics::Boundary::sharp;
    params.maxDepth = 8;
    params.cutoff = kCutoff;
    return params;
}

view::Params along(const dvec3& direction, const dvec3& target, double height,
                   const glm::ivec2& size) {
    const dvec3 d = glm::normalize(direction);
    const dvec3 up = std::abs(d.y) > 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    return sharply(view::parallel(target - 80.0 * d, target, height, size, up));
}

view::Params oneRay(const judge::Ray& ray) {
    const dvec3 d = glm::normalize(ray.direction);
    const dvec3 up = std::abs(d.y) > 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    return sharply(view::parallel(ray.x, ray.x + d, 1e-3, {1, 1}, up));
}

judge::Ray rayOf(const view::Params& params, int x, int y) {
    const view::Camera& camera = params.camera;
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const dvec3 up = glm::cross(right, forward);
    const double pixel = camera.height / camera.rows;
    return {camera.eye + pixel * (x + 0.5 - 0.5 * camera.width) * right +
                pixel * (0.5 * camera.rows - y - 0.5) * up,
            forward};
}

double degreesBetween(const dvec3& a, const dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

Off offOf(const view::Look& look, const view::Params& params, const judge::Glass& glass,
          const std::function<bool(const judge::Ray&)>& counts) {
    Off off;
    for (int y = 0; y < look.picture.height; ++y)
        for (int x = 0; x < look.picture.width; ++x) {
            const judge::Ray ray = rayOf(params, x, y);
            if (!counts(ray)) continue;
            const judge::Exit wanted =
                judge::exitOf(glass, ray, dvec3(0), dvec3(look.plan.scene.size()));
            const double degrees = degreesBetween(look.direction(x, y), wanted.direction);
            if (!(degrees <= off.degrees)) off.degrees = degrees, off.worst = ray;
            // Across: where a ray leaves a face at a slant it says more of the slant than of the
            // ray.
            const dvec3 apart = look.place(x, y) - wanted.x;
            const dvec3 across = apart - glm::dot(apart, wanted.direction) * wanted.direction;
            off.place = std::max(off.place, glm::length(across));
            off.optical = std::max(off.optical, std::abs(look.at("optical_path_length.V", x, y) -
                                                         wanted.opticalLength));
            ++off.rays;
        }
    return off;
}

double impactOf(const judge::Ray& ray, const dvec3& centre, double radius) {
    const dvec3 r = centre - ray.x, d = glm::normalize(ray.direction);
    return glm::length(r - glm::dot(r, d) * d) / radius;
}

bool tellable(const judge::Glass& glass, const judge::Ray& ray) {
    const judge::Path path = judge::followTransmitted(glass, ray, 8);
    if (!path.left) return false;
    for (const judge::Met& met : path.met)
        if (nearEdge(glass, met.x)) return false;
    for (const judge::Ray& aside : raysAside(ray, 1e-3)) {
        const judge::Path other = judge::followTransmitted(glass, aside, 8);
        if (other.met.size() != path.met.size() ||
            degreesBetween(other.ray.direction, path.ray.direction) > 0.011)
            return false;
    }
    return true;
}

double energyOff(const view::Look& look, const view::Params& params, const judge::Glass& glass,
                 const std::function<bool(const judge::Ray&)>& counts, int* rays) {
    const judge::Limits limits{.maxDepth = params.maxDepth, .minThroughput = params.cutoff};
    double off = 0;
    for (int y = 0; y < look.picture.height; ++y)
        for (int x = 0; x < look.picture.width; ++x) {
            const judge::Ray ray = rayOf(params, x, y);
            if (!counts(ray) || !tellableTree(glass, ray, limits)) continue;
            const double wanted = judge::radiance(
                glass, ray, [](const dvec3&) { return 1.0; }, limits);
            off = std::max(off, std::abs(look.at("R", x, y) - wanted));
            if (rays) ++*rays;
        }
    return off;
}

image::Image mapOf(const std::function<dvec3(dvec3)>& radiance, int width) {
    const int height = width / 2;
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            // Row 0 is +Y, the centre +Z, +X at longitude +π/2, which is left of the centre.
            const double longitude = std::numbers::pi * (1 - 2 * (x + 0.5) / width);
            const double latitude = std::numbers::pi * (0.5 - (y + 0.5) / height);
            const dvec3 value =
                radiance({std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                          std::cos(latitude) * std::cos(longitude)});
            for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(value[c]));
        }
    image::Image map(width, height);
    map.addChannels({"R", "G", "B"}, values, 3);
    return map;
}

} // namespace eikonal::sharp
