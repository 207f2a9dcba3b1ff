// Lights of every kind: what they send, in closed form.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "image/lat_long.h"
#include "support/lit.h"
#include "support/opaque_volume.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kPi = std::numbers::pi;

/// A white, opaque floor up to y = 4.3 in empty space.
TestVolume floorScene(const ivec3& size) {
    return opaqueVolume(
        size, [](dvec3 p) { return p.y - 4.3; }, dvec3(1));
}

/// Irradiance of the floor's upper side within two voxels of a place over the exact one, less 1.
double errorAt(const Lit& lit, const dvec3& place,
               const std::function<double(const dvec3& x)>& exact) {
    const volume::FineGrid& grid = lit.result.irradiance;
    double sum = 0, wanted = 0;
    int count = 0;
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        const dvec3 x = (dvec3(grid.voxels[i]) + 0.5) / static_cast<double>(grid.detail);
        const dvec3 off = glm::abs(x - place);
        if (off.x > 2 || off.z > 2 || off.y > 1.5) continue;
        sum += grid.values[i].x;
        wanted += exact(dvec3(x.x, 4.3, x.z));
        ++count;
    }
    EXPECT_GE(count, 16);
    return wanted > 0 ? sum / wanted - 1 : sum;
}

std::function<double(const dvec3&)> evenly(double value) {
    return [=](const dvec3&) { return value; };
}

const auto nothing = evenly(0);

Params onFloor(const Light& light) {
    Params params = paramsOf({light}, 1 << 16);
    params.outputs = Output::irradiance;
    params.surfaceDetail = 1;
    return params;
}

/// Form factor of a rectangle [x0, x1] × [z0, z1] at that height over a level element at the
/// origin, as a sum over its corners.
double formFactor(double x0, double x1, double z0, double z1, double height) {
    const auto corner = [&](double x, double z) {
        const double a = x / height, b = z / height;
        const double p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
        return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * kPi);
    };
    return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

Light environmentOf(int width, int height,
                    const std::function<glm::vec3(const dvec3& direction)>& radiance) {
    auto map = std::make_shared<image::Image>(width, height);
    std::vector<float> samples;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double longitude = (0.5 - (x + 0.5) / width) * 2 * kPi;
            const double latitude = (0.5 - (y + 0.5) / height) * kPi;
            const glm::vec3 its =
                radiance({std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                          std::cos(longitude) * std::cos(latitude)});
            for (int c = 0; c < 3; ++c) samples.push_back(its[c]);
        }
    map->addChannels({"R", "G", "B"}, samples, 3);
    Light light;
    light.kind = Light::Kind::environment;
    light.map = map;
    return light;
}

} // namespace

TEST(Lights, AreReadFromTheirSpecs) {
    const Light sun = parseLight("directional:0,-2,0:1,2,3:0.53");
    EXPECT_EQ(sun.vector, dvec3(0, -1, 0));
    EXPECT_EQ(sun.rgb, dvec3(1, 2, 3));
    EXPECT_EQ(sun.angle, 0.53);
    EXPECT_TRUE(sun.isExtended());
    EXPECT_FALSE(parseLight("directional:0,-2,0:1:0").isExtended());
    const Light spot = parseLight("key=spot:1,2,3:0,0,-4:30");
    EXPECT_EQ(spot.name, "key");
    EXPECT_EQ(spot.vector, dvec3(1, 2, 3));
    EXPECT_EQ(spot.axis, dvec3(0, 0, -1));
    EXPECT_EQ(spot.angle, 30);
    EXPECT_EQ(spot.soft, 0);
    EXPECT_EQ(spot.rgb, dvec3(1));
    EXPECT_EQ(parseLight("spot:1,2,3:0,0,-4:30:5").soft, 5);
    const Light coloured = parseLight("spot:1,2,3:0,0,-4:30:4,5,6");
    EXPECT_EQ(coloured.soft, 0);
    EXPECT_EQ(coloured.rgb, dvec3(4, 5, 6));
    EXPECT_EQ(parseLight("spot:1,2,3:0,0,-4:30:5:6").rgb, dvec3(6));
    const Light rect = parseLight("rect:1,2,3:4,0,0:0,0,5:7");
    EXPECT_EQ(rect.vector, dvec3(1, 2, 3));
    EXPECT_EQ(rect.edges[0], dvec3(4, 0, 0));
    EXPECT_EQ(rect.edges[1], dvec3(0, 0, 5));
    EXPECT_EQ(rect.rgb, dvec3(7));
    EXPECT_EQ(parseLight("sphere:1,2,3:0.5").radius, 0.5);
    EXPECT_EQ(parseLight("sky=environment:maps/sky.exr:left").file, "maps/sky.exr:left");
    EXPECT_EQ(parseLight("sky=environment:maps/sky.exr:left").name, "sky");
    // A polariser leaves half.
    const Light polarised = parseLight("key=spot:1,2,3:0,0,-4:30:4:polarizer=3,0,0");
    EXPECT_EQ(polarised.polarizer, dvec3(1, 0, 0));
    EXPECT_EQ(polarised.soft, 4);
    EXPECT_EQ(polarised.rgb, dvec3(0.5));
    EXPECT_EQ(parseLight("directional:0,-2,0:2:polarizer=0,0,-2").rgb, dvec3(1));
    EXPECT_EQ(parseLight("directional:0,-2,0").polarizer, dvec3(0));
}

TEST(Lights, BadSpecsAreRefused) {
    for (const char* spec : {"",
                             "sun:0,-1,0",
                             "directional:0,-1,0:polarizer=0,0,0",
                             "directional:0,-1,0:polarizer=30",
                             "directional:0,-1,0:polarizer=1,0,0:1",
                             "point:polarizer=1,0,0",
                             "environment:sky.exr:polarizer=1,0,0",
                             "directional",
                             "directional:",
                             "directional:0,0,0",
                             "directional:1,2",
                             "directional:0,-1,0:1,1,1:-1",
                             "directional:0,-1,0:1,1,1:181",
                             "directional:0,-1,0:1:2:3",
                             "directional:0,-1,0:-1,0,0",
                             "point:1,2,x",
                             "point:1,2,3:1:2",
                             "spot:1,2,3:0,0,1",
                             "spot:1,2,3:0,0,0:30",
                             "spot:1,2,3:0,0,1:0",
                             "spot:1,2,3:0,0,1:200",
                             "spot:1,2,3:0,0,1:10:20",
                             "spot:1,2,3:0,0,1:170:20",
                             "spot:1,2,3:0,0,1:30:5:1,2",
                             "rect:1,2,3:1,0,0",
                             "rect:1,2,3:1,0,0:2,0,0",
                             "rect:1,2,3:0,0,0:0,0,1",
                             "sphere:1,2,3",
                             "sphere:1,2,3:0",
                             "sphere:1,2,3:-1",
                             "sphere:1,2,3:1:1,1,1:1",
                             "environment",
                             "environment:",
                             "a b=point:1,2,3",
                             "=point:1,2,3"})
        EXPECT_THROW(parseLight(spec), UsageError) << spec;
}

TEST(Lights, ASphereIsSeenUnderItsSolidAngle) {
    // Outside the domain, above its middle; the fluence of a sphere is its radiance times that.
    Light light = parseLight("sphere:8,30,8:6:3,2,1");
    const TestVolume scene = std::move(TestVolume(ivec3(16)).constant("ior", 1));
    // A block of 4³ voxels counts a fortieth of the photons at most: 0.9 % of noise of 2^18.
    Params params = paramsOf({light}, 1 << 22);
    const Lit lit(scene.volume(), params);
    params.method = Method::wavefront;
    params.lightSamples = 32;
    params.photons = 1 << 18;
    const Lit fronts(scene.volume(), params);
    for (const ivec3& low : {ivec3(6, 2, 6), ivec3(6, 11, 6), ivec3(2, 6, 10)}) {
        dvec3 found(0), carried(0), exact(0);
        forEachVoxel(ivec3(4), [&](ivec3 p) {
            const double share = 6 / glm::distance(dvec3(low + p) + 0.5, light.vector);
            exact += dvec3(3, 2, 1) * (2 * kPi * (1 - std::sqrt(1 - share * share)));
            for (int c = 0; c < 3; ++c) {
                found[c] += lit.fluence(low + p, c);
                carried[c] += fronts.fluence(low + p, c);
            }
        });
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], exact[c], 0.01 * exact[c]);
            EXPECT_NEAR(carried[c], exact[c], 0.01 * exact[c]) << "wavefront";
        }
    }
    // A sphere's mean cosine is what it has of the irradiance across, π sin².
    const double share = 6 / 21.5;
    const double mean = share * share / (2 * (1 - std::sqrt(1 - share * share)));
    EXPECT_NEAR(-lit.direction({8, 8, 8}).y, mean, 0.002);
}

TEST(Lights, ASphereLightsAFloorByItsSineSquared) {
    const Light light = parseLight("sphere:20,26,12:5:2");
    const Lit lit(floorScene(ivec3(24, 12, 24)).volume(), onFloor(light));
    const auto exact = [&](const dvec3& x) {
        const dvec3 towards = light.vector - x;
        return 2 * kPi * 25 * towards.y / std::pow(glm::length(towards), 3);
    };
    for (const dvec3& place : {dvec3(12, 4.3, 12), dvec3(6, 4.3, 16)})
        EXPECT_NEAR(errorAt(lit, place, exact), 0, 0.01);
}

TEST(Lights, ARectLightsAFloorByItsFormFactor) {
    // U × V looks down; the same with its edges swapped looks up and lights nothing.
    const Light light = parseLight("rect:10,16.3,12:8,0,0:0,0,4:2");
    const Light away = parseLight("rect:10,16.3,12:0,0,4:8,0,0:2");
    const TestVolume scene = floorScene(ivec3(24, 12, 24));
    const Lit dark(scene.volume(), onFloor(away)), lit(scene.volume(), onFloor(light));
    EXPECT_EQ(errorAt(dark, dvec3(12, 4.3, 12), nothing), 0);
    const auto exact = [](const dvec3& x) {
        return 2 * kPi * formFactor(6 - x.x, 14 - x.x, 10 - x.z, 14 - x.z, 12);
    };
    for (const dvec3& place : {dvec3(12, 4.3, 12), dvec3(18, 4.3, 8)})
        EXPECT_NEAR(errorAt(lit, place, exact), 0, 0.01);
    EXPECT_NEAR(lit.stats.energy.emitted[0], 2 * kPi * 32, 1e-9);
}

TEST(Lights, ASpotLightsACone) {
    // It stands over the floor, and all of its cone falls on it.
    const TestVolume scene = floorScene(ivec3(32, 16, 32));
    const Light hard = parseLight("spot:16,14.3,16:0,-1,0:40:5");
    const Lit lit(scene.volume(), onFloor(hard));
    // On the axis I/d², and there only within 35° all of it, beyond 45° nothing.
    const auto exact = [](const dvec3& x) {
        return 10 / std::pow(glm::distance(x, dvec3(16, 14.3, 16)), 3);
    };
    EXPECT_NEAR(errorAt(lit, dvec3(16, 4.3, 16), exact), 0, 0.01);
    EXPECT_NEAR(errorAt(lit, dvec3(20, 4.3, 16), exact), 0, 0.01);
    EXPECT_EQ(errorAt(lit, dvec3(29, 4.3, 16), nothing), 0);
    // Its power by the smooth step between 35° and 45°.
    double power = 0;
    for (int i = 0; i < 45000; ++i) {
        const double degrees = (i + 0.5) * 1e-3, t = std::min((45 - degrees) / 10, 1.0);
        power += t * t * (3 - 2 * t) * 2 * kPi * std::sin(degrees * kPi / 180) * kPi / 180 * 1e-3;
    }
    EXPECT_NEAR(lit.stats.energy.emitted[0], power, 1e-4 * power);
    EXPECT_NEAR(lit.stats.energy.absorbed[0], power, 5e-3 * power);
    // A cone without a soft edge by photons.
    Params params = onFloor(parseLight("spot:16,14.3,16:0.3,-1,0:20"));
    params.method = Method::photons;
    const Lit photons(scene.volume(), params);
    // By wavefronts its light crosses empty space.
    Params front = paramsOf(params.lights, 1 << 12);
    front.method = Method::wavefront;
    const Lit carried(TestVolume(ivec3(32)).constant("ior", 1).volume(), front);
    EXPECT_NEAR(carried.stats.energy.entered[0], 2 * kPi * (1 - std::cos(20 * kPi / 180)), 0.01);
    const double cap = 2 * kPi * (1 - std::cos(20 * kPi / 180));
    EXPECT_NEAR(photons.stats.energy.emitted[0], cap, 1e-9);
    EXPECT_NEAR(photons.stats.energy.absorbed[0], cap, 5e-3 * cap);
}

TEST(Lights, ADiscGivesItsIrradianceAcrossItsAxis) {
    const TestVolume scene = floorScene(ivec3(24, 12, 24));
    for (const char* spec : {"directional:0,-1,0:2:20", "directional:0,-1,0:2:100"}) {
        Params params = onFloor(parseLight(spec));
        params.lightSamples = 16;
        const Lit lit(scene.volume(), params);
        EXPECT_NEAR(errorAt(lit, dvec3(12, 4.3, 12), evenly(2)), 0, 0.005) << spec;
    }
    // Its fluence is that of a cap of even radiance E/(π sin²).
    const Lit lit(TestVolume(ivec3(16)).constant("ior", 1).volume(),
                  paramsOf({parseLight("directional:0,-1,0:1:100")}, 1 << 18));
    const double half = 50 * kPi / 180, sine = std::sin(half);
    const double exact = 2 * (1 - std::cos(half)) / (sine * sine);
    EXPECT_NEAR(lit.fluence({8, 8, 8}), exact, 0.01 * exact);
}

TEST(Lights, AnEvenEnvironmentGivesFourPiAndPi) {
    const glm::vec3 radiance(0.5, 0.25, 0.125);
    const Light sky = environmentOf(8, 4, [&](const dvec3&) { return radiance; });
    const Lit inside(TestVolume(ivec3(12)).constant("ior", 1).volume(), paramsOf({sky}, 1 << 18));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(inside.total(c) / (12 * 12 * 12), 4 * kPi * radiance[c],
                    0.01 * 4 * kPi * radiance[c]);
    EXPECT_LT(glm::length(inside.direction({6, 6, 6})), 0.01);
    const Lit lit(floorScene(ivec3(16, 8, 16)).volume(), onFloor(sky));
    EXPECT_NEAR(errorAt(lit, dvec3(8, 4.3, 8), evenly(kPi * 0.5)), 0, 0.01);
}

TEST(Lights, AnEnvironmentsSunIsFoundWhereItIs) {
    // A small, bright sun at 30° above +X in a faint sky, and the map turned so that it stands at
    // +Z.
    const dvec3 towards = glm::normalize(dvec3(std::sqrt(3.0), 1, 0));
    const auto radiance = [&](const dvec3& d) {
        return glm::dot(d, towards) > std::cos(0.03) ? glm::vec3(1000, 500, 0) : glm::vec3(0);
    };
    Light sky = environmentOf(1024, 512, radiance);
    const TestVolume scene = std::move(TestVolume(ivec3(12)).constant("ior", 1));
    const double cap = 2 * kPi * (1 - std::cos(0.03));
    Params params = paramsOf({sky}, 1 << 16);
    const Lit lit(scene.volume(), params);
    EXPECT_NEAR(lit.fluence({6, 6, 6}, 0), 1000 * cap, 0.05 * 1000 * cap); // by pixels
    EXPECT_NEAR(lit.fluence({6, 6, 6}, 1), 500 * cap, 0.05 * 500 * cap);
    EXPECT_EQ(lit.fluence({6, 6, 6}, 2), 0);
    EXPECT_LT(glm::length(lit.direction({6, 6, 6}) + towards), 0.01);
    params.lights[0].mapFromWorld = image::mapFromWorld(90, false);
    const Lit turned(scene.volume(), params);
    EXPECT_LT(glm::length(turned.direction({6, 6, 6}) + dvec3(0, towards.y, towards.x)), 0.01);
    params.lights[0].mapFromWorld = image::mapFromWorld(0, true);
    const Lit standing(scene.volume(), params);
    EXPECT_LT(glm::length(standing.direction({6, 6, 6}) + dvec3(towards.x, 0, towards.y)), 0.01);
}

TEST(Lights, ABlackEnvironmentGivesNothing) {
    const Light night = environmentOf(8, 4, [](const dvec3&) { return glm::vec3(0); });
    TestVolume scene = floorScene(ivec3(12));
    Params params = onFloor(night);
    params.outputs = Output::both | Output::irradiance;
    params.bounces = 1;
    for (const Method method : {Method::automatic, Method::photons, Method::wavefront}) {
        params.method = method;
        const Lit lit(scene.volume(), params);
        EXPECT_EQ(lit.total(), 0);
        EXPECT_EQ(errorAt(lit, dvec3(6, 4.3, 6), nothing), 0);
    }
}

TEST(Lights, OneBesideAnExtendedOneIsWhatItIsAlone) {
    // Photons of a point start in the middles of its pixels, whatever lights there are beside it.
    const TestVolume scene = std::move(TestVolume(ivec3(12)).constant("ior", 1));
    const Light lamp = parseLight("point:6,20,6:100");
    const Lit alone(scene.volume(), paramsOf({lamp}, 1 << 14));
    const Light dark = parseLight("sphere:6,6,6:1:0");
    const Lit beside(scene.volume(), paramsOf({lamp, dark}, 1 << 14));
    forEachVoxel(ivec3(12), [&](ivec3 p) {
        ASSERT_NEAR(beside.fluence(p), alone.fluence(p), 1e-3 * alone.fluence(p));
    });
}

TEST(Lights, TheSameRunGivesTheSameBytes) {
    const Params params = onFloor(parseLight("rect:10,16.3,12:0,0,4:8,0,0:2"));
    const TestVolume scene = floorScene(ivec3(16, 8, 16));
    const Lit first(scene.volume(), params), second(scene.volume(), params);
    EXPECT_EQ(first.result.irradiance.values, second.result.irradiance.values);
}

TEST(Lights, ApartTheyAddUpToAllOfThem) {
    TestVolume scene = floorScene(ivec3(16, 10, 16));
    scene.constantVector("scattering", dvec3(0.01));
    Params params = paramsOf(
        {parseLight("sphere:8,20,8:2:3,2,1"), parseLight("directional:0.3,-1,0.2:1,0,2")}, 1 << 14);
    params.outputs = Output::both | Output::irradiance;
    params.lightSamples = 8;
    const Lit all(scene.volume(), params);
    params.lightsApart = true;
    std::vector<Result> apart;
    Stats stats;
    const Result sum = simulate(device(), makePlan(scene.volume(), params), params, stats, {},
                                [&](size_t k, const Result& light) {
                                    EXPECT_EQ(k, apart.size());
                                    apart.push_back(light);
                                });
    ASSERT_EQ(apart.size(), 2u);
    const auto near = [](const std::vector<float>& a, const std::vector<float>& b, float most) {
        ASSERT_EQ(a.size(), b.size());
        for (size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], most) << i;
    };
    near(sum.fluence.values, all.result.fluence.values, 1e-4F);
    near(sum.direction.values, all.result.direction.values, 1e-3F);
    ASSERT_EQ(sum.irradiance.values.size(), all.result.irradiance.values.size());
    double red = 0;
    for (size_t i = 0; i < sum.irradiance.values.size(); ++i) {
        const glm::vec3 each = apart[0].irradiance.values[i] + apart[1].irradiance.values[i];
        ASSERT_LT(glm::distance(sum.irradiance.values[i], each), 1e-6F);
        ASSERT_LT(glm::distance(sum.irradiance.values[i], all.result.irradiance.values[i]), 1e-4F);
        red += apart[1].irradiance.values[i].x;
    }
    EXPECT_GT(red, 0);
}
