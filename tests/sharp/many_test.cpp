// Up to 64 objects: each is traced as it is alone, whatever its number, however many are near.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

namespace {

/// Boxes of glass, one to a cell of ten voxels in a grid of eight by eight, that fill it row by
/// row.
constexpr int kCells = 8;
constexpr double kCell = 10;
const ivec3 kBoxes(80, 80, 24);

double indexOf(int k) {
    return 1.2 + 0.01 * k;
}

double depthOf(int k) {
    return 8.2 + 0.1 * k;
}

judge::Solid boxIn(int k) {
    const dvec3 low(kCell * (k % kCells) + 1.3, kCell * (k / kCells) + 1.2, 5.4);
    return judge::glassBox(low, low + dvec3(7.6, 7.4, depthOf(k)), indexOf(k));
}

volume::Volume boxesOf(int count) {
    judge::Glass glass;
    for (int k = 0; k < count; ++k) glass.solids.push_back(boxIn(k));
    return volumeOf(glass, {.size = kBoxes});
}

std::string own(const char* grid, int k) {
    return volume::ownGrid(grid, "S" + std::to_string(k));
}

/// A ray through each cell's middle, along z; `z` is where it begins.
Params throughCells(double z) {
    const dvec3 middle(0.5 * kCells * kCell, 0.5 * kCells * kCell, z);
    Params params = sharply(view::parallel(middle, middle + dvec3(0, 0, 1), kCells * kCell,
                                           {kCells, kCells}, {0, 1, 0}));
    params.background = dvec3(1);
    return params;
}

/// Calls visit(k, x, y) with the cell that a pixel looks through.
template<typename Visit> void forEachCell(const Params& params, const Visit& visit) {
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
            const dvec3 at = rayOf(params, x, y).x / kCell;
            visit(static_cast<int>(at.y) * kCells + static_cast<int>(at.x), x, y);
        }
}

/// What one boundary lets through, straight on.
double throughOf(double n) {
    return 1 - (n - 1) * (n - 1) / ((n + 1) * (n + 1));
}

/// A sheet of balls that touch, each of another index.
constexpr double kRadius = 8;
judge::Glass sheetOfBalls() {
    judge::Glass glass;
    for (int k = 0; k < kCells * kCells; ++k)
        glass.solids.push_back(
            judge::glassBall(dvec3(9.3, 9.1, 8.9) + 2 * kRadius * dvec3(k % kCells, k / kCells, 0),
                             kRadius, indexOf(k)));
    return glass;
}

/// How many boundaries a ray meets on its way through.
size_t metBy(const judge::Glass& glass, const judge::Ray& ray) {
    return judge::followTransmitted(glass, ray).met.size();
}

} // namespace

// About the number at which a set goes on in its second word, and the last but one.
class SharpManyBoxes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, SharpManyBoxes, testing::Values(31, 32, 33, 63));

TEST_P(SharpManyBoxes, EachRefractsAndAbsorbs) {
    const int count = GetParam();
    volume::Volume boxes = boxesOf(count);
    const auto sigmaOf = [](int k) { return 0.02 + 0.003 * k; };
    for (int k = 0; k < count; ++k)
        boxes.putConstant(own("absorption", k), glm::vec3(static_cast<float>(sigmaOf(k))));
    const Params params = throughCells(-9);
    const Look look(std::move(boxes), params);
    forEachCell(params, [&](int k, int x, int y) {
        const double depth = k < count ? depthOf(k) : 0, n = k < count ? indexOf(k) : 1;
        // A box's faces are 1e-3 voxels off at the worst, this close to its edges.
        EXPECT_NEAR(look.at("optical_path_length.V", x, y), kBoxes.z + (n - 1) * depth, 2e-3) << k;
        EXPECT_NEAR(look.at("transmittance.R", x, y),
                    throughOf(n) * throughOf(n) * std::exp(-sigmaOf(k) * depth), 1e-4)
            << k;
    });
}

TEST(SharpMany, AnEyeInEachOfSixtyFour) {
    const double z = 9.7;
    const Params params = throughCells(z);
    const Look look(boxesOf(64), params);
    forEachCell(params, [&](int k, int x, int y) {
        const double within = 5.4 + depthOf(k) - z;
        EXPECT_NEAR(look.at("optical_path_length.V", x, y),
                    kBoxes.z - z + (indexOf(k) - 1) * within, 2e-3)
            << k;
    });
}

TEST(SharpMany, OpaqueAndMirroringObjectsOfEveryNumber) {
    // By turns opaque, of boundaries that mirror nothing, and plain glass.
    volume::Volume boxes = boxesOf(64);
    for (int k = 0; k < 64; k += 3) boxes.putConstant(own("opacity", k), glm::vec3(1));
    for (int k = 1; k < 64; k += 3) boxes.putConstant(own("reflectance", k), glm::vec3(0));
    const Params params = throughCells(-9);
    const Look look(std::move(boxes), params);
    forEachCell(params, [&](int k, int x, int y) {
        const double through = throughOf(indexOf(k)) * throughOf(indexOf(k));
        // Of the sky's light what is mirrored comes back, but from what mirrors none; what is
        // opaque mirrors as a coat of its index does.
        const double coat = 1 - throughOf(indexOf(k));
        const double seen = k % 3 == 0 ? coat : k % 3 == 1 ? through : 1;
        EXPECT_NEAR(look.at("transmittance.R", x, y), k % 3 == 0 ? 0 : through, 1e-4) << k;
        EXPECT_NEAR(look.at("R", x, y), seen, 1e-4) << k;
    });
}

TEST(SharpMany, SixtyFourBallsThatTouch) {
    const judge::Glass glass = sheetOfBalls();
    const Params params = along({0.2, 0.5, 1}, {65, 65, 9}, 128, {64, 64});
    const Look look(volumeOf(glass, {.size = ivec3(130, 130, 18), .halfWidth = 6}), params);
    std::vector<int> met(glass.solids.size());
    const Off off = offOf(look, params, glass, [&](const judge::Ray& ray) {
        const judge::Path path = judge::followTransmitted(glass, ray);
        if (path.met.size() != 2 || !tellable(glass, ray)) return false;
        ++met[static_cast<size_t>(path.met[0].to)];
        return true;
    });
    EXPECT_GT(off.rays, 500);
    EXPECT_EQ(std::count(met.begin(), met.end(), 0), 0);
    // A ball of four voxels is held to 0.4°, one of eight to a quarter of that.
    EXPECT_LT(off.degrees, 0.1);
}

TEST(SharpMany, GrazingOneWithManyNear) {
    // Within a ball of the lowest priority are others of its index, which rays do not meet that
    // graze it: they are within it for less than two voxels.
    const dvec3 centre(15.63, 16.21, 15.87);
    const double radius = 12, n = 1.5;
    judge::Glass glass;
    for (int k = 0; k < 40; ++k)
        glass.solids.push_back(judge::glassBall(centre, radius - 0.5 - 0.02 * k, n, 1));
    glass.solids.push_back(judge::glassBall(centre, radius, n, 0));
    const Voxels voxels{.size = ivec3(32), .halfWidth = 6};
    const dvec3 d = glm::normalize(dvec3(0.3, -1, 0.2));
    const dvec3 across = glm::normalize(glm::cross(d, dvec3(1, 0, 0)));
    // From 0.003 to 0.033 voxels deep.
    const int rays = 8;
    const Params params = along(d, centre + (radius - 0.018) * across, 0.03, {rays, rays});
    const Look look(volumeOf(glass, voxels), params);
    for (int y = 0; y < rays; ++y)
        for (int x = 0; x < rays; ++x) {
            // What enters at a grazing angle is told by how much is reflected.
            const double impact = impactOf(rayOf(params, x, y), centre, radius);
            EXPECT_LT(look.at("transmittance.R", x, y), 0.6) << impact;
        }
    // An eye in all of them, with no boundary near.
    const Look within(volumeOf(glass, voxels), oneRay({centre, d}));
    const double leaves = (centre.y / -d.y) - radius;
    EXPECT_NEAR(within.at("optical_path_length.V"), n * radius + leaves, 2e-3);
}

TEST(SharpMany, FortyShells) {
    // Balls in balls, half a voxel apart, the inner ones of a higher index and priority: some
    // fourteen boundaries are near every point between them.
    const dvec3 centre(31.63, 32.21, 31.87);
    const Voxels voxels{.halfWidth = 6};
    judge::Glass glass;
    for (int k = 0; k < 40; ++k)
        glass.solids.push_back(judge::glassBall(centre, 27.5 - 0.5 * k, 1 + 0.0125 * (k + 1), k));
    Params params = along({0.05, -1, 0.1}, centre, 50, {15, 15});
    params.maxDepth = 64;
    const Look look(volumeOf(glass, voxels), params);
    const Off off = offOf(look, params, glass, [&](const judge::Ray& ray) {
        return impactOf(ray, centre, 27.5) < 0.95 && metBy(glass, ray) <= 64;
    });
    EXPECT_GT(off.rays, 20);
    EXPECT_LT(off.degrees, 0.01); // the bar
    // From within all of them, across each once.
    const dvec3 eye = centre + dvec3(2, -1, 3);
    Params inside = sharply(view::parallel(eye, eye + dvec3(1, 0.3, -0.2), 4, {5, 5}, {0, 1, 0}));
    inside.maxDepth = 64;
    const Look out(volumeOf(glass, voxels), inside);
    const Off within = offOf(out, inside, glass, [](const judge::Ray&) { return true; });
    EXPECT_EQ(within.rays, 25);
    EXPECT_LT(within.degrees, 0.01);
    EXPECT_LT(within.optical, 0.01);
}

TEST(SharpMany, IdleObjectsChangeNothing) {
    // Bubbles in wine in glass as they are, and with objects in the domain's corners, so many that
    // kernels go by lists of the objects near.
    const dvec3 centre(31.63, 32.21, 31.87);
    const judge::Glass alone{{judge::glassBall(centre, 26, 1.5, 0),
                              judge::glassBall(centre + dvec3(1, 2, -1), 20, 1.34, 1),
                              judge::glassBall(centre + dvec3(-2, 1, 1), 11, 1, 2)}};
    judge::Glass glass = alone;
    const Params params = along({0.05, -1, 0.1}, centre, 28, {32, 32});
    const Look few(volumeOf(alone), params);
    for (int k = 0; k < 40; ++k) {
        const dvec3 corner(k & 1 ? 57.5 : 6.5, k & 2 ? 57.5 : 6.5, k & 4 ? 57.5 : 6.5);
        glass.solids.push_back(judge::glassBall(corner, 2.5, 1.1, 3 + k % 5));
    }
    const Look many(volumeOf(glass), params);
    // What goes straight through, by leaps that end elsewhere, and meets none of the others.
    int rays = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const judge::Ray ray = rayOf(params, x, y);
            if (!tellable(alone, ray) || metBy(alone, ray) != metBy(glass, ray)) continue;
            for (const char* channel : {"transmittance.R", "exit_direction.X", "exit_direction.Z"})
                EXPECT_NEAR(many.at(channel, x, y), few.at(channel, x, y), 2e-5);
            ++rays;
        }
    EXPECT_GT(rays, 100);
}
