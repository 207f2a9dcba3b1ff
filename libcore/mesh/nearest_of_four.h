// The nearest points of four faces to four points at once.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/curved_face.h"

namespace eikonal::mesh {

/// Where a face is nearest to x; without `sides` it is flat.
struct FaceQuestion {
    const glm::dvec3* corners = nullptr; ///< three
    const EdgeCurve* sides = nullptr;    ///< three
    glm::dvec3 x{0};
};

/// Answers four questions, all of flat faces or all of curved ones, by the method of
/// CurvedFace::nearest from flatNearest; of a flat face the height is not told. Gives for which of
/// them (bit k) a step of Newton's method led further off, so that it must be asked itself.
unsigned nearestOfFour(const FaceQuestion (&questions)[4], CurvedFace::Nearest (&answers)[4]);

} // namespace eikonal::mesh
