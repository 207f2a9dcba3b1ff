// Solids of revolution against what is solved on paper, the judge's balls, and a count of points.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/revolved.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

using namespace judge;

namespace {

using std::numbers::pi;

// Lengths of some tens, whose roundings of 1e-14 curved faces make larger.
constexpr double kRounding = 1e-11;

Revolved solidOf(const std::string& profile) {
    std::istringstream in(profile);
    return readProfile(in);
}

std::string arc(dvec2 centre, double radius, double from, double to) {
    std::ostringstream out;
    out.precision(17);
    out << "arc " << centre.x << ' ' << centre.y << ' ' << radius << ' ' << from << ' ' << to
        << '\n';
    return out.str();
}

std::string line(dvec2 from, dvec2 to) {
    std::ostringstream out;
    out.precision(17);
    out << "line " << from.x << ' ' << from.y << ' ' << to.x << ' ' << to.y << '\n';
    return out.str();
}

/// A disc with a round edge: faces at y = ±half, straight up to `flat` from the axis.
std::string disc(double flat, double half) {
    return line({0, -half}, {flat, -half}) + arc({flat, 0}, half, -pi / 2, pi / 2) +
           line({flat, half}, {0, half});
}

/// Each kind of piece, hollow and round: a plane, tori, a cone, a cylinder, a ball, an arc beyond
/// the axis, and a bowl within.
std::string vase() {
    const double a = 0.3, top = pi / 2 - a; // the shoulder's slope
    const dvec2 shoulder(9, 6);
    const dvec2 from = shoulder + 4.0 * dvec2(std::cos(top), std::sin(top));
    const dvec2 way(-std::sin(top), std::cos(top));
    const dvec2 neck = from + 3.0 * way;                                   // the cone's end
    const dvec2 hollow = neck + 2.0 * dvec2(std::cos(top), std::sin(top)); // a fillet's centre
    const dvec2 rim(hollow.x - 2 - 1, hollow.y + 4);                       // a cylinder's end
    // Round the rim to a hollow half of a spindle: an arc whose centre is beyond the axis from it.
    return line({0, 2}, {9, 2}) + arc(shoulder, 4, -pi / 2, top) + line(from, neck) +
           arc(hollow, 2, top + pi, pi) + line({hollow.x - 2, hollow.y}, {rim.x + 1, rim.y}) +
           arc(rim, 1, 0, pi / 2 + 0.6) + [&] {
               const dvec2 out(std::cos(pi / 2 + 0.6), std::sin(pi / 2 + 0.6));
               // A hollow ball on the axis that goes on from the rim in the same direction.
               const double radius = (rim + out).x / -out.x;
               const dvec2 centre = rim + (1 + radius) * out;
               return arc({0, centre.y}, radius, pi / 2 + 0.6 - pi, -pi / 2);
           }();
}

/// Whether a point is within a profile, by the crossings of a line to the right with a polygon.
bool within(const Revolved& solid, const dvec2& point) {
    bool odd = false;
    for (const ProfilePiece& piece : solid.pieces) {
        const int steps = piece.curved ? 60 : 1;
        for (int k = 0; k < steps; ++k) {
            const dvec2 a = piece.at(double(k) / steps), b = piece.at((k + 1.0) / steps);
            if ((a.y > point.y) == (b.y > point.y)) continue;
            odd ^= point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
        }
    }
    return odd;
}

} // namespace

TEST(Revolved, ABallIsTheJudgesBall) {
    const double radius = 12;
    const Revolved turned = solidOf(arc({0, 3}, radius, -pi / 2, pi / 2));
    const Glass glass{{glassBall({0, 3, 0}, radius, 1.5)}};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> to(-1, 1);
    for (int k = 0; k < 1000; ++k) {
        const dvec3 aim(12 * to(random), 12 * to(random), 12 * to(random));
        const dvec3 d = glm::normalize(dvec3(to(random), to(random), to(random)));
        const Ray ray{aim - 50.0 * d, d};
        const Path found = followTransmitted(turned, ray), wanted = followTransmitted(glass, ray);
        ASSERT_EQ(found.met.size(), wanted.met.size()) << k;
        EXPECT_NEAR(glm::length(found.ray.direction - wanted.ray.direction), 0, 1e-9) << k;
        EXPECT_NEAR(found.opticalLength, wanted.opticalLength, 1e-9) << k;
    }
}

TEST(Revolved, ASlabSetsRaysOffAsOnPaper) {
    const double half = 0.5, n = 1.5;
    const Revolved slab = solidOf(disc(40, half));
    for (const double degrees : {0.0, 20.0, 50.0, 80.0}) {
        const double angle = degrees * pi / 180, sine = std::sin(angle), cosine = std::cos(angle);
        const dvec3 d(sine, -cosine, 0), start = dvec3(3, 0, -2) - 10.0 * d;
        const Path path = followTransmitted(slab, {start, d});
        ASSERT_EQ(path.met.size(), 2u);
        EXPECT_NEAR(glm::length(path.ray.direction - d), 0, kRounding);
        const dvec3 apart = path.ray.x - start;
        EXPECT_NEAR(glm::length(apart - glm::dot(apart, d) * d),
                    2 * half * sine * (1 - cosine / std::sqrt(n * n - sine * sine)), kRounding);
    }
}

TEST(Revolved, AConeOf45DegreesSendsRaysBack) {
    // A tip and an edge that are round; the cone itself would end at y = 20.
    const double a = pi / 4, tip = 1, edge = 1, apex = 20;
    const double tipY = apex - tip / std::cos(a);
    const dvec2 rim(apex - edge - edge / std::cos(a), edge); // touches y = 0 and the cone
    const dvec2 normal(std::cos(a), std::sin(a));
    const Revolved cone = solidOf(line({0, 0}, {rim.x, 0}) + arc(rim, edge, -pi / 2, a) +
                                  line(rim + edge * normal, dvec2(0, tipY) + tip * normal) +
                                  arc({0, tipY}, tip, a, pi / 2));
    for (const double off : {1.0, 5.0, 15.0}) {
        const Path path = followTransmitted(cone, {{0.6 * off, -7, 0.8 * off}, {0, 1, 0}});
        ASSERT_EQ(path.met.size(), 4u);
        EXPECT_NEAR(glm::length(path.ray.direction - dvec3(0, -1, 0)), 0, kRounding);
        EXPECT_NEAR(glm::length(path.ray.x - dvec3(-0.6 * off, 0, -0.8 * off)), 0, kRounding);
        EXPECT_NEAR(path.opticalLength, 7 + 1.5 * 2 * apex, kRounding);
    }
}

TEST(Revolved, CrossingsPartWhatIsWithinFromWhatIsNot) {
    const Revolved solid = solidOf(vase());
    std::mt19937 random(2);
    std::uniform_real_distribution<double> to(-1, 1);
    int crossings = 0;
    for (int k = 0; k < 600; ++k) {
        const dvec3 aim(12 * to(random), 10 + 9 * to(random), 12 * to(random));
        const dvec3 d = glm::normalize(dvec3(to(random), to(random), to(random)));
        const dvec3 x = aim - 50.0 * d;
        const std::vector<Crossing> all = crossingsOf(solid, x, d);
        ASSERT_EQ(all.size() % 2, 0u) << k;
        crossings += static_cast<int>(all.size());
        for (size_t i = 0; i < all.size(); ++i)
            EXPECT_EQ(glm::dot(all[i].normal, d) > 0, i % 2 == 1) << k;
        for (double t = 20; t < 80; t += 0.71) {
            const auto near = [&](const Crossing& c) { return std::abs(c.t - t) < 0.05; };
            if (std::ranges::any_of(all, near)) continue;
            const dvec3 p = x + t * d;
            const auto before =
                std::ranges::count_if(all, [&](const Crossing& c) { return c.t < t; });
            EXPECT_EQ(before % 2 == 1, within(solid, {std::hypot(p.x, p.z), p.y})) << k << " " << t;
        }
    }
    EXPECT_GT(crossings, 800);
}

TEST(Revolved, RefusesProfilesThatDoNotGoOn) {
    EXPECT_THROW(solidOf("line 0 0 1 0\n"), std::invalid_argument);               // open
    EXPECT_THROW(solidOf("line 0 0 1 0\nline 1 0 0 1\n"), std::invalid_argument); // a corner
    EXPECT_THROW(solidOf("line 0 0 1 0\nline 1 1 0 1\n"), std::invalid_argument); // a gap
    EXPECT_THROW(solidOf("curve 0 0 1 0\n"), std::invalid_argument);
    EXPECT_THROW(solidOf("arc 0 0 1 0\n"), std::invalid_argument);
}
