// What the regions between sharp boundaries have, and what can be traced of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "medium/objects.h"

#include <string>
#include <utility>
#include <vector>

namespace eikonal::medium {

/// A grid's values in a region, whichever that is.
using RegionValues = OneSided Region::*;

/// One index grid for all regions whose index varies, or an index that does not: each voxel has the
/// value of the varying object that is nearest, so that look-ups within one object, and the few
/// voxels round it that they reach, find its own values alone. `path` is the file's. Throws
/// DataError where two regions that vary come closer than that.
Index varyingIndex(const Objects& objects, const std::string& path);

/// Throws DataError naming grid and region if one of these grids varies within a region.
void requireConstants(const Objects& objects, const std::string& path,
                      const std::vector<std::pair<const char*, RegionValues>>& grids);

/// Says of each object whose distances are not distances: they grow by more than 1 a voxel, so that
/// rays may leap over a boundary.
std::vector<std::string> distanceWarnings(const Objects& objects);

/// Whether some region has values that are not 0.
bool anyHas(const Objects& objects, RegionValues values);
/// Who has, in words.
std::string whoHas(const Objects& objects, RegionValues values);

/// Whether some boundary or index bends rays, and who makes it, in words.
std::pair<bool, std::string> whatRefracts(const Objects& objects);

} // namespace eikonal::medium
