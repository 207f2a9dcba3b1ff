// Traces rays through closed-form media to rounding, as the reference that steps are judged by.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/media.h"

namespace judge {

struct Ray {
    dvec3 x;         ///< [voxel]
    dvec3 direction; ///< of any length but 0
};

struct Exit {
    dvec3 x;              ///< [voxel], exactly on the face it left by, or on the medium's edge
    dvec3 direction;      ///< of length 1
    double opticalLength; ///< ∫ n ds within the box [voxel]
    double pathLength;    ///< ∫ ds within the box [voxel]
    double drift;         ///< the largest | |w| − n | met: the integrator's own error meter
    bool left;            ///< false: stopped after mostLength, still within
};

/// Follows dx/dτ = w, dw/dτ = ½∇(n²) with w = n dx/ds through the box [low, high]. A ray from
/// outside is first brought straight to the box, whose faces do not refract; one that misses the
/// box comes back as it went, with lengths of 0. Where the medium is a single part with an edge the
/// ray leaves there, too, to rounding.
/// tolerance: error of one step (Fehlberg's formula of order 8), relative to half the box's longest
/// edge; mostLength: where to stop a trapped ray [voxel].
/// Throws std::invalid_argument for an empty box or no direction, std::runtime_error where the
/// field is not finite, or not smooth within a part.
Exit trace(const Medium& medium, const Ray& ray, dvec3 low, dvec3 high, double tolerance = 1e-13,
           double mostLength = 1e5);

} // namespace judge
