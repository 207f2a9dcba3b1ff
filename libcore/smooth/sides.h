// Where a grid's values are those of one object or of the medium alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <string>
#include <vector>

namespace eikonal::smooth {

/// The objects of a volume, and which voxels the one-sided grids hold values for.
class Sides {
public:
    /// `volume` must outlive this. Throws DataError on level sets that are none.
    explicit Sides(const volume::Volume& volume);

    const std::vector<volume::ObjectFacts>& objects() const { return mObjects; }

    /// Per voxel of the domain 1 where the grid's values are valid, else 0; nothing for a grid that
    /// is valid everywhere.
    std::vector<float> countsOf(const std::string& grid) const;

private:
    std::vector<float> countsBy(const volume::ObjectFacts& object, float side) const;

    const volume::Volume& mVolume;
    std::vector<volume::ObjectFacts> mObjects;
};

} // namespace eikonal::smooth
