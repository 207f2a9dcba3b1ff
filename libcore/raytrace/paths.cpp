// Paths of viewing rays through bodies.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/paths.h"

#include "base/error.h"
#include "raytrace/dielectric.h"
#include "raytrace/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace eikonal::raytrace {

namespace {

using glm::dvec3;

/// Faces in a row that a path passes without an interface, where bodies overlap. At a corner
/// rounding might send it to and fro between two for ever.
constexpr int kMostPassed = 4096;

double brightest(const dvec3& share) {
    return std::max({share.x, share.y, share.z});
}

double meanOf(const dvec3& share) {
    return (share.x + share.y + share.z) / 3;
}

std::vector<const mesh::TriangleMesh*> meshesOf(const std::vector<Body>& bodies) {
    std::vector<const mesh::TriangleMesh*> meshes;
    for (const Body& body : bodies) meshes.push_back(&body.mesh);
    return meshes;
}

} // namespace

void Counters::operator+=(const Counters& other) {
    rays += other.rays;
    interfaces += other.interfaces;
    deep += other.deep;
    dim += other.dim;
    lost += other.lost;
}

/// A path that is followed, or waits to be.
struct Scene::Branch {
    dvec3 x, direction;
    dvec3 throughput; ///< of L/n²
    Windings within;
    int depth = 0;  ///< interfaces met
    int passed = 0; ///< faces since then that were none
    Face from{};    ///< which it starts on
};

/// A pixel's ray on its way.
struct Scene::Work {
    std::vector<Branch> waiting;
    FirstPath& first;
    Counters& counters;
    dvec3 light{0};      ///< L/n² so far
    bool isFirst = true; ///< the first branch is on its way
    dvec3 along{1};      ///< by what its throughput is more than its own: reflections not followed
};

Scene::Scene(const std::vector<Body>& bodies, const Params& params,
             const std::optional<image::Image>& map)
    : mBodies(bodies), mParams(params), mMap(map), mFaces(meshesOf(bodies)) {
    int clear = 0;
    for (const Body& body : bodies) mPlace.push_back(body.opaque ? kNone : clear++);
    if (clear < static_cast<int>(bodies.size())) mIrradiance = camera::irradianceFrom(params, map);
    requireOption(clear <= kMostClearBodies, "input", std::to_string(clear) + " clear bodies",
                  "at most " + std::to_string(kMostClearBodies));
}

Windings Scene::windingsAt(const dvec3& x) const {
    const std::vector<int> found = mFaces.windings(x);
    Windings windings{};
    for (size_t i = 0; i < mBodies.size(); ++i)
        if (mPlace[i] != kNone)
            windings[static_cast<size_t>(mPlace[i])] =
                static_cast<std::uint8_t>(std::clamp(found[i], 0, 255));
    return windings;
}

/// Where bodies overlap, the later one rules.
Scene::Medium Scene::mediumIn(const Windings& windings) const {
    for (size_t i = mBodies.size(); i-- > 0;)
        if (mPlace[i] != kNone && windings[static_cast<size_t>(mPlace[i])] > 0)
            return {mBodies[i].ior, mBodies[i].absorption, static_cast<int>(i)};
    return {mParams.outsideIor, dvec3(0), kNone};
}

bool Scene::coloured() const {
    return std::any_of(mBodies.begin(), mBodies.end(), [](const Body& body) {
        return !body.opaque &&
               (body.absorption.x != body.absorption.y || body.absorption.y != body.absorption.z);
    });
}

dvec3 Scene::radiance(const dvec3& eye, const dvec3& direction, const Windings& windings,
                      FirstPath& first, Counters& counters) const {
    first.x = eye;
    Work work{{}, first, counters};
    work.waiting.push_back({eye, direction, dvec3(1), windings});
    while (!work.waiting.empty()) {
        Branch branch = work.waiting.back();
        work.waiting.pop_back();
        while (step(branch, work)) {
        }
        if (work.isFirst) {
            first.direction = branch.direction;
            if (first.normal == dvec3(0))
                first.through = branch.throughput / work.along;
            else
                first.through = dvec3(0);
        }
        work.isFirst = false;
    }
    if (first.changed) ++counters.rays;
    const double n = mediumIn(windings).ior;
    return work.light * (n * n); // L/n² is what a ray keeps
}

void Scene::seeBeyond(const Branch& branch, Work& work) const {
    const double n = mParams.outsideIor;
    work.light +=
        branch.throughput * camera::radianceFrom(mParams, mMap, branch.direction) / (n * n);
}

/// A path ends on an opaque body, on the side that the normal looks to.
void Scene::land(const Branch& branch, Work& work, const Body& body, const dvec3& normal) const {
    const double n = mParams.outsideIor;
    const dvec3 leaves = body.albedo * camera::irradianceOn(mIrradiance, normal) / std::numbers::pi;
    work.light += branch.throughput * leaves / (n * n);
    if (work.isFirst) work.first.normal = normal;
}

/// To the next face and beyond. False: the path has ended.
bool Scene::step(Branch& branch, Work& work) const {
    const auto hit = mFaces.next(branch.x, branch.direction, branch.from);
    if (!hit || branch.passed > kMostPassed) {
        if (mediumIn(branch.within).body != kNone) work.counters.lost += meanOf(branch.throughput);
        seeBeyond(branch, work);
        return false;
    }
    const Body& body = mBodies[hit->face.mesh];
    const SurfacePoint point =
        surfaceAt(body.mesh, hit->face.triangle, branch.x + hit->t * branch.direction);
    const Medium here = mediumIn(branch.within);
    if (here.body != kNone) {
        const double length = glm::distance(point.x, branch.x);
        branch.throughput *= glm::exp(-here.absorption * length);
        if (work.isFirst) {
            work.first.length += length;
            work.first.opticalLength += here.ior * length;
        }
    }
    branch.x = point.x;
    branch.from = hit->face;
    const bool enters = glm::dot(branch.direction, point.face) < 0;
    Windings beyond = branch.within;
    if (!body.opaque) {
        std::uint8_t& winding = beyond[static_cast<size_t>(mPlace[hit->face.mesh])];
        if (enters && winding < 255) ++winding;
        // A path outside may run a little below a flat face that stands for a round surface: where
        // it comes out again there is nothing.
        if (!enters && winding > 0) --winding;
        const Medium there = mediumIn(beyond);
        if (there.body == here.body ||
            (there.ior == here.ior && there.absorption == here.absorption)) {
            branch.within = beyond;
            ++branch.passed;
            return true;
        }
    }
    if (work.isFirst) {
        work.first.x = point.x;
        work.first.changed = true;
    }
    ++work.counters.interfaces;
    if (body.opaque) {
        land(branch, work, body, enters ? point.smooth : -point.smooth);
        return false;
    }
    return part(branch, work, beyond, point);
}

/// A ray parts at an interface: what is refracted goes on, what is reflected waits.
bool Scene::part(Branch& branch, Work& work, const Windings& beyond,
                 const SurfacePoint& point) const {
    if (branch.depth >= mParams.maxDepth) {
        work.counters.deep += meanOf(branch.throughput);
        seeBeyond(branch, work);
        return false;
    }
    const Medium here = mediumIn(branch.within), there = mediumIn(beyond);
    const dvec3 back = glm::dot(branch.direction, point.face) < 0 ? point.face : -point.face;
    const dvec3 normal = facingNormal(point.smooth, back, branch.direction);
    const Scattered made = scatter(branch.direction, normal, here.ior, there.ior);
    const auto branchOf = [&](const dvec3& direction, double share, bool goesBeyond) {
        const bool inside = (goesBeyond ? there : here).body != kNone;
        return Branch{point.x,
                      inside ? keptWithin(direction, goesBeyond ? -back : back) : direction,
                      branch.throughput * share,
                      goesBeyond ? beyond : branch.within,
                      branch.depth + 1,
                      0,
                      branch.from};
    };
    const Branch mirrored = branchOf(made.reflected, made.reflectance, false);
    if (made.refracted) {
        branch = branchOf(*made.refracted, 1 - made.reflectance, true);
        if (brightest(mirrored.throughput) >= mParams.cutoff) {
            work.waiting.push_back(mirrored);
        } else {
            const dvec3 both = branch.throughput + mirrored.throughput;
            if (work.isFirst) work.along *= both / glm::max(branch.throughput, dvec3(1e-30));
            branch.throughput = both;
        }
    } else {
        branch = mirrored;
    }
    if (brightest(branch.throughput) >= mParams.cutoff * mParams.cutoff) return true;
    work.counters.dim += meanOf(branch.throughput);
    seeBeyond(branch, work);
    return false;
}

} // namespace eikonal::raytrace
