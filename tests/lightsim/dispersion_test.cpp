// Light by wavelength: photons, beams and fronts through what disperses, against Snell's law on
// paper. SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"
#include "support/shapes.h"

#include <numbers>

namespace eikonal::lightsim {
namespace {

using glm::dvec3;
using glm::ivec3;

constexpr double kLines[] = {486.1, 587.6, 656.3}; // Fraunhofer's F, d, C [nm]

double lawOf(double index, double dispersion, double nanometres) {
    const double um = nanometres / 1000;
    return index + dispersion * (1 / (um * um) - 1 / (0.5876 * 0.5876));
}

/// Of 60°, its edge along z, without a base.
volume::Volume prism(double index, double dispersion) {
    TestVolume scene(ivec3(48, 40, 8));
    scene.add("sdf", [](dvec3 p) {
        const double y = p.y - 24.3, x = p.x - 24.1;
        return std::max(0.5 * y + std::sqrt(0.75) * x, 0.5 * y - std::sqrt(0.75) * x) - 6;
    });
    scene.constant("ior", index);
    scene.constant("dispersion", dispersion);
    return scene.take();
}

/// The mean direction of light behind the prism.
dvec3 directionBehind(const Lit& lit) {
    dvec3 sum(0);
    for (int z = 2; z < 6; ++z)
        for (int y = 0; y < 40; ++y) sum += lit.fluence({46, y, z}) * lit.direction({46, y, z});
    return glm::normalize(sum);
}

/// Across the way before the prism: what starts there goes through both faces.
Triangles windowBefore() {
    const mesh::TriangleMesh box = mesh::boxShape(dvec3(2, 4, 0.5), dvec3(2.01, 12, 7.5));
    Triangles corners;
    for (const glm::uvec3& triangle : box.triangles)
        for (int i = 0; i < 3; ++i) corners.push_back(box.points[triangle[i]]);
    return corners;
}

TEST(LightDispersion, APrismTurnsEachLineBySnellsLaw) {
    for (const auto& [index, dispersion] : {std::pair(1.5168, 0.0042), std::pair(1.72828, 0.01342)})
        for (const double line : kLines) {
            const double n = lawOf(index, dispersion, line);
            const double aslant = std::asin(0.5 * n) - std::numbers::pi / 6;
            const dvec3 in(std::cos(aslant), std::sin(aslant), 0);
            Params params = paramsOf({beam(in)}, 1 << 14);
            params.outputs = Output::both;
            params.proxy = windowBefore();
            params.maxDepth = 2; // what is reflected within is of no interest
            params.tracing.wavelengths.list = {line};
            const Lit lit(prism(index, dispersion), params);
            const dvec3 out = directionBehind(lit);
            // It passes symmetrically: what came upward leaves downward.
            const double turn = std::atan2(-out.y, out.x) + aslant;
            // 0.002°.
            EXPECT_NEAR(turn, 2 * aslant, 3.5e-5) << line;
        }
}

constexpr double kSlope = 0.4, kFloor = 4, kStrong = 0.05;

/// Glass on a floor, its top aslant, under a screen with a slit along z.
volume::Volume slitOverGlass(double dispersion) {
    TestVolume scene(ivec3(48, 48, 10));
    const auto put = [&](const std::string& name, const TestVolume::Scalar& distance, double index,
                         bool opaque) {
        scene.add("sdf." + name, distance, 1e3);
        scene.constant("ior." + name, index);
        if (opaque) scene.constant("opacity." + name, 1);
        if (!opaque) scene.constant("dispersion." + name, dispersion);
    };
    put(
        "glass",
        [](dvec3 p) { return (p.y - 24.2 - kSlope * (p.x - 24)) / std::hypot(1.0, kSlope); }, 1.5,
        false);
    put(
        "stone", [](dvec3 p) { return p.y - kFloor; }, 1, true);
    put(
        "screen",
        [](dvec3 p) { return std::max(std::abs(p.y - 42.5) - 2, 3 - std::abs(p.x - 30.25)); }, 1,
        true);
    return scene.take();
}

Params ontoFloor(Method method, const optics::Wavelengths& wavelengths) {
    Params params = paramsOf({beam({0, -1, 0})}, 1 << 16);
    params.outputs = Output::irradiance;
    params.surfaceDetail = 4;
    params.method = method;
    params.maxDepth = 3;
    params.tracing.wavelengths = wavelengths;
    return params;
}

/// Power on the floor by columns of fine voxels along x, away from the ends along z.
std::vector<dvec3> profileOf(const Lit& lit) {
    const volume::FineGrid& grid = lit.result.irradiance;
    std::vector<dvec3> columns(48 * static_cast<size_t>(grid.detail), dvec3(0));
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        const dvec3 x = (dvec3(grid.voxels[i]) + 0.5) / static_cast<double>(grid.detail);
        if (std::abs(x.y - kFloor) > 0.5 || std::abs(x.z - 5) > 2) continue;
        columns[static_cast<size_t>(grid.voxels[i].x)] += dvec3(grid.values[i]);
    }
    return columns;
}

double centreOf(const std::vector<dvec3>& columns) {
    double sum = 0, moment = 0;
    for (size_t i = 0; i < columns.size(); ++i) {
        sum += columns[i].y;
        moment += (static_cast<double>(i) + 0.5) / 4 * columns[i].y;
    }
    return moment / sum;
}

TEST(LightDispersion, LinesLandWhereSnellsLawSendsThem) {
    for (const Method method : {Method::automatic, Method::photons})
        for (const double line : kLines) {
            const Lit lit(slitOverGlass(kStrong), ontoFloor(method, {8, {line}}));
            const double tilt = std::atan(kSlope);
            const double within = std::asin(std::sin(tilt) / lawOf(1.5, kStrong, line));
            const double height = 24.2 + kSlope * (30.25 - 24) - kFloor;
            // The middle of the slit lands in the middle, since all land by one scale.
            const double wanted = 30.25 + height * std::tan(tilt - within);
            // A hundredth of a voxel; from F to C it moves by 0.35.
            EXPECT_NEAR(centreOf(profileOf(lit)), wanted, 0.01) << line;
        }
}

double offBetween(const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
    double off = 0, all = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        off += glm::dot(a[i] - b[i], a[i] - b[i]);
        all += glm::dot(b[i], b[i]);
    }
    return std::sqrt(off / all);
}

TEST(LightDispersion, EightPartsMakeTheRainbowOfManyLines) {
    const auto profile = [](Method method, int count) {
        return profileOf(Lit(slitOverGlass(10 * kStrong), ontoFloor(method, {count, {}})));
    };
    // Of ten times the dispersion: a slit of six voxels is spread over eight.
    const std::vector<dvec3> many = profile(Method::automatic, 48);
    const double plain = offBetween(profile(Method::automatic, 1), many);
    // Light lies about the middle of each part, so that neighbours' colours pass over into each
    // other. Of the middle alone beams would be off by 0.16 of it.
    EXPECT_LT(offBetween(profile(Method::photons, 8), many), 0.1 * plain);
    EXPECT_LT(offBetween(profile(Method::automatic, 8), many), 0.1 * plain);
}

TEST(LightDispersion, PointsGetAllOfTheirParts) {
    // Two parts of the spectrum: much of their light lands bricks away from their middles'.
    const volume::Volume scene = slitOverGlass(20 * kStrong);
    Params params = ontoFloor(Method::beams, {2, {}});
    const Lit all(scene, params);
    const std::vector<dvec3> columns = profileOf(all);
    const glm::dmat4 worldFromVoxel = glm::inverse(all.plan.scene.voxelFromWorld());
    params.points.width = 1;
    params.points.normals = {all.plan.scene.worldFromVoxelTurn() * dvec3(0, 1, 0)};
    double most = 0;
    for (const dvec3& column : columns) most = std::max(most, glm::length(column / 32.0));
    EXPECT_GT(most, 0.1);
    for (int x = 4; x < 44; x += 2) {
        params.points.places = {
            dvec3(worldFromVoxel * glm::dvec4(x - 0.375, kFloor - 0.5, 4.625, 1))};
        const dvec3 found(Lit(scene, params).result.points.at(0).at(0).irradiance);
        // The floor is between two layers of fine voxels, of which the column has 16 each along z.
        const dvec3 wanted = columns[static_cast<size_t>(4 * x)] / 32.0;
        EXPECT_LT(glm::distance(found, wanted), 0.03 * most) << x;
    }
}

TEST(LightDispersion, WhiteAddsUpAgain) {
    const auto profile = [](double dispersion, Method method) {
        const Lit lit(slitOverGlass(dispersion), ontoFloor(method, {8, {}}));
        EXPECT_EQ(lit.plan.scene.disperses, dispersion > 0);
        return profileOf(lit);
    };
    for (const Method method : {Method::automatic, Method::photons})
        EXPECT_LT(offBetween(profile(1e-9, method), profile(0, method)), 1e-3);
    // Through a volume, by photons and by a front, blurred, with the direction.
    for (const Method method : {Method::automatic, Method::wavefront}) {
        const auto lit = [method](double dispersion) {
            TestVolume scene(ivec3(16));
            scene.index([](dvec3 p) { return 1.3 + 0.02 * p.x; });
            scene.constant("dispersion", dispersion);
            Params params = paramsOf({beam({0, -1, 0}, {3, 2, 1})}, 1 << 12);
            params.outputs = Output::both;
            params.method = method;
            return Lit(scene.volume(), params);
        };
        const Lit parts = lit(1e-9), plain = lit(0);
        for (int i = 0; i < 16; ++i) {
            const ivec3 p(i, 8, 8);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(parts.fluence(p, c), plain.fluence(p, c), 1e-3 * plain.fluence(p, c));
            EXPECT_LT(glm::length(parts.direction(p) - plain.direction(p)), 1e-3);
        }
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(parts.stats.energy.entered[c], plain.stats.energy.entered[c],
                        1e-6 * plain.stats.energy.entered[c]);
    }
}

TEST(LightDispersion, FrontsFollowTheirLine) {
    // As those of an index that is the line's own.
    const auto direction = [](double slope, double dispersion, double line) {
        TestVolume scene(ivec3(48, 32, 6));
        scene.index([=](dvec3 p) { return 1.3 + slope * p.x; });
        scene.add("dispersion", [=](dvec3 p) { return dispersion * p.x; });
        Params params = paramsOf({beam({0, -1, 0})});
        params.outputs = Output::both;
        params.method = Method::wavefront;
        params.tracing.wavelengths.list = {line};
        return Lit(scene.volume(), params).direction({20, 1, 3}).x;
    };
    for (const double line : kLines)
        EXPECT_NEAR(direction(0.004, 0.0015, line), direction(lawOf(0.004, 0.0015, line), 0, line),
                    1e-5)
            << line; // from F to C it changes by 0.05
}

} // namespace
} // namespace eikonal::lightsim
