// What the smoothing stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace eikonal::smooth {

/// The defaults are those of Sun et al. 2008, §4.1: 9 taps, a standard deviation of a sixth of it.
struct Params {
    double sigma = 1.5;        ///< standard deviation of the Gaussian [voxel]; 0: no smoothing
    std::optional<int> kernel; ///< taps along each axis, odd; else the next from 6 sigma on
    /// `ior` and `opacity` where they are there, and `ior.NAME` of objects and `ior.medium` where
    /// they vary; else `grids`.
    bool automaticGrids = true;
    std::vector<std::string> grids;

    /// The taps of the kernel, given or not.
    int width() const;

    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

} // namespace eikonal::smooth
