// A solid that a profile of arcs and lines makes when it is turned round the y axis, and the rays
// that Snell's law makes of one. SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/glass.h"

#include <glm/vec2.hpp>
#include <iosfwd>
#include <vector>

namespace judge {

using glm::dvec2;

/// A piece of a profile, which runs with the solid to its left. Points are (distance from the y
/// axis, y), in any one unit.
struct ProfilePiece {
    dvec2 from{0}, to{0};
    bool curved = false;
    dvec2 centre{0};                         ///< of an arc
    double radius = 0;                       ///< of an arc; 0: a line
    double fromAngle = 0, toAngle = 0;       ///< of an arc, from the x axis [rad]; falling: hollow
    dvec2 at(double share) const;            ///< share of the way along it [1]
    dvec2 outward(const dvec2& point) const; ///< of length 1, for a point of the piece
    double distance(const dvec2& point) const; ///< from its line or circle; negative: in the solid
    bool reaches(const dvec2& point) const;    ///< a point of its line or circle is on the piece
};

/// A closed solid of revolution: its profile starts and ends on the axis and has no corners.
struct Revolved {
    std::vector<ProfilePiece> pieces;
    double index = 1.5; ///< n [1]; 1 around it
};

/// Reads lines "line X0 Y0 X1 Y1" and "arc CX CY RADIUS FROM TO", angles in radians. Throws
/// std::invalid_argument for anything else, and where a piece does not begin as the last one ends,
/// in place and direction, to 1e-9.
Revolved readProfile(std::istream& in, double index = 1.5);

/// Where a line meets the surface.
struct Crossing {
    double t;     ///< along the direction, of length 1
    dvec3 normal; ///< outward, of length 1
};
/// All of them, also behind the start, in order; what lies within 1e-9 of the last is the same.
/// Planes, cylinders, cones and balls by quadratics, tori by a quartic and Newton's steps.
std::vector<Crossing> crossingsOf(const Revolved& solid, const dvec3& x, const dvec3& direction);

/// As followTransmitted() of Glass; `from` and `to` of what is met are 0 for the solid. Throws
/// std::runtime_error where boundaries do not alternate, which says that one was missed.
Path followTransmitted(const Revolved& solid, const Ray& ray, int mostMet = 1000);

} // namespace judge
