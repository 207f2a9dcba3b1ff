// What smoothing a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/plan.h"

#include "base/text.h"
#include "smooth/kernel.h"

#include <algorithm>

namespace eikonal::smooth {

namespace {

/// Only the grids that bend or bound light (Sun et al. 2008, §4.1).
const std::vector<std::string> kDefaultGrids = {"ior", "opacity"};

bool constant(const volume::DenseGrid& grid) {
    const auto count = static_cast<size_t>(grid.components);
    for (size_t i = count; i < grid.values.size(); ++i)
        if (grid.values[i] != grid.values[i - count]) return false;
    return true;
}

} // namespace

Plan makePlan(const volume::Volume& volume, const Params& params) {
    Plan plan;
    plan.size = volume.domain().size();
    plan.weights = gaussianWeights(params.sigma, params.width());
    const bool wide = params.sigma > 0 && plan.weights.size() > 1;
    const std::string size =
        "sigma " + toText(params.sigma) + ", " + std::to_string(params.width()) + " taps";
    std::vector<std::string> seen;
    for (const std::string& grid : params.automaticGrids ? kDefaultGrids : params.grids) {
        if (std::find(seen.begin(), seen.end(), grid) != seen.end()) continue;
        seen.push_back(grid);
        const bool present = volume.has(grid);
        if (!present && !params.automaticGrids) volume.require(grid);
        if (!present) {
            plan.effects.push_back({grid, false, "no grid '" + grid + "'"});
            continue;
        }
        Item item{grid, {}, volume.dense(grid, volume.domain())};
        if (!wide) {
            plan.effects.push_back({grid, false, size});
        } else if (constant(item.values)) {
            plan.effects.push_back({grid, false, "it has one value"});
        } else {
            item.background = volume.background(grid, glm::vec3(0));
            plan.items.push_back(std::move(item));
            plan.effects.push_back({grid, true, size});
        }
    }
    return plan;
}

} // namespace eikonal::smooth
