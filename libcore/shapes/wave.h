// The surface of water with waves on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <optional>

namespace eikonal::shapes {

struct WaveParams {
    double half = 1;                ///< half its width along x and z, about the origin [unit]
    int squares = 256;              ///< each way
    double height = 1;              ///< scales the waves
    double time = 0;                ///< [s]; the unit is a metre
    std::optional<double> bottom{}; ///< closed by walls and a floor there [unit]; none: a sheet

    /// Throws UsageError.
    void check() const;
};

/// Of three waves at (x, z), a sum of sines about 0 [unit]. They travel as waves on deep water do,
/// by ω² = g k (Lamb, Hydrodynamics, §229).
double waveHeight(double x, double z, double time);

/// Without `bottom` a sheet that looks up, for mesh2vol --fill-below.
mesh::TriangleMesh makeWave(const WaveParams& params);

} // namespace eikonal::shapes
