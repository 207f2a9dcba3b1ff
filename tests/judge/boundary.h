// The next boundary on a ray's way through solids, and what leaves it: for followers of rays.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/glass.h"

namespace judge {

/// Boundaries nearer to each other than this are one [voxel].
constexpr double kTouching = 1e-9;

/// Where the line x + t d, d of length 1, is within a solid; enter > leave: nowhere.
struct Chord {
    double enter, leave;
    dvec3 enterNormal, leaveNormal; ///< outward
};
Chord chordOf(const Solid& solid, const dvec3& x, const dvec3& d);

/// The solid that a ray is in just after its start.
int solidAt(const Glass& glass, const Ray& ray);

double indexAt(const Glass& glass, int solid, const dvec3& x);

/// The way from a place within `from` to the boundary to another solid.
struct Piece {
    bool meets; ///< false: none ahead, and the lengths are 0
    Met met;
    dvec3 direction; ///< as it arrives, of length 1
    double pathLength, opticalLength;
};
Piece pieceOf(const Glass& glass, const Ray& ray, int from);

dvec3 refracted(const dvec3& direction, const Met& met);
dvec3 reflected(const dvec3& direction, const Met& met);

/// The two ways on from a boundary, those of no power left out; calls
/// visit(direction, solid, share, letter).
template<typename Visit> void waysOn(const Piece& piece, const Visit& visit) {
    const Met& met = piece.met;
    if (met.reflected < 1) visit(refracted(piece.direction, met), met.to, 1 - met.reflected, 'T');
    if (met.reflected > 0) visit(reflected(piece.direction, met), met.from, met.reflected, 'R');
}

/// Follows a ray's whole tree: onPiece(from, to, weight) for every straight piece between
/// boundaries, onLeft(ray, weight, course) for every branch that leaves, onDeep(ray, weight,
/// course) for one that would meet too many boundaries, onDropped(weight) for what is too faint to
/// follow and onWeight(weight) for every weight held against minThroughput.
template<typename Visitor>
void followTree(const Glass& glass, const Ray& ray, int solid, double weight, int depth,
                std::string& course, const Limits& limits, Visitor& visitor) {
    const Piece piece = pieceOf(glass, ray, solid);
    if (!piece.meets) {
        visitor.onLeft(ray, weight, course);
        return;
    }
    visitor.onPiece(ray.x, piece.met.x, weight);
    if (depth == limits.maxDepth) {
        visitor.onDeep({piece.met.x, ray.direction}, weight, course);
        return;
    }
    waysOn(piece, [&](const dvec3& direction, int into, double share, char letter) {
        const double left = weight * share;
        visitor.onWeight(left);
        if (left < limits.minThroughput) {
            visitor.onDropped(left);
            return;
        }
        course.push_back(letter);
        followTree(glass, {piece.met.x, direction}, into, left, depth + 1, course, limits, visitor);
        course.pop_back();
    });
}

} // namespace judge
