// A mesh's triangles in the sub-samples of a lattice, ready to be drawn.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"
#include "voxelize/lattice.h"
#include "voxelize/shared.h"

#include <cstdint>
#include <vector>

namespace eikonal::voxelize {

/// A mesh placed in a lattice, handing out the facets that touch some rows of it.
class FacetSource {
public:
    FacetSource(const mesh::TriangleMesh& mesh, const Lattice& lattice);

    /// Starts again with the rows [firstRow, firstRow + rows) [voxel].
    void seek(int firstRow, int rows);
    /// Replaces `facets` by the next ones, about `count` at most; none at the end.
    void next(std::vector<Facet>& facets, size_t count);

private:
    void addClipped(const glm::dvec3* corners, std::vector<Facet>& facets) const;
    void addFacet(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                  std::vector<Facet>& facets) const;

    struct Rows {
        double low, high;
    };

    const mesh::TriangleMesh& mMesh;
    std::vector<glm::dvec3> mPoints; ///< [sample], from the domain's low corner
    std::vector<Rows> mRows;         ///< of each triangle, since every strip asks all [sample]
    double mView, mDeepest;          ///< [sample]
    int mSupersample;
    double mFrom = 0, mTo = 0; ///< rows looked for [sample]
    size_t mNext = 0;          ///< first triangle not looked at yet
};

} // namespace eikonal::voxelize
