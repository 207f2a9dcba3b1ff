// Which triangle a ray meets next, against a search in double.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_tree.h"
#include "raytrace/faces.h"
#include "raytrace/surface.h"
#include "support/shapes.h"

#include <gtest/gtest.h>
#include <random>

namespace eikonal::raytrace {
namespace {

using glm::dvec3;

struct Rays {
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> share{-1, 1};

    dvec3 direction() {
        for (;;) {
            const dvec3 v(share(random), share(random), share(random));
            if (glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
        }
    }
};

/// From points on its faces, into the body, through all of it.
void compareWithin(const mesh::TriangleMesh& mesh, const dvec3& middle, double size) {
    const Faces faces({&mesh});
    const mesh::TriangleTree tree(mesh);
    Rays rays;
    int apart = 0;
    const int kRays = 20000;
    std::vector<mesh::TriangleTree::Hit> hits;
    for (int i = 0; i < kRays; ++i) {
        const auto triangle = static_cast<std::uint32_t>(rays.random() % mesh.triangles.size());
        const glm::uvec3 f = mesh.triangles[triangle];
        dvec3 weights = glm::abs(
            dvec3(rays.share(rays.random), rays.share(rays.random), rays.share(rays.random)));
        weights /= weights.x + weights.y + weights.z;
        const SurfacePoint at =
            surfaceAt(mesh, triangle,
                      weights.x * mesh.points[f.x] + weights.y * mesh.points[f.y] +
                          weights.z * mesh.points[f.z]);
        dvec3 direction = rays.direction();
        if (glm::dot(direction, at.face) > 0) direction = -direction;
        tree.hits(at.x, direction, 1e9, hits);
        double nearest = 1e9;
        for (const auto& hit : hits)
            if (hit.face != triangle) nearest = std::min(nearest, hit.t);
        const auto found = faces.next(at.x, direction, {0, triangle});
        ASSERT_TRUE(found) << "ray " << i << " leaves the body through no face";
        apart += std::abs(found->t - nearest) > 1e-5 * size;
        const double out = glm::distance(at.x + found->t * direction, middle);
        ASSERT_LT(out, 2 * size);
    }
    // The other search may miss both faces at an edge; this one finds one of them.
    EXPECT_LE(apart, 2);
}

TEST(Faces, MeetsTheNextFaceFromAnother) {
    compareWithin(mesh::icosphere(1, 4), dvec3(0), 1);
    compareWithin(mesh::boxShape(dvec3(-1), dvec3(1)), dvec3(0), 1.8);
}

// Single precision alone would be a thousandth of the body off.
TEST(Faces, IsExactFarFromTheOrigin) {
    const dvec3 far(1e5, -2e5, 3e5);
    compareWithin(mesh::moved(mesh::icosphere(1, 4), far), far, 1);
}

TEST(Faces, MeetsASphereFromAfarWhereItIs) {
    const mesh::TriangleMesh mesh = mesh::icosphere(1, 5);
    const Faces faces({&mesh});
    const auto found = faces.next({0, 0.2, 1e6}, {0, 0, -1});
    ASSERT_TRUE(found);
    // Its facets lie within h²/8 of the sphere, h = 0.04 their edges' length; across, a slope's
    // more.
    EXPECT_NEAR(found->t, 1e6 - std::sqrt(1 - 0.04), 3e-4);
    EXPECT_FALSE(faces.next({0, 1.2, 1e6}, {0, 0, -1}));
    EXPECT_FALSE(faces.next({0, 0.2, -1e6}, {0, 0, -1}));
}

TEST(Faces, NeverStopsAtTheFaceARayStartsOn) {
    const mesh::TriangleMesh mesh = mesh::boxShape(dvec3(0), dvec3(1));
    const Faces faces({&mesh});
    const dvec3 start(0.3, 0.4, 0);
    const auto first = faces.next(start - dvec3(0, 0, 1), {0, 0, 1});
    ASSERT_TRUE(first);
    EXPECT_DOUBLE_EQ(first->t, 1);
    const auto second = faces.next(start, {0, 0, 1}, first->face);
    ASSERT_TRUE(second);
    EXPECT_DOUBLE_EQ(second->t, 1);
    EXPECT_FALSE(faces.next(start, {0, 0, -1}, first->face));
}

TEST(Faces, CountsHowOftenASurfaceWindsAroundAPoint) {
    const mesh::TriangleMesh box = mesh::boxShape(dvec3(-1), dvec3(1));
    const mesh::TriangleMesh twice =
        mesh::joined(box, mesh::boxShape(dvec3(-0.5, -0.5, -0.5), dvec3(2, 2, 2)));
    const mesh::TriangleMesh hollow =
        mesh::joined(box, mesh::turnedInsideOut(mesh::icosphere(0.5, 2)));
    const Faces faces({&box, &twice, &hollow});
    EXPECT_EQ(faces.windings({0.1, 0.2, 0.3}), (std::vector<int>{1, 2, 0}));
    EXPECT_EQ(faces.windings({-0.7, -0.8, -0.9}), (std::vector<int>{1, 1, 1}));
    EXPECT_EQ(faces.windings({1.1, 1.2, 1.3}), (std::vector<int>{0, 1, 0}));
    EXPECT_EQ(faces.windings({-3, -4, -5}), (std::vector<int>{0, 0, 0}));
}

} // namespace
} // namespace eikonal::raytrace
