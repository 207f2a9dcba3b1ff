// How each effect leaves the kernel of sharp boundaries. Members of parameter blocks stay: the host
// writes them, and no instruction does.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

namespace effects {

namespace {

/// The steps' own estimates, which adaptive ones alone make.
void dropErrors(Cut& cut) {
    cut.writes = {"seen.error"};
    cut.edits.push_back({"float error;", ""});
    cut.edits.push_back({"kWalking, 0.0, 0.0", "kWalking, 0.0"});
}

Cut withoutOpaque(const std::string& k) {
    Cut cut{"opaque objects", k, {{"kOpaque", false}, {"stopped", false}}};
    cut.edits = {{"bool stopped =", "const bool stopped ="},
                 {"vec4(0.0, 0.0, 0.0, kLeft)", "vec4(0.0)"},
                 {", seen.fate);", ", 0.0);"}};
    cut.gone = {"kOpaque", "OPAQUE", "surfaceLight", "faceNormal", "kStopped", "stopped"};
    return cut;
}

Cut withoutPaths(const std::string& k) {
    Cut cut{"AOVs", k, {{"kPaths", false}}};
    cut.writes = {"seen.opticalLength", "seen.pathLength"};
    cut.edits = {{"float pathLength;", ""},
                 {"float opticalLength;", ""},
                 {"0.0, 0.0, 0.0); Branch branch", "0.0); Branch branch"},
                 {"vec4(seen.opticalLength, seen.pathLength, seen.steps,", "vec4(0.0, 0.0, 0.0,"}};
    cut.gone = {"kPaths",        "PATHS",      "paths",           "PixelPath",
                "opticalLength", "pathLength", "verletOpticalEnd"};
    return cut;
}

/// Rays between boundaries are straight: one piece of way from each to the next.
Cut withoutCurves(const std::string& k) {
    Cut cut{"indices that vary", k, {{"kField > 0", false}, {"kField == 0", true}}};
    for (const char* name : {"kEuler", "kVerlet", "kRk4", "kAdaptive"})
        cut.constants.emplace_back(std::string("kPath == ") + name, false);
    cut.branches = {"FIELD == 1", "FIELD == 2"};
    cut.edits = {{"vec3 second; vec3 third;", ""},
                 {", vec3(0.0), vec3(0.0), length)", ", length)"}};
    dropErrors(cut);
    cut.gone = {"kPath",     "PATH",       "kAdaptive",    "walkBent",  "runClear",
                "curvedWay", "sharmaStep", "embeddedStep", "eulerStep", "rk4Step",
                "Advance",   "noteError",  "kRounding",    "fieldAt",   "third"};
    return cut;
}

} // namespace

std::vector<Cut> sharpCuts() {
    const std::string k = kSharpKernel;
    std::vector<Cut> cuts;
    cuts.push_back({"absorption", k, {{"kDims", false}}});
    cuts.back().edits = {
        {"vec3 sigma = medium.absorption + medium.scattering;", ""},
        {"vec3 depth = sigma * ds; Attenuation red = attenuationOf(depth.x);"
         "Attenuation green = attenuationOf(depth.y); Attenuation blue = attenuationOf(depth.z);",
         ""},
        {"branch.through * vec3(red.mean, green.mean, blue.mean) * shine",
         "branch.through * shine"},
        {"branch.through *= vec3(red.through, green.through, blue.through);", ""}};
    cuts.back().gone = {"kDims", "attenuationOf", "Attenuation", "sigma"};
    cuts.push_back({"scattering", k, {{"kShines", false}, {"kLobes", false}, {"scatters", false}}});
    cuts.back().edits = {
        {"bool scatters = kShines && surfaces.regions[region].scattering.xyz != vec3(0.0);", ""}};
    cuts.back().gone = {"kShines", "SOURCE", "kLobes", "henyeyGreenstein", "kIsotropicPhase"};
    cuts.push_back({"lobes", k, {{"kLobes", false}}});
    cuts.back().edits = {
        {"float g;", ""}, {"here.scattering.w,", ""}, {".xyz, absorption.w", ".xyz"}};
    cuts.back().gone = {"kLobes", "henyeyGreenstein", "g"};
    cuts.push_back({"emission", k, {{"kEmission", false}}});
    cuts.back().edits = {{"vec3 emission;", ""},
                         {", here.emission.xyz)", ")"},
                         {", textureLod(emissions, at, 0.0).xyz)", ")"}};
    cuts.back().gone = {"kEmission", "EMISSION", "emissions"};
    cuts.push_back(
        {"coefficients that vary", k, {{"kVaries", false}, {"variesIn(region)", false}}});
    cuts.back().branches = {"VARIES"};
    cuts.back().gone = {"kVaries", "VARIES", "variesIn", "absorptions", "scatterings", "emissions"};
    cuts.push_back({"environment map", k, {{"kMap", false}}});
    cuts.back().gone = {"kMap", "mapAt", "environment", "latLongOf"};
    cuts.push_back(withoutOpaque(k));
    cuts.push_back(withoutPaths(k));
    cuts.push_back(withoutCurves(k));
    cuts.push_back({"objects beside one", k, {{"kSolids == 1", true}}});
    cuts.back().gone = {"nearby"};
    return cuts;
}

std::vector<Cut> curvedSharpCuts() {
    const std::string k = kSharpKernel;
    std::vector<Cut> cuts;
    cuts.push_back({"other integrators", k, {{"kPath == kVerlet", true}}});
    for (const char* name : {"kEuler", "kRk4", "kAdaptive"})
        cuts.back().constants.emplace_back(std::string("kPath == ") + name, false);
    dropErrors(cuts.back());
    cuts.back().gone = {"kPath",   "PATH",      "kEuler",       "kRk4",      "kAdaptive",
                        "rk4Step", "eulerStep", "embeddedStep", "noteError", "kRounding"};
    cuts.push_back({"cubic interpolation", k, {}});
    cuts.back().branches = {"FIELD == 2"};
    return cuts;
}

} // namespace effects
