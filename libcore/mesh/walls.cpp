// How thick a mesh's solid is where it is thinnest.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/walls.h"

#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>
#include <vector>

namespace eikonal::mesh {

namespace {

using glm::dvec3;

constexpr size_t kSamples = 20000;
constexpr size_t kSites = 64; // thinnest samples from which the search goes on
constexpr int kHalvings = 12; // of its stride, to 1/4000 of the distance between samples
const double kOpposite = -std::cos(glm::radians(30.0));

/// A wall with the direction across it.
struct Across {
    Wall wall;
    dvec3 normal; ///< of the face it was measured from
};

class Probe {
public:
    explicit Probe(const TriangleMesh& mesh) : mMesh(mesh), mTree(mesh) {
        const Box box = boundingBox(mesh);
        mSkin = 1e-9 * glm::distance(box.min, box.max);
    }

    dvec3 normalOf(size_t face) const {
        const glm::uvec3& f = mMesh.triangles[face];
        const dvec3 normal = glm::cross(mMesh.points[f.y] - mMesh.points[f.x],
                                        mMesh.points[f.z] - mMesh.points[f.x]);
        const double length = glm::length(normal);
        return length > 0 ? normal / length : dvec3(0);
    }

    /// The wall behind a point of a face that bounds the solid.
    std::optional<Across> behind(const dvec3& x, size_t face) const {
        const dvec3 normal = normalOf(face);
        // Faces of no area have no normal; those within the solid have some of it on both sides.
        if (normal == dvec3(0) || mTree.winding(x + mSkin * normal) > 0) return {};
        const auto exit = exitFrom(x - mSkin * normal, -normal);
        if (!exit || glm::dot(normalOf(exit->face), normal) > kOpposite) return {};
        const double thickness = exit->t + mSkin;
        return Across{{thickness, x - 0.5 * thickness * normal}, normal};
    }

    /// The wall around a point of the solid, along or against a direction.
    std::optional<Across> around(const dvec3& x, const dvec3& direction) const {
        if (mTree.winding(x) <= 0) return {};
        const auto front = exitFrom(x, direction);
        if (!front) return {};
        return behind(x + front->t * direction, front->face);
    }

private:
    /// Where a ray that starts in the solid leaves it.
    std::optional<TriangleTree::Hit> exitFrom(const dvec3& x, const dvec3& direction) const {
        std::vector<TriangleTree::Hit> hits;
        mTree.hits(x, direction, std::numeric_limits<double>::max(), hits);
        std::sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
        int winding = mTree.winding(x);
        for (const TriangleTree::Hit& hit : hits) {
            winding += glm::dot(normalOf(hit.face), direction) > 0 ? -1 : 1;
            if (winding <= 0) return hit;
        }
        return {};
    }

    const TriangleMesh& mMesh;
    TriangleTree mTree;
    double mSkin; // far above rounding, far below any wall [unit]
};

struct Sample {
    dvec3 x;
    size_t face;
};

/// Points spread over the surface by area, within faces by the R2 sequence (Roberts 2018).
std::vector<Sample> samplesOf(const TriangleMesh& mesh, double& spacing) {
    std::vector<double> areas;
    double total = 0;
    for (const glm::uvec3& f : mesh.triangles) {
        const dvec3 &a = mesh.points[f.x], &b = mesh.points[f.y], &c = mesh.points[f.z];
        areas.push_back(total += 0.5 * glm::length(glm::cross(b - a, c - a)));
    }
    spacing = std::sqrt(total / kSamples);
    std::vector<Sample> samples;
    size_t face = 0;
    for (size_t i = 0; i < kSamples; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / kSamples * total;
        while (face + 1 < areas.size() && areas[face] < share) ++face;
        const glm::uvec3& f = mesh.triangles[face];
        double u = std::fmod(0.7548776662466927 * static_cast<double>(i + 1), 1.0);
        double v = std::fmod(0.5698402909980532 * static_cast<double>(i + 1), 1.0);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const dvec3 &a = mesh.points[f.x], &b = mesh.points[f.y], &c = mesh.points[f.z];
        samples.push_back({a + u * (b - a) + v * (c - a), face});
    }
    return samples;
}

/// Goes sideways in ever smaller strides while the wall gets thinner.
Across downhill(const Probe& probe, Across best, double stride) {
    for (int i = 0; i < kHalvings; ++i, stride /= 2)
        for (bool thinner = true; thinner;) {
            thinner = false;
            const dvec3 n = best.normal;
            const dvec3 aside = std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
            const dvec3 u = glm::normalize(glm::cross(n, aside)), v = glm::cross(n, u);
            for (const dvec3& step : {dvec3(0), u, -u, v, -v})
                for (const double side : {1.0, -1.0}) {
                    const auto found =
                        probe.around(best.wall.middle + stride * step, side * best.normal);
                    // By a share worth a step, or the search would creep.
                    if (!found || found->wall.thickness > best.wall.thickness * (1 - 1e-3))
                        continue;
                    best = *found;
                    thinner = true;
                }
        }
    return best;
}

} // namespace

std::optional<Wall> thinnestWall(const TriangleMesh& mesh) {
    const Probe probe(mesh);
    double spacing = 0;
    const std::vector<Sample> samples = samplesOf(mesh, spacing);
    std::vector<std::optional<Across>> found(samples.size());
    tbb::parallel_for(size_t{0}, samples.size(),
                      [&](size_t i) { found[i] = probe.behind(samples[i].x, samples[i].face); });
    std::erase(found, std::nullopt);
    const auto thinner = [](const auto& a, const auto& b) {
        return a->wall.thickness < b->wall.thickness;
    };
    std::stable_sort(found.begin(), found.end(), thinner);
    if (found.empty()) return {};
    found.resize(std::min(found.size(), kSites));
    tbb::parallel_for(size_t{0}, found.size(),
                      [&](size_t i) { found[i] = downhill(probe, *found[i], spacing); });
    return (*std::min_element(found.begin(), found.end(), thinner))->wall;
}

} // namespace eikonal::mesh
