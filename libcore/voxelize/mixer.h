// Coverage to material: what each voxel's share of the objects makes of its values.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"
#include "voxelize/counts.h"
#include "voxelize/grids.h"
#include "voxelize/lattice.h"

#include <cstdint>
#include <vector>

namespace eikonal::voxelize {

/// Shares each voxel among the objects and fills the grids of a volume, some rows at a time.
///
/// Objects take their coverage in order of precedence, each as much as is left; the rest is the
/// surrounding medium. So objects that abut within a voxel fill it wholly. To multiply by what
/// those before left over would suit objects scattered at random and leave a quarter of the voxel
/// between two halves: a film of air in every joint.
class Mixer {
public:
    /// `params` must outlive the mixer.
    Mixer(const Params& params, const std::vector<Grid>& grids, const Lattice& lattice);

    /// `counts` holds per object the samples inside, of rows from `firstRow` on, which begin with a
    /// brick's and end with one's or with the volume's.
    void mix(const std::vector<Counts>& counts, int firstRow);

    /// Voxels that some object covers, and those that object `k` covers.
    std::int64_t occupied() const { return mOccupied; }
    std::int64_t covered(size_t k) const { return mCovered[k]; }

    /// Hands over the values of a grid.
    volume::BrickGrid take(Grid grid);
    /// Whether any value of a filled grid is not the background.
    bool showsSomething(Grid grid) const;

private:
    struct Filled {
        Grid grid{};
        volume::BrickGrid bricks;
        glm::dvec3 fallback{0};
        std::vector<glm::dvec3> values; // per object, the medium last
        std::vector<double> weights;
        std::vector<glm::vec3> alone; // what is stored where there is nothing else
    };
    /// Whose samples a voxel has, of those that have some in its brick and, last, the medium.
    struct Shares {
        std::vector<size_t> takers; ///< the objects' numbers, first come first served
        std::vector<size_t> sorted; ///< all numbers, the medium's last
        std::vector<int> samples;   ///< by number
    };
    /// A row of bricks along x, mixed.
    struct Slab {
        std::int64_t occupied = 0;
        std::vector<std::int64_t> covered;
        std::vector<size_t> uneven;             ///< bricks
        std::vector<std::vector<float>> values; ///< of them, per grid
        Shares shares;                          ///< of the voxel at hand
    };
    class Brick;
    void mixBrick(const Brick& brick, size_t place, Slab& slab);
    void tally(const Brick& brick, size_t voxel, std::int64_t times, Shares& shares,
               Slab& slab) const;
    void store(const Shares& shares, size_t grid, float* out) const;
    static glm::vec3 meanOf(const Filled& grid, const Shares& shares);
    void takeIn(const Slab& slab);
    size_t indexOf(Grid grid) const;

    const Params& mParams;
    glm::ivec3 mSize;
    int mMost;
    std::vector<size_t> mOrder; // of objects, first come first served
    std::vector<Filled> mGrids;
    std::int64_t mOccupied = 0;
    std::vector<std::int64_t> mCovered;
};

} // namespace eikonal::voxelize
