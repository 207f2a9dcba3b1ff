// What the light stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/params.h"

#include "base/error.h"
#include "base/text.h"
#include "scene/surface_voxels.h"

#include <algorithm>
#include <cmath>

namespace eikonal::lightsim {

namespace {

void require(bool holds, const std::string& option, double found, const std::string& wanted) {
    if (!holds) throw UsageError(option + ": found " + toText(found) + ", expected " + wanted);
}

} // namespace

Method parseMethod(const std::string& name) {
    if (name == "auto") return Method::automatic;
    if (name == "photons") return Method::photons;
    if (name == "beams") return Method::beams;
    if (name == "wavefront") return Method::wavefront;
    throw UsageError("--method: found '" + name + "', expected auto, photons, beams or wavefront");
}

std::int64_t photonCount(double number) {
    const double kMostPhotons = 1099511627776.0; // 2^40: weeks of work on any device
    require(number >= 1 && number <= kMostPhotons && number == std::floor(number), "--photons",
            number, "a whole number from 1 to 2^40");
    return static_cast<std::int64_t>(number);
}

void Params::check() const {
    if (lights.empty()) throw UsageError("--light: none given, expected at least one");
    require(lightSamples >= 0 && lightSamples <= kMostLightSamples, "--light-samples", lightSamples,
            "auto or 1 to " + std::to_string(kMostLightSamples));
    if (photons != 0) photonCount(static_cast<double>(photons));
    const bool directionAlone =
        outputs == Output::direction || outputs == (Output::direction | Output::irradiance);
    if (lightsApart && !automaticOutputs && directionAlone)
        throw UsageError(
            "--outputs: found light_direction without fluence, by which --lights-apart "
            "adds up directions; expected both");
    if (method == Method::wavefront && !proxy.empty())
        throw UsageError("--proxy: photons start on it, and --method wavefront sends none; "
                         "expected one of them");
    if (seeFront && method != Method::wavefront)
        throw UsageError("--dump-fronts: only wavefronts have fronts, expected --method wavefront");
    tracing.check("--tolerance");
    require(octreeTolerance >= 0, "--octree-tolerance", octreeTolerance, "0 or more");
    require(octreeTolerance2 >= octreeTolerance, "--octree-tolerance2", octreeTolerance2,
            "at least --octree-tolerance (" + toText(octreeTolerance) + ")");
    require(stepLimit > 0, "--step-limit", stepLimit, "above 0");
    require(stepMin >= 0.01 && stepMin <= 1e4, "--step-min", stepMin, "0.01 to 10000");
    require(maxSteps >= 1 && maxSteps <= 1 << 16, "--max-steps", maxSteps, "1 to 65536");
    require(surfaceDetail >= 0 && surfaceDetail <= scene::kMostDetail, "--surface-detail",
            surfaceDetail, "auto or 1 to " + std::to_string(scene::kMostDetail));
    require(beamError > 0 && beamError <= 100, "--beam-error", beamError, "above 0 to 100");
    require(shadowCull > 0 && shadowCull <= 1, "--shadow-cull", shadowCull, "above 0 to 1");
    require(bounces >= 0 && bounces <= 64, "--bounces", bounces, "0 to 64");
    require(maxDepth >= 0 && maxDepth <= 4096, "--max-depth", maxDepth, "0 to 4096");
    require(dropBelow >= 0 && dropBelow < 1, "--drop-below", dropBelow, "0 to below 1");
    require(thinTo >= 0 && thinTo < 1, "--thin-to", thinTo, "0 to below 1");
    require(smoothing >= 0 && smoothing <= 64, "--smoothing", smoothing, "0 to 64");
}

} // namespace eikonal::lightsim
