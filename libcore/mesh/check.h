// Whether a mesh bounds a volume, and if not, why: what stands between a file and voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>
#include <vector>

namespace eikonal::mesh {

/// What checkMesh() found. Faces with a repeated corner count as degenerate and nowhere else.
struct MeshReport {
    size_t points = 0;
    size_t triangles = 0;
    size_t degenerateFaces = 0;  ///< of no area: a repeated corner, or three exactly in a line
    size_t duplicateFaces = 0;   ///< more faces on the same three corners than one
    size_t boundaryEdges = 0;    ///< with a single face
    size_t holes = 0;            ///< connected groups of those edges
    size_t nonManifoldEdges = 0; ///< with more than two faces
    size_t components = 0;       ///< groups of faces joined by edges
    bool closed = false;         ///< every edge has an even number of faces, and there are faces
    bool oriented = false;       ///< at no edge do faces disagree about which side is out
    /// Closed, oriented, of positive volume, and no component looks inward unless it is a cavity,
    /// that is, lies within another.
    bool outward = false;
    size_t selfIntersectingPairs = 0; ///< pairs of faces that meet in more than what they share
    size_t buried = 0; ///< components that look outward within others: solid, and no cavity
    double volume = 0; ///< of the solid, signed [unit³]; means nothing while the mesh is open

    /// Ready to be voxelised: closed, oriented and outward. Crossing faces do not hinder that.
    bool boundsVolume() const { return closed && oriented && outward; }

    /// The report in plain words: the size first, then one sentence per fault, none when sound.
    std::vector<std::string> sentences() const;
};

/// At this many crossing pairs the search ends: thousands of stacked faces would yield billions.
constexpr size_t kMaxReportedPairs = 1000000;

/// Takes any soup of finite points and indices in range; changes nothing.
MeshReport checkMesh(const TriangleMesh& mesh);

/// checkMesh() without the search for crossing faces, which takes most of its time.
MeshReport checkTopology(const TriangleMesh& mesh);

} // namespace eikonal::mesh
