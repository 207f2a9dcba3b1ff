// Four faces' nearest points at once, against each face alone and against triangles.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/nearest_of_four.h"
#include "mesh/triangle_tree.h"

#include <gtest/gtest.h>
#include <random>

namespace eikonal::mesh {
namespace {

using glm::dvec3;

struct Random {
    std::mt19937 engine{7};

    double number(double most) {
        return std::uniform_real_distribution<double>(-most, most)(engine);
    }
    dvec3 point(double most) { return {number(most), number(most), number(most)}; }
};

struct Face {
    std::array<dvec3, 3> corners;
    std::array<EdgeCurve, 3> sides;
};

/// Curves of up to `bulge` on a triangle about as long as 1.
Face face(Random& random, double bulge) {
    Face found{{random.point(1), random.point(1), random.point(1)}, {}};
    for (EdgeCurve& side : found.sides) side = {random.point(bulge), random.point(bulge)};
    return found;
}

TEST(NearestOfFour, AreThoseOfCurvedFacesAlone) {
    Random random;
    int asked = 0, again = 0;
    for (int round = 0; round < 500; ++round) {
        Face faces[4];
        FaceQuestion questions[4];
        for (int k = 0; k < 4; ++k) {
            faces[k] = face(random, 0.02);
            questions[k] = {faces[k].corners.data(), faces[k].sides.data(), random.point(2)};
        }
        CurvedFace::Nearest answers[4];
        const unsigned left = nearestOfFour(questions, answers);
        for (int k = 0; k < 4; ++k) {
            ++asked;
            again += left >> k & 1;
            if (left >> k & 1) continue;
            const CurvedFace alone(faces[k].corners, faces[k].sides);
            const auto wanted = alone.nearest(questions[k].x, alone.flatNearest(questions[k].x));
            // Both end where a step would save less than 1e-9 of the square.
            EXPECT_NEAR(answers[k].squared, wanted.squared, 1e-8 * wanted.squared);
            EXPECT_NEAR(answers[k].height, wanted.height, 1e-3);
        }
    }
    EXPECT_LT(again, asked / 20);
}

double squaredToSide(const dvec3& x, const dvec3& a, const dvec3& b) {
    const double length = glm::dot(b - a, b - a);
    const double t = length > 0 ? glm::clamp(glm::dot(x - a, b - a) / length, 0.0, 1.0) : 0.0;
    const dvec3 off = a + t * (b - a) - x;
    return glm::dot(off, off);
}

TEST(NearestOfFour, AreThoseOfTrianglesNeedlesAndPoints) {
    Random random;
    for (int round = 0; round < 500; ++round) {
        std::array<dvec3, 3> corners[4];
        for (auto& some : corners) some = {random.point(1), random.point(1), random.point(1)};
        corners[1][2] = 0.3 * corners[1][0] + 0.7 * corners[1][1]; // a needle
        corners[2][1] = corners[2][0];                             // two corners at one place
        if (round % 2 == 0) corners[3][1] = corners[3][2] = corners[3][0];
        FaceQuestion questions[4];
        for (int k = 0; k < 4; ++k) questions[k] = {corners[k].data(), nullptr, random.point(2)};
        CurvedFace::Nearest answers[4];
        EXPECT_EQ(nearestOfFour(questions, answers), 0u);
        for (int k = 0; k < 4; ++k) {
            const auto& [a, b, c] = corners[k];
            const dvec3& x = questions[k].x;
            // All but the first, and in every other round the last, have no inside.
            const double wanted = k == 0 || (k == 3 && round % 2 != 0)
                                      ? squaredDistance(x, a, b, c)
                                      : std::min({squaredToSide(x, a, b), squaredToSide(x, b, c),
                                                  squaredToSide(x, c, a)});
            EXPECT_NEAR(answers[k].squared, wanted, 1e-12);
        }
    }
}

} // namespace
} // namespace eikonal::mesh
