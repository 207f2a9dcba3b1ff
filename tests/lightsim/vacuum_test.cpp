// Light that meets nothing: directional and point lights in empty space and in even glass.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kPi = std::numbers::pi;

TestVolume emptiness(ivec3 size = ivec3(16), double voxelSize = 1) {
    return std::move(TestVolume(size, voxelSize).constant("ior", 1));
}

/// Area of the box's shadow across a direction [voxel²].
double silhouette(const dvec3& size, const dvec3& direction) {
    const dvec3 d = glm::abs(glm::normalize(direction));
    return d.x * size.y * size.z + d.y * size.z * size.x + d.z * size.x * size.y;
}

const dvec3 kDirections[] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},  {0, -1, 0},  {0, 0, 1},
                             {0, 0, -1}, {1, 1, 1},  {-1, 2, 0}, {0.3, -1, 2}};

} // namespace

TEST(LightVacuum, FluenceIsTheIrradianceEverywhere) {
    for (const dvec3& direction : kDirections) {
        SCOPED_TRACE(testing::Message() << direction.x << "," << direction.y << "," << direction.z);
        const bool alongAxis = glm::length(direction) == 1;
        const Lit lit(emptiness().volume(), paramsOf({beam(direction, {3, 2, 1})}, 1 << 16));
        // Along an axis the map's pixels divide the voxels evenly, 256 to a voxel, and only the
        // fixed point rounds. Askew, a voxel's share of 256 pixels is off by those its outline
        // cuts: about 60 of them, half in half out at random, sqrt(60) / 2 in 256 is 1.5 %, and
        // four deviations of that are 6 %.
        const double tolerance = alongAxis ? 1e-5 : 0.06;
        const dvec3 unit = glm::normalize(direction);
        forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(lit.fluence(p, c), 3 - c, tolerance * (3 - c))
                    << p.x << " " << p.y << " " << p.z;
            // The sums of direction are rounded like those of fluence, of which they are twice the
            // difference: a few units in some thousands.
            ASSERT_LT(glm::length(lit.direction(p) - unit), 1e-3);
        });
        // All voxels together see every photon's whole way: what is left is the outline of the box.
        EXPECT_NEAR(lit.total() / (3 * 4096), 1, alongAxis ? 1e-5 : 2e-3);
    }
}

TEST(LightVacuum, WhatEntersIsTheIrradianceOnTheSilhouetteAndEscapes) {
    for (const dvec3& direction : kDirections) {
        SCOPED_TRACE(testing::Message() << direction.x << "," << direction.y << "," << direction.z);
        const Lit lit(emptiness({16, 8, 12}, 0.5).volume(),
                      paramsOf({beam(direction, {3, 2, 1})}, 1 << 14));
        const Energy& energy = lit.stats.energy;
        for (size_t c = 0; c < 3; ++c) {
            const double power =
                (3.0 - static_cast<double>(c)) * silhouette(dvec3(8, 4, 6), direction);
            // Of 2^14 pixels, at most those the outline cuts, 4 · 128, are in or out by chance:
            // sqrt(512) / 2 in 2^14 is 7e-4. Along an axis it is a whole row in the worst case.
            EXPECT_NEAR(energy.emitted[c], power, 0.01 * power);
            EXPECT_EQ(energy.entered[c], energy.emitted[c]);
            EXPECT_NEAR(energy.escaped[c], energy.entered[c], 1e-6 * power); // sums of floats
            EXPECT_EQ(energy.absorbed[c] + energy.scattered[c], 0);
        }
        EXPECT_EQ(lit.counter("trapped"), 0);
    }
}

TEST(LightVacuum, EvenGlassIsNoLens) {
    // An index that does not vary bends nothing, whatever it is; nor where it varies elsewhere.
    const auto lights = paramsOf({beam({1, 2, 3}), lamp({-4, 5, 30})}, 1 << 14);
    const Lit empty(emptiness().volume(), lights);
    const TestVolume glass = std::move(TestVolume(ivec3(16)).constant("ior", 1.5));
    const Lit straight(glass.volume(), lights);
    EXPECT_FALSE(straight.plan.bends);
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        ASSERT_NEAR(straight.fluence(p), empty.fluence(p), 1e-4); // 1.5 d / 1.5 rounds
    });

    const TestVolume chipped = std::move(
        TestVolume(ivec3(16)).index([](dvec3 p) { return glm::length(p) < 1 ? 1.51 : 1.5; }, 1.5));
    const Lit curved(chipped.volume(), paramsOf({beam({0, 0, -1})}, 1 << 14));
    ASSERT_TRUE(curved.plan.bends);
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        if (std::max(p.x, p.y) < 4) return; // the corner's own surroundings
        // Steps of up to 16 voxels end on the faces to 1e-6 of that.
        ASSERT_NEAR(curved.fluence(p), 1, 2e-5) << p.x << " " << p.y << " " << p.z;
    });
}

TEST(LightVacuum, APointLightOutsideFallsOffWithTheSquare) {
    const dvec3 place(8, 8, -24), intensity(2, 5, 3);
    const Lit lit(emptiness().volume(), paramsOf({lamp(place, intensity)}, 1 << 16));
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        const dvec3 away = dvec3(p) + 0.5 - place;
        const double square = glm::dot(away, away);
        for (int c = 0; c < 3; ++c)
            // A voxel far off is seen by some 100 pixels of which its outline cuts 40: 3 % for one
            // deviation of sqrt(40) / 2.
            ASSERT_NEAR(lit.fluence(p, c) * square / intensity[c], 1, 0.1);
        // Towards every voxel another way: its rays are within half a voxel of its centre's.
        ASSERT_LT(glm::length(lit.direction(p) - glm::normalize(away)), 0.02);
    });
    double mean = 0;
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        const dvec3 away = dvec3(p) + 0.5 - place;
        mean += lit.fluence(p) * glm::dot(away, away) / 4096 / intensity.x;
    });
    // Over all voxels the noise is gone, and the mean of 1/r² in a voxel is that at its centre to
    // 1/(4 r²), below 5e-4.
    EXPECT_NEAR(mean, 1, 3e-3);
    // The near face, half edge a at distance d, hides all others: Ω = 4 atan(a²/(d √(2a² + d²))).
    const double a = 8, d = 24;
    const double solidAngle = 4 * std::atan(a * a / (d * std::sqrt(2 * a * a + d * d)));
    for (size_t c = 0; c < 3; ++c) {
        const double i = intensity[static_cast<int>(c)];
        // Float sums over 2^16 pixels, all within the face.
        EXPECT_NEAR(lit.stats.energy.entered[c], i * solidAngle, 1e-5 * i * solidAngle);
        EXPECT_DOUBLE_EQ(lit.stats.energy.emitted[c], 4 * kPi * i);
    }
}

TEST(LightVacuum, APointLightInsideSendsAllItHas) {
    const dvec3 place(5.3, 9.1, 7.7);
    const Lit lit(emptiness({16, 16, 20}).volume(), paramsOf({lamp(place)}, 1 << 16));
    // Six faces of 105 pixels an edge, each pixel's solid angle to fourth order: 105^-4, and
    // floats.
    EXPECT_NEAR(lit.stats.energy.entered[0], 4 * kPi, 1e-5 * 4 * kPi);
    double worst = 0, mean = 0, count = 0;
    forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
        const dvec3 away = dvec3(p) + 0.5 - place;
        const double r = glm::length(away);
        if (r < 3) return; // within, 1/r² varies over a voxel
        const double ratio = lit.fluence(p) * r * r;
        worst = std::max(worst, std::abs(ratio - 1));
        mean += ratio;
        count += 1;
        ASSERT_LT(glm::length(lit.direction(p) - away / r), 0.1); // half a voxel in three, at most
    });
    // The farthest voxels, at r = 17, are crossed by 2^16 / (4π 17²) = 18 rays; their outlines cut
    // as many, so that one deviation is 12 %. A cube whose faces do not meet leaves some in the
    // dark and lights others twice.
    EXPECT_LT(worst, 0.4);
    // From r = 3 on, 1/(12 r²) of variation within a voxel.
    EXPECT_NEAR(mean / count, 1, 0.01);
}

TEST(LightVacuum, AFewPhotonsCarryAllTheLight) {
    // From one photon a face of the light's cube on: a pixel of 90° has its exact solid angle, and
    // its deposits, the largest there are, must fit the fixed point.
    for (const std::int64_t photons : {6, 24, 600, 20000}) {
        const Lit lit(emptiness({15, 15, 15}).volume(), paramsOf({lamp(dvec3(7.5))}, photons));
        EXPECT_NEAR(lit.stats.energy.entered[0], 4 * kPi, 1e-5 * 4 * kPi) << photons; // floats
        double paths = 0;
        forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) { paths += lit.fluence(p); });
        // Each travels from the centre to a face: between half the edge and half the diagonal.
        EXPECT_GE(paths, 7.5 * 4 * kPi * (1 - 1e-4)) << photons; // fixed point and floats
        EXPECT_LE(paths, 7.5 * std::sqrt(3.0) * 4 * kPi) << photons;
    }
}

TEST(LightVacuum, OppositeLightsCancelInDirectionAndAddInFluence) {
    const dvec3 way(1, 2, -2);
    const Lit one(emptiness().volume(), paramsOf({beam(way)}));
    const Lit two(emptiness().volume(), paramsOf({beam(way), beam(-way)}));
    double mean = 0;
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        mean += two.fluence(p) / 4096;
        // Two lattices of pixels that do not match: as many rays but for those the voxel's outline
        // cuts, 10 % of them at 64 a voxel.
        ASSERT_LT(glm::length(two.direction(p)), 0.12);
    });
    EXPECT_NEAR(mean, 2, 1e-2); // the box's outline, twice
    const Lit axis(emptiness().volume(), paramsOf({beam({0, 0, 1}), beam({0, 0, -1})}));
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        ASSERT_NEAR(axis.fluence(p), 2, 1e-4);           // fixed point
        ASSERT_LT(glm::length(axis.direction(p)), 1e-3); // fixed point
    });
}

TEST(LightVacuum, LightsAddUp) {
    const Light first = beam({1, 0.2, -0.3}, {1, 2, 3}), second = lamp({-5, 3, 30}, {90, 80, 700});
    const Lit a(emptiness().volume(), paramsOf({first}));
    const Lit b(emptiness().volume(), paramsOf({second}));
    const Lit both(emptiness().volume(), paramsOf({first, second}));
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        for (int c = 0; c < 3; ++c) {
            const double sum = a.fluence(p, c) + b.fluence(p, c);
            ASSERT_NEAR(both.fluence(p, c), sum, 1e-6 * sum); // one float addition
        }
        const auto power = [&](const Lit& lit) {
            return lit.fluence(p, 0) + lit.fluence(p, 1) + lit.fluence(p, 2);
        };
        const dvec3 mean = (power(a) * a.direction(p) + power(b) * b.direction(p)) / power(both);
        // Each run's own direction was held to length 1, which rounding passes by up to 1e-3.
        ASSERT_LT(glm::length(both.direction(p) - mean), 1e-3);
    });
    for (size_t c = 0; c < 3; ++c)
        EXPECT_DOUBLE_EQ(both.stats.energy.emitted[c],
                         a.stats.energy.emitted[c] + b.stats.energy.emitted[c]);
}

TEST(LightVacuum, PowerScalesTheResultAndNothingElse) {
    const dvec3 way(1, 2, -2), rgb(1, 2, 0);
    const Lit reference(emptiness().volume(), paramsOf({beam(way, rgb)}));
    for (const double scale : {1e-8, 1e8}) {
        const Lit scaled(emptiness().volume(), paramsOf({beam(way, scale * rgb)}));
        forEachVoxel(ivec3(16), [&](ivec3 p) {
            for (int c = 0; c < 3; ++c)
                // Two roundings to float.
                ASSERT_NEAR(scaled.fluence(p, c) / scale, reference.fluence(p, c),
                            2e-7 * reference.fluence(p, c));
            // Three more, in sums that nearly cancel.
            ASSERT_LT(glm::length(scaled.direction(p) - reference.direction(p)), 1e-5);
        });
        EXPECT_NEAR(scaled.stats.energy.emitted[0] / scale, reference.stats.energy.emitted[0],
                    1e-12 * reference.stats.energy.emitted[0]);
    }
}

TEST(LightVacuum, ADarkLightGivesNothing) {
    const Lit lit(emptiness().volume(), paramsOf({beam({1, 0, 0}, dvec3(0))}));
    EXPECT_EQ(lit.total(), 0);
    EXPECT_EQ(glm::length(lit.direction({3, 4, 5})), 0);
}

TEST(LightVacuum, AnyShapeOfVolume) {
    for (const ivec3& size : {ivec3(1), ivec3(1, 9, 9), ivec3(100, 3, 3), ivec3(1, 50, 1)})
        for (const dvec3& direction : {dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(1, -2, 3)}) {
            SCOPED_TRACE(testing::Message() << size.x << "x" << size.y << "x" << size.z << " along "
                                            << direction.x << "," << direction.y);
            const Lit lit(emptiness(size).volume(), paramsOf({beam(direction)}, 1 << 14));
            const double voxels = static_cast<double>(lit.plan.voxels());
            // Power in times mean chord is the volume; the outline of a long thin shadow takes a
            // pixel in twenty across.
            EXPECT_NEAR(lit.total() / voxels, 1, 0.05);
            const double shadow = silhouette(dvec3(size), direction);
            EXPECT_NEAR(lit.stats.energy.entered[0], shadow, 0.05 * shadow); // as above
        }
}

TEST(LightVacuum, EveryPhotonThroughOneVoxel) {
    // A million photons into a single voxel: the sum must neither overflow nor lose.
    const Lit one(emptiness(ivec3(1)).volume(), paramsOf({beam({0, 0, 1})}, 1 << 20));
    EXPECT_NEAR(one.fluence(ivec3(0)), 1, 2e-3); // a row of 1024 may fall outside
    EXPECT_NEAR(one.fluence(ivec3(0)), one.stats.energy.entered[0], 1e-5); // fixed point
    const Lit column(emptiness({1, 40, 1}).volume(), paramsOf({beam({0, -1, 0})}, 1 << 16));
    for (int y = 0; y < 40; ++y)
        EXPECT_NEAR(column.fluence({0, y, 0}), column.stats.energy.entered[0], 1e-5); // as above
}

TEST(LightVacuum, AnySizeOfVoxel) {
    for (const double h : {1e-4, 1e6}) {
        const Lit lit(emptiness(ivec3(8), h).volume(), paramsOf({beam({0, 1, 0})}, 1 << 14));
        forEachVoxel(ivec3(8), [&](ivec3 p) { ASSERT_NEAR(lit.fluence(p), 1, 1e-5); });
        const double power = 64 * h * h;
        EXPECT_NEAR(lit.stats.energy.entered[0], power, 1e-5 * power); // pixels divide it evenly
    }
}

TEST(LightVacuum, ATurnedVolumeTurnsTheResultWithIt) {
    // The same voxels, turned and moved; the light comes from the same side of them.
    const glm::dmat4 placed = glm::rotate(glm::translate(glm::dmat4(1), dvec3(100, -20, 3)), 1.1,
                                          glm::normalize(dvec3(1, -2, 0.5)));
    const Lit straight(emptiness().volume(), paramsOf({beam({1, 2, 3}), lamp({-9, 3, 4})}));
    const TestVolume scene = std::move(TestVolume(ivec3(16), 1, placed).constant("ior", 1));
    const Lit turned(scene.volume(), paramsOf({beam(glm::dmat3(placed) * dvec3(1, 2, 3)),
                                               lamp(dvec3(placed * glm::dvec4(-9, 3, 4, 1)))}));
    double worst = 0;
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        worst = std::max(worst, std::abs(turned.fluence(p) / straight.fluence(p) - 1));
        ASSERT_LT(glm::length(turned.direction(p) - glm::dmat3(placed) * straight.direction(p)),
                  0.02); // a pixel of 60 that lies on a voxel's edge
    });
    EXPECT_LT(worst, 0.05);                                                 // as above, two of 60
    EXPECT_NEAR(turned.total(), straight.total(), 1e-4 * straight.total()); // rounding of edges
}
