// What volpaint makes of grids, against sums on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint/noise.h"
#include "paint/paint.h"
#include "support/scratch.h"
#include "support/test_volume.h"

#include <numbers>

namespace eikonal {

using namespace paint;
using std::numbers::pi;
using volume::Volume;

constexpr double kVoxel = 0.05;

/// A cube of 32 voxels from the origin on, of an even absorption.
Volume cube() {
    return TestVolume({32, 32, 32}, kVoxel)
        .constant("ior", 1)
        .constantVector("absorption", {2, 1, 0.5})
        .take();
}

double sumOf(const Volume& volume, const std::string& grid, int component) {
    const volume::DenseGrid dense = volume.dense(grid, volume.domain());
    double sum = 0;
    for (size_t i = 0; i < dense.voxels(); ++i)
        sum += static_cast<double>(dense.values[i * static_cast<size_t>(dense.components) +
                                                static_cast<size_t>(component)]);
    return sum * kVoxel * kVoxel * kVoxel;
}

glm::vec3 valueAt(const Volume& volume, const std::string& grid, const glm::ivec3& p) {
    volume::IndexBox box{p + volume.domain().min, p + volume.domain().min};
    const auto dense = volume.dense(grid, box);
    return dense.components == 3 ? glm::vec3(dense.values[0], dense.values[1], dense.values[2])
                                 : glm::vec3(dense.values[0]);
}

/// Paints, and gives the warnings.
std::vector<std::string> painted(Volume& volume, const Params& params) {
    Stats stats;
    params.check();
    return run(volume, params, stats);
}

TEST(Paint, NoiseMultipliesByWhatItIsAtVoxels) {
    Volume volume = cube();
    Params params;
    params.noises = {parseNoise("absorption:0.8:0.3:3:7")};
    EXPECT_TRUE(painted(volume, params).empty());
    for (const glm::ivec3& p : {glm::ivec3(0), {5, 9, 30}, {31, 2, 17}}) {
        const glm::dvec3 x = kVoxel * (glm::dvec3(p) + 0.5);
        const double factor = 1 + 0.8 * fractalNoise(x / 0.3, 3, 7);
        const glm::vec3 value = valueAt(volume, "absorption", p);
        EXPECT_NEAR(value.x, 2 * factor, 1e-6);
        EXPECT_NEAR(value.z, 0.5 * factor, 1e-6);
    }
    // Beyond -1 it is 0, never less.
    Params deep;
    deep.noises = {parseNoise("absorption:40:0.3")};
    painted(volume, deep);
    const auto dense = volume.dense("absorption", volume.domain());
    EXPECT_EQ(*std::min_element(dense.values.begin(), dense.values.end()), 0);
}

TEST(Paint, ASoftSphereAddsWhatItsProfileIntegratesTo) {
    Volume volume = cube();
    Params params;
    params.spheres = {parseSphere("scattering:0.8,0.79,0.81:0.5:3,2,1:1")};
    painted(volume, params);
    // 4π ∫ r² (3t² − 2t³) dr with t = 1 − r/R: 4π R³ / 15. Ten voxels along R.
    const double whole = 4 * pi / 15 * 0.125;
    EXPECT_NEAR(sumOf(volume, "scattering", 0), 3 * whole, 1e-3 * whole);
    EXPECT_NEAR(sumOf(volume, "scattering", 2), whole, 1e-3 * whole);
    EXPECT_EQ(sumOf(volume, "absorption", 0), sumOf(cube(), "absorption", 0));
    // Hard, it is all or nothing; given again, it adds up.
    params.spheres = {parseSphere("absorption:0.8,0.8,0.8:0.4:4:0"),
                      parseSphere("absorption:0.8,0.8,0.8:0.1:4:0")};
    painted(volume, params);
    EXPECT_EQ(valueAt(volume, "absorption", {16, 16, 16}), glm::vec3(10, 9, 8.5));
    EXPECT_EQ(valueAt(volume, "absorption", {21, 16, 16}), glm::vec3(6, 5, 4.5));
    EXPECT_EQ(valueAt(volume, "absorption", {24, 16, 16}), glm::vec3(2, 1, 0.5));
}

TEST(Paint, WhatIsBeyondTheRangeIsCutOrRefused) {
    Volume volume = cube();
    Params params;
    params.spheres = {parseSphere("absorption:0.8,0.8,0.8:0.2:-9:0")};
    const auto warnings = painted(volume, params);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("'absorption' was cut"), std::string::npos);
    EXPECT_EQ(valueAt(volume, "absorption", {16, 16, 16}), glm::vec3(0));
    params.spheres = {parseSphere("ior:0.8,0.8,0.8:0.2:-1:0")};
    expectError(ExitStatus::data, {"painted, 'ior'", "expected > 0"},
                [&] { painted(volume, params); });
    params.spheres = {parseSphere("anisotropy:0.8,0.8,0.8:0.2:1:0")};
    expectError(ExitStatus::data, {"painted, 'anisotropy'"}, [&] { painted(volume, params); });
    params.spheres.clear();
    params.noises = {parseNoise("emission:1:1")};
    EXPECT_NE(painted(volume, params).at(0).find("no such grid"), std::string::npos);
}

class Stamps : public ScratchTest {
protected:
    /// A brush of 8 voxels along an edge of `voxel` [unit], from the origin on.
    void makeBrush(const std::string& name, double voxel, const TestVolume::Vector& value) {
        TestVolume brush({8, 8, 8}, voxel);
        brush.addVector("absorption", value);
        AtomicFile out(at(name));
        brush.volume().write(out, {"tester", "1", "tester"});
        out.commit();
    }
    Params stamp(const std::string& name, const glm::dmat4& place) {
        Params params;
        params.stamps = {{at(name), place}};
        return params;
    }
};

TEST_F(Stamps, KeepTheirSumWhereverTheyAre) {
    makeBrush("brush.vdb", kVoxel, [](glm::dvec3 p) { return glm::dvec3(1 + p.x, p.y, 3); });
    const double before = sumOf(cube(), "absorption", 0), edge = 8 * kVoxel;
    const double whole = edge * edge * edge * (1 + edge / 2);
    for (const glm::dvec3& shift : {glm::dvec3(0.5), {0.513, 0.487, 0.601}, {0.31, 0.9, 0.5}}) {
        Volume volume = cube();
        painted(volume, stamp("brush.vdb", glm::translate(glm::dmat4(1), shift)));
        EXPECT_NEAR(sumOf(volume, "absorption", 0) - before, whole, 1e-5 * whole);
    }
    // Twice as large: eight times as much of it, each voxel as strong.
    makeBrush("fine.vdb", kVoxel / 4, [](glm::dvec3) { return glm::dvec3(5); });
    Volume volume = cube();
    const glm::dmat4 place =
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.3)), glm::dvec3(8));
    painted(volume, stamp("fine.vdb", place));
    EXPECT_NEAR(valueAt(volume, "absorption", {16, 16, 16}).x, 2 + 5, 1e-5);
    const double large = 0.8 * 0.8 * 0.8 * 5;
    EXPECT_NEAR(sumOf(volume, "absorption", 0) - before, large, 0.01 * large);
}

TEST_F(Stamps, AreLinearBetweenVoxelsAndTurn) {
    makeBrush("brush.vdb", 0.1, [](glm::dvec3 p) { return glm::dvec3(1 + 2 * p.x, 3 * p.y, p.z); });
    Volume volume = cube();
    // Turned by 90° about Z: the brush's x runs along the world's y, its y against x.
    glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(1.2, 0.4, 0.4));
    place = glm::rotate(place, pi / 2, glm::dvec3(0, 0, 1));
    painted(volume, stamp("brush.vdb", place));
    for (const glm::ivec3& p : {glm::ivec3(14, 16, 15), {18, 13, 20}}) {
        const glm::dvec3 x = kVoxel * (glm::dvec3(p) + 0.5);
        const glm::dvec3 own(x.y - 0.4, 1.2 - x.x, x.z - 0.4);
        const glm::vec3 found = valueAt(volume, "absorption", p) - glm::vec3(2, 1, 0.5);
        EXPECT_NEAR(found.x, 1 + 2 * own.x, 1e-5);
        EXPECT_NEAR(found.y, 3 * own.y, 1e-5);
        EXPECT_NEAR(found.z, own.z, 1e-5);
    }
    EXPECT_EQ(valueAt(volume, "absorption", {2, 2, 2}), glm::vec3(2, 1, 0.5));
}

TEST_F(Stamps, WithoutABrushsGridsAreRefused) {
    TestVolume brush({8, 8, 8}, 1);
    brush.constant("density", 1);
    AtomicFile out(at("smoke.vdb"));
    brush.volume().write(out, {"tester", "1", "tester"});
    out.commit();
    Volume volume = cube();
    expectError(ExitStatus::data, {"smoke.vdb", "absorption, scattering, emission", "sim2vol"},
                [&] { painted(volume, stamp("smoke.vdb", glm::dmat4(1))); });
    expectError(ExitStatus::missing, {"absent.vdb"},
                [&] { painted(volume, stamp("absent.vdb", glm::dmat4(1))); });
}

TEST(Strokes, AreReadOrRefused) {
    const Noise noise = parseNoise("absorption.amber:0.5:0.2");
    EXPECT_EQ(noise.grid, "absorption.amber");
    EXPECT_EQ(noise.octaves, 4);
    const Sphere sphere = parseSphere("ior:1,2,3:0.5:0.1:0.25");
    EXPECT_EQ(sphere.centre, glm::dvec3(1, 2, 3));
    EXPECT_EQ(sphere.soft, 0.25);
    for (const char* text :
         {"", "absorption", "absorption:1", "sdf:1:1", "fluence:1:1", "x:1:1", "absorption:x:1",
          "absorption:1:0", "absorption:1:-1", "absorption:1:1:0", "absorption:1:1:2.5",
          "absorption:1:1:2:-1", "absorption:1:1:2:1:1"})
        expectError(ExitStatus::usage, {"--noise", std::string("'") + text + "'"},
                    [&] { parseNoise(text); });
    for (const char* text : {"absorption:0,0:1:1", "absorption:0,0,0:0:1", "absorption:0,0,0:1:1,2",
                             "absorption:0,0,0:1:1:2", "ior:0,0,0:1:1,2,3", "absorption:0,0,0:1"})
        expectError(ExitStatus::usage, {"--sphere", std::string("'") + text + "'"},
                    [&] { parseSphere(text); });
    expectError(ExitStatus::usage, {"nothing to paint"}, [] { Params().check(); });
}

} // namespace eikonal
