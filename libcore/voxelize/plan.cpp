// What voxelising a scene will make, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/plan.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <iomanip>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

namespace eikonal::voxelize {

namespace {

/// Down to the ground, and to the sides as far as shadows and caustics have room on it.
void includeGround(mesh::Box& box, const Params& params) {
    const double y = params.ground->y;
    if (!(box.max.y > y))
        throw UsageError("--ground: found Y " + toText(y) + ", expected below the objects' top, " +
                         toText(box.max.y));
    const glm::dvec3 edges = box.max - box.min;
    const double margin = params.groundMargin.value_or(std::max(edges.x, edges.z));
    box.min = {box.min.x - margin, y, box.min.z - margin};
    box.max = {box.max.x + margin, box.max.y, box.max.z + margin};
}

mesh::Box boxOf(const Params& params) {
    if (params.bounds) return *params.bounds;
    mesh::Box box;
    for (const Object& object : params.objects) {
        if (object.isGround) continue;
        const mesh::Box own = mesh::boundingBox(object.mesh);
        box.include(own.min);
        box.include(own.max);
    }
    if (params.ground) includeGround(box, params);
    return box;
}

/// The whole voxels an edge needs; an edge that is a whole number but for rounding needs no more.
int voxelsAlong(double edge, double voxelSize) {
    const double kRounding = 1e-6; // [voxel]
    // Held to a range that an int can tell; what is too long is refused by the caller.
    return static_cast<int>(std::clamp(std::ceil(edge / voxelSize - kRounding), 1.0, 1e9));
}

double longestEdge(const mesh::Box& box) {
    const glm::dvec3 edges = box.max - box.min;
    return std::max({edges.x, edges.y, edges.z});
}

/// Voxels on each side of the objects in a domain of `resolution` along its longest edge. What was
/// not asked for leaves them half of it.
int paddingWithin(const Params& params, int resolution) {
    if (params.bounds) return 0;
    return params.padding.value_or(std::min(kUsualPadding, resolution / 4));
}

/// The same where the voxels' size is given: they are no fewer for more padding, so that only the
/// longest edge that can be limits it.
int paddingAround(const Params& params, int objects) {
    if (params.bounds) return 0;
    return params.padding.value_or(std::clamp((kLongestEdge - objects) / 2, 0, kUsualPadding));
}

/// The area of the faces whose boxes reach into the domain [unit²].
double areaWithin(const mesh::TriangleMesh& mesh, const Lattice& lattice) {
    mesh::Box domain;
    domain.min = lattice.low;
    domain.max = lattice.low + glm::dvec3(lattice.size) * lattice.voxelSize;
    double area = 0;
    for (const glm::uvec3& face : mesh.triangles) {
        mesh::Box own;
        for (int k = 0; k < 3; ++k) own.include(mesh.points[face[k]]);
        if (own.touches(domain)) area += mesh::faceArea(mesh, face);
    }
    return area;
}

/// What the host holds at the most, about: a strip of samples, and bricks near surfaces, once as
/// they are filled and once as a tree.
std::int64_t bytesFor(const Params& params, const Lattice& lattice, int components) {
    double area = 0; // [voxel²]
    for (const Object& object : params.objects)
        area += areaWithin(object.mesh, lattice) / (lattice.voxelSize * lattice.voxelSize);
    const double voxels = static_cast<double>(lattice.size.x) * lattice.size.y * lattice.size.z;
    const double bricks = voxels / volume::kBrickVoxels;
    // A brick is as wide as its edge times 3/2, in the mean over the ways a surface may lie.
    const auto voxelsWithin = [&](double reach) {
        return std::min(area * (1.5 * volume::kBrick + 2 * reach), voxels);
    };
    const double strip =
        std::min(static_cast<double>(stripBytesFor(params.objects.size())), 4 * voxels);
    const double objects = static_cast<double>(params.objects.size());
    const double mixed = (voxelsWithin(0) + bricks) * 4 * components;
    const double distances = params.sharp ? (voxelsWithin(params.sdfBand) + bricks) * 4 : 0;
    return static_cast<std::int64_t>(strip * (1 + objects / 2) + 2 * (mixed + distances));
}

/// Throws if the machine has not that much memory at all, or the process may not have it; what is
/// free changes too fast to ask.
void requireHostFit(std::int64_t bytes) {
    double has =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        has = std::min(has, static_cast<double>(limit.rlim_cur));
    if (static_cast<double>(bytes) > has)
        throw MemoryError("the grids need " + bytesText(static_cast<double>(bytes)) +
                          ", the host has " + bytesText(has));
}

std::string rounded(double x, int digits = 3) {
    std::ostringstream text;
    text << std::setprecision(digits) << x;
    return text.str();
}

/// The option that makes voxels small enough for a wall [unit].
std::string remedyFor(const Params& params, double thickness) {
    // A figure that holds it, but need not be typed to the last digit of a rounded thickness.
    const double exact = thickness / kThinnestWall * (1 + 1e-6);
    const double digit = std::pow(10, std::floor(std::log10(exact)) - 3);
    const double voxelSize = std::floor(exact / digit) * digit;
    const double objects = std::ceil(longestEdge(boxOf(params)) / exact);
    const int most = kLongestEdge - 2 * paddingWithin(params, kLongestEdge);
    if (!(objects <= most))
        return "no --resolution up to " + std::to_string(kLongestEdge) + " would";
    auto resolution = static_cast<int>(objects);
    while (resolution - 2 * paddingWithin(params, resolution) < objects) ++resolution;
    return (params.voxelSize ? "--voxel-size " + rounded(voxelSize, 4)
                             : "--resolution " + std::to_string(resolution)) +
           " would";
}

/// How far a plate of so many voxels turns rays at the most, as tests hold it. [degree]
double mostTurn(double voxels) {
    struct Bar {
        double voxels, degrees;
    };
    constexpr Bar kBars[] = {{2, 8}, {3, 1.4}, {5, 0.03}};
    const Bar* bar = voxels < 3 ? kBars : kBars + 1;
    const double t = (voxels - bar[0].voxels) / (bar[1].voxels - bar[0].voxels);
    return bar[0].degrees * std::pow(bar[1].degrees / bar[0].degrees, t);
}

/// What becomes of a wall that is too thin.
std::string harmOf(double voxels) {
    if (voxels < kLostWall) return "a sharp boundary loses it";
    return "rays through it may be " + rounded(mostTurn(voxels), 2) + "° off";
}

} // namespace

Lattice latticeOf(const Params& params) {
    const mesh::Box box = boxOf(params);
    const glm::dvec3 edges = box.max - box.min;
    const double longest = longestEdge(box);
    const int padding = params.voxelSize
                            ? paddingAround(params, voxelsAlong(longest, *params.voxelSize))
                            : paddingWithin(params, params.resolution);
    Lattice lattice;
    lattice.supersample = params.supersample;
    lattice.voxelSize =
        params.voxelSize ? *params.voxelSize : longest / (params.resolution - 2 * padding);
    if (!(lattice.voxelSize >= kSmallestVoxel && lattice.voxelSize <= kLargestVoxel))
        throw DataError("the domain's longest edge of " + toText(longest) + " makes voxels of " +
                        toText(lattice.voxelSize) + ", expected " + toText(kSmallestVoxel) +
                        " to " + toText(kLargestVoxel));
    for (int i = 0; i < 3; ++i)
        lattice.size[i] = voxelsAlong(edges[i], lattice.voxelSize) + 2 * padding;
    const int most = std::max({lattice.size.x, lattice.size.y, lattice.size.z});
    if (most > kLongestEdge)
        throw UsageError((params.voxelSize
                              ? "--voxel-size: found " + toText(*params.voxelSize)
                              : "--resolution: found " + std::to_string(params.resolution)) +
                         ", which makes the longest edge " + std::to_string(most) +
                         " voxels long, expected at most " + std::to_string(kLongestEdge));
    if (params.cube) lattice.size = glm::ivec3(most);
    // Centred, so that what rounding up to whole voxels adds is the same on both sides.
    lattice.low = (box.min + box.max) / 2.0 - glm::dvec3(lattice.size) / 2.0 * lattice.voxelSize;
    return lattice;
}

std::vector<std::string> thinWallWarnings(const Params& params, const Plan& plan) {
    std::vector<std::string> warnings;
    for (size_t k = 0; k < plan.walls.size(); ++k) {
        const auto& wall = plan.walls[k];
        if (!wall) continue;
        // But for the rounding of a search.
        const double voxels = wall->thickness / plan.lattice.voxelSize * (1 + 1e-6);
        if (voxels >= kThinnestWall) continue;
        warnings.push_back("'" + params.objects[k].name + "' has a wall of " +
                           rounded(wall->thickness) + " units, " + rounded(voxels) +
                           " voxels, at (" + rounded(wall->middle.x) + ", " +
                           rounded(wall->middle.y) + ", " + rounded(wall->middle.z) +
                           "): " + harmOf(voxels) + "; it needs " + toText(kThinnestWall) +
                           " voxels, " + remedyFor(params, wall->thickness));
    }
    return warnings;
}

std::optional<double> thinnestWallVoxels(const Plan& plan) {
    std::optional<double> least;
    for (const auto& wall : plan.walls)
        if (wall && !(least && *least <= wall->thickness / plan.lattice.voxelSize))
            least = wall->thickness / plan.lattice.voxelSize;
    return least;
}

double voxelSizeOf(const Params& params) {
    return latticeOf(params).voxelSize;
}

std::optional<mesh::SheetDomain> sheetDomainOf(const Params& params, bool below) {
    if (!params.bounds) return {};
    const Lattice lattice = latticeOf(params);
    const double h = lattice.voxelSize;
    mesh::SheetDomain domain;
    domain.box.min = lattice.low;
    domain.box.max = lattice.low + glm::dvec3(lattice.size) * h;
    domain.slack = 0.5 * h;
    // What is curved may bulge, and the outermost samples are at half a voxel.
    domain.clear = ((params.sharp ? params.sdfBand : 0) + 1) * h;
    domain.below = below;
    return domain;
}

Plan makePlan(const Params& params) {
    Plan plan;
    plan.lattice = latticeOf(params);
    const Lattice& lattice = plan.lattice;
    plan.box = {glm::ivec3(0), lattice.size - 1};
    plan.frame.voxelSize = lattice.voxelSize;
    plan.frame.worldFromIndex =
        glm::scale(glm::translate(glm::dmat4(1), lattice.low + lattice.voxelSize / 2),
                   glm::dvec3(lattice.voxelSize));
    int components = 0;
    for (Grid grid : kGrids) {
        const GridNeed need = needOf(params, grid);
        plan.effects.push_back({nameOf(grid), need.needed, need.why});
        if (!need.needed) continue;
        plan.grids.push_back(grid);
        components += componentsOf(grid);
    }
    plan.effects.push_back(
        {"sdf", params.sharp, params.sharp ? "--boundary sharp" : "--boundary blurred"});
    if (params.sharp)
        for (const Object& object : params.objects)
            plan.walls.push_back(object.isGround ? std::nullopt : mesh::thinnestWall(object.mesh));
    plan.hostBytes = bytesFor(params, lattice, components);
    requireHostFit(plan.hostBytes);
    return plan;
}

} // namespace eikonal::voxelize
