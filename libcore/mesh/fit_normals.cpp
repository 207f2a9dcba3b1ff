// Fans' normals by which every edge is bent alike at both its ends.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fit_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tbb/parallel_for.h>

namespace eikonal::mesh {

namespace {

using glm::dvec2;
using glm::dvec3;

/// The corners of each fan, fan by fan.
struct CornersOfFans {
    explicit CornersOfFans(const Fans& fans) : ends(fans.normals.size() + 1, 0) {
        for (const glm::uvec3& of : fans.of)
            for (int k = 0; k < 3; ++k) ++ends[of[k] + 1];
        for (size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
        corners.resize(ends.back());
        std::vector<size_t> next(ends.begin(), ends.end() - 1);
        for (std::uint32_t f = 0; f < fans.of.size(); ++f)
            for (std::uint32_t k = 0; k < 3; ++k)
                corners[next[fans.of[f][static_cast<int>(k)]]++] = 3 * f + k;
    }
    std::vector<size_t> ends;
    std::vector<std::uint32_t> corners; ///< 3 · face + k
};

/// The least squares of what a fan's normal leaves over its edges, for a turn of it.
struct Turn {
    explicit Turn(const dvec3& of) : normal(of) {
        const dvec3 aside = std::abs(of.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        u = glm::normalize(glm::cross(of, aside));
        v = glm::cross(of, u);
    }
    /// An edge along `chord` to a fan with a normal of its own.
    void add(const dvec3& chord, const dvec3& other) {
        const double square = glm::dot(chord, chord);
        if (!(square > 0) || other == dvec3(0)) return;
        // The angle left grows by the length's square where curvature changes: what it says counts
        // by the inverse, squared, and once more the length's for the angle's sine.
        const double weight = 1 / (square * square * square);
        const dvec2 across(glm::dot(chord, u), glm::dot(chord, v));
        const double left = glm::dot(chord, normal + other);
        uu += weight * across.x * across.x;
        uv += weight * across.x * across.y;
        vv += weight * across.y * across.y;
        right -= weight * left * across;
    }
    /// What the turn is worth: the sum of squares that it saves, over the weights.
    double gain() const {
        const dvec3 by = turned() - normal;
        const dvec2 t(glm::dot(by, u), glm::dot(by, v));
        const double saved =
            2 * glm::dot(right, t) - uu * t.x * t.x - 2 * uv * t.x * t.y - vv * t.y * t.y;
        const double share = saved / (uu + vv);
        return std::isfinite(share) ? share : 0; // no edges, or some too short to tell
    }
    dvec3 turned() const {
        const double kStay = 0.01; // of the weights, for staying: what no edge asks for stays
        const double stay = kStay * (uu + vv), a = uu + stay, c = vv + stay;
        const double area = a * c - uv * uv;
        if (!(area > 0)) return normal;
        const dvec2 by = dvec2(c * right.x - uv * right.y, a * right.y - uv * right.x) / area;
        return glm::normalize(normal + by.x * u + by.y * v);
    }

    dvec3 normal, u, v;
    double uu = 0, uv = 0, vv = 0;
    dvec2 right{0};
};

} // namespace

void fitNormals(const TriangleMesh& mesh, const std::vector<char>& fixed, Fans& fans) {
    // Few: along a chain of edges errors of points that take turns could add up.
    constexpr int kSweeps = 2;
    const CornersOfFans of(fans);
    const auto turnOf = [&](std::uint32_t fan) {
        Turn turn(fans.normals[fan]);
        for (size_t i = of.ends[fan]; i < of.ends[fan + 1]; ++i) {
            const std::uint32_t face = of.corners[i] / 3;
            const int k = static_cast<int>(of.corners[i] % 3);
            const glm::uvec3& points = mesh.triangles[face];
            for (const int j : {(k + 1) % 3, (k + 2) % 3})
                turn.add(mesh.points[points[j]] - mesh.points[points[k]],
                         fans.normals[fans.of[face][j]]);
        }
        return turn;
    };
    std::vector<std::uint32_t> order;
    for (std::uint32_t fan = 0; fan < fans.normals.size(); ++fan)
        if (!fixed[fan] && fans.normals[fan] != dvec3(0)) order.push_back(fan);
    std::vector<double> gains(fans.normals.size(), 0);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        // The worst first: what is wrong is put right by what is right, not the other way round.
        tbb::parallel_for(size_t{0}, order.size(),
                          [&](size_t i) { gains[order[i]] = turnOf(order[i]).gain(); });
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return gains[a] > gains[b]; });
        for (const std::uint32_t fan : order) fans.normals[fan] = turnOf(fan).turned();
    }
}

} // namespace eikonal::mesh
