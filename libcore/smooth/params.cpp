// What the smoothing stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/params.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>

namespace eikonal::smooth {

namespace {

// More than any volume is long; the bound keeps the table of weights small.
constexpr double kMostSigma = 10000;
constexpr int kMostTaps = 60001;

} // namespace

int Params::width() const {
    if (kernel) return *kernel;
    const int taps = static_cast<int>(std::ceil(6 * sigma));
    return taps % 2 == 1 ? taps : taps + 1;
}

void Params::check() const {
    if (!(sigma >= 0 && sigma <= kMostSigma))
        throw UsageError("--sigma: found " + toText(sigma) + ", expected 0 to " +
                         toText(kMostSigma) + " voxels");
    if (kernel && (*kernel < 1 || *kernel > kMostTaps || *kernel % 2 == 0))
        throw UsageError("--kernel: found " + std::to_string(*kernel) +
                         ", expected an odd number of taps, 1 to " + std::to_string(kMostTaps));
    for (const std::string& grid : grids)
        if (grid.empty()) throw UsageError("--grids: found an empty name, expected NAME,...");
    if (!automaticGrids && grids.empty())
        throw UsageError("--grids: found no name, expected NAME,...");
}

} // namespace eikonal::smooth
