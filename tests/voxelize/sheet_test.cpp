// Open sheets that a domain closes: their distances within it against closed bodies and formulas.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lattice.h"
#include "support/scratch.h"
#include "voxelize/accept.h"
#include "voxelize/curve.h"
#include "voxelize/distances.h"
#include "voxelize/plan.h"

#include <functional>
#include <random>

namespace eikonal::voxelize {
namespace {

using glm::dvec3;
using glm::ivec3;
using mesh::Box;
using mesh::TriangleMesh;
using Height = std::function<double(double, double)>;

constexpr double kBand = 6;         // [voxel]
constexpr double kVoxel = 2.0 / 32; // [unit]

double waves(double x, double z) {
    return 0.05 * std::sin(5 * x + 2 * z) + 0.03 * std::sin(-3 * x + 7 * z + 1);
}

/// Heights over a square of that half width, looking up.
TriangleMesh heights(const Height& height, double half, int n) {
    TriangleMesh sheet;
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = half * (2.0 * i / n - 1), z = half * (2.0 * j / n - 1);
            sheet.points.emplace_back(x, height(x, z), z);
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            sheet.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            sheet.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return sheet;
}

/// The same closed by hand: by upright sides and a bottom.
TriangleMesh boxUnder(TriangleMesh sheet, int n, double bottom) {
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    std::vector<std::uint32_t> rim; // seen from above, anticlockwise
    for (int k = 0; k < n; ++k) rim.push_back(at(0, k));
    for (int k = 0; k < n; ++k) rim.push_back(at(k, n));
    for (int k = n; k > 0; --k) rim.push_back(at(n, k));
    for (int k = n; k > 0; --k) rim.push_back(at(k, 0));
    const auto first = static_cast<std::uint32_t>(sheet.points.size());
    const auto count = static_cast<std::uint32_t>(rim.size());
    for (const std::uint32_t point : rim) {
        const dvec3 x = sheet.points[point];
        sheet.points.emplace_back(x.x, bottom, x.z);
    }
    sheet.points.emplace_back(0, bottom, 0);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t next = (k + 1) % count;
        sheet.triangles.push_back({rim[next], rim[k], first + k});
        sheet.triangles.push_back({rim[next], first + k, first + next});
        sheet.triangles.push_back({first + next, first + k, first + count});
    }
    return sheet;
}

/// A plane's part in a box, as one fan that looks along its normal.
TriangleMesh planeIn(const Box& box, const dvec3& through, const dvec3& normal) {
    const dvec3 aside = std::abs(normal.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 u = glm::normalize(glm::cross(aside, normal)), v = glm::cross(normal, u);
    std::vector<dvec3> polygon;
    for (const glm::dvec2& c : {glm::dvec2(-9, -9), {9, -9}, {9, 9}, {-9, 9}})
        polygon.push_back(through + c.x * u + c.y * v);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const double face = side < 0 ? -box.min[axis] : box.max[axis];
            std::vector<dvec3> cut;
            for (size_t k = 0; k < polygon.size(); ++k) {
                const dvec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
                const double da = face - side * a[axis], db = face - side * b[axis];
                if (da >= 0) cut.push_back(a);
                if (da * db < 0) {
                    cut.push_back(glm::mix(a, b, da / (da - db)));
                    cut.back()[axis] = side * face;
                }
            }
            polygon = cut;
        }
    TriangleMesh sheet{polygon, {}};
    for (std::uint32_t k = 2; k < polygon.size(); ++k) sheet.triangles.push_back({0, k - 1, k});
    mesh::mergeIdenticalPoints(sheet);
    return sheet;
}

/// Accepts the sheet for a domain, and curves it.
Params sceneOf(const TriangleMesh& sheet, const Box& bounds, bool below = false,
               double voxelSize = kVoxel, double smooth = mesh::kUsualSmooth) {
    Params params;
    params.bounds = bounds;
    params.voxelSize = voxelSize;
    params.sdfBand = kBand;
    params.smooth = smooth;
    params.objects.push_back({"sheet", {}});
    params.objects[0].mesh = sheet;
    const Acceptance found =
        acceptMesh(params.objects[0].mesh, "sheet.obj", false, sheetDomainOf(params, below));
    EXPECT_FALSE(found.closing.empty());
    params.sharp = false; // walls need not be looked for
    Stats stats;
    EXPECT_TRUE(curveObjects(params, stats).empty());
    return params;
}

volume::BrickGrid distancesOf(const Params& params) {
    return signedDistances(params.objects[0].mesh, makePlan(params).lattice, kBand);
}

/// Calls `act` with every voxel and its middle.
template<typename Act> void eachVoxel(const Lattice& lattice, const Act& act) {
    for (int z = 0; z < lattice.size.z; ++z)
        for (int y = 0; y < lattice.size.y; ++y)
            for (int x = 0; x < lattice.size.x; ++x)
                act(ivec3(x, y, z), lattice.low + (dvec3(x, y, z) + 0.5) * lattice.voxelSize);
}

/// The most by which distances are off what `distance` says of a place [voxel].
template<typename Distance> double deviation(const Params& params, const Distance& distance) {
    const volume::BrickGrid grid = distancesOf(params);
    const Lattice lattice = makePlan(params).lattice;
    double most = 0;
    eachVoxel(lattice, [&](const ivec3& i, const dvec3& x) {
        const double wanted = glm::clamp(distance(x) / lattice.voxelSize, -kBand, kBand);
        most = std::max(most, std::abs(grid.at(i) / lattice.voxelSize - wanted));
    });
    return most;
}

/// The most by which two scenes' distances differ [voxel].
double difference(const Params& a, const Params& b, double sign = 1) {
    const volume::BrickGrid p = distancesOf(a), q = distancesOf(b);
    double most = 0;
    eachVoxel(makePlan(a).lattice, [&](const ivec3& i, const dvec3&) {
        most = std::max(most, std::abs(static_cast<double>(p.at(i)) - sign * q.at(i)));
    });
    return most / *a.voxelSize;
}

// Of a voxel: floats hold six voxels to 5e-7 of one.
constexpr double kSame = 1e-5;
const Box kPool{{-1, -0.4, -1}, {1, 0.3, 1}};

TEST(Sheets, HaveTheDistancesOfABoxByHand) {
    // Eight voxels beyond the domain, more than the band.
    constexpr int n = 60;
    const TriangleMesh sheet = heights(waves, 1.5, n);
    const Params open = sceneOf(sheet, kPool);
    Params closed = open;
    closed.objects[0].mesh = boxUnder(sheet, n, -1.2);
    Stats stats;
    curveObjects(closed, stats);
    EXPECT_LT(difference(open, closed), kSame);
    // What is beyond the band, too, and what is counted.
    const Lattice lattice = makePlan(open).lattice;
    EXPECT_EQ(countsOf(open.objects[0].mesh, lattice), countsOf(closed.objects[0].mesh, lattice));
}

TEST(Sheets, ThatEndAtTheFacesGoOnAlongTheirSlope) {
    const dvec3 normal = glm::normalize(dvec3(-0.2, 1, 0.3));
    const TriangleMesh sheet = heights([](double x, double z) { return 0.2 * x - 0.3 * z; }, 1, 10);
    // Ends at the faces, and, by what is added up to whole voxels, 0.45 voxels within them.
    for (const double voxelSize : {kVoxel, 2.0 / 31.1})
        EXPECT_LT(deviation(sceneOf(sheet, {{-1, -0.9, -1}, {1, 0.9, 1}}, false, voxelSize),
                            [&](const dvec3& x) { return glm::dot(x, normal); }),
                  kSame);
    // Waves that end there have the box's distances but for what its sides are near to.
    constexpr int n = 40;
    const TriangleMesh wavy = heights(waves, 1, n);
    const Params open = sceneOf(wavy, kPool, false, 2.0 / 48);
    Params closed = open;
    closed.objects[0].mesh = boxUnder(wavy, n, -1.2);
    Stats stats;
    curveObjects(closed, stats);
    const volume::BrickGrid p = distancesOf(open), q = distancesOf(closed);
    const double h = *open.voxelSize;
    eachVoxel(makePlan(open).lattice, [&](const ivec3& i, const dvec3& x) {
        EXPECT_EQ(p.at(i) < 0, q.at(i) < 0);
        if (std::max(std::abs(x.x), std::abs(x.z)) < 1 - 2 * kBand * h) {
            EXPECT_NEAR(p.at(i), q.at(i), kSame * h);
        }
    });
}

TEST(Sheets, AreFilledBehindTheirFacesOrBelow) {
    const TriangleMesh up = heights(waves, 1, 40), down = mesh::turnedInsideOut(up);
    const Params below = sceneOf(up, kPool);
    const Params above = sceneOf(down, kPool);
    EXPECT_LT(difference(below, above, -1), kSame);
    EXPECT_LT(difference(below, sceneOf(up, kPool, true)), kSame);
    EXPECT_LT(difference(below, sceneOf(down, kPool, true)), kSame);
    TriangleMesh copy = down;
    const auto domain = sheetDomainOf(below, true);
    EXPECT_NE(acceptMesh(copy, "down.obj", false, domain).closing.find("turned over"),
              std::string::npos);
}

TEST(Sheets, MayLeaveTheDomainByAnyOfItsFaces) {
    const Box cube{dvec3(-1), dvec3(1)};
    Box around;
    around.min = dvec3(-1.7);
    around.max = dvec3(2.4);
    std::mt19937 random(5);
    std::normal_distribution<double> any;
    for (int i = 0; i < 12; ++i) {
        const dvec3 normal = i == 0 ? glm::normalize(dvec3(1))
                                    : glm::normalize(dvec3(any(random), any(random), any(random)));
        const dvec3 through = 0.15 * dvec3(any(random), any(random), any(random));
        for (const Box& end : {cube, around})
            EXPECT_LT(deviation(sceneOf(planeIn(end, through, normal), cube, false, 2.0 / 20),
                                [&](const dvec3& x) { return glm::dot(x - through, normal); }),
                      kSame)
                << "normal " << normal.x << " " << normal.y << " " << normal.z;
    }
}

TEST(Sheets, MayHaveHolesOutsideTheDomain) {
    // Cells beyond the domain's side are left out.
    constexpr int n = 30;
    TriangleMesh sheet = heights(waves, 3, n);
    const auto middle = [&](const glm::uvec3& f) {
        return (sheet.points[f.x] + sheet.points[f.y] + sheet.points[f.z]) / 3.0;
    };
    std::erase_if(sheet.triangles, [&](const glm::uvec3& f) {
        return glm::distance(middle(f), dvec3(2.2, 0, 0.3)) < 0.4;
    });
    // Flat: curved, what is round beside a hole would bend all the way into the domain.
    const Params whole = sceneOf(heights(waves, 3, n), kPool, false, kVoxel, 0);
    EXPECT_LT(difference(sceneOf(sheet, kPool, false, kVoxel, 0), whole), kSame);
}

/// Refused, with these words.
void expectRefused(const TriangleMesh& sheet, bool below, std::vector<std::string> words) {
    Params params;
    params.bounds = kPool;
    params.voxelSize = kVoxel;
    words.emplace_back("sheet.obj: bounds no volume: ");
    words.emplace_back("--fill-below");
    TriangleMesh copy = sheet;
    expectError(ExitStatus::data, words,
                [&] { acceptMesh(copy, "sheet.obj", false, sheetDomainOf(params, below)); });
    EXPECT_EQ(copy.triangles, sheet.triangles);
}

TEST(Sheets, AreRefusedWhereTheDomainDoesNotCloseThem) {
    // 0.6 voxels within the faces.
    for (const bool below : {false, true})
        expectRefused(
            heights(waves, 1 - 0.6 * kVoxel, 40), below,
            {"its rim lies within the domain, at (", "0.0375 units from its nearest face"});
    TriangleMesh holed = heights(waves, 1.5, 40);
    holed.triangles.erase(holed.triangles.begin() + 2 * (20 * 40 + 20));
    expectRefused(holed, false, {"around 2 holes", "its rim lies within the domain, at ("});
    TriangleMesh mixed = heights(waves, 1, 40);
    for (size_t f = 0; f < 80; ++f) std::swap(mixed.triangles[f].x, mixed.triangles[f].y);
    for (const bool below : {false, true})
        expectRefused(mixed, below, {"neighbouring faces disagree about which side is out"});
    TriangleMesh upright = heights(waves, 1.5, 20);
    for (dvec3& x : upright.points) x = {x.x, x.z, x.y};
    const Params behind = sceneOf(upright, kPool);
    EXPECT_LT(difference(behind, sceneOf(mesh::turnedInsideOut(upright), kPool), -1), kSame);
    expectRefused(upright, true, {"it stands upright, so that nothing lies below it"});
    // Three sheets on one line.
    TriangleMesh book{{{-2, 0, 2}, {2, 0, 2}, {0, 0, -2}, {0, 2, -2}, {0, -2, -2}},
                      {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
    expectRefused(book, false, {"not a plain surface"});
}

TEST(Sheets, SayThatAClosedMeshNeedsNoFilling) {
    Params params;
    params.bounds = kPool;
    TriangleMesh box = mesh::boxShape(dvec3(-0.2), dvec3(0.2));
    const Acceptance found = acceptMesh(box, "box.obj", false, sheetDomainOf(params, true));
    ASSERT_EQ(found.warnings.size(), 1u);
    EXPECT_EQ(found.warnings[0], "is closed: --fill-below does nothing");
    EXPECT_TRUE(found.closing.empty());
}

} // namespace
} // namespace eikonal::voxelize
