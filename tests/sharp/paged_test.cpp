// Textures of voxels that are cut into blocks give what those in one box give.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"
#include "support/look.h"

using namespace eikonal;
using glm::dvec3;
using glm::ivec3;

namespace {

const ivec3 kSize(88, 64, 56); // most of it empty

/// 1 within a ball, 0 out of it, blurred over four voxels; near a face of the domain.
double ball(const dvec3& p) {
    return std::clamp(0.5 + 0.25 * (7 - glm::length(p - dvec3(40, 30, 4))), 0.0, 1.0);
}

double distance(const dvec3& p) {
    return glm::length(p - dvec3(40, 30, 4)) - 7;
}

/// A coloured, glowing medium that scatters forward about an opaque post, all blurred.
volume::Volume blurredScene() {
    TestVolume scene(kSize);
    scene.index([](dvec3 p) { return 1 + 0.3 * ball(p); });
    scene.addVector("absorption", [](dvec3 p) { return ball(p) * dvec3(0.02, 0.05, 0.01); });
    scene.addVector("scattering", [](dvec3 p) { return ball(p) * dvec3(0.08, 0.05, 0.02); });
    scene.add("anisotropy", [](dvec3 p) { return 0.4 * ball(p); });
    scene.addVector("emission", [](dvec3 p) { return ball(p) * dvec3(0.001, 0, 0.002); });
    scene.add("opacity",
              [](dvec3 p) { return p.x > 18 && p.x < 24 && p.y < 30 && p.z < 12 ? 1.0 : 0.0; });
    scene.addVector("albedo", [](dvec3) { return dvec3(0.8, 0.7, 0.6); });
    return scene.take();
}

/// A ball whose coefficients vary within its sharp boundary, as its index does.
volume::Volume sharpScene() {
    TestVolume scene(kSize);
    scene.add("sdf", distance, 1e3);
    scene.index([](dvec3 p) { return distance(p) < 4 ? 1.5 - 0.01 * (p.x - 40) : 1.5; });
    scene.constant("ior.medium", 1);
    scene.addVector("absorption", [](dvec3 p) {
        return distance(p) < 6 ? dvec3(0.01, 0.02, 0.0) * (1 + 0.05 * p.y) : dvec3(0);
    });
    scene.addVector("scattering",
                    [](dvec3 p) { return distance(p) < 6 ? dvec3(0.05 + 0.002 * p.x) : dvec3(0); });
    scene.add("anisotropy", [](dvec3) { return 0.3; });
    return scene.take();
}

lightsim::Result lightOf(const volume::Volume& scene, bool paged) {
    lightsim::Params params =
        lightsim::paramsOf({lightsim::beam({-0.3, -1, 0.4}, {3, 2, 1})}, 1 << 14);
    params.automaticOutputs = true; // dark where nothing is
    lightsim::Plan plan = lightsim::makePlan(scene, params);
    plan.scene.layout = scene::layoutOf(plan.scene, paged ? 0 : 1 << 24);
    EXPECT_EQ(plan.scene.layout.paged, paged);
    Stats stats;
    return lightsim::simulate(device(), plan, params, stats, {});
}

image::Image pictureOf(volume::Volume scene, bool paged) {
    view::Params params = view::perspective({30, 60, 90}, {36, 26, 8}, 30, {48, 40});
    params.aovs.clear();
    params.background = dvec3(0.3, 0.4, 0.5);
    const scene::Files files(scene);
    view::Plan plan = view::makePlan(files, params, false);
    plan.scene.layout = scene::layoutOf(plan.scene, paged ? 0 : 1 << 24);
    EXPECT_EQ(plan.scene.layout.paged, paged);
    EXPECT_TRUE(plan.anisotropic && plan.colour && plan.lit());
    Stats stats;
    return view::render(device(), plan, params, {}, stats, {});
}

/// Root of the mean square of differences, by that of the values.
double apart(const std::vector<float>& a, const std::vector<float>& b) {
    double difference = 0, all = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        difference += std::pow(static_cast<double>(a[i]) - b[i], 2);
        all += std::pow(static_cast<double>(a[i]), 2);
    }
    return std::sqrt(difference / all);
}

void expectSame(volume::Volume (*sceneOf)()) {
    const volume::Volume scene = sceneOf();
    const lightsim::Result box = lightOf(scene, false), blocks = lightOf(scene, true);
    // Roundings of where a sample lies let photons land elsewhere by chance.
    EXPECT_LT(apart(box.fluence.values, blocks.fluence.values), 2e-3);
    const auto lit = [&] {
        volume::Volume found = sceneOf();
        found.put("fluence", found.domain(), box.fluence, {});
        found.put("light_direction", found.domain(), box.direction, {});
        return found;
    };
    const image::Image one = pictureOf(lit(), false), other = pictureOf(lit(), true);
    EXPECT_LT(apart(one.pixels, other.pixels), 1e-5);
}

} // namespace

TEST(Paged, BlurredMediaLookTheSame) {
    expectSame(blurredScene);
}

TEST(Paged, SharpMediaLookTheSame) {
    expectSame(sharpScene);
}
