// A gem in the round brilliant cut.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/brilliant.h"

#include "base/error.h"
#include "base/text.h"
#include "mesh/triangulate.h"

#include <cmath>
#include <numbers>

namespace eikonal::shapes {

using std::numbers::pi;

void BrilliantParams::check() const {
    requireOption(radius > 0 && std::isfinite(radius), "--radius", toText(radius), "above 0");
    const auto between = [](double value, double low, double high, const char* option) {
        requireOption(value > low && value < high, option, toText(value),
                      "above " + toText(low) + ", below " + toText(high));
    };
    between(table, 0, 100, "--table");
    between(crown, 0, 90, "--crown");
    between(pavilion, 0, 90, "--pavilion");
    between(girdle, 0, 100, "--girdle");
    between(star, 0, 100, "--star");
    between(culet, 0, 100, "--culet");
    between(lower, 0, 100 - culet, "--lower");
}

mesh::TriangleMesh makeBrilliant(const BrilliantParams& params) {
    // Of radius 1 first, where percent of the diameter and of the radius are the same.
    mesh::TriangleMesh stone;
    const auto corner = [&](unsigned sixteenth, double radius, double y) {
        const double a = sixteenth * pi / 8;
        stone.points.emplace_back(radius * std::cos(a), y, radius * std::sin(a));
        return static_cast<std::uint32_t>(stone.points.size() - 1);
    };
    const double beside = std::cos(pi / 8); // what a corner between two main facets has of its
                                            // radius along their normals
    const double table = params.table / 100, half = params.girdle / 100;
    const double crown = std::tan(params.crown * pi / 180), angle = params.pavilion * pi / 180;
    const double inner = table * beside + params.star / 100 * (1 - table * beside);
    const double deep = 1 - params.lower / 100, culet = params.culet / 100;
    const auto below = [&](double radius) {
        return -half - std::tan(angle) * (1 - radius * beside);
    };

    std::array<std::uint32_t, 8> T{}, S{}, L{}, C{}; // corners of table, stars, lower girdle, culet
    std::array<std::uint32_t, 16> A{}, B{};          // above and below the girdle
    for (unsigned k = 0; k < 8; ++k) {               // main facets face the even sixteenths
        T[k] = corner(2 * k, table, half + crown * (1 - table));
        S[k] = corner(2 * k + 1, inner, half + crown * (1 - inner * beside));
        L[k] = corner(2 * k + 1, deep, below(deep));
        C[k] = corner(2 * k + 1, culet, below(culet));
    }
    for (unsigned k = 0; k < 16; ++k) {
        A[k] = corner(k, 1, half);
        B[k] = corner(k, 1, -half);
    }
    if (!params.upright) { // about x until the main facet that faces z looks down
        double lowest = 0;
        for (glm::dvec3& p : stone.points) {
            p = {p.x, p.y * std::cos(angle) - p.z * std::sin(angle),
                 p.y * std::sin(angle) + p.z * std::cos(angle)};
            lowest = std::min(lowest, p.y);
        }
        for (glm::dvec3& p : stone.points) p.y -= lowest;
    }
    const auto facet = [&](const std::vector<std::uint32_t>& corners) {
        mesh::appendTriangles(stone.points, corners, stone.triangles);
    };
    facet({T.rbegin(), T.rend()});
    facet({C.begin(), C.end()});
    for (size_t k = 0; k < 8; ++k) {
        const size_t next = (k + 1) % 8, before = (k + 7) % 8;
        const size_t main = 2 * k, right = main + 1, far = (main + 2) % 16;
        facet({T[k], T[next], S[k]});                       // star
        facet({T[k], S[k], A[main], S[before]});            // bezel
        facet({S[k], A[right], A[main]});                   // upper girdle
        facet({S[k], A[far], A[right]});                    //
        facet({A[main], A[right], B[right], B[main]});      // girdle
        facet({A[right], A[far], B[far], B[right]});        //
        facet({L[k], B[main], B[right]});                   // lower girdle
        facet({L[k], B[right], B[far]});                    //
        facet({B[main], L[k], C[k], C[before], L[before]}); // pavilion
    }
    for (glm::dvec3& p : stone.points) p *= params.radius;
    mesh::setFlatNormals(stone);
    return stone;
}

} // namespace eikonal::shapes
