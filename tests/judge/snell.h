// Snell's and Fresnel's laws for a homogeneous ball in parallel light, and the fluence behind it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace judge {

using glm::dvec3;
using glm::ivec3;

// ---- one boundary. `ratio` is n on the far side over n on the near side [1] throughout.

/// Reflectances for light polarised across (s) and in (p) the plane of incidence; 1 past the
/// critical angle.
struct Reflectance {
    double s, p;
    double mean() const { return 0.5 * (s + p); }
};
Reflectance reflectance(double ratio, double cosIncidence);

// ---- one ray past a ball. `off` is impact parameter over radius [1], 0 ≤ off ≤ 1; `ratio` is n
// inside over n outside. Past the critical angle of a bubble, off > ratio, only order 0 is left.

/// The angle that a ray is turned by after `order` passes through the ball, towards the axis where
/// positive [rad]: (p − 1) π + 2θ_i − 2p θ_t. Order 0 is reflected outside, 1 goes straight
/// through, 2 is reflected inside once. Throws std::invalid_argument where there is no such ray.
double ballDeflection(double ratio, double off, int order = 1);
/// d(deflection)/d(off) of order 1 [rad].
double ballDeflectionSlope(double ratio, double off);
/// Where rays near the axis meet, from the centre: n R/(2 (n − 1)), n the ratio [voxel].
double ballFocus(double ratio, double radius);

/// Shares of a ray's power in orders 0 to 3: R, T², T²R, T²R². `polarised` keeps s and p apart
/// from boundary to boundary, as they stay in a ball, and takes the mean at the end; otherwise
/// each boundary takes the mean, as a tracer of unpolarised light does.
std::array<double, 4> ballOrders(double ratio, double off, bool polarised = true);

/// A point of the caustic, the envelope of rays of order 1: `along` the light from the ball's
/// centre, `across` it, negative beyond the axis [voxel]. Real where it lies outside the ball;
/// the cusp is at off = 0, in the focus.
struct Caustic {
    double along, across;
};
Caustic ballCaustic(double ratio, double radius, double off);

// ---- a ball lit by parallel light, in a grid

enum class Fresnel {
    None,        ///< all power goes through; total reflection reflects
    Unpolarised, ///< each boundary passes on 1 − ½(R_s + R_p); the rest is booked as reflected
    Polarised    ///< the same with s and p kept apart
};

struct BallScene {
    dvec3 centre{0};             ///< [voxel]
    double radius = 1;           ///< [voxel]
    double index = 1.5;          ///< n inside [1]
    double around = 1;           ///< n outside [1]
    dvec3 direction{1, 0, 0};    ///< where the light goes, of any length but 0
    double irradiance = 1;       ///< across the direction [W/voxel²]
    double extinction = 0;       ///< σ_a + σ_s inside [1/voxel]
    double extinctionAround = 0; ///< σ_a + σ_s outside, up to the grid's faces [1/voxel]
    Fresnel fresnel = Fresnel::None;
    double photons = 1e6; ///< that meet the ball; as dense around it
};

/// Cubes of side `voxel` from the corner `low`; of cell (x, y, z) the number is x + nx (y + ny z).
struct Grid {
    dvec3 low{0};
    double voxel = 1;
    ivec3 size{1};
    size_t cells() const;
    size_t cell(ivec3 at) const;
    dvec3 high() const;
    dvec3 middle(ivec3 at) const;
};

/// Where the power went [W]: entered = attenuated + escaped + reflected. What is reflected is not
/// followed, except where reflection is total.
struct Energy {
    double entered = 0, attenuated = 0, escaped = 0, reflected = 0;
};

/// Fluence [W/voxel²] by track lengths: every photon adds power × path length / voxel volume to
/// each cell it crosses, with Beer and Lambert's law integrated along the piece. Photons stand in a
/// sunflower's spiral across the light: equal areas, no chance in it. Light that has been scattered
/// is not followed. The ball must lie within the grid; throws std::invalid_argument otherwise.
std::vector<double> ballFluence(const BallScene& scene, const Grid& grid, Energy* energy = nullptr);

/// The same at a point, by counting the rays through it: fluence is irradiance × b db/(y dy cosδ)
/// for each, infinite on the axis and the caustic. Throws std::invalid_argument for extinction.
double ballFluenceAt(const BallScene& scene, dvec3 x);

// ---- simple scenes

/// Fluence of a beam after `path` in extinction σ: irradiance e^(−σ path) [W/voxel²].
double beerLambert(double irradiance, double extinction, double path);
/// Its mean from path `from` to `to`, as a cell of a grid has it.
double beerLambertMean(double irradiance, double extinction, double from, double to);
/// Fluence of a point light: intensity e^(−σ r)/r² [W/voxel²], intensity in [W/sr].
double inverseSquare(double intensity, double distance, double extinction = 0);
/// Its mean over a cube, by quadrature of eighth order in `parts` slices a side. The light must be
/// outside the cube.
double inverseSquareMean(double intensity, dvec3 light, dvec3 low, double side,
                         double extinction = 0, int parts = 1);

/// Calls visit(cell, length) for every cell that the segment crosses, in order, with the length in
/// each [voxel]; parts outside the grid are left out.
void walk(const Grid& grid, dvec3 from, dvec3 to,
          const std::function<void(size_t cell, double length)>& visit);

} // namespace judge
