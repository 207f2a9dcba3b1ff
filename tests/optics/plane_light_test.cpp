// Closed forms of what lights send on a plane, against sums over the lights' surfaces.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shader_lib.h"

#include <functional>
#include <gtest/gtest.h>

using namespace eikonal::shader_lib;

namespace {

constexpr double kPi = 3.141592653589793;
const vec3 kUp(0, 1, 0);

/// What an element of a surface of radiance 1, at x and facing `out`, sends on a level plane at the
/// origin, per area of it.
double fromElement(const vec3& x, const vec3& out) {
    const double square = glm::dot(x, x);
    return std::max(x.y, 0.0) * std::max(-glm::dot(out, x), 0.0) / (square * square);
}

double sumOfSphere(const vec3& centre, double radius) {
    const int n = 1200;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double height = -1 + (2 * i + 1.0) / n, turn = 2 * kPi * (k + 0.5) / n;
            const double flat = std::sqrt(1 - height * height);
            const vec3 out(flat * std::cos(turn), height, flat * std::sin(turn));
            sum += fromElement(centre + radius * out, out);
        }
    return sum * 4 * kPi * radius * radius / n / n;
}

} // namespace

TEST(PlaneLight, APointSendsTheCosineOverTheSquare) {
    EXPECT_NEAR(pointOnPlane({0, 2, 0}, kUp), 0.25, 1e-15);
    EXPECT_NEAR(pointOnPlane({3, 4, 0}, kUp), 0.8 / 25, 1e-15);
    EXPECT_EQ(pointOnPlane({3, -4, 0}, kUp), 0);
}

TEST(PlaneLight, AConeFadesBetweenItsAngles) {
    const vec3 axis(0, -1, 0); // down on the point, which sees the light at 45° from below
    const vec3 place(1, 1, 0);
    const auto at = [&](double inner, double outer) {
        return coneTowards(place, axis, inner * kPi / 180, outer * kPi / 180);
    };
    EXPECT_EQ(at(46, 50), 1);
    EXPECT_EQ(at(30, 44), 0);
    EXPECT_NEAR(at(40, 50), 0.5, 1e-12);
    EXPECT_NEAR(at(35, 75), 27.0 / 32, 1e-12); // t = 3/4
    EXPECT_EQ(coneTowards(place, -axis, 0.1, 1.0), 0);
}

// The sums' cells are coarse at the rim of what is seen: they are off by a thousandth.
TEST(PlaneLight, ASphereSendsWhatItsElementsDo) {
    for (const auto& [x, y, radius] : {std::array{0.0, 3.0, 1.0},
                                       {2.0, 1.2, 1.0},
                                       {2.0, 0.5, 1.0},
                                       {2.0, 0.0, 1.0},
                                       {2.0, -0.4, 1.0},
                                       {0.5, 1.05, 1.0}}) {
        const double wanted = sumOfSphere({x, y, 0.3}, radius);
        EXPECT_NEAR(sphereOnPlane({x, y, 0.3}, radius, kUp), wanted, 2e-3 * wanted)
            << x << " " << y;
    }
    EXPECT_EQ(sphereOnPlane({2, -1.01, 0}, 1, kUp), 0);
    EXPECT_EQ(sphereOnPlane({0.3, 0.5, 0}, 1, kUp), 0); // within
    EXPECT_NEAR(sphereOnPlane({0, 3, 0}, 1, kUp), kPi / 9, 1e-12);
}

TEST(PlaneLight, APolygonSendsWhatItsElementsDo) {
    const vec3 corner(-1, 2, 1), u(2, 0.3, 0), v(0.4, -1, 1.5);
    const vec3 corners[4] = {corner, corner + u, corner + u + v, corner + v};
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += edgeOnPlane(corners[i], corners[(i + 1) % 4], kUp);
    vec3 out = glm::cross(u, v);
    const double area = glm::length(out);
    out /= glm::dot(out, corner) > 0 ? -area : area; // towards the origin
    double wanted = 0;
    const int n = 400; // midpoints: off by 1/n² of the whole
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
            wanted += fromElement(corner + (i + 0.5) / n * u + (k + 0.5) / n * v, out);
    wanted *= area / n / n;
    EXPECT_GT(wanted, 0.1);
    EXPECT_NEAR(std::abs(sum), wanted, 1e-4 * wanted);
}
