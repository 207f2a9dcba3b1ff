// Distances to the surfaces that facets stand for, against those of formulas.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/smooth_surface.h"
#include "support/lattice.h"
#include "voxelize/curve.h"
#include "voxelize/distances.h"

#include <functional>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace eikonal::voxelize {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec3;
using mesh::TriangleMesh;

constexpr double kBand = 6;

TriangleMesh curvedBy(const TriangleMesh& mesh, double degrees, double sagitta = kSagitta) {
    mesh::SmoothCounts counts;
    TriangleMesh result = mesh::curved(mesh, mesh::findFans(mesh, degrees), sagitta, counts);
    EXPECT_EQ(counts.flat, 0u);
    return result;
}

struct Deviation {
    double most = 0, rms = 0; // of the distance [voxel]
    double slope = 0;         // rms of its gradient's direction [degree]
    int wrongSide = 0;
};

/// Against a formula, over the voxels within 5 of the surface where `counts`.
Deviation compare(const TriangleMesh& mesh, const ivec3& size,
                  const std::function<double(dvec3)>& formula,
                  const std::function<bool(dvec3)>& counts = [](const dvec3&) { return true; }) {
    const Lattice lattice = latticeAt(dvec3(-0.5), 1, size, 1);
    const volume::BrickGrid grid = signedDistances(mesh, lattice, kBand);
    Deviation found;
    int voxels = 0;
    for (int z = 1; z + 1 < size.z; ++z)
        for (int y = 1; y + 1 < size.y; ++y)
            for (int x = 1; x + 1 < size.x; ++x) {
                const ivec3 at(x, y, z);
                const double wanted = formula(dvec3(at));
                if (std::abs(wanted) > 4 || !counts(dvec3(at))) continue;
                const double value = grid.at(at);
                found.most = std::max(found.most, std::abs(value - wanted));
                found.rms += (value - wanted) * (value - wanted);
                found.wrongSide += std::abs(wanted) > 1e-5 && value * wanted < 0;
                dvec3 slope, formulas;
                for (int axis = 0; axis < 3; ++axis) {
                    ivec3 step(0);
                    step[axis] = 1;
                    slope[axis] = grid.at(at + step) - grid.at(at - step);
                    formulas[axis] = formula(dvec3(at + step)) - formula(dvec3(at - step));
                }
                const double sine = glm::length(
                    glm::cross(glm::normalize(slope), glm::normalize(formulas)));
                found.slope += sine * sine;
                ++voxels;
            }
    EXPECT_GT(voxels, 1000);
    found.rms = std::sqrt(found.rms / voxels);
    found.slope = glm::degrees(std::sqrt(found.slope / voxels));
    return found;
}

void tell(const char* name, const TriangleMesh& flat, const TriangleMesh& mesh, const ivec3& size,
          const std::function<double(dvec3)>& formula,
          const std::function<bool(dvec3)>& counts = [](const dvec3&) { return true; }) {
    for (const TriangleMesh* m : {&flat, &mesh}) {
        const Deviation d = compare(*m, size, formula, counts);
        std::printf("%-20s %8zu most %.6f rms %.6f slope %.5f wrong %d\n", name,
                    m->triangles.size(), d.most, d.rms, d.slope, d.wrongSide);
    }
}

TEST(Curve, Fillet) {
    const dvec3 c(20.3, 20.6, 20.1);
    const auto filleted = [&](const dvec3& x) {
        const dvec3 p = x - c;
        const dvec2 q(glm::length(dvec2(p.x, p.z)) - 10, std::abs(p.y) - 8);
        return glm::length(glm::max(q, 0.0)) + std::min(std::max(q.x, q.y), 0.0) - 3;
    };
    for (int rings : {1, 3}) for (int n : {4, 6, 12}) {
        std::vector<dvec2> profile = {{0, -11}};
        for (int r = 1; r < rings; ++r) profile.emplace_back(10. * r / rings, -11);
        for (int i = 0; i <= n; ++i) {
            const double a = glm::half_pi<double>() * i / n;
            profile.emplace_back(10 + 3 * std::sin(a), -8 - 3 * std::cos(a));
        }
        for (int i = 0; i <= n; ++i) {
            const double a = glm::half_pi<double>() * i / n;
            profile.emplace_back(10 + 3 * std::cos(a), 8 + 3 * std::sin(a));
        }
        for (int r = rings - 1; r >0 ; --r) profile.emplace_back(10. * r / rings, 11);
        profile.emplace_back(0, 11);
        const TriangleMesh m = mesh::moved(mesh::turned(profile, 48, false), c);
        tell("fillet", m, curvedBy(m, 30), ivec3(41), filleted);
        TriangleMesh own = m;
        const mesh::Fans fans = mesh::findFans(m, 30);
        for (size_t f = 0; f < m.triangles.size(); ++f) {
            own.normals.emplace_back();
            for (int k = 0; k < 3; ++k) {
                dvec3 p = m.points[m.triangles[f][k]] - c;
                dvec2 r(glm::length(dvec2(p.x, p.z)), p.y);
                dvec2 q = r - glm::clamp(r, dvec2(0, -8), dvec2(10, 8));
                q = glm::normalize(q);
                dvec3 n = r.x > 0 ? dvec3(p.x / r.x * q.x, q.y, p.z / r.x * q.x) : dvec3(0, q.y, 0);
                own.normals[f][k] = n;
                if (f % 48 == 1 && p.y < 0 && k == 0) {
                    dvec3 N = fans.normals[fans.of[f][k]];
                    printf("r %.3f y %.3f err %.3f\n", r.x, p.y, glm::degrees(glm::length(glm::cross(N, n))));
                }
            }
        }
        tell("own", m, curvedBy(own, 30), ivec3(41), filleted);
    }
}

TEST(Curve, Noise) {
    const dvec3 c(20.3, 20.6, 20.1);
    const auto ball = [&](const dvec3& x) { return glm::distance(x, c) - 15; };
    for (int n : {3, 4, 5}) for (double e : {0.003, 0.01, 0.03}) {
        TriangleMesh m = mesh::moved(mesh::icosphere(15, n), c);
        unsigned seed = 1;
        for (auto& p : m.points) { seed = seed * 1664525u + 1013904223u; p += e * (2 * (seed / 4294967296.) - 1) * glm::normalize(p - c); }
        std::printf("%g ", e);
        tell("noise", m, curvedBy(m, 30), ivec3(41), ball);
    }
}
TEST(Curve, Ellipsoid) {
    const dvec3 c(20.3, 20.6, 20.1);
    const dvec3 r(15,9,12);
    const auto ball = [&](const dvec3& x) { dvec3 p=x-c; const double k=glm::length(p/r); dvec3 g=p/(r*r); 
        // Newton for distance
        double t=0; for(int i=0;i<50;++i){ dvec3 q=p*r/(r*r+t); double f=glm::dot(q,q)-1; double df=-2*glm::dot(q*q,1.0/(r*r+t)); double dt=f/df; t-=dt; if(std::abs(dt)<1e-12)break; if(t<-80)t=-79.9;}
        dvec3 foot=p*r*r/(r*r+t); return (k>1?1:-1)*glm::distance(p,foot); };
    for (int n : {2, 3, 4, 5}) {
        TriangleMesh m = mesh::icosphere(1, n);
        for (auto& p : m.points) p=p*r+c;
        tell("ellipsoid", m, curvedBy(m, 40), ivec3(41), ball, [&](const dvec3&x){return ball(x)>-2.5;});
    }
}

TEST(Curve, Explore) {
    const dvec3 c(20.3, 20.6, 20.1);
    const auto ball = [&](const dvec3& x) { return glm::distance(x, c) - 15; };
    for (int n : {1, 2, 3, 4, 5}) {
        const TriangleMesh m = mesh::moved(mesh::icosphere(15, n), c);
        tell("icosphere", m, curvedBy(m, 30), ivec3(41), ball);
    }
    for (int n : {500, 2000, 8000}) {
        const TriangleMesh m = mesh::moved(mesh::uvSphere(15, n), c);
        tell("uvsphere", m, curvedBy(m, 30), ivec3(41), ball);
    }
    const auto torus = [&](const dvec3& x) {
        const dvec3 p = x - c;
        return glm::length(dvec2(glm::length(dvec2(p.x, p.z)) - 12, p.y)) - 5;
    };
    for (int n : {16, 24, 48, 96}) {
        std::vector<dvec2> profile;
        for (int i = 0; i < n / 2; ++i) {
            const double a = glm::two_pi<double>() * i / (n / 2);
            profile.emplace_back(12 + 5 * std::cos(a), 5 * std::sin(a));
        }
        const TriangleMesh m = mesh::moved(mesh::turned(profile, n, true), c);
        tell("torus", m, curvedBy(m, 46), ivec3(41), torus);
    }
    const auto cylinder = [&](const dvec3& x) {
        const dvec3 p = x - c;
        const dvec2 q(glm::length(dvec2(p.x, p.z)) - 13, std::abs(p.y) - 11);
        return glm::length(glm::max(q, 0.0)) + std::min(std::max(q.x, q.y), 0.0);
    };
    for (int n : {12, 16, 32, 64}) {
        const TriangleMesh m =
            mesh::moved(mesh::turned({{0, -11}, {13, -11}, {13, 11}, {0, 11}}, n, false), c);
        tell("cylinder", m, curvedBy(m, 31), ivec3(41), cylinder);
    }
}

} // namespace
} // namespace eikonal::voxelize
