// Flat faces: slabs, prisms, total reflection.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

namespace {

using std::numbers::pi;

const dvec3 kMiddle(31.63, 32.21, 31.87);

/// An upright frame turned any way: its columns.
struct Turn {
    dvec3 x, y, z;
};
const std::vector<Turn>& turns() {
    static const std::vector<Turn> all = [] {
        std::vector<Turn> list{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        const dvec3 y = glm::normalize(dvec3(0.35, 0.8, -0.3));
        const dvec3 x = glm::normalize(glm::cross(y, dvec3(0, 0, 1)));
        list.push_back({x, y, glm::cross(x, y)});
        return list;
    }();
    return all;
}

judge::Plane face(const dvec3& normal, double off) {
    const dvec3 n = glm::normalize(normal);
    return {n, glm::dot(n, kMiddle) + off};
}

/// `thick` along y, 40 across.
judge::Glass slabOf(const Turn& turn, double thick, double index) {
    std::vector<judge::Plane> planes{face(turn.y, thick / 2), face(-turn.y, thick / 2)};
    for (const dvec3& side : {turn.x, -turn.x, turn.z, -turn.z}) planes.push_back(face(side, 20));
    return {{judge::glassHull(planes, index)}};
}

/// A prism along z from the outward normals of its sides, in the turn's x and y.
judge::Glass prismOf(const Turn& turn, const std::vector<std::array<double, 3>>& sides,
                     double index) {
    std::vector<judge::Plane> planes{face(turn.z, 22), face(-turn.z, 22)};
    for (const auto& [x, y, off] : sides) planes.push_back(face(x * turn.x + y * turn.y, off));
    return {{judge::glassHull(planes, index)}};
}

/// Rays along `direction` about one through `through`.
Params bundle(const dvec3& direction, const dvec3& through) {
    Params params = along(direction, through, 3, {9, 9});
    params.background = dvec3(1);
    return params;
}

void expectJudges(const Look& look, const Params& params, const judge::Glass& glass, int rays) {
    const auto counts = [&](const judge::Ray& ray) { return tellable(glass, ray); };
    const Off off = offOf(look, params, glass, counts);
    EXPECT_GE(off.rays, rays);
    EXPECT_LT(off.degrees, 0.01); // the bar of the requirements
    EXPECT_LT(off.place, 0.02);   // 0.01° over 100 voxels
    EXPECT_LT(off.optical, 0.02);
    EXPECT_LT(energyOff(look, params, glass, counts), 1e-4);
}

} // namespace

TEST(SharpFlat, ASlabShiftsARay) {
    for (const Turn& turn : turns())
        for (const double thick : {12.3, 7.1}) {
            const judge::Glass glass = slabOf(turn, thick, 1.5);
            for (const double angle : {0.0, 0.3, 0.8, 1.2}) {
                const dvec3 d = std::sin(angle) * turn.x - std::cos(angle) * turn.y;
                const Params params = bundle(d, kMiddle + 0.5 * thick * turn.y);
                const Look look(volumeOf(glass), params);
                expectJudges(look, params, glass, 70);
                const dvec3 ray = rayOf(params, 4, 4).x, off = look.place(4, 4) - ray;
                const double shift = glm::length(off - glm::dot(off, d) * d);
                const double s = std::sin(angle);
                const double wanted = thick * s * (1 - std::cos(angle) / std::sqrt(2.25 - s * s));
                // A plane's spline is exact; floats of places up to 64 are good to 4e-6, some tens.
                EXPECT_NEAR(shift, wanted, 2e-4) << angle;
                // Sides apart, no more is lost than what is dropped: below T² R² and R⁸.
                EXPECT_NEAR(look.at("R", 4, 4), 1, 2e-3);
            }
        }
}

TEST(SharpFlat, APrismsLeastDeviation) {
    const double h = std::sqrt(0.75);
    for (const Turn& turn : turns()) {
        const judge::Glass glass = prismOf(turn, {{-h, 0.5, 12}, {h, 0.5, 12}, {0, -1, 12}}, 1.5);
        const dvec3 side = kMiddle + 12.0 * (-h * turn.x + 0.5 * turn.y);
        const auto deviation = [&](double incidence) {
            const double tilt = incidence - pi / 6;
            const dvec3 d = std::cos(tilt) * turn.x + std::sin(tilt) * turn.y;
            const Params params = bundle(d, side);
            const Look look(volumeOf(glass), params);
            expectJudges(look, params, glass, 40);
            return degreesBetween(look.direction(4, 4), d);
        };
        const double least = std::asin(0.75);
        EXPECT_NEAR(deviation(least), 37.18, 0.01); // the number to its digits, and the bar
        // To both sides it is more: by 0.1° at 4° off, ten times the bar.
        EXPECT_GT(deviation(least + 0.07), 37.25);
        EXPECT_GT(deviation(least - 0.07), 37.25);
    }
}

TEST(SharpFlat, ARightAnglePrismTurnsAllLight) {
    const double r = std::sqrt(0.5);
    for (const Turn& turn : turns()) {
        const judge::Glass glass = prismOf(turn, {{-1, 0, 12}, {0, -1, 12}, {r, r, 4}}, 1.5);
        const Params params = bundle(turn.x, kMiddle - 12.0 * turn.x - 2.0 * turn.y);
        const Look look(volumeOf(glass), params);
        expectJudges(look, params, glass, 60);
        EXPECT_LT(degreesBetween(look.direction(4, 4), -turn.y), 0.01); // the bar
        // Out of the other leg goes what both legs pass, once and after a way back and forth.
        const image::Image map =
            mapOf([&](dvec3 d) { return dvec3(degreesBetween(d, -turn.y) < 5); });
        const Look mirrored(volumeOf(glass), params, map);
        EXPECT_NEAR(mirrored.at("R", 4, 4), 0.96 * 0.96 * (1 + 0.0016), 1e-3); // that of orders
    }
}

TEST(SharpFlat, ARodGuidesLightByTotalReflection) {
    // Into the end of a rod at 42° and along it, at 26.5° from its axis: a zigzag off its sides,
    // past the critical angle, and out at the far end.
    for (const Turn& turn : turns()) {
        std::vector<judge::Plane> planes{face(turn.x, 26.5), face(-turn.x, 26.5)};
        for (const dvec3& side : {turn.y, -turn.y, turn.z, -turn.z})
            planes.push_back(face(side, 7));
        const judge::Glass glass{{judge::glassHull(planes, 1.5)}};
        const dvec3 d = glm::normalize(turn.x + 0.9 * turn.y);
        const Params params = bundle(d, kMiddle - 26.5 * turn.x + 0.8 * turn.y);
        const judge::Path path = judge::followTransmitted(glass, rayOf(params, 4, 4));
        EXPECT_EQ(path.met.size(), 4u);
        expectJudges(Look(volumeOf(glass), params), params, glass, 20);
    }
}

TEST(SharpFlat, ABoxThatFillsItsDomainIsMetAtItsFaces) {
    // Its sides lie on the domain's own, where rays leave: they refract and are reflected there as
    // the judge's, away from edges, however many faces they meet.
    const dvec3 middle(20);
    std::vector<judge::Plane> planes;
    for (const dvec3& side : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)})
        for (const double sign : {-1.0, 1.0})
            planes.push_back({sign * side, glm::dot(sign * side, middle) + 20});
    const judge::Glass glass{{judge::glassHull(planes, 1.5)}};
    Voxels voxels;
    voxels.size = ivec3(40);
    for (const dvec3& direction : {dvec3(0.4, -1, 0.7), dvec3(-1, 0.15, 0.1)}) {
        Params params = along(glm::normalize(direction), middle, 60, {64, 64});
        params.background = dvec3(1);
        const Look look(volumeOf(glass, voxels), params);
        expectJudges(look, params, glass, 700);
        // Nor does a ray leave near an edge as it went within the glass, as if no face were there.
        const dvec3 within = glm::abs(glm::normalize(direction)) / 1.5;
        int unbent = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const dvec3 off = glm::abs(glm::abs(look.direction(x, y)) - within);
                unbent += (off.x < 1e-4) + (off.y < 1e-4) + (off.z < 1e-4) > 1;
            }
        EXPECT_EQ(unbent, 0);
    }
}
