// The ground as an object of the domain, on which light falls as on any other.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/ground.h"

#include "base/error.h"
#include "base/text.h"
#include "voxelize/plan.h"

#include <array>
#include <limits>

namespace eikonal::voxelize {

namespace {

// Voxels of the domain below the plane: a spline of distances looks two on, from up to one beside.
constexpr double kLeastDepth = 3;

/// A box, its faces outward.
mesh::TriangleMesh boxMesh(const glm::dvec3& low, const glm::dvec3& high) {
    mesh::TriangleMesh box;
    for (unsigned k = 0; k < 8; ++k)
        box.points.emplace_back(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y,
                                k & 4 ? high.z : low.z);
    constexpr std::array<std::array<unsigned, 4>, 6> kFaces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& f : kFaces) {
        box.triangles.emplace_back(f[0], f[1], f[2]);
        box.triangles.emplace_back(f[0], f[2], f[3]);
    }
    return box;
}

/// Throws UsageError where the plane is too near a face of the domain, or beyond.
void requireWithin(double y, const Lattice& lattice) {
    const double above = (y - lattice.low.y) / lattice.voxelSize;
    const double kRounding = 1e-6; // [voxel]
    if (above > kLeastDepth - kRounding && above < lattice.size.y - 1) return;
    throw UsageError("--ground: found Y " + toText(y) + ", which is " + toText(above) +
                     " voxels above the low face of a domain of " + std::to_string(lattice.size.y) +
                     ", expected " + toText(kLeastDepth) +
                     " or more, and within (--padding, "
                     "--bounds)");
}

} // namespace

void addGround(Params& params) {
    if (!params.ground) return;
    const volume::Ground& ground = *params.ground;
    const Lattice lattice = latticeOf(params);
    requireWithin(ground.y, lattice);
    const double beyond = (params.sdfBand + 2) * lattice.voxelSize;
    const glm::dvec3 low = lattice.low - beyond;
    glm::dvec3 high = lattice.low + glm::dvec3(lattice.size) * lattice.voxelSize + beyond;
    high.y = ground.y;
    Object object;
    object.name = volume::kGround;
    object.isGround = true;
    object.priority = std::numeric_limits<int>::max();
    object.mesh = boxMesh(low, high);
    object.material.ior = params.medium.ior;
    object.material.dispersion = params.medium.dispersion;
    object.material.opacity = 1;
    object.material.albedo = ground.meanAlbedo();
    params.objects.push_back(std::move(object));
}

} // namespace eikonal::voxelize
