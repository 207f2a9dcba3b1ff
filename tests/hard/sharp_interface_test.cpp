// Hard cases of a flat sharp boundary: at grazing incidence, at the critical angle, hardly there.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sharp.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

/// Index n0 below a plane that the domain cuts on four sides, n1 above it.
struct Plane {
    double n0, n1;
    dvec3 up{0, 1, 0};
    ivec3 size{32, 32, 32};

    dvec3 point() const { return 0.5 * dvec3(size) + 0.113 * up; }
    volume::Volume volume() const {
        return Bodies{.all = {halfSpace(point(), up, n0)}, .around = n1, .size = size}.volume();
    }
    /// Of a ray from below whose angle to the plane has that sine.
    double through(double sine) const { return fresnelThrough(n0, n1, sine); }
};

/// A ray from below that meets the plane in its middle, at `elevation` above the plane [rad].
Params risingRay(const Plane& plane, double elevation, double back) {
    const dvec3 u = glm::normalize(plane.up), along = across(u);
    const dvec3 d = std::cos(elevation) * along + std::sin(elevation) * u;
    return rayFrom(plane.point() - back * d, d);
}

/// What becomes of one such ray: its direction, and its share that goes through, as of one whose
/// elevation is within `off` of it [rad].
void expectSnell(const Plane& plane, double elevation, double back, double off) {
    SCOPED_TRACE(testing::Message() << plane.n0 << " to " << plane.n1 << " at " << elevation);
    const Params params = risingRay(plane, elevation, back);
    const Look look(plane.volume(), params);
    expectSky(look, plane.n0 / plane.n1);
    EXPECT_EQ(look.counter("boundaries_met"), 1);
    const dvec3 u = glm::normalize(plane.up),
                in = glm::normalize(params.camera.target - params.camera.eye);
    const dvec3 out = look.direction();
    const double cosine = glm::dot(in, glm::normalize(in - glm::dot(in, u) * u));
    const auto normal2 = [&](double angle) { // (n1 sin elevation beyond)²
        const double a = plane.n0 * std::sin(angle);
        return plane.n1 * plane.n1 - plane.n0 * plane.n0 + a * a;
    };
    const double least = normal2(std::max(elevation - off, 0.0)), most = normal2(elevation + off);
    const double through = look.at("transmittance.R");
    // It stays in its plane.
    EXPECT_NEAR(glm::dot(out, glm::cross(u, in)), 0, 2e-6);
    if (glm::dot(out, u) < 0) { // total
        EXPECT_LE(least, 0);
        EXPECT_EQ(through, 1);
        EXPECT_NEAR(glm::dot(out, u), -std::sin(elevation), off);
        return;
    }
    EXPECT_GE(most, 0);
    const double rise = plane.n1 * glm::dot(out, u);
    EXPECT_GE(rise * rise, least - 4e-7 * plane.n1 * plane.n1); // floats of a direction
    EXPECT_LE(rise * rise, most + 4e-7 * plane.n1 * plane.n1);
    EXPECT_NEAR(std::sqrt(1 - std::pow(glm::dot(out, u), 2)) * plane.n1, cosine * plane.n0,
                1e-6 * plane.n0 + off * std::sin(elevation) * plane.n0);
    const double low = plane.through(std::sin(std::max(elevation - off, 0.0)));
    const double high = plane.through(std::sin(elevation + off));
    EXPECT_GE(through, low - 2e-6);
    EXPECT_LE(through, high + 2e-6);
}

} // namespace

TEST(HardSharpInterface, TotalReflectionBeginsWithin1e4RadiansOfTheCriticalAngle) {
    for (const Plane& plane : {Plane{1.5, 1}, Plane{1.5, 1, {0.2, 1, -0.1}}, Plane{2.42, 1},
                               Plane{4, 1}, Plane{1, 0.999}, Plane{1, 0.999, {0.02, 1, -0.1}}}) {
        const double critical = std::acos(plane.n1 / plane.n0); // above the plane
        for (const double off : {1e-2, 1e-3, 1e-4, -1e-4, -1e-3, -1e-2})
            // The plane's slope, from floats of 16 voxels' distance, and those of the direction:
            // 1e-6 of a radian, a hundredth of the least that is told apart. |w|² in floats, off by
            // 1.5e-7, is as much at 45°, but more where the boundary is nearly grazed.
            expectSnell(plane, critical + off, 6, 1e-6 + 1.5e-7 / std::sin(2 * critical));
    }
}

TEST(HardSharpInterface, GrazingRaysAreMirroredByFresnelsShare) {
    // From the thinner side, from the denser one, and with hardly any contrast.
    for (const Plane& plane :
         {Plane{1, 1.5}, Plane{1.5, 1}, Plane{1, 4}, Plane{0.999, 1}, Plane{1, 1.5, {0.1, 1, 0.3}}})
        for (const double elevation : {1e-1, 1e-2, 1e-3, 1e-4})
            expectSnell(plane, elevation, 10, 2e-6);
}

TEST(HardSharpInterface, ARayThatHardlyRisesIsMirroredOrPasses) {
    // At 1e-5 and 1e-6 of a radian floats decide where it meets the plane, if it does: it is
    // mirrored, nearly all of it, or leaves as it came; no light is made of it.
    for (const double elevation : {1e-5, 1e-6, 0.0}) {
        const Plane plane{1, 1.5};
        const Look look(plane.volume(), risingRay(plane, elevation, 10));
        expectSky(look, plane.n0 / plane.n1);
        EXPECT_LE(look.counter("boundaries_met"), 1);
        EXPECT_NEAR(look.at("R") * 2.25, 1, 1e-3); // what may be dropped as dim
    }
}

TEST(HardSharpInterface, APlateLeavesADirectionAsItWas) {
    // Down to grazing incidence: turned once, and back by the other face.
    for (const dvec3& up : {dvec3(0, 1, 0), dvec3(0.3, 1, 0.2)}) {
        const dvec3 u = glm::normalize(up), middle(48.1, 24.2, 16.3);
        const Body plate{[=](dvec3 x) { return std::abs(glm::dot(x - middle, u)) - 7.3; }};
        for (const double elevation : {1.2, 0.5, 0.1, 0.03}) {
            const dvec3 d = std::cos(elevation) * across(u) - std::sin(elevation) * u;
            const dvec3 met = middle + 7.3 * u - 8.0 * across(u);
            const Look look(Bodies{.all = {plate}, .size = {96, 48, 32}}.volume(),
                            rayFrom(met - 5.0 * d, d));
            expectSky(look);
            // Where it leaves at a grazing angle an error of the square of the sine, of 1e-6, is
            // that over twice the sine.
            EXPECT_LT(radiansBetween(look.direction(), d), 2e-6 + 1e-6 / std::sin(elevation));
            EXPECT_NEAR(look.at("transmittance.R"),
                        std::pow(fresnelThrough(1, 1.5, std::sin(elevation)), 2), 1e-4);
            // Aside by t sin θ (1 − cosθ/√(n² − sin²θ)), θ from the normal.
            const double s = std::cos(elevation), c = std::sin(elevation);
            const double aside = 14.6 * s * (1 - c / std::sqrt(2.25 - s * s));
            EXPECT_NEAR(glm::length(glm::cross(look.place() - met, d)), aside, 2e-3);
        }
    }
}

TEST(HardSharpInterface, AContrastOf1e6IsFaintAndNoMore) {
    for (const double more : {1e-6, -1e-6, 1e-5, -1e-5}) {
        const Plane plane{1.5, 1.5 * (1 + more)};
        for (const double elevation : {1.2, 0.6, 0.1}) {
            const Params params = risingRay(plane, elevation, 6);
            const Look look(plane.volume(), params);
            expectSky(look, plane.n0 / plane.n1);
            const dvec3 in = glm::normalize(params.camera.target - params.camera.eye);
            // cos e0 = (1 + more) cos e1; and a share of (more / 2 sin²)² mirrored at the most.
            const double turned = more / std::tan(elevation);
            EXPECT_NEAR(radiansBetween(look.direction(), in), std::abs(turned),
                        0.1 * std::abs(turned) + 2e-7); // indices' floats, and directions'
            EXPECT_NEAR(look.at("transmittance.R"), 1, 1e-6);
        }
    }
}

TEST(HardSharpInterface, NoContrastIsNotSeen) {
    // An object of the index around it does nothing to light: its alpha, too, is that of a ray that
    // left as it came.
    for (const double n : {1.0, 1.5}) {
        const Bodies bodies{.all = {ballBody({16.2, 15.7, 16.1}, 11, n)}, .around = n};
        const Look look(bodies.volume(), alongTo({1, 0.3, -0.2}, dvec3(16), 30, {16, 16}));
        const dvec3 d = glm::normalize(dvec3(1, 0.3, -0.2));
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                EXPECT_NEAR(look.at("R", x, y), 1, 1e-6);
                EXPECT_EQ(look.at("transmittance.R", x, y), 1);
                EXPECT_LT(radiansBetween(look.direction(x, y), d), 6e-7); // floats, twice
                EXPECT_EQ(look.at("A", x, y), 0) << x << " " << y;
            }
    }
}
