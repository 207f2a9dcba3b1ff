// Refractive index as closed formulas: what the judge traces rays through, with no voxel anywhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

namespace judge {

using glm::dvec3;
using Scalar = std::function<double(dvec3)>;
using Vector = std::function<dvec3(dvec3)>;
using Profile = std::function<double(double)>;

/// A region with a formula of its own. The formula goes on smoothly past the region's edge, so that
/// an integrator's trial points beyond the edge do no harm.
struct Part {
    Scalar where; ///< signed distance to the edge [voxel], negative within; none: everywhere
    Scalar index; ///< n [1]
    Vector force; ///< ½∇(n²) [1/voxel]
};

/// A refractive index field. Lengths are in voxels, or in any one unit.
struct Medium {
    std::string name;
    Scalar index; ///< n [1]
    Vector force; ///< ½∇(n²) [1/voxel]
    /// Where the field is not smooth: a point belongs to the first part it is within, and the last
    /// is everywhere. n must be continuous from part to part. Empty: one smooth formula. A single
    /// part that is not everywhere: nothing is known beyond its edge, and rays end on it.
    std::vector<Part> parts;
    /// No step may be longer [voxel], or it might leap over a thin layer unseen.
    double longestStep = std::numeric_limits<double>::infinity();
};

/// n² = n0sq + 2 a·x; the ray is a parabola. n² must stay positive in the box. [a] = 1/voxel
Medium linearSquared(double n0sq, dvec3 a);

/// n² = n0² (1 − g² ρ²), ρ the distance from the axis through `centre` along z: a harmonic
/// oscillator (the ideal GRIN rod of Saleh and Teich, Fundamentals of Photonics §1.3). g is
/// in [1/voxel].
Medium grinRod(double n0, double g, dvec3 centre);

/// n² = 2 − r²/R² up to the rim r = R, 1 beyond it (Luneburg, Mathematical Theory of Optics, 1944).
Medium luneburg(dvec3 centre, double radius);

/// n² = 2 − r²/R² with no rim: smooth, and positive to r = √2 R.
Medium luneburgCore(dvec3 centre, double radius);

/// n = 2 / (1 + r²/R²); rays are circles (Maxwell 1854; Born and Wolf §4.2.2).
Medium maxwellFishEye(dvec3 centre, double radius);

/// n² = n0sq + gain (1 − exp(−(y − y0)/scale)): falls ever faster downwards and turns rays back up,
/// as hot ground does.
Medium layeredExponential(double n0sq, double gain, double y0, double scale);

/// Any n(y), with its derivative [1/voxel].
Medium layered(std::string name, Profile n, Profile slope,
               double longestStep = std::numeric_limits<double>::infinity());

/// Any spherical index n(r), with its derivative [1/voxel].
Medium radial(std::string name, dvec3 centre, Profile n, Profile slope,
              double longestStep = std::numeric_limits<double>::infinity());

/// n(r) = 1 + (n − 1)/2 erfc((r − R)/(σ√2)): a ball of index n in vacuum with an edge of standard
/// deviation σ. It is the Gaussian blur of a step in r; that of a ball differs by terms of σ/R.
Medium blob(dvec3 centre, double radius, double sigma, double n);
Profile blobIndex(double radius, double sigma, double n);
Profile blobSlope(double radius, double sigma, double n);

/// n = n− + (n+ − n−)/2 erfc(−d/(σ√2)), d = normal·(x − point): the Gaussian blur, of standard
/// deviation σ, of a plane between n− behind and n+ ahead of it. Exact, and layered along `normal`.
Medium step(dvec3 point, dvec3 normal, double behind, double ahead, double sigma);

} // namespace judge
