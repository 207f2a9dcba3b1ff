// The options of how rays are stepped, which render and lightsim share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/session.h"
#include "optics/tracing.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace eikonal::tool {

/// What the command line says, until finish() makes a Tracing of it.
class TracingOptions {
public:
    /// Adds --boundary, --max-depth (into `maxDepth`, for `what`), --integrator, --interpolation,
    /// --step, --wavelengths and --tolerance.
    TracingOptions(CLI::App& app, const std::string& stepHelp, int& maxDepth,
                   const std::string& what);

    CLI::Option* toleranceOption() const { return mTolerance; }

    /// A tolerance alone asks for adaptive steps. Throws UsageError where another integrator was
    /// named beside it.
    optics::Tracing finish() const;

    /// Says of a run what did not go as asked: trapped rays, a tolerance out of reach.
    void warnOf(Session& session, const std::string& rays) const;

private:
    std::string mIntegrator = "verlet", mInterpolation, mBoundary = "auto", mWavelengths = "8";
    optics::Tracing mTracing;
    CLI::Option *mIntegratorOption, *mTolerance;
};

/// Warns of every limit that took more than a hundredth of a run's light: `limits` are counters of
/// such shares and the options that set them.
void warnOfDropped(Session& session,
                   const std::vector<std::pair<std::string, std::string>>& limits);

} // namespace eikonal::tool
