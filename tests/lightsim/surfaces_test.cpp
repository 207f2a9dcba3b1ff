// Light on opaque surfaces: by beams, by photons.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/caustic.h"
#include "support/glass_volume.h"
#include "support/lit.h"

#include <glm/trigonometric.hpp>
#include <map>

namespace eikonal::lightsim {
namespace {

using glm::dvec3;
using glm::ivec3;

/// Solids with sharp boundaries, those of index 1 opaque.
volume::Volume sceneOf(const judge::Glass& glass, const ivec3& size) {
    sharp::Voxels voxels;
    voxels.size = size;
    voxels.halfWidth = 4;
    volume::Volume volume = sharp::volumeOf(glass, voxels);
    if (glass.solids.size() == 1) { // whose grids are the plain ones; around it nothing is opaque
        const volume::DenseGrid opaque{
            size, 1, std::vector<float>(static_cast<size_t>(size.x) * size.y * size.z, 1)};
        volume.put("opacity", {ivec3(0), size - 1}, opaque, {});
        return volume;
    }
    for (size_t i = 0; i < glass.solids.size(); ++i)
        if (glass.solids[i].index == 1)
            volume.putConstant("opacity.S" + std::to_string(i), glm::vec3(1));
    return volume;
}

Params onSurfaces(const Light& light, int detail, std::int64_t photons = 1 << 18) {
    Params params = paramsOf({light}, photons);
    params.outputs = Output::irradiance;
    params.surfaceDetail = detail;
    return params;
}

/// Middles of fine voxels [voxel, from the domain's low corner] and their irradiance.
template<typename Visit> void forEachLit(const volume::FineGrid& grid, const Visit& visit) {
    for (size_t i = 0; i < grid.voxels.size(); ++i)
        visit((dvec3(grid.voxels[i]) + 0.5) / static_cast<double>(grid.detail), grid.values[i]);
}

bool within(const dvec3& x, const ivec3& size, double margin) {
    for (int axis = 0; axis < 3; ++axis)
        if (x[axis] < margin || x[axis] > size[axis] - margin) return false;
    return true;
}

TEST(LightSurfaces, ATiltedPlaneGetsTheLightTimesTheCosine) {
    const ivec3 size(24);
    for (const dvec3& tilt : {dvec3(0, 1, 0), dvec3(0.3, 1, 0.1), dvec3(0.7, 0.8, 0.75)}) {
        const dvec3 normal = glm::normalize(tilt), light = glm::normalize(dvec3(0.2, -1, 0.1));
        const judge::Glass plane{{judge::glassHull({{normal, glm::dot(normal, dvec3(12.3))}}, 1)}};
        const Lit lit(sceneOf(plane, size), onSurfaces(beam(light, dvec3(2, 1, 0.5)), 3));
        const double cosine = -glm::dot(light, normal);
        int found = 0;
        forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
            if (!within(x, size, 2)) return;
            ++found;
            EXPECT_NEAR(e.x, 2 * cosine, 0.005 * 2 * cosine) << x.x << " " << x.y << " " << x.z;
            EXPECT_NEAR(e.y, cosine, 0.005 * cosine);
            EXPECT_NEAR(e.z, 0.5 * cosine, 0.005 * 0.5 * cosine);
        });
        EXPECT_GE(found, 20 * 20 * 9); // the plane crosses the domain
    }
}

TEST(LightSurfaces, ABallAndACubeGetTheCosineAndTheirFarSidesNothing) {
    const dvec3 light = glm::normalize(dvec3(0.3, -1, 0.2));
    const ivec3 size(40);
    const dvec3 middle(20);
    const judge::Glass ball{{judge::glassBall(middle, 15, 1)}};
    const Lit lit(sceneOf(ball, size), onSurfaces(beam(light), 2, 1 << 24));
    int bright = 0;
    forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
        // Where the ball is met by the voxel's column, along the axis that is steepest to it.
        dvec3 normal = (x - middle) / 15.0;
        int steep = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs(normal[axis]) > std::abs(normal[steep])) steep = axis;
        // Where two axes are as steep, it is not told which column the voxel counts to.
        for (int axis = 0; axis < 3; ++axis)
            if (axis != steep && std::abs(std::abs(normal[axis]) - std::abs(normal[steep])) < 0.06)
                return;
        double rest = 1;
        for (int axis = 0; axis < 3; ++axis)
            rest -= axis == steep ? 0 : normal[axis] * normal[axis];
        normal[steep] = std::copysign(std::sqrt(rest), normal[steep]);
        const double cosine = -glm::dot(light, normal);
        if (cosine < -0.05) {
            EXPECT_EQ(e.x, 0);
        }
        if (cosine < 0.1) return; // within a voxel and a half of where light grazes
        ++bright;
        EXPECT_NEAR(e.x, cosine, 0.005)
            << cosine << " at " << normal.x << " " << normal.y << " " << normal.z;
    });
    EXPECT_GT(bright, 2 * 3.1 * 15 * 15 * 4);

    const judge::Glass box{{judge::glassBox(dvec3(8.3), dvec3(31.6), 1)}};
    const Lit cube(sceneOf(box, size), onSurfaces(beam(light), 2, 1 << 20));
    int onTop = 0, below = 0;
    forEachLit(cube.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
        // A face's voxels more than one from its edges.
        const auto inside = [](double a) { return a > 10.3 && a < 29.6; };
        if (!inside(x.x) || !inside(x.z)) return;
        const bool top = x.y > 20;
        EXPECT_NEAR(e.x, top ? -light.y : 0, 0.005);
        (top ? onTop : below)++;
    });
    EXPECT_GE(onTop, 19 * 19 * 4);
    EXPECT_GE(below, 19 * 19 * 4);
}

TEST(LightSurfaces, WideBeamsDoNotBendAroundEdges) {
    // A box under a slanting sun by cells of some four voxels, many of which lie across an edge.
    const ivec3 size(40);
    const dvec3 light = glm::normalize(dvec3(0.2, -1, 0.6));
    const judge::Glass box{{judge::glassBox(dvec3(8.3), dvec3(31.6), 1)}};
    const Lit cube(sceneOf(box, size), onSurfaces(beam(light), 2, 1 << 12));
    int onTop = 0, onSide = 0;
    forEachLit(cube.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
        const auto inside = [](double a) { return a > 10.3 && a < 29.6; };
        const bool top = inside(x.x) && inside(x.z) && x.y > 20;
        const bool side = inside(x.x) && inside(x.y) && x.z < 20; // which the light meets
        if (top) {
            EXPECT_NEAR(e.x, -light.y, 0.03);
        }
        if (side) {
            EXPECT_NEAR(e.x, light.z, 0.03);
        }
        onTop += top;
        onSide += side;
    });
    EXPECT_GE(onTop, 19 * 19 * 4);
    EXPECT_GE(onSide, 19 * 19 * 4);
}

TEST(LightSurfaces, BlurredPlanesGetTheLightWhereverTheyLie) {
    // Opacity that is 0 or 1, or fades over two voxels, with its half value at any height.
    for (const double fades : {1e-3, 2.0})
        for (const int k : {0, 2, 3, 5})
            for (const int detail : {1, 4}) {
                const double height = 6 + k / 8.0;
                SCOPED_TRACE(testing::Message()
                             << "height " << height << " over " << fades << " detail " << detail);
                TestVolume scene{ivec3(12)};
                scene.constant("ior", 1);
                scene.add("opacity", [=](dvec3 p) {
                    return std::clamp(0.5 + (height - p.y) / fades, 0.0, 1.0);
                });
                Params params = onSurfaces(beam({0, -1, 0}), detail, 1 << 12);
                params.tracing.boundary = optics::Boundary::blurred;
                const Lit lit(scene.volume(), params);
                double least = 1e9, most = 0;
                forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
                    if (!within(x, ivec3(12), 2) || std::abs(x.y - height) > 1.2) return;
                    least = std::min(least, double{e.x});
                    most = std::max(most, double{e.x});
                });
                EXPECT_NEAR(least, 1, 0.02);
                EXPECT_NEAR(most, 1, 0.02);
            }
}

TEST(LightSurfaces, LongStepsDoNotPassThinPlates) {
    // Blurred, an index that varies elsewhere: through the even rest steps are as long as the
    // octree allows, longer than the plate is thick.
    TestVolume scene{ivec3(48)};
    scene.index([](dvec3 p) { return 1 + 0.2 * std::exp(-0.1 * glm::dot(p - 8.0, p - 8.0)); });
    scene.add("opacity", [](dvec3 p) { return std::abs(p.y - 20) < 1.5 ? 1.0 : 0.0; });
    Params params = onSurfaces(beam({0.1, -1, 0.05}), 1, 1 << 12);
    params.method = Method::beams;
    const Lit beams(scene.volume(), params);
    params.method = Method::photons;
    const Lit photons(scene.volume(), params);
    // What passes beside the plate leaves through the sides above it.
    EXPECT_NEAR(beams.stats.energy.absorbed[0], photons.stats.energy.absorbed[0],
                0.02 * photons.stats.energy.absorbed[0]);
}

TEST(LightSurfaces, AThinWallLetsNoLightThrough) {
    // Two voxels thick, slanting, lit from above.
    const dvec3 normal = glm::normalize(dvec3(0.4, 1, 0.2));
    const double at = glm::dot(normal, dvec3(12));
    const judge::Glass wall{{judge::glassHull({{normal, at + 1}, {-normal, 1 - at}}, 1)}};
    for (const Method method : {Method::beams, Method::photons})
        for (const int detail : {1, 2}) {
            Params params = onSurfaces(beam({0, -1, 0}), detail);
            params.method = method;
            const Lit lit(sceneOf(wall, ivec3(24)), params);
            int above = 0, below = 0;
            forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
                if (!within(x, ivec3(24), 2)) return;
                const double off = glm::dot(normal, x) - at;
                if (off < -0.5) {
                    ++below;
                    EXPECT_EQ(e.x, 0);
                }
                if (off > 0.5) above += e.x > 0.5 * normal.y;
            });
            EXPECT_GT(above, 300 * detail * detail);
            EXPECT_GT(below, 300 * detail * detail);
        }
}

/// A ball of 16 voxels over a floor, as the judge has it in units of 32 voxels.
struct BallOverFloor {
    static constexpr int kDetail = 2, kTexels = 64;
    judge::BallOverPlane exact{};
    ivec3 size{80, 46, 80};
    dvec3 centre{40, 26, 40};

    BallOverFloor() {
        exact.texels = kTexels;
        exact.extent = 1;
    }
    volume::Volume volume() const {
        return sceneOf({{judge::glassBall(centre, 16, exact.index),
                         judge::glassBox(dvec3(-20), {120, 2, 120}, 1)}},
                       size);
    }
    /// The floor's irradiance by the judge's texels.
    std::vector<double> texelsOf(const volume::FineGrid& grid) const {
        std::vector<double> found(static_cast<size_t>(kTexels) * kTexels);
        const int layers = 2; // of fine voxels that the floor touches, above it and below
        forEachLit(grid, [&](const dvec3& x, const glm::vec3& e) {
            if (x.y < 1.5 || x.y > 2.5) return;
            const ivec3 at(glm::floor(x - dvec3(8, 0, 8))); // a texel is a voxel wide
            if (at.x < 0 || at.z < 0 || at.x >= kTexels || at.z >= kTexels) return;
            const double share = 1.0 / (kDetail * kDetail * layers);
            found[static_cast<size_t>(at.z) * kTexels + static_cast<size_t>(at.x)] += e.x * share;
        });
        return found;
    }
};

/// Root mean square of the differences, relative to the truth and a tenth of its mean.
double relativeError(const std::vector<double>& found, const std::vector<double>& exact) {
    double mean = 0, sum = 0;
    for (double value : exact) mean += value / static_cast<double>(exact.size());
    for (size_t i = 0; i < exact.size(); ++i)
        sum += (found[i] - exact[i]) * (found[i] - exact[i]) /
               (exact[i] * exact[i] + 0.01 * mean * mean);
    return std::sqrt(sum / static_cast<double>(exact.size()));
}

double meanOf(const std::vector<double>& values) {
    double sum = 0;
    for (double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

TEST(LightSurfaces, BeamsDrawTheCausticOfABallOnAFloor) {
    const BallOverFloor scene;
    const std::vector<double> exact = judge::irradianceUnder(scene.exact, 5000);
    const Lit lit(scene.volume(), onSurfaces(beam(scene.exact.direction), scene.kDetail, 1 << 21));
    const std::vector<double> found = scene.texelsOf(lit.result.irradiance);
    EXPECT_LT(relativeError(found, exact), 0.02);
    EXPECT_NEAR(meanOf(found), meanOf(exact), 1e-3 * meanOf(exact));

    Params params = onSurfaces(beam(scene.exact.direction), scene.kDetail, 1 << 21);
    params.method = Method::photons;
    const std::vector<double> photons =
        scene.texelsOf(Lit(scene.volume(), params).result.irradiance);
    EXPECT_LT(relativeError(photons, exact), 0.1);
    EXPECT_NEAR(meanOf(photons), meanOf(exact), 2e-3 * meanOf(exact));
}

/// What a disc of that diameter [degree] throws, by the judge's light from directions on rings,
/// which fill its projection evenly.
std::vector<double> exactUnderDisc(const BallOverFloor& scene, double diameter, int rings) {
    const dvec3 axis = glm::normalize(scene.exact.direction);
    const dvec3 right = glm::normalize(glm::cross(axis, dvec3(1, 0, 0)));
    const dvec3 up = glm::cross(axis, right);
    std::vector<double> sum(static_cast<size_t>(scene.kTexels) * scene.kTexels);
    for (int ring = 0; ring < rings; ++ring) {
        const int around = 6 * ring + 3; // as many as the ring is wide
        for (int k = 0; k < around; ++k) {
            const double off = std::sin(glm::radians(diameter / 2)) * (ring + 0.5) / rings;
            const double turn = glm::radians(360.0 * (k + 0.5 * (ring % 2)) / around);
            const double along = std::sqrt(1 - off * off);
            judge::BallOverPlane from = scene.exact;
            from.direction = along * axis + off * (std::cos(turn) * right + std::sin(turn) * up);
            judge::Texels texels({-1, -1}, {1, 1}, scene.kTexels / 2);
            judge::irradianceUnder(from, texels, 1.0 / 64);
            for (size_t i = 0; i < sum.size(); ++i)
                sum[i] += texels.values[i] / (3.0 * rings * rings * along);
        }
    }
    return sum;
}

TEST(LightSurfaces, ABallsPenumbraAndCausticUnderADiscAreTheJudges) {
    const BallOverFloor scene;
    for (const double diameter : {0.53, 6.0}) {
        SCOPED_TRACE(diameter);
        const std::vector<double> exact = exactUnderDisc(scene, diameter, 3);
        Light disc = beam(scene.exact.direction);
        disc.angle = diameter;
        Params params = onSurfaces(disc, scene.kDetail, 1 << 18);
        if (diameter > 1) params.lightSamples = 24; // half of what it would take
        const Lit lit(scene.volume(), params);
        const std::vector<double> found = scene.texelsOf(lit.result.irradiance);
        EXPECT_LT(relativeError(found, exact), 0.02);
        EXPECT_NEAR(meanOf(found), meanOf(exact), 1e-3 * meanOf(exact));
    }
    // Without its disc the wider one's light is another.
    const Lit point(scene.volume(),
                    onSurfaces(beam(scene.exact.direction), scene.kDetail, 1 << 17));
    EXPECT_GT(relativeError(scene.texelsOf(point.result.irradiance), exactUnderDisc(scene, 6, 3)),
              0.08);
}

TEST(LightSurfaces, TheSameRunGivesTheSameBytes) {
    const BallOverFloor scene;
    const Params params = onSurfaces(beam(scene.exact.direction), 1, 1 << 14);
    const Lit a(scene.volume(), params), b(scene.volume(), params);
    EXPECT_EQ(a.result.irradiance.voxels, b.result.irradiance.voxels);
    EXPECT_EQ(a.result.irradiance.values, b.result.irradiance.values);
}

TEST(LightSurfaces, SmallBodiesBetweenWideBeamsAreNotMissed) {
    // So few photons that a map starts with cells of some 16 voxels, rays 8 apart.
    const ivec3 size(48);
    for (int k = 0; k < 4; ++k) {
        const judge::Glass glass{{judge::glassBall(dvec3(19.0 + 3 * k, 20, 26.0 - 2 * k), 2, 1.5),
                                  judge::glassBox(dvec3(-20), {80, 4, 80}, 1)}};
        Params params = onSurfaces(beam({0, -1, 0}), 1, 576);
        params.maxDepth = 3;
        const Lit lit(sceneOf(glass, size), params);
        double least = 1, most = 1;
        forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
            if (!within(x, size, 2) || std::abs(x.y - 4) > 0.6) return;
            least = std::min(least, double{e.x});
            most = std::max(most, double{e.x});
        });
        EXPECT_LT(least, 0.6) << k;
        EXPECT_GT(most, 1.02) << k;
    }
}

TEST(LightSurfaces, AFewWideBeamsLoseNoLight) {
    // A beam or four for 192² fine voxels and more: far more than a work item's loops may go
    // through.
    const dvec3 normal = glm::normalize(dvec3(0.6, 0.8, 0.5)), light(0, -1, 0);
    const judge::Glass plane{{judge::glassHull({{normal, glm::dot(normal, dvec3(12.3))}}, 1)}};
    for (const std::int64_t photons : {64, 256}) {
        const Lit lit(sceneOf(plane, ivec3(24)), onSurfaces(beam(light), 8, photons));
        int found = 0;
        forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
            if (!within(x, ivec3(24), 2)) return;
            ++found;
            EXPECT_NEAR(e.x, normal.y, 0.005 * normal.y);
        });
        EXPECT_GE(found, 20 * 20 * 64);
    }
}

TEST(LightSurfaces, LightJustOffASurfaceLandsOnIt) {
    // Chords of wide beams lie in a ball's voxels, or one beside them.
    const judge::Glass ball{{judge::glassBall(dvec3(20), 15, 1)}};
    const Lit lit(sceneOf(ball, ivec3(40)), onSurfaces(beam({0.3, -1, 0.2}), 4, 1 << 10));
    EXPECT_GT(lit.counter("beam_deposits"), 10000);
    EXPECT_EQ(lit.counter("beam_deposits_missed"), 0);
}

TEST(LightSurfaces, PanesSendEachOthersReflectionsDown) {
    // What N interfaces of reflectance R let through, all orders summed: (1 − R)/(1 + (N − 1) R).
    const ivec3 size(24, 44, 24);
    judge::Glass glass{{judge::glassBox(dvec3(-50, -50, -50), dvec3(70, 6.3, 70), 1)}};
    for (const double y : {12.2, 20.6, 29.1})
        glass.solids.push_back(judge::glassBox(dvec3(-50, y, -50), dvec3(70, y + 4.4, 70), 1.5));
    Params params = onSurfaces(beam({0, -1, 0}), 1, 1 << 10);
    params.beamCutoff = 1e-5;
    const Lit lit(sceneOf(glass, size), params);
    int found = 0;
    forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
        if (!within(x, size, 4)) return;
        ++found;
        EXPECT_NEAR(e.x, 0.96 / (1 + 5 * 0.04), 1e-3) << x.x << " " << x.y << " " << x.z;
    });
    EXPECT_GE(found, 16 * 16);
    EXPECT_LT(lit.counter("light_dropped_by_depth"), 1e-4);
}

TEST(LightSurfaces, DimLightThatIsSpreadWideIsAllThere) {
    // A lamp shines up at a ball: its floor gets what the ball sends back alone, of every order.
    const ivec3 size(64, 32, 64);
    judge::Glass glass{{judge::glassBox(dvec3(-50, -50, -50), dvec3(114, 6.3, 114), 1)}};
    glass.solids.push_back(judge::glassBall(dvec3(32, 20, 32), 6, 1.5));
    const Lit lit(sceneOf(glass, size), onSurfaces(parseLight("spot:32,11,32:0,1,0:40"), 2));
    double sum = 0;
    forEachLit(lit.result.irradiance, [&](const dvec3&, const glm::vec3& e) { sum += e.x / 4; });
    const Energy& energy = lit.stats.energy;
    EXPECT_GT(energy.absorbed[0], 0.03 * energy.entered[0]);
    EXPECT_LT(energy.absorbed[0], 0.2 * energy.entered[0]);
    EXPECT_NEAR(sum, energy.absorbed[0], 0.005 * energy.absorbed[0]);
}

TEST(LightSurfaces, APointLightFallsOffWithTheSquare) {
    const judge::Glass floor{{judge::glassBox(dvec3(-9), {40, 3, 40}, 1)}};
    const dvec3 place(12, 20, 12);
    for (const dvec3& at : {place, dvec3(12, 60, 12)}) { // in the domain, above it
        const Lit lit(sceneOf(floor, ivec3(24)), onSurfaces(lamp(at, dvec3(100)), 2, 1 << 22));
        int found = 0;
        forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
            if (!within(x, ivec3(24), 1.5)) return;
            ++found;
            const dvec3 way = dvec3(x.x, 3, x.z) - at;
            const double distance = glm::length(way);
            const double expected = 100 * -way.y / (distance * distance * distance);
            EXPECT_NEAR(e.x, expected, 0.005 * expected);
        });
        EXPECT_GT(found, 20 * 20 * 4);
    }
}

TEST(LightSurfaces, WhatAbsorbsDimsTheLightThatComesToASurface) {
    TestVolume scene(ivec3(20));
    scene.constant("ior", 1).constantVector("absorption", dvec3(0.05, 0.1, 0));
    scene.add("opacity", [](dvec3 p) { return p.y < 4 ? 1 : 0; });
    const Lit lit(scene.volume(), onSurfaces(beam({0, -1, 0}), 2));
    int found = 0;
    forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
        if (!within(x, ivec3(20), 1.5)) return;
        ++found;
        EXPECT_NEAR(e.x, std::exp(-0.05 * 16), 0.005);
        EXPECT_NEAR(e.y, std::exp(-0.1 * 16), 0.005);
        EXPECT_NEAR(e.z, 1, 0.005);
    });
    EXPECT_GT(found, 16 * 16 * 4);
}

TEST(LightSurfaces, WhatTheDomainsFaceCutsOpenIsLitThere) {
    const judge::Glass floor{{judge::glassBox(dvec3(-9), {40, 10.3, 40}, 1)}};
    const dvec3 light = glm::normalize(dvec3(1, -0.5, 0.2));
    for (const Method method : {Method::beams, Method::photons}) {
        Params params = onSurfaces(beam(light), 2, 1 << 20);
        params.method = method;
        const Lit lit(sceneOf(floor, ivec3(24)), params);
        int found = 0;
        forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
            if (x.x > 0.5 || x.y > 8 || x.y < 1 || x.z < 1 || x.z > 23) return;
            ++found;
            // A row of photons more or less: some hundred and fifty a voxel.
            EXPECT_NEAR(e.x, light.x, (method == Method::beams ? 0.005 : 0.1) * light.x);
        });
        EXPECT_GE(found, 7 * 22 * 4);
    }
}

TEST(LightSurfaces, SmoothingTakesNoDarknessFromBehindASurface) {
    // Thin haze over a floor: its light is 1 down to the floor, whatever the rounds.
    for (const bool sharp : {false, true}) {
        TestVolume scene(ivec3(16));
        scene.constant("ior", 1).constantVector("scattering", dvec3(1e-4));
        scene.add("opacity", [](dvec3 p) { return p.y < 6 ? 1 : 0; });
        volume::Volume volume = scene.take();
        if (sharp) {
            volume = sceneOf({{judge::glassBox(dvec3(-9), {40, 6, 40}, 1)}}, ivec3(16));
            volume.putConstant("scattering.medium", glm::vec3(1e-4f));
        }
        Params params = paramsOf({beam({0, -1, 0})}, 1 << 14);
        params.automaticOutputs = true;
        params.smoothing = 2;
        const Lit lit(volume, params);
        EXPECT_TRUE(lit.plan.photons && lit.plan.beams);
        for (int y = 6; y < 16; ++y) EXPECT_NEAR(lit.fluence({8, y, 8}), 1, 0.01) << y;
        EXPECT_EQ(lit.fluence({8, 4, 8}), 0);
        bool onFloor = false;
        forEachLit(lit.result.irradiance, [&](const dvec3& x, const glm::vec3& e) {
            if (!within(x, ivec3(16), 2) || std::abs(x.y - 6) > 0.2) return;
            onFloor = true;
            EXPECT_NEAR(e.x, 1, 0.005); // dimmed by 0.001
        });
        EXPECT_TRUE(onFloor);
    }
}

TEST(LightSurfaces, FluenceIsSimulatedWhereSomethingScattersAlone) {
    TestVolume scene(ivec3(8));
    scene.constant("ior", 1).add("opacity", [](dvec3 p) { return p.y < 3 ? 1 : 0; });
    Params params = onSurfaces(beam({0, -1, 0}), 0);
    params.automaticOutputs = true;
    const Plan plan = makePlan(scene.volume(), params);
    EXPECT_EQ(plan.outputs, Output::irradiance);
    EXPECT_TRUE(plan.beams);
    EXPECT_FALSE(plan.photons);
    scene.constantVector("scattering", dvec3(0.1));
    const Plan hazy = makePlan(scene.volume(), params);
    EXPECT_EQ(hazy.outputs, Output::fluence | Output::irradiance);
    EXPECT_TRUE(hazy.beams);
    EXPECT_TRUE(hazy.photons);
}

} // namespace
} // namespace eikonal::lightsim
