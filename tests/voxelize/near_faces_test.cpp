// Faces near a brick: what floats tell of distances to curved ones.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/near_faces.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace eikonal::voxelize {
namespace {

using glm::dvec3;

class Random {
public:
    dvec3 point(double most) { return {number(most), number(most), number(most)}; }

private:
    double number(double most) {
        return std::uniform_real_distribution<double>(-most, most)(mEngine);
    }
    std::mt19937 mEngine{11};
};

struct Face {
    std::array<dvec3, 3> corners;
    std::array<mesh::EdgeCurve, 3> sides;
};

/// Curved ones of up to some voxels' length, as far off their triangles as facets are cut to, and
/// their frames.
std::vector<Face> someFaces(size_t count, std::vector<FaceFrame>& frames) {
    Random random;
    std::vector<Face> faces;
    for (size_t i = 0; i < count; ++i) {
        Face face{{random.point(4), random.point(4), random.point(4)}, {}};
        for (mesh::EdgeCurve& side : face.sides) side = {random.point(0.05), random.point(0.05)};
        faces.push_back(face);
        frames.emplace_back(face.corners).bend(face.sides);
    }
    return faces;
}

/// Of x off the triangle's plate, in the frame's axes and in double.
double offPlate(const Face& face, const FaceFrame& frame, const dvec3& x) {
    const auto axis = [&](size_t k) {
        return dvec3(frame.numbers[k], frame.numbers[k + 1], frame.numbers[k + 2]);
    };
    const dvec3 across = axis(6);
    const double height = glm::dot(x - frame.origin, across), thickness = frame.thickness();
    const dvec3 flat = x - glm::dot(x - face.corners[0], across) * across;
    const mesh::CurvedFace triangle(face.corners, {});
    const double aside = std::sqrt(triangle.flatNearest(flat).squared);
    return std::hypot(aside, height - std::clamp(height, 0.0, thickness));
}

TEST(NearFaces, PlatesHoldCurvedFaces) {
    std::vector<FaceFrame> frames;
    const std::vector<Face> faces = someFaces(200, frames);
    double thickness = 0, bulge = 0;
    for (size_t f = 0; f < faces.size(); ++f) {
        const mesh::CurvedFace curved(faces[f].corners, faces[f].sides);
        constexpr int kSteps = 12;
        for (int i = 0; i <= kSteps; ++i)
            for (int j = 0; i + j <= kSteps; ++j) {
                const dvec3 x = curved.at(glm::dvec2(i, j) / (1.0 * kSteps));
                // Floats hold the axes to 1e-7 of what is 10 voxels long.
                EXPECT_LE(offPlate(faces[f], frames[f], x), frames[f].aside + 1e-5);
            }
        thickness += frames[f].thickness();
        bulge += 2 * curved.bulge();
    }
    EXPECT_LT(thickness, 0.8 * bulge); // what a plate of all that a face may be off would take
}

TEST(NearFaces, DistancesAreOffByNoMoreThanTheySay) {
    std::vector<FaceFrame> frames;
    const std::vector<Face> faces = someFaces(100, frames);
    std::vector<std::uint32_t> all(faces.size());
    std::iota(all.begin(), all.end(), 0u);
    NearFaces near;
    near.assign(all, frames, dvec3(0));
    Random random;
    for (int round = 0; round < 200; ++round) {
        const dvec3 x = random.point(6);
        near.measureFrom(glm::vec3(x));
        std::vector<std::uint32_t> within;
        for (size_t f = 0; f < faces.size(); ++f) {
            const mesh::CurvedFace curved(faces[f].corners, faces[f].sides);
            const double distance = std::sqrt(curved.nearest(x, curved.flatNearest(x)).squared);
            // Any face is within its own distance, and what is so has not lost its slack.
            near.listWithin(static_cast<float>(distance), within);
            EXPECT_TRUE(std::find(within.begin(), within.end(), f) != within.end());
            if (distance < static_cast<double>(near.mostOff())) continue;
            near.listWithin(static_cast<float>(distance) - near.mostOff() - near.slack(f), within);
            EXPECT_TRUE(std::find(within.begin(), within.end(), f) == within.end());
        }
    }
}

} // namespace
} // namespace eikonal::voxelize
