// Which meshes are taken, which repaired, and which refused though they could be repaired.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/scratch.h"
#include "support/shapes.h"
#include "voxelize/accept.h"

namespace eikonal::voxelize {
namespace {

using glm::dvec3;

TEST(Accept, RefusesWhatBoundsNoVolumeUnlessRepaired) {
    mesh::TriangleMesh open = mesh::boxShape(dvec3(0), dvec3(1));
    open.triangles.pop_back();
    mesh::TriangleMesh turned = mesh::boxShape(dvec3(0), dvec3(1));
    std::swap(turned.triangles[3].x, turned.triangles[3].y);
    for (const auto& [mesh, fault] :
         {std::pair{open, "3 edges with a single face, around 1 hole"},
          {mesh::turnedInsideOut(mesh::boxShape(dvec3(0), dvec3(1))), "inside out"},
          {turned, "disagree about which side is out"}}) {
        mesh::TriangleMesh copy = mesh;
        try {
            acceptMesh(copy, "box.off", false);
            ADD_FAILURE() << "accepted: " << fault;
        } catch (const DataError& error) {
            const std::string said = error.what();
            EXPECT_EQ(said.find("box.off: "), 0u);
            EXPECT_NE(said.find(fault), std::string::npos) << said;
            EXPECT_NE(said.find("--repair"), std::string::npos) << said;
        }
        const Acceptance accepted = acceptMesh(copy, "box.off", true);
        EXPECT_FALSE(accepted.repairs.empty());
        EXPECT_NEAR(mesh::signedVolume(copy), 1, 1e-12);
    }
}

TEST(Accept, RefusesWhatStaysFlat) {
    mesh::TriangleMesh sheet;
    sheet.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_THROW(acceptMesh(sheet, "sheet.off", true), DataError);
}

TEST(Accept, SaysThatTrianglesCross) {
    mesh::TriangleMesh both = mesh::joined(mesh::boxShape(dvec3(0), dvec3(2)),
                                           mesh::boxShape({1, 0.5, 0.5}, {3, 1.5, 1.5}));
    EXPECT_EQ(acceptMesh(both, "boxes.off", false).warnings.size(), 1u);
    mesh::TriangleMesh one = mesh::boxShape(dvec3(0), dvec3(2));
    EXPECT_TRUE(acceptMesh(one, "box.off", false).warnings.empty());
}

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

TEST(Accept, DoubtsWhatIsMostlyFilled) {
    // A quarter of a ball's surface is closed by about as much as it has.
    mesh::TriangleMesh piece = mesh::icosphere(1, 3);
    std::erase_if(piece.triangles, [&](const glm::uvec3& t) {
        const glm::dvec3 sum = piece.points[t.x] + piece.points[t.y] + piece.points[t.z];
        return sum.x < 0 || sum.y < 0;
    });
    const Acceptance found = acceptMesh(piece, "piece.obj", true);
    ASSERT_EQ(found.warnings.size(), 1u);
    EXPECT_NE(found.warnings[0].find("fills its holes"), std::string::npos);
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
