// Solids of glass with sharp boundaries: Snell's and Fresnel's laws, every ray that they make of
// one. SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/snell.h"
#include "judge/trace.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace judge {

// ---- scenes. Lengths are in voxels, or in any one unit of a size like a scene's: boundaries that
// touch to 1e-9 of it are one, and what is thinner is not there.

/// The half space normal·x < offset; the normal points out and has length 1.
struct Plane {
    dvec3 normal;
    double offset; ///< [voxel]
};

/// A convex solid: a ball, or where half spaces are given what they have in common.
struct Solid {
    dvec3 centre{0};
    double radius = 0;            ///< [voxel]
    std::vector<Plane> planes;    ///< none: a ball
    double index = 1.5;           ///< n [1], where the index is constant
    std::optional<Part> graded{}; ///< a ball's index where it varies; its edge is not asked for
    int priority = 0;
};

Solid glassBall(dvec3 centre, double radius, double index, int priority = 0);
Solid glassBox(dvec3 low, dvec3 high, double index, int priority = 0);
Solid glassHull(std::vector<Plane> planes, double index, int priority = 0);
/// n² = rim² (2 − r²/R²): a Luneburg lens whose index at its rim is not that around it.
Solid luneburgBall(dvec3 centre, double radius, double rim);
/// Any n(r), with its derivative [1/voxel].
Solid gradedBall(dvec3 centre, double radius, Profile n, Profile slope);

/// Where solids overlap the one of higher priority is there, of equals the later. Nothing else may
/// be within a graded one. At most 64 solids.
struct Glass {
    std::vector<Solid> solids;
    double around = 1; ///< n outside them all [1]
};

constexpr int kAround = -1; ///< what stands for the surroundings among the solids' numbers

// ---- one ray

/// A boundary that a ray met.
struct Met {
    dvec3 x;
    dvec3 normal; ///< against the ray as it came, of length 1
    int from, to; ///< solids, or kAround
    double ratio; ///< n beyond over n before [1]
    double cosIncidence;
    double reflected; ///< the mean of both polarisations' shares; 1 where reflection is total
};

/// A ray that refracts where it can and reflects only where that is total.
struct Path {
    Ray ray;                          ///< on its way from the last boundary, direction of length 1
    bool left;                        ///< false: it still was in glass after so many boundaries
    double pathLength, opticalLength; ///< from the start to the last boundary [voxel]
    std::vector<Met> met;
};
Path followTransmitted(const Glass& glass, const Ray& ray, int mostMet = 1000);

/// The same as it leaves the box [low, high], which holds all solids; lengths count within it. A
/// ray that misses the box comes back as it went, with lengths of 0.
Exit exitOf(const Glass& glass, const Ray& ray, dvec3 low, dvec3 high);

// ---- all that becomes of one ray

/// How far it is followed.
struct Limits {
    int maxDepth = 8;            ///< boundaries that a branch may meet; at one more it is dropped
    double minThroughput = 1e-3; ///< share of the power below which a branch is dropped [1]
};

struct Branch {
    Ray ray;       ///< on its way from the last boundary, direction of length 1
    double weight; ///< share of the power [1]; each boundary takes the mean of the polarisations
    std::string course; ///< "TRT": in, reflected inside once, out
};

struct Tree {
    std::vector<Branch> left;
    std::vector<Branch> deep; ///< that would meet too many boundaries, as they come to the next one
    double tooDeep = 0, tooFaint = 0; ///< shares of the power that were dropped
    /// The nearest that a branch's weight came to minThroughput, as |weight/minThroughput − 1|:
    /// where that is a rounding, which side it falls on is chance.
    double closestCall = 1;
    std::vector<dvec3> met; ///< where boundaries were met, by any branch
    double sum() const;     ///< of the weights of what left
};
Tree followAll(const Glass& glass, const Ray& ray, const Limits& limits = {});

/// Radiance that arrives at a ray's start from where it points to, for the radiance of the
/// surroundings by direction (from the eye outwards): (n at the eye / n around)² Σ weight · L. What
/// would meet too many boundaries sees what is straight ahead.
double radiance(const Glass& glass, const Ray& ray, const std::function<double(dvec3)>& environment,
                const Limits& limits = {});

// ---- parallel light

struct Beam {
    dvec3 direction{0, -1, 0}; ///< where the light goes, of any length but 0
    double irradiance = 1;     ///< across the direction [W/voxel²]
    double photons = 1e6;      ///< over a disc just large enough for the grid and all solids
    Limits limits{};
};

/// Power of the photons that meet glass [W]: met = left + dropped.
struct BeamBook {
    double met = 0, left = 0, dropped = 0;
};

/// Fluence [W/voxel²] by track lengths, as ballFluence has it, with every reflection followed: a
/// photon is split at a boundary, so that no chance decides. The grid may be as thin a slab as is
/// wanted and need not hold the solids. No solid may be graded; throws std::invalid_argument.
std::vector<double> beamFluence(const Glass& glass, const Beam& beam, const Grid& grid,
                                BeamBook* book = nullptr);

} // namespace judge
