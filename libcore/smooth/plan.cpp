// What smoothing a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/plan.h"

#include "base/text.h"
#include "smooth/kernel.h"
#include "smooth/sides.h"

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

/// What is smoothed where nothing is asked for.
std::vector<std::string> automaticGrids(const volume::Volume& volume, const Sides& sides) {
    std::vector<std::string> grids = kDefaultGrids;
    for (const volume::ObjectFacts& object : sides.objects())
        grids.push_back(volume::ownGrid("ior", object.name));
    grids.push_back(volume::ownGrid("ior", volume::kMedium));
    std::erase_if(grids, [&](const std::string& grid) {
        const bool always =
            std::find(kDefaultGrids.begin(), kDefaultGrids.end(), grid) != kDefaultGrids.end();
        return !always && !volume.has(grid);
    });
    return grids;
}

/// An index of doubles, and its background, as what exceeds a float near them all, so that a faint
/// contrast keeps its digits. Nothing changes where floats hold the grid.
void takeDifferences(const volume::Volume& volume, Item& item) {
    if (item.grid != "ior") return;
    const volume::BrickGrid rest = volume.remainders(item.grid, volume.domain());
    if (rest.page.empty()) return;
    item.base = double{item.background.x};
    size_t next = 0;
    for (int z = 0; z < rest.size.z; ++z)
        for (int y = 0; y < rest.size.y; ++y)
            for (int x = 0; x < rest.size.x; ++x) {
                float& value = item.values.values[next++];
                value = static_cast<float>(double{value} - *item.base + double{rest.at({x, y, z})});
            }
    // Beyond all active voxels, further off than a node of OpenVDB's tree is long.
    const glm::ivec3 outside = volume.domain().max + 2 * 4096;
    const volume::BrickGrid beyond = volume.remainders(item.grid, {outside, outside});
    item.background = glm::vec3(beyond.page.empty() ? 0.0f : beyond.at(glm::ivec3(0)));
}

/// The grid with what tells how to smooth it; nothing if it has one value.
std::optional<Item> itemOf(const volume::Volume& volume, const Sides& sides,
                           const std::string& grid) {
    if (volume.constant(grid)) return {};
    Item item{grid, volume.background(grid, glm::vec3(0)), volume.dense(grid, volume.domain())};
    takeDifferences(volume, item);
    if (constant(item.values)) return {};
    for (const volume::ObjectFacts& object : sides.objects())
        if (object.sdf == grid) item.object = object;
    if (item.object)
        item.halfWidth = item.background.x / volume.frame().voxelSize;
    else
        item.counts = sides.countsOf(grid);
    return item;
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
    const Sides sides(volume);
    for (const std::string& grid :
         params.automaticGrids ? automaticGrids(volume, sides) : params.grids) {
        if (std::find(seen.begin(), seen.end(), grid) != seen.end()) continue;
        seen.push_back(grid);
        const bool present = volume.has(grid);
        if (!present && !params.automaticGrids) volume.require(grid);
        if (!present) {
            plan.effects.push_back({grid, false, "no grid '" + grid + "'"});
            continue;
        }
        std::optional<Item> item = itemOf(volume, sides, grid);
        if (!wide) {
            plan.effects.push_back({grid, false, size});
        } else if (!item) {
            plan.effects.push_back({grid, false, "it has one value"});
        } else {
            plan.effects.push_back(
                {grid, true, size + (item->counts.empty() ? "" : ", one-sided")});
            plan.items.push_back(std::move(*item));
        }
    }
    return plan;
}

} // namespace eikonal::smooth
