// Where a light's map is aimed at: the parts of it through which something is seen that light
// meets. SPDX-License-Identifier: GPL-3.0-or-later
//
// Elsewhere light goes straight through a medium that is the same everywhere, and what it leaves
// there follows by Beer's law: photons go where they are needed.
#pragma once

#include "lightsim/photon_map.h"
#include "lightsim/plan.h"

#include <cstdint>
#include <vector>

namespace eikonal::lightsim {

/// A window of a light's map by square tiles.
struct AimedMap {
    Window window;
    int across = 0; ///< tiles along x
    /// Of each tile, x fastest: 0 where light meets nothing.
    std::vector<std::uint32_t> tiles;
};

class Aims {
public:
    explicit Aims(const Plan& plan);

    /// Whether all of a map is aimed at.
    bool everywhere() const { return mEverywhere; }

    /// By tiles of `edge`² pixels.
    AimedMap mapOf(const Window& window, int edge) const;

private:
    std::vector<VoxelBox> mBoxes;
    bool mEverywhere;
};

} // namespace eikonal::lightsim
