// Opaque bodies, lit from one side: the others are black.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"
#include "support/look.h"
#include "support/opaque_volume.h"

using namespace eikonal;
using glm::dvec3;
using glm::ivec3;

namespace {

/// A box of a white, opaque material in empty space.
TestVolume boxOf(const dvec3& low, const dvec3& high) {
    const auto distance = [=](dvec3 p) {
        const dvec3 q = glm::max(low - p, p - high);
        return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
    };
    return opaqueVolume(ivec3(40), distance, dvec3(0.8));
}

/// What the middle of the face that looks along `outward` shows, brightest pixel.
double brightest(volume::Volume scene, optics::Boundary boundary, const dvec3& outward,
                 double height) {
    const dvec3 middle(20), up = std::abs(outward.y) > 0.5 ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
    view::Params params = view::parallel(middle + 80.0 * outward, middle, height, {24, 24}, up);
    params.boundary = boundary;
    const view::Look look(std::move(scene), params);
    double most = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) most = std::max(most, look.at("R", x, y));
    return most;
}

volume::Volume litScene(TestVolume scene, optics::Boundary boundary, const dvec3& sun) {
    lightsim::Params params = lightsim::paramsOf({lightsim::beam(sun)}, 1 << 16);
    params.outputs = lightsim::Output::irradiance;
    params.surfaceDetail = 2;
    params.tracing.boundary = boundary;
    const lightsim::Lit found(scene.volume(), params);
    volume::Volume lit = scene.take();
    lit.putFine("irradiance", lit.domain(), found.result.irradiance);
    return lit;
}

} // namespace

TEST(Unlit, SidesOfOpaqueBoxesAreBlack) {
    // A sun aslant: three faces of the box are lit, three are not. The views stay four voxels off
    // the edges, which are round by a voxel. Even light of 1 W/m² would show as 0.8/π.
    const dvec3 sun = glm::normalize(dvec3(0.3, -1, -0.2));
    for (const auto boundary : {optics::Boundary::sharp, optics::Boundary::blurred}) {
        SCOPED_TRACE(boundary == optics::Boundary::sharp ? "sharp" : "blurred");
        const auto scene = [&] { return litScene(boxOf(dvec3(8.3), dvec3(31.6)), boundary, sun); };
        for (const dvec3& outward : {dvec3(0, -1, 0), dvec3(1, 0, 0), dvec3(0, 0, -1)})
            EXPECT_LT(brightest(scene(), boundary, outward, 21), 1e-3 * 0.8 / M_PI);
        EXPECT_GT(brightest(scene(), boundary, {0, 1, 0}, 15), 0.7 * 0.8 / M_PI);
        // A plate of three voxels, seen from below.
        const auto plate = [&] {
            return litScene(boxOf({8.3, 18.4, 8.3}, {31.6, 21.4, 31.6}), boundary, sun);
        };
        EXPECT_LT(brightest(plate(), boundary, {0, -1, 0}, 21), 1e-3 * 0.8 / M_PI);
        EXPECT_GT(brightest(plate(), boundary, {0, 1, 0}, 15), 0.7 * 0.8 / M_PI);
    }
}
