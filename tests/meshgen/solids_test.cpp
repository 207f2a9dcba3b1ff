// Boxes, spheres, prisms, gems, waves, flecks against what they enclose on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/read.h"
#include "mesh/write_obj.h"
#include "meshgen/sound.h"
#include "shapes/brilliant.h"
#include "shapes/flecks.h"
#include "shapes/solids.h"
#include "shapes/wave.h"
#include "support/scratch.h"

#include <numbers>

namespace eikonal {

using namespace shapes;
using std::numbers::pi;

TEST(Solids, ABox) {
    EXPECT_DOUBLE_EQ(sound(makeBox({{-1, 0, 2}, {1, 3, 2.5}})).volume, 3);
    expectError(ExitStatus::usage, {"--to", "Y"}, [] { BoxParams{{0, 0, 0}, {1, 0, 1}}.check(); });
}

TEST(Solids, ABoxWithABevel) {
    const glm::dvec3 low(-1, 0, 2), high(1, 3, 2.9);
    const double r = 0.2;
    const auto box = makeBox({low, high, r, 32});
    // Steiner: the smaller box, slabs on its faces, quarters of cylinders, a ball.
    const glm::dvec3 s = high - low - 2 * r;
    const double whole = s.x * s.y * s.z + 2 * r * (s.x * s.y + s.y * s.z + s.z * s.x) +
                         pi * r * r * (s.x + s.y + s.z) + 4 * pi / 3 * r * r * r;
    EXPECT_NEAR(sound(box).volume, whole, 1e-4 * whole);
    EXPECT_EQ(eulerCharacteristic(box), 2);
    EXPECT_EQ(mesh::boundingBox(box).min, low);
    EXPECT_EQ(mesh::boundingBox(box).max, high);
    // Each point is the bevel away from the smaller box, along its normal.
    for (size_t f = 0; f < box.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p = box.points[box.triangles[f][k]];
            const glm::dvec3 off = p - glm::clamp(p, low + r, high - r);
            EXPECT_NEAR(glm::length(off), r, 1e-14);
            // Chords are of about the same angle.
            const glm::vec3 next = box.normals[f][static_cast<size_t>((k + 1) % 3)];
            EXPECT_LT(glm::distance(off / r, glm::dvec3(next)), 2 * pi / 2 / 32);
            EXPECT_LT(glm::distance(off / r, glm::dvec3(box.normals[f][static_cast<size_t>(k)])),
                      1e-6);
        }
    expectError(ExitStatus::usage, {"--bevel", "0.45"}, [&] {
        BoxParams{low, high, 0.45}.check();
    });
    expectError(ExitStatus::usage, {"--segments", "3"}, [&] {
        BoxParams{low, high, 0.1, 3}.check();
    });
}

TEST(Solids, ASphereWithItsPointsOnIt) {
    const auto sphere = makeSphere({0.5, 128});
    for (const glm::dvec3& p : sphere.points) EXPECT_NEAR(glm::length(p), 0.5, 1e-15);
    // Polygons of n corners have less area than circles by 2π²/(3 n²), chords of the profile
    // enclose less by (2π/n)²/4.
    const double whole = 4 * pi / 3 * 0.125, share = sound(sphere).volume / whole;
    EXPECT_NEAR(share, 1 - 5 * pi * pi / 3 / (128 * 128), 1e-6);
    expectError(ExitStatus::usage, {"--segments", "7"}, [] { SphereParams{1, 7}.check(); });
}

TEST(Solids, Prisms) {
    EXPECT_NEAR(sound(makePrism({3, 0.7, 0.68, {}})).volume, std::sqrt(3) / 4 * 0.49 * 0.68, 1e-15);
    EXPECT_NEAR(sound(makePrism({6, 2, 3, {}})).volume, 6 * std::sqrt(3) * 3, 1e-14);
    const auto sharp = makePrism({3, 1, 2, 40.0});
    EXPECT_NEAR(sound(sharp).volume, 0.25 / std::tan(20 * pi / 180) * 2, 1e-15);
    const glm::dvec2 a = sharp.points[1] - sharp.points[0], b = sharp.points[2] - sharp.points[0];
    EXPECT_NEAR(glm::dot(a, b) / glm::length(a) / glm::length(b), std::cos(40 * pi / 180), 1e-15);
    expectError(ExitStatus::usage, {"--angle", "5"}, [] { PrismParams{5, 1, 1, 40.0}.check(); });
}

/// The planes of a convex body's facets, each once. Fails where a point is above one.
size_t facetsOf(const mesh::TriangleMesh& body) {
    std::vector<glm::dvec4> planes;
    for (const glm::uvec3& t : body.triangles) {
        const glm::dvec3 a = body.points[t.x];
        const glm::dvec3 n = glm::normalize(glm::cross(body.points[t.y] - a, body.points[t.z] - a));
        const glm::dvec4 plane(n, -glm::dot(n, a));
        for (const glm::dvec3& p : body.points) EXPECT_LT(glm::dot(plane, glm::dvec4(p, 1)), 1e-12);
        const bool known = std::any_of(planes.begin(), planes.end(), [&](const glm::dvec4& other) {
            return glm::length(other - plane) < 1e-9;
        });
        if (!known) planes.push_back(plane);
    }
    return planes.size();
}

TEST(Brilliant, HasTheFacetsOfTheCutAndIsConvex) {
    BrilliantParams params;
    for (const bool upright : {false, true}) {
        params.upright = upright;
        const auto stone = makeBrilliant(params);
        sound(stone);
        EXPECT_EQ(facetsOf(stone), 58u + 16u);
    }
    params.radius = 3;
    const mesh::Box box = mesh::boundingBox(makeBrilliant(params));
    EXPECT_NEAR(box.max.x - box.min.x, 6, 1e-14);
    // Depths above and below the girdle: what is left beside the table, and the culet.
    EXPECT_NEAR(box.max.y, 3 * (0.02 + std::tan(34.5 * pi / 180) * 0.47), 1e-14);
    EXPECT_NEAR(box.min.y, -3 * (0.02 + std::tan(40.75 * pi / 180) * (1 - 0.01 * std::cos(pi / 8))),
                1e-14);
}

TEST(Brilliant, LiesOnAFacet) {
    const auto stone = makeBrilliant({});
    size_t down = 0;
    for (const glm::dvec3& p : stone.points) {
        EXPECT_GE(p.y, 0);
        if (p.y < 1e-12) ++down;
    }
    EXPECT_EQ(down, 5u); // the corners of a main facet of the pavilion
}

TEST(Brilliant, OtherCutsHoldAndImpossibleOnesAreRefused) {
    for (const double table : {30.0, 53.0, 70.0})
        for (const double crown : {15.0, 34.5, 50.0})
            for (const double lower : {40.0, 77.0, 95.0}) {
                BrilliantParams params;
                params.table = table;
                params.crown = crown;
                params.lower = lower;
                params.check();
                const auto stone = makeBrilliant(params);
                sound(stone);
                EXPECT_EQ(facetsOf(stone), 74u);
            }
    BrilliantParams params;
    params.lower = 99.5; // and 1 % of culet
    expectError(ExitStatus::usage, {"--lower", "99.5"}, [&] { params.check(); });
}

class Written : public ScratchTest {};

TEST_F(Written, AMeshComesBackWithItsNormals) {
    const auto stone = makeBrilliant({});
    std::ofstream out(at("stone.obj"));
    mesh::writeObj(out, stone, "a stone");
    out.close();
    const auto back = mesh::readMesh(at("stone.obj"));
    ASSERT_EQ(back.points.size(), stone.points.size());
    for (size_t i = 0; i < back.points.size(); ++i)
        EXPECT_LT(glm::length(back.points[i] - stone.points[i]), 1e-8);
    EXPECT_EQ(back.triangles, stone.triangles);
    ASSERT_EQ(back.normals.size(), stone.triangles.size());
    for (size_t f = 0; f < back.normals.size(); ++f) {
        const glm::uvec3& t = stone.triangles[f];
        const glm::vec3 own = glm::normalize(glm::cross(stone.points[t.y] - stone.points[t.x],
                                                        stone.points[t.z] - stone.points[t.x]));
        for (const glm::vec3& n : back.normals[f]) EXPECT_LT(glm::length(n - own), 1e-6f);
    }
}

TEST(Wave, EnclosesWhatItsSinesIntegrateTo) {
    WaveParams params;
    params.squares = 128;
    params.bottom = -0.5;
    double sines = 0;
    for (const auto& [a, kx, kz, phase] :
         {std::array{0.02, 7.0, 2.0, 0.0}, {0.015, -4.0, 9.0, 1.0}, {0.008, 13.0, 11.0, 2.0}})
        sines += a * std::sin(phase) * 4 * std::sin(kx) / kx * std::sin(kz) / kz;
    // Chords of a sine: h² k² / 12 of it.
    EXPECT_NEAR(sound(makeWave(params)).volume, 2 + sines, 1e-4 * 0.02);
    params.bottom.reset();
    EXPECT_FALSE(mesh::checkTopology(makeWave(params)).closed);
}

TEST(Wave, TravelsAsWavesOnDeepWaterDo) {
    // Along its own direction the longest wave leads: the sum of all, each shifted by its own
    // phase speed g / ω, is what time makes of it. Checked by the equation of motion of a
    // superposition: h(t) + h(-t) = 2 Σ cos(ω t) of the parts, with parts told apart by k.
    const double dt = 1e-3, g = 9.81;
    const auto second = [&](auto&& f, double h) { return (f(h) - 2 * f(0.0) + f(-h)) / (h * h); };
    // ∂⁴h/∂t⁴ = -g² ∇²h: ω⁴ = g² k².
    for (const double x : {-0.3, 0.4}) {
        const auto fourth = second(
            [&](double a) {
                return second([&](double b) { return waveHeight(x, 0.1, 0.7 + a + b); }, 20 * dt);
            },
            20 * dt);
        const double laplace = second([&](double b) { return waveHeight(x + b, 0.1, 0.7); }, dt) +
                               second([&](double b) { return waveHeight(x, 0.1 + b, 0.7); }, dt);
        EXPECT_NEAR(fourth, -g * g * laplace, 0.02 * g * g * 3); // 3: k² a, the sum of all
    }
}

TEST(Flecks, AreApartAndWithin) {
    const auto body = makeSphere({1, 64});
    FlecksParams params;
    params.count = 40;
    params.radius = 0.1;
    const auto flecks = makeFlecks(params, body);
    const mesh::MeshReport report = sound(flecks);
    EXPECT_EQ(report.components, 40u);
    for (const glm::dvec3& p : flecks.points) EXPECT_LT(glm::length(p), 1);
    EXPECT_LT(report.volume, 40 * 4 * pi / 3 * 1e-3);
    EXPECT_GT(report.volume, 40 * 4 * pi / 3 * std::pow(0.1 * 0.4 * 0.5, 3) * 0.9);
    EXPECT_EQ(makeFlecks(params, body).points, flecks.points);
    params.seed = 1;
    EXPECT_NE(makeFlecks(params, body).points, flecks.points);
    params.count = 100;
    params.radius = 0.3;
    params.least = 1;
    expectError(ExitStatus::usage, {"--count", "no place for more"},
                [&] { makeFlecks(params, makeBox({})); });
}

} // namespace eikonal
