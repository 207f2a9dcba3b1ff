// What the regions between sharp boundaries have, and what can be traced of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "medium/regions.h"

#include "base/error.h"

#include <algorithm>

namespace eikonal::medium {

Index varyingIndex(const Objects& objects, const std::string& path) {
    Index index;
    index.background = objects.regions.back().index.value.x;
    index.least = index.most = index.background;
    for (const Region& region : objects.regions) {
        if (!region.index.varies()) continue;
        if (index.varies())
            throw DataError(path + ": the index varies in '" + region.name +
                            "' and elsewhere, expected it to vary on one side of sharp boundaries "
                            "at most");
        const auto& values = region.index.grid.values;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        index.least = *least;
        index.most = *most;
        index.grid = region.index.grid;
    }
    return index;
}

void requireConstants(const Objects& objects, const std::string& path,
                      const std::vector<std::pair<const char*, RegionValues>>& grids) {
    for (const Region& region : objects.regions)
        for (const auto& [grid, values] : grids)
            if ((region.*values).varies())
                throw DataError(path + ": grid '" + grid + "' of '" + region.name +
                                "' varies, expected one value on each side of sharp boundaries "
                                "(--boundary blurred takes any)");
}

bool anyHas(const Objects& objects, RegionValues values) {
    return std::any_of(objects.regions.begin(), objects.regions.end(),
                       [&](const Region& region) { return !(region.*values).isZero(); });
}

std::string whoHas(const Objects& objects, RegionValues values) {
    for (const Region& region : objects.regions)
        if (!(region.*values).isZero()) return "'" + region.name + "' has it";
    return "nothing has it";
}

std::pair<bool, std::string> whatRefracts(const Objects& objects) {
    for (const Region& region : objects.regions)
        if (region.index.varies() || region.index.value != objects.regions.back().index.value)
            return {true, "'" + region.name + "' has an index of its own"};
    return {false, "the index is the same everywhere"};
}

} // namespace eikonal::medium
