// Light at sharp boundaries: slabs, a prism, balls and shadows that are solved on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"

#include "base/error.h"
#include "support/shapes.h"

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

using Distance = TestVolume::Scalar;

/// One object, in a medium of index 1.
TestVolume sceneVolume(ivec3 size, const Distance& sdf, const Distance& n) {
    TestVolume out(size);
    out.add("sdf", sdf, 1e3);
    out.index(n, 1);
    return out;
}

TestVolume sceneVolume(ivec3 size, const Distance& sdf, double n) {
    return sceneVolume(size, sdf, [=](dvec3) { return n; });
}

Distance slab(double low, double high) {
    return [=](dvec3 p) { return std::max(low - p.z, p.z - high); };
}

Distance ball(const dvec3& centre, double radius) {
    return [=](dvec3 p) { return glm::length(p - centre) - radius; };
}

/// Fresnel's share of unpolarised light that is reflected from index 1 to n.
double fresnel(double n, double cosine) {
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double s = (cosine - n * inside) / (cosine + n * inside);
    const double p = (n * cosine - inside) / (n * cosine + inside);
    return 0.5 * (s * s + p * p);
}

/// What parallel layers send on and back, of light that comes from the first: shares of power.
struct Layers {
    double through, back;
};

/// Behind layers `a` a boundary or layer that reflects from both sides alike: every path between
/// them, a geometric series.
Layers behind(const Layers& a, const Layers& b) {
    const double loop = 1 / (1 - a.back * b.back);
    return {a.through * b.through * loop, a.back + a.through * a.through * b.back * loop};
}

Layers boundary(double R) {
    return {1 - R, R};
}

/// A thin box that covers the domain's face at z = 0, at that depth.
Triangles sheet(const glm::ivec2& size, double depth) {
    const mesh::TriangleMesh box =
        mesh::boxShape(dvec3(0, 0, depth), dvec3(size.x, size.y, depth + 1e-3));
    Triangles corners;
    for (const glm::uvec3& triangle : box.triangles)
        for (int i = 0; i < 3; ++i) corners.push_back(box.points[triangle[i]]);
    return corners;
}

double mean(const Lit& lit, ivec3 low, ivec3 high, int c = 0) {
    double sum = 0;
    forEachVoxel(high - low, [&](ivec3 p) { sum += lit.fluence(low + p, c); });
    const ivec3 size = high - low;
    return sum / (double(size.x) * size.y * size.z);
}

Lit lit(const TestVolume& scene, const Params& params) {
    return Lit(scene.volume(), params);
}

} // namespace

TEST(LightSharp, ASlabIsSnellsAndFresnels) {
    const double n = 1.5;
    for (const double degrees : {0.0, 20.0, 50.0, 70.0}) {
        SCOPED_TRACE(degrees);
        const double sine = std::sin(degrees * M_PI / 180), cosine = std::sqrt(1 - sine * sine);
        const double inside = std::sqrt(1 - sine * sine / (n * n)), R = fresnel(n, cosine);
        // At its far end light from the near one has been through so many reflections that more do
        // not count. It starts in front of the slab: from the domain's side it would enter the
        // glass without refraction and never leave.
        const int length = degrees < 60 ? 72 : 112;
        Params params = paramsOf({beam({sine, 0, cosine})}, std::int64_t{2048} * length);
        params.proxy = sheet({length, 8}, 0.125);
        const Lit found = lit(sceneVolume({length, 8, 20}, slab(6.25, 12.25), n), params);
        const ivec3 low(length - 9, 0, 0), high(length - 1, 8, 0);
        const auto at = [&](int from, int to) {
            return mean(found, low + ivec3(0, 0, from), high + ivec3(0, 0, to));
        };
        const Layers both = behind(boundary(R), boundary(R));
        // 64 columns of 256 photons and more. At a slant only some 100 of them stand side by side
        // across the sheet's end, a half of one of which is in doubt; so is the share reflected.
        EXPECT_NEAR(at(14, 19), both.through, 5e-3);
        // Inside both ways together carry what arrives, (1 − R)(1 + R)/(1 − R²), along longer
        // paths.
        EXPECT_NEAR(at(7, 12), cosine / inside, 5e-3);
        EXPECT_NEAR(at(1, 6), 1 + both.back, 5e-3);
    }
}

TEST(LightSharp, WhatASlabAbsorbsIsBooked) {
    const double R = 0.04, sigma = 0.05, depth = 7.5, a = std::exp(-sigma * depth);
    TestVolume glass = sceneVolume({16, 16, 20}, slab(6.25, 13.75), 1.5);
    glass.addVector("absorption", [=](dvec3) { return dvec3(0.3, 1, 2) * sigma; });
    const Lit found = lit(glass, paramsOf({beam({0, 0, 1})}, 1 << 16));
    EXPECT_TRUE(found.plan.colour);
    for (int c = 0; c < 3; ++c) {
        const double left = std::pow(a, c == 0 ? 0.3 : c == 1 ? 1 : 2);
        const double share = (1 - R) * (1 - left) / (1 - R * left);
        const Energy& energy = found.stats.energy;
        const auto i = static_cast<size_t>(c);
        // Of 2^16 photons as many are reflected as should be, but for some tens.
        EXPECT_NEAR(energy.absorbed[i] / energy.entered[i], share, 1e-3);
        EXPECT_NEAR(mean(found, {0, 0, 15}, {16, 16, 20}, c),
                    (1 - R) * (1 - R) * left / (1 - R * R * left * left), 1e-3);
        EXPECT_EQ(found.counter("light_dropped_by_depth"), 0);
    }
}

TEST(LightSharp, AnObjectMayAbsorbHereMoreThanThere) {
    // σ rises along the way: the integral over the slab is that of its middle. Beyond the slab the
    // grid goes on, and is not read.
    const double R = 0.04, a = std::exp(-0.01 * 10 * 7.5);
    TestVolume glass = sceneVolume({16, 16, 20}, slab(6.25, 13.75), 1.5);
    glass.addVector("absorption", [=](dvec3 p) { return dvec3(0.01 * p.z); });
    const Lit found = lit(glass, paramsOf({beam({0, 0, 1})}, 1 << 16));
    // 2^16 photons, of which the share reflected is off by some tens.
    const double through = (1 - R) * (1 - R) * a / (1 - R * R * a * a);
    EXPECT_NEAR(mean(found, {0, 0, 15}, {16, 16, 20}), through, 1e-3);
    EXPECT_NEAR(found.stats.energy.absorbed[0] / found.stats.energy.entered[0],
                (1 - R) * (1 - a) / (1 - R * a), 1e-3);
}

TEST(LightSharp, OutOfGlassLightIsRefractedOrTotallyReflected) {
    // Light that starts in glass of 1.5 under a plane that it meets at an angle, critical 41.8°.
    const double n = 1.5;
    for (const double degrees : {30.0, 45.0, 60.0}) {
        SCOPED_TRACE(degrees);
        const double sine = std::sin(degrees * M_PI / 180), cosine = std::sqrt(1 - sine * sine);
        const Distance under = [=](dvec3 p) { return cosine * (p.z - 16) - sine * (p.x - 24); };
        const Lit found =
            lit(sceneVolume({48, 8, 32}, under, n), paramsOf({beam({0, 0, 1})}, 1 << 18));
        const Energy& energy = found.stats.energy;
        const double out = n * sine;
        if (out >= 1) {
            // Beyond the plane, above glass, no voxel that it does not cut has any light.
            double most = 0;
            forEachVoxel(found.plan.scene.size(), [&](ivec3 p) {
                const dvec3 middle = dvec3(p) + 0.5;
                if (under(middle) > 1 && under({middle.x - 1, middle.y, 0}) < 0)
                    most = std::max(most, found.fluence(p));
            });
            EXPECT_EQ(most, 0);
            EXPECT_NEAR(energy.escaped[0], energy.entered[0], 1e-5 * energy.entered[0]);
        } else {
            // From the boundary's side: the light that arrives is reflected as it would be from
            // without.
            const double beyond = std::sqrt(1 - out * out), R = fresnel(n, beyond);
            // 80 voxels of 170 photons, and the share reflected is off by some tens.
            EXPECT_NEAR(mean(found, {23, 0, 21}, {25, 8, 26}), (1 - R) * cosine / beyond, 0.01);
            // Out at once or turned to the side, and out there.
            EXPECT_NEAR(energy.escaped[0], energy.entered[0], 1e-5 * energy.entered[0]);
        }
    }
}

TEST(LightSharp, ARoofPrismSendsBackAllThatItGets) {
    // In through the long side at z = 8, off both legs at 45°, past the critical 41.8°, and back.
    // What the long side turns back to the legs comes again.
    const Distance prism = [](dvec3 p) {
        return std::max(8 - p.z, (std::abs(p.x - 40) + p.z - 40) * std::sqrt(0.5));
    };
    const Lit found =
        lit(sceneVolume({80, 4, 48}, prism, 1.5), paramsOf({beam({0, 0, 1})}, 80 * 4 * 256));
    // Edges are round over two voxels or three, and scatter what hits them: some 7 in 64 of the
    // light, of which little comes this way.
    EXPECT_NEAR(mean(found, {20, 0, 1}, {32, 4, 7}), 2, 0.02);
    EXPECT_NEAR(mean(found, {48, 0, 1}, {60, 4, 7}), 2, 0.02);
    EXPECT_LT(mean(found, {20, 0, 36}, {28, 4, 44}), 0.03);
}

TEST(LightSharp, ABallGathersLightAtItsCentreAndAbsorbsItsChords) {
    const double n = 1.5, radius = 20;
    const dvec3 centre(24);
    TestVolume clear = sceneVolume(ivec3(48), ball(centre, radius), n);
    const Lit found = lit(clear, paramsOf({beam({0, 0, 1})}, 1 << 19));
    // The front focuses 3 radii behind its vertex: at the centre a bundle is 2/3 as wide. So it is
    // on its way back from the rear, a concave mirror. Aberration: those who pass within a voxel
    // came within two at the front, a tenth of the radius, squared. 16 voxels of 500 photons.
    EXPECT_NEAR(mean(found, ivec3(23, 23, 22), ivec3(25, 25, 26)), 0.96 * 1.04 * 2.25, 0.04);
    // 1.35 radii behind the centre, on the way to the focus at 1.5, the bundle's width is a tenth
    // of what it was: a hundredfold but for aberration, which takes most.
    EXPECT_GT(mean(found, ivec3(23, 23, 45), ivec3(25, 25, 47)), 20);
    EXPECT_NEAR(found.stats.energy.lost[0], 0, 1e-3 * found.stats.energy.entered[0]); // thinned

    const double sigma = 0.02;
    clear.constantVector("absorption", dvec3(sigma));
    const Lit dim = lit(clear, paramsOf({beam({0, 0, 1})}, 1 << 18));
    double absorbed = 0;
    const int rings = 4000;
    for (int i = 0; i < rings; ++i) {
        const double sine = (i + 0.5) / rings;
        const double chord = 2 * radius * std::sqrt(1 - sine * sine / (n * n));
        const double R = fresnel(n, std::sqrt(1 - sine * sine)), a = std::exp(-sigma * chord);
        // Every chord of a path meets the boundary as the first one does.
        absorbed += 2 * M_PI * radius * radius * sine / rings * (1 - R) * (1 - a) / (1 - R * a);
    }
    // The disc's outline cuts 1,500 of the 140,000 pixels that see it, half in half out.
    EXPECT_NEAR(dim.stats.energy.absorbed[0], absorbed, 2e-3 * absorbed);
}

TEST(LightSharp, LayersThatTouchAreOneBoundary) {
    const ivec3 size(16, 16, 32);
    for (const double second : {2.0, 1.5}) {
        TestVolume layers(size);
        layers.add("sdf.first", slab(8.4, 16.4), 1e3).add("sdf.second", slab(16.4, 24.4), 1e3);
        layers.constant("ior.first", 1.5).constant("ior.second", second);
        const Lit found = lit(layers, paramsOf({beam({0, 0, 1})}, 1 << 16));
        EXPECT_EQ(found.plan.scene.objects.size(), 2u);
        const auto between = [](double a, double b) {
            return boundary((a - b) * (a - b) / ((a + b) * (a + b)));
        };
        const Layers all =
            behind(behind(between(1, 1.5), between(1.5, second)), between(second, 1));
        // 2^16 photons, of which the share reflected is off by some tens.
        EXPECT_NEAR(mean(found, {0, 0, 26}, {16, 16, 31}), all.through, 2e-3) << second;
        EXPECT_NEAR(mean(found, {0, 0, 1}, {16, 16, 7}), 1 + all.back, 2e-3) << second;
    }
}

TEST(LightSharp, FortyLayersThatTouch) {
    // Those that light meets first have the highest numbers. It takes photons several launches.
    const ivec3 size(4, 4, 120);
    const auto indexOf = [](int k) { return k % 2 == 0 ? 1.3 : 1.5; };
    TestVolume layers(size);
    for (int k = 0; k < 40; ++k) {
        const std::string name = std::to_string(100 + k);
        layers.add("sdf." + name, slab(8.4 + 2.5 * k, 10.9 + 2.5 * k), 1e3);
        layers.constant("ior." + name, indexOf(k));
    }
    Params params = paramsOf({beam({0, 0, 1})}, 1 << 13);
    params.maxDepth = 1000;
    const Lit clear = lit(layers, params);
    const auto between = [](double a, double b) {
        return boundary((a - b) * (a - b) / ((a + b) * (a + b)));
    };
    Layers all = between(1, indexOf(0));
    for (int k = 1; k < 40; ++k) all = behind(all, between(indexOf(k - 1), indexOf(k)));
    const Layers before = all;
    all = behind(all, between(indexOf(39), 1));
    // 2^13 photons, of which the share reflected is off by some tens.
    EXPECT_NEAR(mean(clear, {0, 0, 112}, {4, 4, 119}), all.through, 1e-2);
    EXPECT_NEAR(mean(clear, {0, 0, 1}, {4, 4, 7}), 1 + all.back, 1e-2);
    // The last layer absorbs: e^(−σd) once through it and once back.
    const double sigma = 0.3, kept = std::exp(-2.5 * sigma);
    layers.constantVector("absorption.139", dvec3(sigma));
    const Lit dim = lit(layers, params);
    const double R = between(indexOf(39), 1).back;
    const Layers last{kept * (1 - R), kept * kept * R};
    EXPECT_NEAR(mean(dim, {0, 0, 112}, {4, 4, 119}), behind(before, last).through, 1e-2);
    EXPECT_NEAR(dim.stats.energy.absorbed[0] / dim.stats.energy.entered[0],
                1 - behind(before, last).through - behind(before, last).back, 1e-2);
}

TEST(LightSharp, LightThatEntersWithinOneOfManyObjects) {
    // It reaches beyond the domain's face and, first of forty, has the highest number.
    const ivec3 size(4, 4, 120);
    const double n = 1.3, sigma = 0.1;
    TestVolume layers(size);
    for (int k = 0; k < 40; ++k) {
        const std::string name = std::to_string(100 + k);
        layers.add("sdf." + name, slab(k == 0 ? -9 : 8.4 + 2.5 * k, 10.9 + 2.5 * k), 1e3);
        layers.constant("ior." + name, n);
    }
    layers.constantVector("absorption.100", dvec3(sigma));
    const Lit found = lit(layers, paramsOf({beam({0, 0, 1})}, 1 << 13));
    const double R = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
    EXPECT_NEAR(mean(found, {0, 0, 112}, {4, 4, 119}), std::exp(-10.9 * sigma) * (1 - R), 2e-3);
}

TEST(LightSharp, AnOpaqueObjectHasASharpShadow) {
    const Distance edge = [](dvec3 p) { return std::max(p.x - 12.25, 10 - p.z); };
    TestVolume block = sceneVolume({24, 8, 24}, edge, 1);
    block.add("opacity", [&](dvec3 p) { return edge(p) < 0; });
    Params params = paramsOf({beam({0, 0, 1})}, 64 * 24 * 8);
    const Lit found = lit(block, params);
    EXPECT_TRUE(found.plan.opaque);
    for (int z = 12; z < 24; ++z) {
        // 8 photons a voxel's edge: the boundary at a quarter of one lies between two of them.
        EXPECT_NEAR(found.fluence({12, 4, z}), 0.75, 1e-4);
        EXPECT_EQ(found.fluence({11, 4, z}), 0);
        EXPECT_NEAR(found.fluence({13, 4, z}), 1, 1e-4); // fixed point
    }
    const Energy& energy = found.stats.energy;
    EXPECT_NEAR(energy.absorbed[0], 12.25 * 8, 1e-3 * energy.entered[0]); // sums of floats
}

TEST(LightSharp, AGradedBallBendsLightWithinItsBoundary) {
    const double radius = 20;
    const dvec3 centre(24);
    for (const double rim : {1.0, 1.5})
        for (const auto integrator : {optics::Integrator::verlet, optics::Integrator::sharma,
                                      optics::Integrator::adaptive}) {
            // n² = rim² (2 − r²/a²): harmonic, ω = rim/a. The centre is reached at ωτ = π/4, where
            // x = x0 (cos ωτ − (1 − 1/rim) sin ωτ) = x0 / (√2 rim); what the rear mirrors comes
            // back as wide.
            const auto index = [=](dvec3 p) {
                const double r = std::min(glm::length(p - centre) / radius, 1.2);
                return rim * std::sqrt(2 - r * r);
            };
            Params params = paramsOf({beam({0, 0, 1})}, 1 << 17);
            params.tracing.integrator = integrator;
            const Lit found = lit(sceneVolume(ivec3(48), ball(centre, radius), index), params);
            EXPECT_TRUE(found.plan.bends);
            const double R = fresnel(rim, 1);
            // 16 voxels of 120 to 250 photons; those who pass within a voxel came within three at
            // the front, a seventh of the radius, and half of its square is aberration.
            EXPECT_NEAR(mean(found, ivec3(23, 23, 22), ivec3(25, 25, 26)),
                        (1 - R) * (1 + R) * 2 * rim * rim, 0.03 * 2 * rim * rim)
                << rim << " " << static_cast<int>(integrator);
        }
}

TEST(LightSharp, AnObjectLikeItsSurroundingsChangesNothing) {
    const Distance cube = [](dvec3 p) {
        const dvec3 off = glm::abs(p - 12.1) - 6.2;
        return std::max({off.x, off.y, off.z});
    };
    const auto lights = paramsOf({beam({1, 2, 3}), lamp({12, 11, 13})}, 1 << 14);
    const TestVolume empty = std::move(TestVolume(ivec3(24)).constant("ior", 1));
    const Lit there = lit(sceneVolume(ivec3(24), cube, 1), lights), gone = lit(empty, lights);
    EXPECT_TRUE(there.plan.scene.sharp);
    EXPECT_FALSE(gone.plan.scene.sharp);
    double off = 0;
    forEachVoxel(ivec3(24), [&](ivec3 p) {
        off += std::abs(there.fluence(p) - gone.fluence(p)) / 13824;
        // A way cut in three rounds to 1e-5 voxels, which may hand a photon's crumb to a neighbour.
        ASSERT_NEAR(there.fluence(p), gone.fluence(p), 1e-3) << p.x << " " << p.y << " " << p.z;
    });
    EXPECT_LT(off, 1e-5); // fixed point
}

TEST(LightSharp, MirrorsAreTinted) {
    TestVolume glass = sceneVolume({16, 16, 20}, slab(6.25, 13.75), 1.5);
    glass.addVector("reflectance", [](dvec3) { return dvec3(1, 0.5, 0); });
    const Lit found = lit(glass, paramsOf({beam({0, 0, 1})}, 1 << 16));
    for (int c = 0; c < 3; ++c) {
        const double tint = c == 0 ? 1 : c == 1 ? 0.5 : 0, R = 0.04, T = 1 - R;
        // Two bounces within lead out behind. 2^16 photons, of which the share reflected is off by
        // some tens.
        EXPECT_NEAR(mean(found, {0, 0, 15}, {16, 16, 20}, c), T * T / (1 - R * R * tint * tint),
                    1e-3);
        EXPECT_NEAR(mean(found, {0, 0, 0}, {16, 16, 5}, c),
                    1 + R * tint + T * T * R * tint / (1 - R * R * tint * tint), 1e-3);
    }
}

TEST(LightSharp, LightThatNeverLeavesIsLostAfterSoManyBoundaries) {
    // From a lamp at 0.9 radii in a ball of glass light at φ to the radius meets the boundary at
    // sin θ = 0.9 sin φ each time anew: past the critical angle, sin φ > 1/(0.9 n), for good.
    const double radius = 20;
    Params params = paramsOf({lamp({24, 24, 24 + 0.9 * radius})}, 1 << 14);
    params.maxDepth = 12;
    params.thinTo = 0;
    const Lit found = lit(sceneVolume(ivec3(48), ball(dvec3(24), radius), 1.5), params);
    const double sine = 1 / (0.9 * 1.5), caught = std::sqrt(1 - sine * sine);
    // Just short of the critical angle some are reflected twelve times, by chance.
    const Energy& energy = found.stats.energy;
    EXPECT_NEAR(energy.lost[0] / energy.entered[0], caught, 0.01);
    EXPECT_NEAR(found.counter("light_dropped_by_depth"), caught, 0.01);
}

TEST(LightSharp, AnObjectsOwnMeshServesAsProxy) {
    // Photons that start on the ball's own boundary are in front of it, all of them: they refract
    // and take no other share of its light than those that come from the domain's faces.
    const dvec3 centre(20.3, 19.6, 20.1);
    const double radius = 12;
    TestVolume scene = sceneVolume(ivec3(40), ball(centre, radius), 1.5);
    scene.addVector("absorption", [](dvec3) { return dvec3(0.02); });
    Params params = paramsOf({beam({0.3, -1, 0.2})}, 1 << 16);
    params.maxDepth = 64;
    const Lit open = lit(scene, params);
    // Corners on the ball, so that facets are up to 0.06 voxels within it, or 0.23; and one a
    // little larger.
    struct Proxy {
        double scale;
        int subdivisions;
    };
    for (const Proxy& proxy : {Proxy{1, 4}, Proxy{1, 3}, Proxy{1.02, 4}}) {
        SCOPED_TRACE(testing::Message() << proxy.scale << " " << proxy.subdivisions);
        params.proxy.clear();
        const mesh::TriangleMesh own =
            mesh::moved(mesh::icosphere(proxy.scale * radius, proxy.subdivisions), centre);
        for (const glm::uvec3& triangle : own.triangles)
            for (int i = 0; i < 3; ++i) params.proxy.push_back(own.points[triangle[i]]);
        const Lit found = lit(scene, params);
        EXPECT_LT(found.counter("light_dropped_by_depth"), 1e-3);
        double sum = 0, wanted = 0;
        forEachVoxel(ivec3(40), [&](ivec3 p) {
            if (glm::length(dvec3(p) + 0.5 - centre) > radius - 1) return;
            sum += found.fluence(p);
            wanted += open.fluence(p);
        });
        // The silhouette of facets is up to 1.1 % smaller than the ball's.
        EXPECT_NEAR(sum / wanted, 1, 0.015);
        EXPECT_NEAR(found.stats.energy.absorbed[0] / open.stats.energy.absorbed[0], 1, 0.015);
    }
}

TEST(LightSharp, RunsRepeatAndSeedsDifferLittle) {
    TestVolume tinted = sceneVolume(ivec3(24), ball(dvec3(12.3), 8), 1.5);
    tinted.constantVector("scattering", {0.01, 0.02, 0.03});
    Params params = paramsOf({beam({1, 2, 3}), lamp({3, 4, 5})}, 1 << 14);
    const Lit a = lit(tinted, params), b = lit(tinted, params);
    EXPECT_EQ(a.result.fluence.values, b.result.fluence.values);
    EXPECT_EQ(a.result.direction.values, b.result.direction.values);
    EXPECT_EQ(a.stats.counters, b.stats.counters);
    params.seed = 1;
    const Lit c = lit(tinted, params);
    double off = 0;
    forEachVoxel(ivec3(24), [&](ivec3 p) { off += std::abs(a.fluence(p) - c.fluence(p)) / 13824; });
    EXPECT_GT(off, 0);
    EXPECT_LT(off, 0.12 * a.total() / 13824);            // 30 pixels a voxel shifted by part of one
    EXPECT_NEAR(a.total(), c.total(), 5e-3 * a.total()); // the box's outline
}

TEST(LightSharp, NeighboursShareOutReflection) {
    // Behind a slab at normal incidence 16 photons cross every voxel, but for those reflected:
    // (1 − R)/(1 + R) = 0.923 go on. By chance that scatters by √(0.923 · 0.077/16) = 6.7 %.
    // Numbers that neighbours share out are off by six tenths of a photon of the 16 in a voxel, 3.8
    // %, and by one of the 256 in a patch of 4 × 4, 0.4 %, a quarter of the 1.7 % of chance. So
    // with every seed.
    const double wanted = 0.96 / 1.04;
    for (const int seed : {0, 1, 2, 3}) {
        Params params = paramsOf({beam({0, 0, 1})}, 16 * 64 * 64);
        params.seed = static_cast<std::uint32_t>(seed);
        const Lit found = lit(sceneVolume({64, 64, 12}, slab(3.25, 7.25), 1.5), params);
        double alone = 0, patch = 0;
        for (int y = 0; y < 64; y += 4)
            for (int x = 0; x < 64; x += 4) {
                const double off = mean(found, {x, y, 9}, {x + 4, y + 4, 10}) - wanted;
                patch += off * off / 256;
            }
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                alone += std::pow(found.fluence({x, y, 9}) - wanted, 2) / 4096;
        EXPECT_LT(std::sqrt(alone), 0.042) << seed;
        EXPECT_LT(std::sqrt(patch), 0.0045) << seed;
    }
}

TEST(LightSharp, ThePlanSaysWhatIsTracedAndWhy) {
    TestVolume glass = sceneVolume(ivec3(8), ball(dvec3(4), 2), 1.5);
    Params params = paramsOf({beam({0, 0, 1})});
    params.automaticOutputs = true;
    EXPECT_EQ(makePlan(glass.volume(), params).outputs, Output::none);
    glass.constantVector("scattering", dvec3(0.1));
    EXPECT_EQ(makePlan(glass.volume(), params).outputs, Output::fluence);
    glass.constant("anisotropy", 0.5);
    const Plan plan = makePlan(glass.volume(), params);
    EXPECT_EQ(plan.outputs, Output::both);
    EXPECT_TRUE(plan.scene.sharp && plan.attenuates && !plan.bends && !plan.colour && !plan.dense);
    EXPECT_EQ(plan.effects.front().name, "sharp_boundaries");
    EXPECT_TRUE(plan.effects.front().on);
    params.tracing.boundary = optics::Boundary::blurred;
    EXPECT_FALSE(makePlan(glass.volume(), params).scene.sharp);
}

TEST(LightSharp, WhatCannotBeTracedIsADataError) {
    Params params = paramsOf({beam({0, 0, 1})});
    params.tracing.boundary = optics::Boundary::sharp;
    const TestVolume bare = std::move(TestVolume(ivec3(8)).constant("ior", 1.5));
    EXPECT_THROW(makePlan(bare.volume(), params), DataError);
    TestVolume uneven = sceneVolume(ivec3(8), ball(dvec3(4), 2), 1.5);
    uneven.addVector("reflectance", [](dvec3 p) { return dvec3(p.x / 8); });
    EXPECT_THROW(makePlan(uneven.volume(), params), DataError);
    params.maxDepth = -1;
    EXPECT_THROW(params.check(), UsageError);
}
