// What a light simulation of a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "gpu/device.h"
#include "lightsim/opaque_surfaces.h"
#include "lightsim/params.h"
#include "lightsim/receiving.h"
#include "scene/scene.h"

#include <vector>

namespace eikonal::lightsim {

/// Photon-map pixels traced at a time; more are done in interleaved batches, so that memory does
/// not grow with the number of photons.
constexpr std::int64_t kBatchPixels = 1 << 20;

/// The scene as the light sees it, and which effects are worth simulating.
struct Plan {
    scene::Scene scene;
    Output outputs = Output::none;
    bool bends = false;      ///< the index varies, of sharp objects within one region
    bool attenuates = false; ///< something absorbs or scatters
    bool dense = false;      ///< a voxel's diagonal may have an optical depth above 0.25
    bool colour = false;     ///< media or mirrors differ by wavelength: three traced channels
    bool colouredLight = false;
    bool sourcesDiffer = false;   ///< of a light: in weight, or by direction
    bool colouredSources = false; ///< of a light's: photons have its colours, not batches
    bool opaque = false;
    ReceivingBricks receiving;          ///< none where no volume receives
    OpaqueSurfaces surfaces;            ///< none where no surface receives
    std::vector<PointOnSurface> points; ///< that are asked for their light, in voxel space
    bool photons = false;               ///< photons are sent
    bool beams = false;                 ///< beams are
    bool polarised = false;             ///< a light has a polariser, and boundaries tell
    int bounces = 0;                    ///< times that surfaces send light on, by photons
    bool wavefront = false;             ///< wavefronts are
    std::vector<Effect> effects;
    std::vector<std::string> warnings;

    bool wants(Output output) const {
        return (static_cast<unsigned>(outputs) & static_cast<unsigned>(output)) != 0;
    }
    /// Whether photons or beams step by the octree: where index or coefficients vary from place to
    /// place.
    bool usesOctree() const { return (bends || !scene.sharp) && (sendsPhotons() || beams); }
    /// Whether light that meets no boundary goes straight through a medium that is the same
    /// everywhere: what it leaves there follows by Beer's law.
    bool isPlainBetween() const {
        return scene.sharp && !bends && !scene.medium().opaque &&
               !scene.medium().coefficientsVary();
    }
    bool receivesInVolume() const { return wants(Output::fluence) || wants(Output::direction); }
    int tracedChannels() const { return colour ? 3 : 1; }
    int fluenceChannels() const { return colour || colouredLight || scene.disperses ? 3 : 1; }
    int directionChannels() const { return wants(Output::direction) ? 3 : 0; }
    bool sendsPhotons() const { return photons || bounces > 0; }
    bool polarises() const { return polarised || scene.anyCrystal(); } ///< paths have modes
    bool sumsFlow() const { return !points.empty(); }                  ///< on surfaces
    /// Fixed-point sums, one a traced channel and component of the direction.
    int planes() const { return tracedChannels() + directionChannels(); }
    std::int64_t voxels() const { return scene.voxels(); }
};

/// Reads the grids the simulation needs and decides. Throws DataError for a volume without what
/// the contract wants.
Plan makePlan(const volume::Volume& volume, const Params& params);

/// How many sources stand for a light when it is carried that way.
int samplesFor(const Plan& plan, const Params& params, const Light& light, Method method);

/// What the run will hold on the device.
std::vector<gpu::Need> needsOf(const Plan& plan, const Params& params);

} // namespace eikonal::lightsim
