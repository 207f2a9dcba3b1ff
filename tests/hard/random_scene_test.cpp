// Scenes drawn at random, of all that a valid file may hold: their light's energy closes, their
// pictures are finite, and both repeat bit by bit.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sharp.h"

#include <cstring>
#include <limits>

using namespace eikonal;
using namespace eikonal::hard;
using glm::dvec3;
using glm::ivec3;

namespace {

/// A property that holds for so many examples; each of these compiles kernels of its own.
template<typename Property> void alwaysOf(int examples, const Property& property) {
    rc::detail::TestParams params = rc::detail::configuration().testParams;
    params.maxSuccess = examples;
    const auto result = rc::detail::checkTestable(
        [&] {
            property();
            RC_ASSERT(!testing::Test::HasFailure());
        },
        rc::detail::TestMetadata(), params);
    if (!result.template is<rc::detail::SuccessResult>()) {
        std::ostringstream text;
        rc::detail::printResultMessage(result, text);
        FAIL() << text.str();
    }
}

bool oneIn(int n) {
    return *rc::gen::inRange(0, n) == 0;
}

dvec3 drawnRgb(double most) {
    return oneIn(2) ? dvec3(drawn(0, most)) : dvec3(drawn(0, most), drawn(0, most), drawn(0, most));
}

/// A smooth function of place, between 0 and 1.
std::function<double(dvec3)> drawnField(double voxelSize) {
    const dvec3 wave = drawnDirection() * (drawn(0.02, 0.4) / voxelSize);
    const double phase = drawn(0, 6);
    return [=](dvec3 p) { return 0.5 + 0.5 * std::sin(glm::dot(wave, p) + phase); };
}

/// Grids of a medium, each there or not, even or varying, grey or coloured.
void addMedia(TestVolume& scene, double voxelSize) {
    const auto vector = [&](const char* grid, double most) {
        if (oneIn(2)) return;
        const dvec3 rgb = drawnRgb(most);
        const auto field = drawnField(voxelSize);
        if (oneIn(2))
            scene.constantVector(grid, rgb);
        else
            scene.addVector(grid, [=](dvec3 p) { return rgb * field(p); });
    };
    const double perVoxel = drawnByMagnitude(1e-4, 3);
    vector("absorption", perVoxel / voxelSize);
    vector("scattering", perVoxel / voxelSize);
    vector("emission", 1 / voxelSize);
    if (oneIn(2)) scene.constantVector("reflectance", drawnRgb(1)); // sharp, one an object
    if (oneIn(2)) scene.constantVector("albedo", drawnRgb(1));
    if (oneIn(2)) scene.constant("anisotropy", drawn(-0.95, 0.95));
    if (oneIn(4)) scene.constant("dispersion", drawn(0, 0.01));
}

glm::dmat4 drawnPlace(double voxelSize) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), drawn(0, 6), drawnDirection());
    return glm::translate(glm::dmat4(1), drawn(0, 100) * voxelSize * drawnDirection()) * turned;
}

Bodies drawnBodies() {
    Bodies bodies;
    bodies.size = {*rc::gen::inRange(6, 29), *rc::gen::inRange(6, 29), *rc::gen::inRange(6, 29)};
    bodies.voxelSize = drawnByMagnitude(1e-3, 1e3);
    bodies.around = drawn(0.9, 1.6);
    bodies.placed = drawnPlace(bodies.voxelSize);
    const int count = *rc::gen::inRange(1, 5);
    const dvec3 size(bodies.size);
    for (int i = 0; i < count; ++i) {
        const dvec3 centre = size * dvec3(drawn(0, 1), drawn(0, 1), drawn(0, 1));
        const double radius = drawn(1, 10), index = drawn(0.7, 2.5);
        const int priority = *rc::gen::inRange(-1, 2);
        if (oneIn(2))
            bodies.all.push_back(ballBody(centre, radius, index, priority));
        else
            bodies.all.push_back(boxBody(centre - radius * dvec3(1, 0.7, 1.3),
                                         centre + radius * dvec3(0.8, 1.1, 1), index, priority));
    }
    return bodies;
}

/// A blurred scene: an index that varies or not, opaque matter or none.
volume::Volume drawnBlurred() {
    const ivec3 size(*rc::gen::inRange(1, 29), *rc::gen::inRange(1, 29), *rc::gen::inRange(2, 29));
    const double h = drawnByMagnitude(1e-3, 1e3);
    TestVolume scene(size, h, drawnPlace(h));
    if (!oneIn(4)) {
        const double base = drawn(0.8, 1.8), contrast = drawnByMagnitude(1e-5, 0.5);
        const auto field = drawnField(h);
        scene.index([=](dvec3 p) { return base + contrast * field(p); }, base);
    }
    if (oneIn(3)) {
        const auto field = drawnField(h);
        scene.add("opacity", [=](dvec3 p) { return field(p) > 0.8 ? 1.0 : 0.0; });
    }
    addMedia(scene, h);
    // So that there is a voxel, whatever else was left out.
    scene.constantVector("emission", drawnRgb(0.1 / h));
    return scene.take();
}

volume::Volume drawnScene() {
    if (oneIn(2)) return drawnBlurred();
    const Bodies bodies = drawnBodies();
    volume::Volume scene =
        bodies.volume([&](TestVolume& more) { addMedia(more, bodies.voxelSize); });
    if (bodies.all.size() > 1)
        for (size_t i = 0; i < bodies.all.size(); ++i) {
            const std::string name = "B" + std::to_string(i);
            const auto own = [&](const char* grid, const dvec3& value) {
                if (oneIn(2)) scene.putConstant(volume::ownGrid(grid, name), glm::vec3(value));
            };
            own("absorption", drawnRgb(1 / bodies.voxelSize));
            own("scattering", drawnRgb(1 / bodies.voxelSize));
            own("emission", drawnRgb(1 / bodies.voxelSize));
            if (oneIn(3)) own("opacity", dvec3(1));
            own("albedo", drawnRgb(1));
        }
    return scene;
}

/// A point of the world at (u, v, w) of the domain, whose faces are at 0 and 1.
dvec3 placeIn(const volume::Volume& scene, const dvec3& share) {
    const volume::IndexBox& box = scene.domain();
    const dvec3 index = dvec3(box.min) - 0.5 + share * dvec3(box.size());
    return dvec3(scene.frame().worldFromIndex * glm::dvec4(index, 1));
}

dvec3 drawnPoint(const volume::Volume& scene) {
    return placeIn(scene, {drawn(-2, 3), drawn(-2, 3), drawn(-2, 3)});
}

optics::Tracing drawnTracing() {
    optics::Tracing tracing;
    tracing.integrator = *rc::gen::element(optics::Integrator::euler, optics::Integrator::verlet,
                                           optics::Integrator::verlet, optics::Integrator::sharma,
                                           optics::Integrator::rk4, optics::Integrator::adaptive);
    if (oneIn(2))
        tracing.interpolation =
            *rc::gen::element(optics::Interpolation::linear, optics::Interpolation::cubic);
    return tracing;
}

void expectSame(const std::vector<float>& a, const std::vector<float>& b, const char* what) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0) << what;
}

/// The least that a component of light may be: pure colours of the spectrum are none of the
/// screen's, and are below 0 in one.
float leastOf(const scene::Scene& scene) {
    return scene.disperses ? -std::numeric_limits<float>::max() : 0.0f;
}

/// Lights it, twice, and puts the light in.
void light(volume::Volume& scene, const optics::Tracing& tracing) {
    std::vector<lightsim::Light> lights{lightsim::beam(drawnDirection(), drawnRgb(10))};
    if (oneIn(2)) lights.push_back(lightsim::lamp(drawnPoint(scene), drawnRgb(10)));
    lightsim::Params params = lightsim::paramsOf(lights, *rc::gen::inRange(1, 3000));
    params.tracing = tracing;
    params.smoothing = *rc::gen::inRange(0, 3);
    params.seed = *rc::gen::inRange(0u, 1000u);
    const lightsim::Lit first(scene, params), second(scene, params); // whose books are checked
    for (const float value : first.result.fluence.values)
        ASSERT_TRUE(std::isfinite(value) && value >= leastOf(first.plan.scene)) << value;
    for (const float value : first.result.direction.values) ASSERT_LE(std::abs(value), 1 + 1e-5);
    expectSame(first.result.fluence.values, second.result.fluence.values, "fluence");
    expectSame(first.result.direction.values, second.result.direction.values, "direction");
    scene.put("fluence", scene.domain(), first.result.fluence, {});
    scene.put("light_direction", scene.domain(), first.result.direction, {});
}

} // namespace

TEST(RandomScenes, AreLitAndSeenAndRepeat) {
    alwaysOf(24, [] {
        volume::Volume scene = drawnScene();
        const optics::Tracing tracing = drawnTracing();
        light(scene, tracing);
        const dvec3 target = placeIn(scene, dvec3(0.5)), eye = drawnPoint(scene);
        RC_PRE(glm::length(eye - target) > 0.1 * scene.frame().voxelSize);
        const dvec3 ahead = glm::normalize(target - eye);
        const double reach = glm::length(placeIn(scene, dvec3(1)) - target);
        view::Params params = view::parallel(eye, target, 3 * reach, {12, 9}, across(ahead));
        static_cast<optics::Tracing&>(params) = tracing;
        params.background = drawnRgb(1);
        params.samples = *rc::gen::inRange(1, 4);
        float least = 0;
        const auto look = [&] {
            Stats stats;
            std::vector<volume::Volume> volumes;
            volumes.push_back(std::move(scene));
            const scene::Files files(std::move(volumes));
            const view::Plan plan = view::makePlan(files, params, false);
            least = leastOf(plan.scene);
            return std::pair(view::render(device(), plan, params, {}, stats, {}),
                             view::render(device(), plan, params, {}, stats, {}));
        };
        const auto [first, second] = look();
        for (const float value : first.pixels) ASSERT_TRUE(std::isfinite(value));
        for (const char* channel : {"R", "G", "B"})
            for (const float value : first.plane(*first.find(channel))) ASSERT_GE(value, least);
        expectSame(first.pixels, second.pixels, "picture");
    });
}

TEST(RandomScenes, AreLitByLightsOfEveryKindAndMethod) {
    using lightsim::Light;
    alwaysOf(16, [] {
        const volume::Volume scene = drawnScene();
        Light light;
        light.kind = *rc::gen::element(Light::Kind::directional, Light::Kind::spot,
                                       Light::Kind::rect, Light::Kind::sphere);
        light.vector =
            light.kind == Light::Kind::directional ? drawnDirection() : drawnPoint(scene);
        light.rgb = drawnRgb(10);
        light.axis = drawnDirection();
        light.angle = drawn(1, 89);
        light.soft = drawn(0, light.angle);
        light.radius = scene.frame().voxelSize * drawn(0.1, 10);
        light.edges = {light.radius * light.axis, light.radius * across(light.axis)};
        lightsim::Params params = lightsim::paramsOf({light}, *rc::gen::inRange(1, 3000));
        params.outputs = lightsim::Output::both | lightsim::Output::irradiance;
        params.tracing = drawnTracing();
        params.lightSamples = *rc::gen::inRange(1, 5);
        params.bounces = *rc::gen::inRange(0, 3);
        params.surfaceDetail = *rc::gen::inRange(1, 3);
        params.maxSteps = 1 << 12;
        params.method = *rc::gen::element(lightsim::Method::automatic, lightsim::Method::photons,
                                          lightsim::Method::wavefront);
        params.check();
        const lightsim::Plan plan = lightsim::makePlan(scene, params);
        Stats stats, again;
        const lightsim::Result first = lightsim::simulate(device(), plan, params, stats, {}),
                               second = lightsim::simulate(device(), plan, params, again, {});
        const float least = leastOf(plan.scene);
        for (const float value : first.fluence.values)
            ASSERT_TRUE(std::isfinite(value) && value >= least) << value;
        for (const float value : first.direction.values) ASSERT_LE(std::abs(value), 1 + 1e-5);
        for (const glm::vec3& value : first.irradiance.values)
            for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(value[c]) && value[c] >= least);
        expectSame(first.fluence.values, second.fluence.values, "fluence");
        expectSame(first.direction.values, second.direction.values, "direction");
        ASSERT_EQ(first.irradiance.values, second.irradiance.values);
        const Energy& energy = stats.energy;
        for (size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(energy.absorbed[c] + energy.scattered[c] + energy.escaped[c] +
                            energy.lost[c],
                        energy.entered[c], 1e-4 * energy.entered[c]);
    });
}

TEST(RandomScenes, BlurredBoundariesTendToSharpOnes) {
    // Balls of any index seen from anywhere: an edge of half the width bends rays that stay off the
    // rim less than half as far from Snell's law.
    alwaysOf(6, [] {
        const int size = 80;
        const double index = drawn(1.05, 1.3), radius = drawn(25, 32);
        const dvec3 d = drawnDirection();
        const dvec3 centre = dvec3(40) + dvec3(drawn(-3, 3), drawn(-3, 3), drawn(-3, 3));
        view::Params params = alongTo(d, centre, 1.6 * radius, {9, 9});
        Bodies bodies;
        bodies.size = ivec3(size);
        bodies.all = {ballBody(centre, radius, index)};
        const view::Look sharp(bodies.volume(), params);
        params.boundary = optics::Boundary::blurred;
        params.integrator = view::Integrator::sharma; // whose own errors do not count
        params.interpolation = view::Interpolation::cubic;
        params.step = 0.5;
        const auto off = [&](double sigma) {
            TestVolume blurred{ivec3(size)};
            blurred.index(
                [&](dvec3 p) { return edge(1, index, radius - glm::length(p - centre), sigma); });
            const view::Look soft(blurred.take(), params);
            double sum = 0;
            for (int y = 0; y < 9; ++y)
                for (int x = 0; x < 9; ++x) {
                    if (std::hypot(x - 4, y - 4) > 3) continue; // 0.53 radii
                    const double angle =
                        radiansBetween(sharp.direction(x, y), soft.direction(x, y));
                    sum += angle * angle;
                }
            return std::sqrt(sum);
        };
        // Narrower still, and voxels no longer tell the edge.
        const double wide = off(6), narrow = off(3);
        EXPECT_LT(narrow, 0.5 * wide);
        EXPECT_LT(narrow, 2e-3 * std::sqrt(29)); // rays
    });
}
