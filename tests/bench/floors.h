// Floors that light falls on, and how near a simulation comes to what is exact.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/texels.h"
#include "lightsim/lightsim.h"

#include <string>

namespace bench {

constexpr int kUnit = 64, kDetail = 4, kPad = 8; // voxels to a unit, fine ones to a voxel
constexpr int kFloor = 4;                        // height of every floor [voxel]

/// A scene, and the irradiance on the [−1, 1]² of its floor by fine voxels.
struct Case {
    std::string name;
    eikonal::volume::Volume volume;
    eikonal::lightsim::Light light;
    int low; ///< where the measured part begins, along x and z [voxel]
    judge::Texels exact{{-1, -1}, {1, 1}, kUnit* kDetail};
};

/// A ball of radius ½ over a floor at −¾.
Case ballOverFloor();

/// Water with waves over [−1.5, 1.5]², so that what goes through its sides does not come to the
/// measured part, with or without a box above it.
Case waterOverFloor(bool box);

struct FloorError {
    double error = 0;  ///< root mean square of the difference over √(R² + (0.1 mean R)²) [1]
    double energy = 0; ///< found over exact, less 1
};

FloorError errorOf(const Case& scene, const eikonal::volume::FineGrid& irradiance);

} // namespace bench
