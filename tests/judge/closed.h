// Rays solved on paper, with no stepping: what the judge's own tracer is judged by.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/trace.h"

#include <optional>
#include <utility>

namespace judge {

/// A point of a ray. Solutions run along τ [voxel], dτ = ds/n, unless they say otherwise.
struct Point {
    dvec3 x;              ///< [voxel]
    dvec3 w;              ///< n dx/ds [1]
    double opticalLength; ///< ∫ n ds since the ray's start [voxel]
};

/// n² = n0sq + 2 a·x: x = x0 + w0 τ + ½ a τ².
Point parabola(double n0sq, dvec3 a, const Ray& ray, double tau);
/// ∫ ds along it [voxel].
double parabolaLength(double n0sq, dvec3 a, const Ray& ray, double tau);
/// The first τ > 0 at which x[axis] is `value`; none if it turns before.
std::optional<double> parabolaTau(double n0sq, dvec3 a, const Ray& ray, int axis, double value);

/// n² = n0² (1 − g² ρ²) about z, at the plane z, where the ray is bound for: across the axis it
/// swings with frequency n0 g in τ, along it w_z is constant.
Point grinRodAt(double n0, double g, dvec3 centre, const Ray& ray, double z);

/// n² = 2 − r²/R²: x swings about the centre with frequency 1/R in τ, along an ellipse.
Point luneburgCoreAt(dvec3 centre, double radius, const Ray& ray, double tau);
/// Where a ray from outside leaves a Luneburg lens: at centre + R·direction, all parallel rays in
/// one point, after πR/2 of τ. None if it misses.
std::optional<Point> luneburgExit(dvec3 centre, double radius, const Ray& ray);

/// The fish-eye is a sphere of radius R in four dimensions seen by stereographic projection, and
/// rays are its great circles; optical length [voxel] is arc length on it.
Point fishEyeAt(dvec3 centre, double radius, const Ray& ray, double opticalLength);
/// One turn has an optical length of 2πR, whatever the circle.
double fishEyePeriod(double radius);
/// The circle's centre and radius [voxel]; the radius is infinite for a ray through the middle.
std::pair<dvec3, double> fishEyeCircle(dvec3 centre, double radius, const Ray& ray);
/// −R² x/|x|² from the centre: where all rays from x meet again, after half a turn.
dvec3 fishEyeImage(dvec3 centre, double radius, dvec3 x);

/// What Snell's law keeps in layers of n(y): the part of w along the layers (n cosθ, θ from them).
dvec3 layeredInvariant(dvec3 w);
/// The height in [low, high] at which n(y) equals the invariant's length, given that
/// n − invariant changes sign there. Throws std::invalid_argument otherwise.
double turningHeight(const Profile& n, double invariant, double low, double high);
/// n² = n0sq + gain (1 − exp(−(y − y0)/scale)). With E = n0sq + gain − invariant² and
/// q = √E (τ − τ0)/(2 scale): exp((y − y0)/scale) = (gain/E) cosh² q, w_y = √E tanh q.
Point layeredExponentialAt(double n0sq, double gain, double y0, double scale, const Ray& ray,
                           double tau);
/// y0 + scale ln(gain/E), the lowest point of the ray through (x, w) [voxel].
double layeredExponentialTurn(double n0sq, double gain, double y0, double scale, dvec3 w);

/// n r sinφ about the centre as a vector, r × w [voxel]: constant in any spherical index, so that
/// the ray stays in one plane, too (Bouguer's rule; Born and Wolf §3.2.1).
dvec3 radialInvariant(dvec3 centre, dvec3 x, dvec3 w);

struct RadialPass {
    double turningRadius; ///< of the point nearest the centre [voxel]
    double deflection;    ///< towards the centre [rad]
    double opticalLength; ///< from `outer` to `outer` [voxel]
};
/// A ray of impact parameter b through n(r), whose slope is 0 from r = outer on:
/// deflection = −2 m ∫ n'/n dr / √(n²r² − m²), m = n(outer) b, from the turning point to `outer`
/// (the inverse of Abel's integral; Born and Wolf §3.2.1, Fjeldbo et al. 1971), by adaptive
/// Gauss–Kronrod quadrature. For 0 ≤ b < outer.
RadialPass radialPass(const Profile& n, const Profile& slope, double b, double outer);

/// The direction that a ray bound along `direction` from x leaves in, and where it leaves the
/// sphere r = outer, after radialPass.
Ray radialExit(dvec3 centre, const Ray& ray, const RadialPass& pass, double outer);

} // namespace judge
