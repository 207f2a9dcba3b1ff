// What is transparent within what is opaque: glass let into a block of stone, flush with its top.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack.h"
#include "stage.h"

using namespace eikonal;
using namespace eikonal::embedded;

namespace {

class Inlay : public Embedded {};
INSTANTIATE_TEST_SUITE_P(Embedded, Inlay, testing::Values(Boundary::sharp, Boundary::blurred),
                         nameOf);

constexpr double kGlass = 1.5;
const dvec3 kAbsorption(0.2, 0.7, 1.9), kAlbedo(0.7, 0.4, 0.6), kSun(3, 2, 1);
// The top lies between voxels: of faces that are flush within one, both sides would be counted in
// it. The floor lies on a quarter of a voxel, by which mesh2vol counts what boxes cover. [unit]
constexpr double kTop = 19 * kVoxel, kFloor = 5.25 * kVoxel;
constexpr double kLeft = 7.1 * kVoxel, kRight = 37.3 * kVoxel; // the glass's sides

/// In sharp files what is opaque has the index of its coat, here none. In blurred ones it is
/// mixed with the glass's, so that it must be the same if nothing shall bend light at the walls.
volume::Volume litInlay(Boundary boundary, const dvec3& sun) {
    Stage stage;
    stage.bounds.max.x = 2.9;
    voxelize::Material glass, stone = mattOf(kAlbedo, boundary == Boundary::sharp ? 1 : kGlass);
    glass.ior = kGlass;
    glass.absorption = stone.absorption = kAbsorption;
    const double h = kVoxel;
    stage.objects = {boxOf("stone", {2.1 * h, -8 * h, 2.2 * h}, {43.9 * h, kTop, 29.8 * h}, stone),
                     boxOf("glass", {kLeft, kFloor, 6.9 * h}, {kRight, kTop, 25.1 * h}, glass)};
    return stage.make(boundary, {sunAlong(sun, kSun)});
}

/// What glass of that depth lets through to a ray of that n sin θ, or from it.
Upward throughGlass(Boundary boundary, double depth, double sine, const dvec3& below) {
    const std::vector<Layer> layers{{0, 1}, {depth, kGlass, kAbsorption}, {0, kGlass}};
    return boundary == Boundary::sharp ? sharpStack(layers, sine, below)
                                       : blurredStack(layers, sine, below, kSoftness);
}

} // namespace

TEST_P(Inlay, IsLitThroughItsWindowAndDarkElsewhere) {
    // The sun comes from the left, aslant: the left wall is in shadow, as is a strip of the floor
    // beside it; the rest of the floor and the right wall are lit through the glass. Nothing sends
    // light on: stone mirrors nothing.
    const Boundary boundary = GetParam();
    const bool sharp = boundary == Boundary::sharp;
    const dvec3 sun = glm::normalize(dvec3(0.8, -1, 0));
    const volume::Volume volume = litInlay(boundary, sun);
    const auto fallenBelow = [&](double down) { // on a level plane
        return -sun.y * kSun * throughGlass(boundary, down, sun.x, dvec3(1)).own;
    };
    const double depth = kTop - kFloor;
    const dvec3 onFloor = fallenBelow(depth);
    const double shade = kLeft + throughGlass(boundary, depth, sun.x, dvec3(1)).shift;
    const double slope = sun.x / std::sqrt(kGlass * kGlass - sun.x * sun.x); // of light in glass
    // So far from walls, and from the shadow's edge, what edges do to light has ended: they are
    // creases of a spline, or blurred by a kernel of four voxels to either side and a look-up.
    const double margin = (sharp ? 5 : 6) * kVoxel;
    const double rim = (sharp ? 1.5 : 5) * kVoxel; // of the lit window
    // As for the insect, and a beam's power is the same all over it, which is felt where beams part
    // at the wall. On the wall beams of a voxel across are long: half a voxel over the sine of
    // their angle in glass, and few to a fine voxel.
    const dvec3 share = (sharp ? 1e-3 : 4e-3) + (sharp ? 0.05 : 0.1) * kVoxel * kAbsorption;
    const dvec3 wallShare = 0.08 + 0.5 * kVoxel * std::sqrt(1 + 1 / (slope * slope)) * kAbsorption;
    int lit = 0, dark = 0, onWall = 0;
    dvec3 sum(0);                           // of found over wanted on the right wall
    for (const double side : {1.0, -1.0}) { // the eye looks to the right, to the left
        const dvec3 sight = glm::normalize(dvec3(0.7 * side, -1, 0));
        const view::Params params = viewAlong(boundary, sight, {1.4, kTop, 1}, 1.7, {1, 80});
        const view::Look look(scene::Files(volume), params);
        const auto seen = [&](double down, const dvec3& fallen) {
            const dvec3 sent = kAlbedo / kPi * fallen / (kGlass * kGlass);
            return throughGlass(boundary, down, std::abs(sight.x), sent);
        };
        forEachPixel(params, [&](int x, int y) {
            const dvec3 o = originOf(params, x, y), p = o + (o.y - kTop) / -sight.y * sight;
            if (p.x < kLeft + 1.5 * kVoxel || p.x > kRight - rim) return;
            const Upward floor = seen(depth, onFloor);
            const double at = p.x + side * floor.shift, wall = side > 0 ? kRight : kLeft;
            const double down = depth * (wall - p.x) / (at - p.x); // at the wall
            if (at > kLeft + margin && at < kRight - margin && std::abs(at - shade) > margin) {
                if (at > shade) expectColour(look, x, y, floor.own, share), ++lit;
            } else if (down > margin && down < depth - margin && side > 0 && sharp) {
                const dvec3 wanted = seen(down, slope * fallenBelow(down)).own;
                expectColour(look, x, y, wanted, wallShare);
                sum += look.colour(x, y) / wanted, ++onWall;
            }
            const bool atWall = side < 0 && down > margin && down < depth;
            const bool inShade = at > kLeft && at < shade - margin;
            if (atWall || inShade) {
                view::expectNear(look.colour(x, y) / floor.own, dvec3(0), 1e-3), ++dark;
                EXPECT_EQ(look.at("A", x, y), 1);
            }
        });
    }
    EXPECT_GT(lit, 15);
    EXPECT_GT(dark, 5);
    if (!sharp) return;
    EXPECT_GT(onWall, 3);
    view::expectNear(sum / static_cast<double>(onWall), dvec3(1), 0.05);
}
