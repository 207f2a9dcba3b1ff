// The ground beyond the domain: what of it is seen directly, through a ball of glass and in it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "image/lat_long.h"
#include "judge/glass.h"
#include "lightsim/environment.h"
#include "scene/ground.h"
#include "support/ground_stage.h"
#include "support/lit.h"
#include "support/look.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::dvec4;

namespace {

constexpr double kPi = std::numbers::pi;

/// Sixteen voxels of half a unit, whose low corner is at (3, -1.1, 2) and which are turned about
/// all axes, round a plane at y = 1.3.
GroundStage turnedStage() {
    GroundStage stage;
    stage.voxelSize = 0.5;
    stage.ground = {1.3, {0.8, 0.4, 0.2}, 0};
    stage.placed = glm::rotate(glm::translate(glm::dmat4(1), dvec3(3, -1.1, 2)), 0.3,
                               glm::normalize(dvec3(1, 2, 3)));
    return stage;
}

/// One ray straight down on the plane at (x, z).
Params downOn(double x, double z) {
    return parallel({x, 50, z}, {x, 0, z}, 1e-3, {1, 1}, {0, 0, 1});
}

/// Irradiance of the plane there by these lights, as a picture shows it.
dvec3 irradianceAt(const GroundStage& stage, const std::string& lights, double x, double z) {
    const Look look(stage.make(lights), downOn(x, z));
    return look.colour() * kPi / albedoAt(stage.ground, {x, 0, z});
}

/// The sum of `f` over n × n midpoints of the unit square, times 1/n².
double meanOver(int n, const std::function<double(double, double)>& f) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) sum += f((i + 0.5) / n, (k + 0.5) / n);
    return sum / n / n;
}

/// What a part of a surface of radiance 1 sends on a level plane at p, per area of both.
double fromPart(const dvec3& p, const dvec3& x, const dvec3& out) {
    const dvec3 way = x - p;
    const double square = glm::dot(way, way);
    return std::max(way.y, 0.0) * std::max(-glm::dot(out, way), 0.0) / (square * square);
}

} // namespace

TEST(ViewGround, HasWhatEachLightSends) {
    const GroundStage stage = turnedStage();
    const dvec3 p(-6, 1.3, 4), far(200, 1.3, -300);
    const auto at = [&](const std::string& light, const dvec3& place) {
        return irradianceAt(stage, light, place.x, place.z);
    };
    // Floats of numbers of hundreds of voxels: 1e-5; a thousandth where a rectangle is a point.
    const auto near = [](const dvec3& found, const dvec3& wanted, double share) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], wanted[c], share * wanted[c] + 1e-12) << "component " << c;
    };
    near(at("directional:0,-3,4:1,2,3", p), 0.6 * dvec3(1, 2, 3), 1e-5);
    near(at("directional:0,-3,4:1,2,3:20", far), 0.6 * dvec3(1, 2, 3), 1e-5);
    EXPECT_EQ(at("directional:0,3,4", p), dvec3(0));
    near(at("point:-3,5.3,4:1,2,3", p), 4.0 / 125 * dvec3(1, 2, 3), 1e-5);
    EXPECT_EQ(at("point:-3,1,4", p), dvec3(0)); // below
    near(at("sky=upward:1,2,3", p), {1, 2, 3}, 1e-5);
    near(at("point:-3,5.3,4:1,2,3\npoint:-6,3.3,4:8\n1=upward:1,0,0", p),
         4.0 / 125 * dvec3(1, 2, 3) + dvec3(2) + dvec3(1, 0, 0), 1e-5);
    // A spot on p, then aimed past it by 30°, where it is half as bright.
    near(at("spot:-6,5.3,4:0,-1,0:10:5:3", p), dvec3(3.0 / 16), 1e-5);
    near(at("spot:-6,5.3,4:0.5,-0.8660254,0:30:10:3", p), dvec3(1.5 / 16), 1e-4);
    EXPECT_EQ(at("spot:-6,5.3,4:0.5,-0.8660254,0:20:5:3", p), dvec3(0));
    near(at("sphere:-3,5.3,4:2:1,2,3", p), kPi * 4 / 25 * 0.8 * dvec3(1, 2, 3), 1e-5);
    const dvec3 centre(-4, 4, 5), u(0, 1, -2), v(2, 0, 0.5); // u × v is down
    for (const dvec3& place : {p, far}) {
        const double area = glm::length(glm::cross(u, v));
        const double wanted = area * meanOver(200, [&](double s, double t) {
                                  return fromPart(place, centre + (s - 0.5) * u + (t - 0.5) * v,
                                                  glm::cross(u, v) / area);
                              });
        near(at("rect:-4,4,5:0,1,-2:2,0,0.5:1,2,3", place), wanted * dvec3(1, 2, 3), 1e-3);
        EXPECT_EQ(at("rect:-4,4,5:2,0,0.5:0,1,-2:1,2,3", place), dvec3(0)); // the other side
    }
}

TEST(ViewGround, CutsLightsThatGoDownThroughIt) {
    const GroundStage stage = turnedStage();
    const dvec3 p(-6, 1.3, 4);
    // An upright rectangle of which a third is below, seen from 3 units before its middle.
    const double wanted =
        6 * meanOver(300, [&](double s, double t) {
            return fromPart(p, dvec3(-3, 1.8 + 3 * (s - 0.5), 4 + 2 * (t - 0.5)), {-1, 0, 0});
        });
    // The sum's cells are half above, half below at the plane, where they count for nothing.
    EXPECT_NEAR(irradianceAt(stage, "rect:-3,1.8,4:0,0,2:0,3,0", p.x, p.z).x, wanted, 1e-3);
    // A disc of 60° whose middle is on the horizon: of radiance L within 30°, half of it, whose
    // mean height is a sum over its rings.
    const double height = meanOver(400, [](double s, double t) {
        const double off = s * kPi / 6, turn = kPi * t; // the upper half of a ring
        return std::sin(off) * std::sin(off) * std::sin(turn);
    });
    const double radiance = 1 / (kPi * 0.25); // of an irradiance of 1 across it
    EXPECT_NEAR(irradianceAt(stage, "directional:1,0,0:1:60", p.x, p.z).x,
                radiance * height * kPi * kPi / 6, 1e-4);
}

TEST(ViewGround, HasNoMoreLightsThanItsKernelTakes) {
    std::string lights;
    for (int i = 0; i < 64; ++i) lights += "point:-6,2.3,4:0.5\nupward:0.5,0,0\n";
    lights.pop_back();
    const GroundStage stage = turnedStage();
    EXPECT_NEAR(irradianceAt(stage, lights, -6, 4).y, 32, 1e-3);
    EXPECT_NEAR(irradianceAt(stage, lights, -6, 4).x, 64, 1e-3);
    EXPECT_THROW(irradianceAt(stage, lights + "\npoint:0,0,0", -6, 4), DataError);
}

TEST(ViewGround, IsASurfaceInEveryAov) {
    GroundStage stage;
    stage.placed = glm::translate(glm::dmat4(1), dvec3(0, -4, 0));
    stage.ground.albedo = {0.5, 0.5, 0.5};
    // Over the domain, which ends at y = 12, through its far side at x = 16 and 2 units down on the
    // ground: in it for 14 units along x, beside it for 4.
    const dvec3 direction = glm::normalize(dvec3(2, -1, 0));
    const auto ray = [&](const dvec3& from, const dvec3& way, double outside) {
        stage.around = outside;
        return Look(stage.make("upward:2,2,2"), parallel(from, from + way, 1e-3));
    };
    for (const double outside : {1.0, 1.33}) {
        const Look look = ray({-18, 19, 8}, direction, outside);
        expectNear(look.position(0, 0), {20, 0, 8}, 1e-4);
        expectNear(look.place(), {20, 0, 8}, 1e-4);
        expectNear(look.normal(0, 0), {0, 1, 0}, 1e-6);
        expectNear(look.direction(), direction, 1e-6);
        EXPECT_NEAR(look.at("Z"), 19 * std::sqrt(5), 1e-4);
        EXPECT_NEAR(look.at("path_length.V"), 8 * std::sqrt(5), 1e-4); // from y = 10 to 2
        EXPECT_EQ(look.at("transmittance.R"), 0);
        EXPECT_NEAR(look.at("error.V"), 0, 1e-6);
        EXPECT_EQ(look.at("A"), 1);
        expectNear(look.colour(), dvec3(1 / kPi), 1e-6); // whatever it is seen through
    }
    // One that never comes to the domain, one that meets the ground before it.
    expectNear(ray({-9, 3, 30}, direction, 1).position(0, 0), {-3, 0, 30}, 1e-4);
    const Look before = ray({-9, 3, 8}, direction, 1);
    expectNear(before.position(0, 0), {-3, 0, 8}, 1e-4);
    EXPECT_EQ(before.at("path_length.V"), 0);
    expectNear(before.colour(), dvec3(1 / kPi), 1e-6);
    // From below it is dark, and faces down; up and past it there is nothing.
    const Look below = ray({30, -3, 8}, {2, 1, 0}, 1);
    expectNear(below.position(0, 0), {36, 0, 8}, 1e-4);
    expectNear(below.normal(0, 0), {0, -1, 0}, 1e-6);
    EXPECT_EQ(below.colour(), dvec3(0));
    EXPECT_EQ(below.at("A"), 1);
    EXPECT_EQ(ray({30, 3, 8}, {2, 1, 0}, 1).at("A"), 0);
}

TEST(ViewGround, IsOnlyWhereMetadataTellOfIt) {
    const GroundStage stage;
    volume::Volume volume = stage.make("upward:2,2,2");
    volume.setMetadata(volume::kGroundKey, "");
    EXPECT_EQ(Look(std::move(volume), downOn(-6, 4)).at("A"), 0);
    Params blurred = downOn(-6, 4);
    blurred.boundary = optics::Boundary::blurred;
    const Look look(stage.make("upward:2,2,2"), blurred);
    EXPECT_EQ(look.at("A"), 0);
    EXPECT_FALSE(look.plan.warnings.empty());
}

TEST(ViewGround, SquaresGoOnFromTheDomain) {
    GroundStage stage;
    stage.placed = glm::translate(glm::dmat4(1), dvec3(-5, -4, -7));
    stage.ground = {0, {0.9, 0.6, 0.3}, 3};
    volume::Volume volume = stage.make("upward:1,1,1");
    volume::FineGrid light; // the same within
    light.detail = 1;
    for (int z = 0; z < 16; ++z)
        for (int y = 2; y < 6; ++y)
            for (int x = 0; x < 16; ++x) {
                light.voxels.emplace_back(x, y, z);
                light.values.emplace_back(1);
            }
    volume.putFine("irradiance", volume.domain(), light);
    Params params = parallel({0, 20, 0}, {0, 0, 0}, 32, {40, 40}, {0, 0, -1});
    const Look look(std::move(volume), params);
    const double pixel = 32.0 / 40;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) {
            const dvec3 p((x + 0.5 - 20) * pixel, 0, (y + 0.5 - 20) * pixel);
            expectNear(look.colour(x, y), albedoAt(stage.ground, p) / kPi, 1e-5);
        }
}

TEST(ViewGround, HasLightThatIsGivenForPointsWithinTheDomainAlone) {
    GroundStage stage;
    stage.placed = glm::translate(glm::dmat4(1), dvec3(-5, -4, -7));
    stage.ground = {0, dvec3(0.5), 0};
    Params params = parallel({0, 20, 0}, {0, 0, 0}, 32, {32, 32}, {0, 0, -1});
    const Look bare(stage.make("upward:1,1,1"), params);
    params.points = {32, 32, {}, std::vector<bool>(32 * 32, true), {}};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) params.points.places.push_back(bare.position(x, y));
    params.points.lights.assign(32 * 32, glm::vec3(2));
    const Look look(stage.make("upward:1,1,1"), params);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            // From a voxel within the sides on, which are at -5 and 11 and at -7 and 9.
            const double off = std::max(std::abs(x - 15.5 - 3), std::abs(y - 15.5 - 1));
            expectNear(look.colour(x, y), dvec3((off < 7 ? 2 : 1) * 0.5 / kPi), 1e-5);
        }
}

// A ball of glass over a checker, lit evenly, under an even sky. The judge knows the ball alone:
// its rays go on to the plane or the sky. Where the plane is within the domain no light is stored,
// and it is black.
TEST(ViewGround, IsSeenBesideThroughAndInABall) {
    GroundStage stage;
    stage.size = {40, 44, 40};
    stage.placed = glm::translate(glm::dmat4(1), dvec3(-20, -4, -20));
    stage.ground = {0, {0.9, 0.6, 0.3}, 25};
    stage.centre = {0, 20, 0};
    stage.radius = 16;
    const judge::Glass glass{{judge::glassBall(stage.centre, stage.radius, 1.5)}};
    Params params = perspective({10, 44, 90}, {0, 16, 0}, 40, {48, 48});
    params.background = dvec3(0.2, 0.3, 0.5);
    params.boundary = optics::Boundary::sharp;
    params.cutoff = 1e-6;
    params.maxDepth = 8;
    const Look look(stage.make("upward:1,1,1"), params);
    int beside = 0, through = 0, mirrored = 0, off = 0;
    // Where a ray comes to the plane; what it shows there, or of the sky.
    const auto placeOf = [](const judge::Ray& ray) {
        return ray.x - ray.x.y / ray.direction.y * ray.direction;
    };
    const auto seenBy = [&](const judge::Ray& ray) {
        if (ray.direction.y >= 0) return dvec3(0.2, 0.3, 0.5);
        const dvec3 p = placeOf(ray);
        const bool within = std::max(std::abs(p.x), std::abs(p.z)) < 20;
        return within ? dvec3(0) : albedoAt(stage.ground, p) / kPi;
    };
    const camera::CameraAxes axes = axesOf(params.camera);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            const double half = std::tan(kPi / 9);
            const dvec3 direction =
                glm::normalize(axes.forward + half * ((2 * x + 1) / 48.0 - 1) * axes.right +
                               half * (1 - (2 * y + 1) / 48.0) * axes.up);
            const judge::Ray ray{params.camera.eye, direction};
            judge::Limits limits;
            limits.minThroughput = 1e-6;
            const judge::Tree tree = judge::followAll(glass, ray, limits);
            dvec3 wanted(0);
            for (const judge::Branch& branch : tree.left)
                wanted += branch.weight * seenBy(branch.ray);
            const judge::Branch& first = tree.left.front();
            const bool met = !tree.met.empty();
            const double error = glm::length(look.colour(x, y) - wanted);
            // A branch of a thousandth may fall on another square; strong ones do in few pixels.
            off += error > 2e-3;
            if (error > 2e-3) continue;
            beside += !met && first.ray.direction.y < 0;
            if (!met) continue;
            for (const judge::Branch& branch : tree.left) {
                if (branch.ray.direction.y >= 0) continue;
                const dvec3 p = placeOf(branch.ray);
                if (std::max(std::abs(p.x), std::abs(p.z)) < 20.5) continue;
                through += branch.course == "TT";
                mirrored += branch.course == "R";
                if (branch.course == "TT" && glm::length(p) < 500)
                    expectNear(look.position(x, y), p, 2e-3 * glm::length(p));
            }
        }
    EXPECT_GT(beside, 300);
    EXPECT_GT(through, 100);
    EXPECT_GT(mirrored, 40);
    EXPECT_LT(off, 20);
}

namespace {

/// Irradiance along a line across the domain's side on an empty stage lit by lightsim, within and
/// beyond, over that of the lights' records. Returns the farthest from 1 on either side.
double stepAtSide(const std::vector<scene::Light>& lights, const std::string& records) {
    GroundStage stage;
    stage.size = {24, 12, 24};
    stage.voxelSize = 0.25;
    stage.placed = glm::translate(glm::dmat4(1), dvec3(-3, -1.1, -3));
    volume::Volume volume = stage.make(records);
    lightsim::Params params;
    params.lights = lights;
    params.photons = 1 << 14;
    params.lightSamples = 64;
    params.surfaceDetail = 4;
    params.automaticOutputs = false;
    params.outputs = lightsim::Output::irradiance;
    const lightsim::Lit lit(volume, params);
    volume.putFine("irradiance", volume.domain(), lit.result.irradiance);
    // 32 pixels over two voxels either side, 1.7 along it.
    Params look = parallel({3, 9, 1.7}, {3, 0, 1.7}, 1.0 / 32, {32, 1}, {0, 0, -1});
    const Look within(std::move(volume), look);
    const Look beyond(
        GroundStage{
            {4, 12, 4}, 0.25, glm::translate(glm::dmat4(1), dvec3(90, -1.1, 90)), stage.ground}
            .make(records),
        look);
    double worst = 0;
    for (int x = 0; x < 32; ++x)
        worst = std::max(worst, std::abs(within.colour(x, 0).x / beyond.colour(x, 0).x - 1));
    return worst;
}

double stepOf(const std::string& spec) {
    return stepAtSide({scene::parseLight(spec)}, spec);
}

} // namespace

// Within a hundredth no step is seen.
TEST(ViewGround, MeetsTheDomainsSideWithoutAStep) {
    EXPECT_LT(stepOf("directional:0.3,-1,0.2:3"), 0.01);
    EXPECT_LT(stepOf("directional:0.3,-1,0.2:3,2.5,2"), 0.01);
    EXPECT_LT(stepOf("point:1,4,1:3"), 0.01);
}

TEST(ViewGround, MeetsItUnderEveryLight) {
    EXPECT_LT(stepOf("directional:0.3,-1,0.2:3:5"), 0.01);
    EXPECT_LT(stepOf("spot:2,3,1:0.3,-1,0.2:40:20:3"), 0.01);
    EXPECT_LT(stepOf("sphere:4,3,1:0.5"), 0.01);
    EXPECT_LT(stepOf("rect:2,3,1:0,0.2,-1:2,0,0.3"), 0.01);
}

TEST(ViewGround, MeetsItUnderASky) {
    scene::Light sky = scene::parseLight("environment:none");
    image::Image map(128, 64);
    std::vector<float> samples;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            for (int c = 0; c < 3; ++c) {
                const dvec3 d = image::directionOf({(x + 0.5) / 128, (y + 0.5) / 64});
                samples.push_back(static_cast<float>(1 + 0.9 * d.y + (c == 0 ? 0.5 * d.x : 0)));
            }
    map.addChannels({"R", "G", "B"}, samples, 3);
    sky.map = std::make_shared<image::Image>(std::move(map));
    // ∫ (1 + 0.9 y) y dω over the upper half; pixels' middles stand for them.
    const dvec3 upward = lightsim::upwardIrradiance(sky);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(upward[c], kPi + 0.6 * kPi, 1e-3);
    EXPECT_LT(stepAtSide({sky}, scene::recordOf(sky, upward)), 0.01);
}
