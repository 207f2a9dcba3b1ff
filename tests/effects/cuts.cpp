// How each effect leaves the kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

namespace effects {

namespace {

using Constants = std::vector<std::pair<std::string, bool>>;

/// A kernel that knows no integrator but the one named ("" for straight rays).
Constants onlyPath(const std::string& integrator) {
    Constants constants;
    for (const char* name : {"kEuler", "kRk4", "kAdaptive"})
        constants.emplace_back(std::string("kPath == ") + name, false);
    constants.emplace_back("kPath == kVerlet", integrator == "verlet");
    constants.emplace_back("kPath > kVerlet", false);
    return constants;
}

// A photon's step without its part of several look-ups.
const std::pair<std::string, std::string> kNoLeap{"vec3 middle; Leap leap;", "vec3 middle;"};

Constants with(Constants constants, const Constants& more) {
    constants.insert(constants.end(), more.begin(), more.end());
    return constants;
}

} // namespace

std::vector<Cut> viewCuts() {
    const std::string k = kViewKernel;
    std::vector<Cut> cuts;
    cuts.push_back({"absorption", k, {{"kDims", false}}});
    cuts.back().gone = {"kDims", "attenuationOf", "Attenuation", "depth"};
    cuts.push_back({"colour", k, {{"kColour", false}}});
    cuts.back().gone = {"kColour", "red", "green", "blue", "source"};
    // Without light of its own the medium is entered only where it dims.
    cuts.push_back(
        {"scattering and emission", k, {{"kShines", false}, {"kLobes", false}, {"!kDims", false}}});
    cuts.back().edits = {
        {"float added = kShines ? walk.through.x * grey.mean * shine.x * scale : 0.0;", ""},
        {"if (kOpaque) walk.light += vec3(added); else walk.light.x += added;", ""}};
    cuts.back().gone = {"kShines",  "SOURCE",           "kLobes", "kEmission", "source",
                        "emission", "henyeyGreenstein", "shine",  "added"};
    cuts.push_back({"lobes", k, {{"kLobes", false}}});
    cuts.back().gone = {"kLobes", "kEmission", "emission", "henyeyGreenstein"};
    cuts.push_back({"emission beside lobes", k, {{"kEmission", false}}});
    cuts.back().gone = {"kEmission", "EMISSION", "emission"};
    cuts.push_back({"environment map", k, {{"kMap", false}}});
    cuts.back().gone = {"kMap", "mapAt", "environment", "latLongOf"};
    cuts.push_back(
        {"opaque surface",
         k,
         {{"kOpaque", false}, {"walk.fate == kStopped", false}, {"walk.fate != kStopped", true}}});
    cuts.back().writes = {"walk.clear", "walk.met"};
    cuts.back().edits = {{"vec3 clear;", ""}, {"vec3 met;", ""}, {", ray.x, ray.x)", ")"}};
    cuts.back().gone = {"kOpaque", "OPAQUE",  "opacityAt", "surfaceLight", "meetSurface",
                        "surface", "fluence", "kStopped",  "clear",        "met"};
    cuts.push_back({"AOVs", k, {{"kPaths", false}}});
    cuts.back().writes = {"walk.opticalLength", "walk.pathLength"};
    cuts.back().edits = {{"float pathLength;", ""},
                         {"float opticalLength;", ""},
                         {"vec3(1.0), 0.0, 0.0, 0,", "vec3(1.0), 0,"}};
    cuts.back().gone = {"kPaths",        "PATHS",      "paths",         "PixelPath",
                        "opticalLength", "pathLength", "verletOptical", "verletOpticalEnd"};
    cuts.push_back(
        {"other integrators", k,
         with(onlyPath("verlet"), {{"kPath == kStraight", false}, {"kPath != kEuler", true}})});
    cuts.back().writes = {"walk.error"};
    cuts.back().edits = {{"float error;", ""}, {"kWalking, 0.0", "kWalking"}};
    cuts.back().gone = {"kPath",     "PATH",      "kEuler",       "kRk4",      "kAdaptive",
                        "kStraight", "eulerStep", "embeddedStep", "noteError", "rk4Step",
                        "reachFace", "kRounding", "kWorst"};
    cuts.push_back({"cubic interpolation", k, {}});
    cuts.back().branches = {"FIELD == 2"};
    cuts.back().gone = {"splineWeights", "splineSlopes"};
    return cuts;
}

std::vector<Cut> photonCuts() {
    const std::string k = kPhotonKernel;
    std::vector<Cut> cuts;
    cuts.push_back({"absorption and scattering", k, {{"kMedium", false}}});
    cuts.back().edits = {{"vec3 along, vec3 sigmaA, vec3 sigmaS)", "vec3 along)"},
                         {"x, along, sigmaA, sigmaS);", "x, along);"},
                         {"carried.absorbed += sigmaA * spent;", ""},
                         {"carried.scattered += sigmaS * spent;", ""}};
    cuts.back().gone = {"kMedium",    "MEDIUM",    "kDense",        "absorption",
                        "scattering", "dimmingOf", "attenuationOf", "thinAttenuationOf",
                        "sigmaA",     "sigmaS",    "sigmaT",        "spent"};
    cuts.push_back({"colour", k, {{"kColour", false}}});
    cuts.back().branches = {"CHANNELS == 3"};
    cuts.back().gone = {"kColour", "red", "green", "blue", "scattering"};
    cuts.push_back({"dense", k, {{"kDense", false}}});
    cuts.back().gone = {"kDense", "attenuationOf"};
    cuts.push_back({"direction", k, {}});
    cuts.back().branches = {"DIRECTION"};
    cuts.back().edits = {{"CHANNELS + 3 * DIRECTION", "CHANNELS"}};
    cuts.back().gone = {"DIRECTION", "towards", "power"};
    cuts.push_back({"opaque surface", k, {{"kOpaque", false}, {"fate == kStopped", false}}});
    cuts.back().edits = {{"float ends;", ""},
                         {"photon.count.z, 0u, 1.0);", "photon.count.z, 0u);"}};
    cuts.back().gone = {"kOpaque", "OPAQUE", "opaque", "kStopped", "ends"};
    cuts.push_back(
        {"other integrators", k,
         with(onlyPath("verlet"), {{"kPath > kStraight", true}, {"kPath > kEuler", true}})});
    cuts.back().edits = {kNoLeap};
    cuts.back().gone = {"kPath",   "PATH",         "kEuler",     "kRk4",   "kAdaptive", "eulerStep",
                        "rk4Step", "embeddedStep", "sharmaStep", "leapOf", "Leap"};
    cuts.push_back({"cubic interpolation", k, {}});
    cuts.back().branches = {"FIELD == 2"};
    cuts.back().gone = {"splineWeights", "splineSlopes"};
    return cuts;
}

std::vector<Cut> straightViewCuts() {
    Cut cut{"refraction", kViewKernel,
            with(onlyPath(""), {{"kPath == kStraight", true}, {"kPath != kEuler", true}})};
    cut.branches = {"FIELD == 1", "FIELD == 2"};
    cut.gone = {"kVerlet",   "verletStep",    "walkByVerlet", "walkByStages", "sharmaStep",
                "eulerStep", "splineWeights", "toVerlet",     "Advance"};
    return {cut};
}

std::vector<Cut> straightPhotonCuts() {
    Cut cut{"refraction", kPhotonKernel,
            with(onlyPath(""), {{"kPath > kStraight", false}, {"kPath > kEuler", false}})};
    cut.branches = {"FIELD == 1", "FIELD == 2"};
    cut.edits = {kNoLeap};
    cut.gone = {"kVerlet",   "halfKick",      "leapOf", "sharmaStep",
                "eulerStep", "splineWeights", "Advance"};
    return {cut};
}

} // namespace effects
