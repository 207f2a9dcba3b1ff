// Hard cases of a volume's shape, size and place: slivers, tiny and huge voxels, far away, turned.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard.h"
#include "support/scratch.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dmat3;
using glm::dmat4;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

/// A medium that bends, dims in colours, and shines, of 12 voxels' edge h.
volume::Volume sceneVolume(double h, const dmat4& placed = dmat4(1)) {
    TestVolume out(ivec3(12), h, placed);
    out.index([=](dvec3 p) {
        const dvec3 q = p / h;
        return 1.3 + 0.08 * std::sin(0.4 * q.x) + 0.05 * q.y / (4 + q.z);
    });
    out.addVector("absorption", [=](dvec3 p) { return dvec3(0.01, 0.02, 0.03) * p.x / h / h; });
    out.constantVector("scattering", dvec3(0.02, 0.01, 0.03) / h);
    out.addVector("fluence", [=](dvec3 p) { return dvec3(1 + p.y / h); });
    out.addVector("light_direction",
                  [=](dvec3 p) { return dmat3(placed) * dvec3(0.6, -0.05 * p.z / h, 0.5); });
    out.constant("anisotropy", 0.6);
    return out.take();
}

/// The same view of it: the camera is scaled and placed alike.
Params viewOf(double h, const dmat4& placed = dmat4(1)) {
    const auto at = [&](const dvec3& p) { return dvec3(placed * glm::dvec4(p * h, 1)); };
    return perspective(at({30, 14, 25}), at(dvec3(6)), 26, {8, 8}, dmat3(placed) * dvec3(0, 1, 0));
}

/// Fails unless two pictures agree, colour by colour and way by way.
void expectSame(const Look& a, const Look& b, double tolerance) {
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const double scale = glm::length(a.colour(x, y)) + 1e-6;
            expectNear(b.colour(x, y) / scale, a.colour(x, y) / scale, tolerance);
            EXPECT_NEAR(b.at("transmittance.B", x, y), a.at("transmittance.B", x, y), tolerance);
        }
}

dmat4 drawnPlace(double distance) {
    return glm::rotate(glm::translate(dmat4(1), distance * drawnDirection()), drawn(0, 2 * kPi),
                       drawnDirection());
}

} // namespace

TEST(HardShape, VolumesOfAnyShapeAreSeenAndLitTheirWholeLength) {
    for (const ivec3& size : {ivec3(1), ivec3(1, 7, 7), ivec3(7, 1, 7), ivec3(1000, 3, 3),
                              ivec3(3, 3, 1000), ivec3(1, 500, 1)}) {
        SCOPED_TRACE(testing::Message() << size.x << " x " << size.y << " x " << size.z);
        for (int axis = 0; axis < 3; ++axis)
            for (const bool bends : {false, true}) {
                TestVolume box(size);
                box.constantVector("emission", dvec3(1e-3));
                // A slope of the index along the ray, which it does not bend.
                if (bends) box.index([=](dvec3 p) { return 1.2 + 0.1 * p[axis] / size[axis]; });
                dvec3 d(0);
                d[axis] = -1;
                const dvec3 middle = 0.5 * dvec3(size);
                const Look look(box.take(),
                                parallel(middle - 2000.0 * d, middle, 0.1, {1, 1}, across(d)));
                const double length = size[axis];
                // Floats of 1000 voxels over 1000 steps; and the steps' n against their |w|.
                const double tolerance = (bends ? 2e-4 : 1e-5) * length + 1e-3;
                EXPECT_NEAR(look.at("path_length.V"), length, tolerance) << axis;
                expectNear(look.direction(), d, 1e-5);
                if (!bends) {
                    EXPECT_NEAR(look.at("R"), 1e-3 * length, 1e-3 * tolerance);
                }
                EXPECT_EQ(look.counter("trapped"), 0);
            }
        TestVolume box = std::move(TestVolume(size).constant("ior", 1));
        for (const dvec3& way : {dvec3(1, 0, 0), dvec3(0, 0, -1), dvec3(3, 1, 2)}) {
            const lightsim::Lit lit(box.volume(),
                                    lightsim::paramsOf({lightsim::beam(way)}, 1 << 14));
            const double voxels = static_cast<double>(lit.plan.voxels());
            // Power times mean chord is the volume; a long thin shadow's outline takes a pixel in
            // twenty across.
            EXPECT_NEAR(lit.total() / voxels, 1, 0.05);
        }
    }
}

TEST(HardShape, AVolumesUnitDoesNotChangeThePicture) {
    const Look one(sceneVolume(1), viewOf(1));
    for (const double h : {2e-5, 1e-3, 1e6}) {
        SCOPED_TRACE(h);
        const Look other(sceneVolume(h), viewOf(h));
        expectSame(one, other, 1e-5); // coefficients in 1/voxel, and the camera, round once each
        EXPECT_NEAR(other.at("path_length.V", 3, 4) / h, one.at("path_length.V", 3, 4), 1e-4);
        const lightsim::Lit small(sceneVolume(1), lightsim::paramsOf({lightsim::beam({1, -2, 1})}));
        const lightsim::Lit lit(sceneVolume(h), lightsim::paramsOf({lightsim::beam({1, -2, 1})}));
        forEachVoxel(ivec3(12), [&](ivec3 p) {
            // The same weights but for the last bit of a coefficient, which moves the dither.
            ASSERT_NEAR(lit.fluence(p), small.fluence(p), 1e-3 * small.fluence(p) + 1e-4);
        });
        EXPECT_NEAR(lit.stats.energy.absorbed[0] / (h * h), small.stats.energy.absorbed[0],
                    1e-4 * small.stats.energy.absorbed[0]); // sums of floats
    }
}

TEST(HardShape, AVoxelTooSmallForVdbIsRefusedInWords) {
    // 1e-6 cubed is below what OpenVDB's maps take for a determinant.
    for (const double h : {1e-6, 1e-30})
        expectError(ExitStatus::data, {"OpenVDB", "1.5e-05", "smaller unit"},
                    [&] { TestVolume(ivec3(2), h).constant("ior", 1.5); });
}

RC_GTEST_PROP(HardShape, AVolumeFarFromTheOriginLooksTheSame, ()) {
    const double distance = *rc::gen::element(1e3, 1e6, 1e8);
    const dmat4 placed = glm::translate(dmat4(1), distance * drawnDirection());
    const Look near(sceneVolume(1), viewOf(1)), far(sceneVolume(1, placed), viewOf(1, placed));
    // Set up in double: 1e8 · 1e-16 of a voxel, 1e-8, is below the floats of the walk.
    expectSame(near, far, 2e-5);
    const lightsim::Light here = lightsim::lamp({-5, 7, 20}, dvec3(400)),
                          there =
                              lightsim::lamp(dvec3(placed * glm::dvec4(-5, 7, 20, 1)), dvec3(400));
    const lightsim::Lit a(sceneVolume(1), lightsim::paramsOf({here}, 1 << 12)),
        b(sceneVolume(1, placed), lightsim::paramsOf({there}, 1 << 12));
    double difference = 0;
    forEachVoxel(ivec3(12), [&](ivec3 p) { difference += std::abs(a.fluence(p) - b.fluence(p)); });
    // A photon in a thousand that grazes a voxel's edge may fall on its other side.
    EXPECT_LT(difference, 2e-3 * a.total());
}

RC_GTEST_PROP(HardShape, ATurnedVolumeSeenByATurnedCameraLooksTheSame, ()) {
    const double h = drawnByMagnitude(1e-3, 1e3);
    const dmat4 placed = drawnPlace(drawn(0, 100) * h);
    const Look still(sceneVolume(1), viewOf(1));
    const Look turned(sceneVolume(h, placed), viewOf(h, placed));
    // Floats of the camera's axes and of some thirty curved steps.
    expectSame(still, turned, 1e-4);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            expectNear(turned.direction(x, y), dmat3(placed) * still.direction(x, y), 1e-4);
            const dvec3 place(placed * glm::dvec4(still.place(x, y) * h, 1));
            if (still.at("path_length.V", x, y) > 0)
                expectNear(turned.place(x, y) / h, place / h, 1e-3); // as above, of 12 voxels
        }
}
