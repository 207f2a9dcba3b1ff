// What a light simulation of a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "gpu/device.h"
#include "lightsim/params.h"
#include "medium/field.h"
#include "medium/medium.h"
#include "medium/objects.h"
#include "volume/volume.h"

#include <vector>

namespace eikonal::lightsim {

/// The volume as the light sees it, and which effects are worth simulating.
struct Plan {
    glm::ivec3 size{0};   ///< [voxel]
    double voxelSize = 1; ///< [unit]
    Output outputs = Output::none;
    bool sharp = false;      ///< boundaries are the zeros of signed distances
    bool bends = false;      ///< the index varies, of sharp objects within one region
    bool attenuates = false; ///< something absorbs or scatters
    bool dense = false;      ///< a voxel's diagonal may have an optical depth above 0.25
    bool colour = false;     ///< it does so by wavelength: three traced channels, not one
    bool colouredLight = false;
    bool opaque = false;
    medium::Index index;
    medium::Coefficient absorption, scattering, opacity; ///< blurred
    medium::Objects objects;                             ///< sharp
    std::vector<Effect> effects;
    std::vector<std::string> warnings;

    bool wants(Output output) const {
        return (static_cast<unsigned>(outputs) & static_cast<unsigned>(output)) != 0;
    }
    int tracedChannels() const { return colour ? 3 : 1; }
    int planes() const { return tracedChannels() + (wants(Output::direction) ? 3 : 0); }
    int fluenceChannels() const { return colour || colouredLight ? 3 : 1; }
    std::int64_t voxels() const { return std::int64_t{size.x} * size.y * size.z; }
};

/// Reads the grids the simulation needs and decides. Throws DataError for a volume without what
/// the contract wants.
Plan makePlan(const volume::Volume& volume, const Params& params);

/// What the run will hold on the device.
std::vector<gpu::Need> needsOf(const Plan& plan, const Params& params);

} // namespace eikonal::lightsim
