// Scenes of glass twice over, as the judge's solids and as voxels, and what a picture makes of
// them. SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/glass.h"
#include "support/look.h"

#include <functional>
#include <vector>

namespace eikonal::sharp {

using glm::dvec3;
using glm::ivec3;

// ---- voxels of solids. Lengths are in voxels, from the low corner of the domain.

/// Signed distance to a solid, negative inside; to a hull that to the nearest of its planes, which
/// is less than the distance where an edge is nearer than any face.
double distanceTo(const judge::Solid& solid, const dvec3& x);

struct Voxels {
    ivec3 size{64};
    double voxelSize = 1; ///< [unit]; the solids' lengths are in voxels all the same
    double halfWidth =
        1e3; ///< of the level sets' bands [voxel]; as it is, distances are everywhere
    /// Distances of its own for a solid that the judge has in another form; null: distanceTo().
    std::vector<std::function<double(dvec3)>> distances{};
};

/// One solid as `sdf` and a one-sided `ior`; several as `sdf.S0`, `ior.S0`, and so on, in their
/// order and with their priorities.
volume::Volume volumeOf(const judge::Glass& glass, const Voxels& voxels = {});

// ---- rays of pictures

/// A parallel view along `direction` with `target` in its middle, eye 80 voxels before it.
view::Params along(const dvec3& direction, const dvec3& target, double height,
                   const glm::ivec2& size);

/// One ray.
view::Params oneRay(const judge::Ray& ray);

/// The ray through the centre of a pixel of a parallel view, on the eye's plane.
judge::Ray rayOf(const view::Params& params, int x, int y);

/// A view with all that sharp boundaries need.
view::Params sharply(view::Params params);

// ---- found and wanted

/// The angle between two directions [degree].
double degreesBetween(const dvec3& a, const dvec3& b);

/// How far the farthest ray is from the judge's.
struct Off {
    double degrees = 0; ///< of the direction it leaves in
    double place = 0;   ///< of where it leaves the domain, across the ray [voxel]
    double optical = 0; ///< of its optical path length [voxel]
    int rays = 0;
    judge::Ray worst{}; ///< the ray that is farthest off in direction
};

/// Compares the transmitted path of every pixel whose ray `counts`. Voxels of size 1.
Off offOf(const view::Look& look, const view::Params& params, const judge::Glass& glass,
          const std::function<bool(const judge::Ray&)>& counts);

/// Impact parameter of a ray past a point, over a radius.
double impactOf(const judge::Ray& ray, const dvec3& centre, double radius);

/// Nearer than this to a hull's edge [voxel] a spline of its distance is not flat: the distance has
/// kinks there, which run inwards at half the edge's angle. From here on they are 3.5 voxels off.
constexpr double kEdge = 5.5;

/// Whether a ray is one whose direction can be told: it meets hulls away from their edges, and a
/// thousandth of a voxel aside it turns by less than 0.011° more or less: what it does in a ball of
/// glass of 26 voxels at 0.95 of the radius, up to where the requirements hold directions to 0.01°.
bool tellable(const judge::Glass& glass, const judge::Ray& ray);

/// The largest difference between a picture's radiance in a uniform background of 1 and what the
/// judge's tree leaves of it, over the pixels that `counts` chooses. Left out are those that have
/// another tree a hundredth of a voxel aside, since rounding decides on it, and those that have a
/// branch near an edge.
double energyOff(const view::Look& look, const view::Params& params, const judge::Glass& glass,
                 const std::function<bool(const judge::Ray&)>& counts, int* rays = nullptr);

// ---- surroundings

/// A lat-long map of radiance by direction, three channels; see docs/contract.md.
image::Image mapOf(const std::function<dvec3(dvec3)>& radiance, int width = 512);

} // namespace eikonal::sharp
