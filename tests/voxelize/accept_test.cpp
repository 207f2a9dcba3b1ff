// Which meshes are taken, which repaired, and which refused though they could be repaired.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/scratch.h"
#include "support/shapes.h"
#include "voxelize/accept.h"

namespace eikonal::voxelize {
namespace {

TEST(Accept, RefusesARepairThatLosesTheObject) {
    // Every face of a ball alone, pulled away from its neighbours by a hundredth.
    const mesh::TriangleMesh ball = mesh::icosphere(1, 2);
    mesh::TriangleMesh soup;
    for (const glm::uvec3& face : ball.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        const glm::dvec3 middle =
            (ball.points[face.x] + ball.points[face.y] + ball.points[face.z]) / 3.0;
        for (int k = 0; k < 3; ++k)
            soup.points.push_back(glm::mix(ball.points[face[k]], middle, 0.01));
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    mesh::TriangleMesh given = soup;
    expectError(ExitStatus::data, {"soup.obj", "expected"},
                [&] { acceptMesh(given, "soup.obj", true); });
    EXPECT_EQ(given.points, soup.points);
    given = mesh::joined(mesh::moved(ball, {5, 0, 0}), soup); // and one that is whole
    expectError(ExitStatus::data, {"soup.obj", "another object", "expected"},
                [&] { acceptMesh(given, "soup.obj", true); });
}

TEST(Accept, SaysWhatARepairCameTo) {
    mesh::TriangleMesh box = mesh::boxShape({0, 0, 0}, {1, 2, 3});
    box.triangles.pop_back();
    const Acceptance found = acceptMesh(box, "box.obj", true);
    ASSERT_FALSE(found.repairs.empty());
    EXPECT_EQ(found.repairs.back(), "repaired: 12 triangles, 8 points, 1 component, volume 6");
    EXPECT_TRUE(found.warnings.empty());
}

TEST(Accept, TellsOfACavityThatIsNone) {
    const mesh::TriangleMesh outer = mesh::boxShape({0, 0, 0}, {4, 4, 4});
    const mesh::TriangleMesh inner = mesh::boxShape({1, 1, 1}, {3, 3, 3});
    mesh::TriangleMesh hollow = mesh::joined(outer, mesh::turnedInsideOut(inner));
    EXPECT_TRUE(acceptMesh(hollow, "hollow.obj", false).warnings.empty());
    mesh::TriangleMesh solid = mesh::joined(outer, inner);
    const Acceptance found = acceptMesh(solid, "solid.obj", false);
    ASSERT_EQ(found.warnings.size(), 1u);
    EXPECT_NE(found.warnings[0].find("1 closed part looks outward within another and is solid like "
                                     "it, volume 64: the faces of a cavity look inward"),
              std::string::npos)
        << found.warnings[0];
}

} // namespace
} // namespace eikonal::voxelize
