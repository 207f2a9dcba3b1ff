// What both parts of the light measurements share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/lightsim.h"
#include "rays.h"
#include "support/test_volume.h"

namespace accuracy {

/// One light simulation: the fluence of its first channel and its time.
struct Lit {
    std::vector<float> fluence; ///< per voxel, x fastest [W/unit²]
    double ms = 0;              ///< GPU time of birth, photons, resolving, smoothing
    double steps = 0;
};

/// No smoothing, fluence alone.
eikonal::lightsim::Params lightParams(const eikonal::lightsim::Light& light, std::int64_t photons);
Lit light(Bench& bench, const eikonal::volume::Volume& volume,
          const eikonal::lightsim::Params& params);

/// √(Σ (a − b)² / Σ b²), over the voxels for which `counts` says so; none: all.
double relativeRms(const std::vector<float>& found, const std::vector<float>& wanted,
                   const std::function<bool(size_t)>& counts = {});

/// A ball of index 1.5, its radius a quarter of a box of 64 units, its edge blurred by `sigma`
/// voxels; haze of σ_s 0.01 around it if asked for.
eikonal::TestVolume hazyBall(int voxels, double sigma, bool haze);
const dvec3& ballCentre();
eikonal::lightsim::Light slantingLight();

/// The tasks judged by formulas: slab, point light, caustic.
void addTruthTasks(Bench& bench, std::vector<Task>& tasks);

} // namespace accuracy
