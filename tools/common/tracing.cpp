// The options of how rays are stepped, which render and lightsim share.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/tracing.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>

namespace eikonal::tool {

TracingOptions::TracingOptions(CLI::App& app, const std::string& stepHelp, int& maxDepth,
                               const std::string& what) {
    const char* const kGroup = "Tracing";
    app.add_option("--boundary", mBoundary,
                   "sharp (Snell's and Fresnel's laws at the zero of signed distances), blurred "
                   "(the gradient of 'ior' alone bends rays), or auto: sharp where the file has "
                   "signed distances")
        ->check(CLI::IsMember({"auto", "blurred", "sharp"}))
        ->capture_default_str()
        ->group(kGroup);
    app.add_option("--max-depth", maxDepth, "sharp boundaries that " + what + " meets at most")
        ->type_name("N")
        ->capture_default_str()
        ->group(kGroup);
    mIntegratorOption =
        app.add_option(
               "--integrator", mIntegrator,
               "euler (the older papers' scheme, first order), verlet (one look-up a step), "
               "sharma (fourth order, three), rk4 (four), adaptive (keeps to --tolerance); "
               "the default is the cheapest at its error (docs/accuracy.md)")
            ->check(CLI::IsMember(optics::integratorNames()))
            ->capture_default_str()
            ->group(kGroup);
    app.add_option("--interpolation", mInterpolation,
                   "of the index: linear (one look-up), or cubic (a spline through the samples); "
                   "default linear for euler and verlet, cubic for the others")
        ->check(CLI::IsMember({"linear", "cubic"}))
        ->group(kGroup);
    app.add_option("--step", mTracing.step, stepHelp)
        ->type_name("VOXELS")
        ->check([](const std::string& text) {
            return parseNumbers(text) && parseNumbers(text)->front() == 0
                       ? std::string("found 0, expected 0.001 to 1000 voxels")
                       : std::string();
        })
        ->group(kGroup);
    app.add_option(
           "--wavelengths", mWavelengths,
           "where 'dispersion' makes the index depend on it: parts of 380 to 730 nm, traced "
           "one by one (1: 587.6 nm alone), or a list of wavelengths [nm]")
        ->type_name("N|LIST")
        ->capture_default_str()
        ->group(kGroup);
    mTolerance =
        app.add_option("--tolerance", mTracing.tolerance,
                       "error that a ray may have where it leaves [voxel]; implies adaptive")
            ->type_name("VOXELS")
            ->capture_default_str()
            ->group(kGroup);
}

optics::Tracing TracingOptions::finish() const {
    optics::Tracing tracing = mTracing;
    std::string integrator = mIntegrator;
    if (mTolerance->count() > 0) {
        if (mIntegratorOption->count() > 0 && integrator != "adaptive")
            throw UsageError("--tolerance: --integrator " + integrator +
                             " keeps to no tolerance, expected adaptive");
        integrator = "adaptive";
    }
    tracing.integrator = optics::parseIntegrator(integrator);
    tracing.boundary = optics::parseBoundary(mBoundary);
    tracing.wavelengths = optics::parseWavelengths("--wavelengths", mWavelengths);
    if (!mInterpolation.empty()) tracing.interpolation = optics::parseInterpolation(mInterpolation);
    return tracing;
}

void TracingOptions::warnOf(Session& session, const std::string& rays) const {
    const Stats& stats = session.stats();
    const double trapped = stats.counter("trapped");
    if (trapped > 0)
        session.warn(toText(trapped) + " " + rays + " used up --max-steps within the volume");
    const double error = stats.counter("position_error_voxels");
    if (error > mTracing.tolerance)
        session.warn("--tolerance " + toText(mTracing.tolerance) +
                     " is out of reach of 32-bit floats, or of the longest ways: errors up to " +
                     toText(std::round(error * 1e6) / 1e6) + " voxels are estimated");
}

void warnOfDropped(Session& session,
                   const std::vector<std::pair<std::string, std::string>>& limits) {
    for (const auto& [counter, option] : limits) {
        const double share = session.stats().counter(counter);
        if (share > 0.01)
            session.warn(toText(std::round(share * 1000) / 10) + " % of the light was dropped by " +
                         option + ": what is seen of it is too dark");
    }
}

} // namespace eikonal::tool
