// How much of each voxel lies inside a mesh: crossings from the device, summed up by the host.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "voxelize/counts.h"
#include "voxelize/facets.h"

#include <cstdint>
#include <vector>

namespace eikonal::voxelize {

/// What the device holds at once for a lattice, for Device::requireFit().
std::vector<gpu::Need> coverageNeeds(const Lattice& lattice, std::int64_t stripBytes);

/// Counts, strip by strip of rows along y, the sub-samples of each voxel inside a mesh.
///
/// Sun et al. 2008, §4.1, draw the mesh once per slice of a volume four times as fine along each
/// axis, draw it again at the final size, compare 3×3×3 neighbours and average 4×4×4 samples where
/// they differ. That costs the mesh once per slice and 64 times the memory, and misses what is
/// thinner than a voxel, since the coarse volume does not see it. Here one draw suffices: a
/// fragment is the place where a sub-column crosses the surface, and how many samples of each
/// voxel from there on lie inside is a step function of depth with its ramp inside one voxel. So
/// each fragment adds two differences to the coarse volume, and a sum along the columns gives all
/// S×S×S samples of every voxel, exactly, for the price of the surface. Sums of integers do not
/// depend on their order.
class Coverage {
public:
    Coverage(gpu::Device& device, const Lattice& lattice, std::int64_t stripBytes = kStripBytes);

    int rowsPerStrip() const { return mRows; }

    /// The samples inside `mesh`, 0 to S³, of rows [firstRow, firstRow + rows), at most
    /// rowsPerStrip(). Shells that overlap count as one solid, but in voxels
    /// where both their surfaces pass up to twice the shared part is counted.
    Counts count(FacetSource& mesh, int firstRow, int rows);

private:
    gpu::Device& mDevice;
    Lattice mLattice;
    int mRows;
    gpu::Program mCrossings;
    gpu::Buffer mChanges, mFacets, mParams;
};

} // namespace eikonal::voxelize
