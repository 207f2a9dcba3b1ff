// Where a batch's energy went.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/beams.h"
#include "lightsim/photons.h"

#include <array>

namespace eikonal::lightsim {

/// A batch's photons in weights and numbers.
struct BatchEnergy {
    glm::dvec3 remaining{0}, absorbed{0}, scattered{0}, escaped{0};
    std::array<double, 4> counts{}; ///< photons, steps, deposits, trapped
    glm::dvec4 dropped{0};          ///< weight: by depth, by steps, by thinning, as dim
    double left = 0;                ///< weight that one more bounce would send on, mean of rgb
    double error = 0;               ///< the largest, estimated [voxel]
};

/// Sums up photons on the device.
class EnergyMeter {
public:
    explicit EnergyMeter(gpu::Device& device);
    BatchEnergy sum(const scene::Transport& transport, const Photons& photons);

private:
    gpu::Program mProgram;
    gpu::Buffer mBlock, mSums;
};

/// Books a batch in the statistics: what entered with the photons when they were emitted, and what
/// has become of it.
void book(Stats& stats, const Plan& plan, const Unit& unit, const BatchEnergy& emitted,
          const BatchEnergy& done);

/// The same of a batch of beams. Returns what limits took away [W], the mean of rgb, in the order
/// of BatchEnergy::dropped.
glm::dvec4 book(Stats& stats, const Plan& plan, const Unit& unit, const BeamEnergy& done);

/// Power that a batch's photons took away when limits ended them [W], the mean of rgb, in the order
/// of BatchEnergy::dropped.
glm::dvec4 droppedPower(const Unit& unit, const BatchEnergy& done);

/// Power that surfaces took at the last bounce, which one more would send on [W], the mean of rgb.
double leftPower(const Unit& unit, const BatchEnergy& done);

/// Counts such power of all batches as shares of what has entered (`light_dropped_by_depth` ...).
void tellDropped(Stats& stats, const glm::dvec4& power);
void tellLeft(Stats& stats, double power);

} // namespace eikonal::lightsim
