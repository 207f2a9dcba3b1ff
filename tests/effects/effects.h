// The price list of effects: scenes that differ by one, kernels that lack one, and their measures.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cut.h"

#include "gpu/program.h"

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace effects {

using Json = nlohmann::ordered_json;

inline constexpr const char* kViewKernel = "view/march.comp.glsl";
inline constexpr const char* kSharpKernel = "view/sharp.comp.glsl";
inline constexpr const char* kPhotonKernel = "lightsim/march.comp.glsl";

/// A kernel as the device was given it.
struct Variant {
    std::string kernel, text;
    eikonal::gpu::Switches switches;
    std::int64_t binaryBytes = 0; ///< of the linked program, 0 where the driver does not tell
};

/// From now on every program that is made is noted.
void watchPrograms();
/// The variant of this kernel that was made last.
const Variant& lastVariant(const std::string& kernel);

/// What the functions of the text do as optimised SPIR-V, which no device has a say in: names of
/// instructions in their order. None where glslang or SPIRV-Tools are not installed. Files are made
/// in `work`.
using Instructions = std::vector<std::string>;
std::optional<Instructions> instructionsOf(const std::string& text, const std::string& work);

/// Kernels are read from this folder while it lives; "": those built in.
class ShaderFolder {
public:
    explicit ShaderFolder(const std::string& folder);
    ~ShaderFolder();
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;
};

/// Writes the kernel without these effects to `folder`, to be used through ShaderFolder.
void writeWithout(const std::vector<Cut>& cuts, const std::string& folder);

/// Every effect that leaves the kernel of curved rays; lobes and their emission also by themselves.
std::vector<Cut> viewCuts();
std::vector<Cut> photonCuts();
/// Refraction, for scenes whose index does not vary.
std::vector<Cut> straightViewCuts();
std::vector<Cut> straightPhotonCuts();
/// Every effect that leaves the kernel of sharp boundaries round one object of glass; and that of
/// one whose index varies.
std::vector<Cut> sharpCuts();
std::vector<Cut> curvedSharpCuts();

struct Outcome {
    double gpuMs = 0; ///< of the pass that the case is about
    double steps = 0;
    std::vector<float> result; ///< pixels, or fluence
};

/// A scene to look at or to light.
struct Case {
    std::string name, kernel;
    bool isTracing = false; ///< it differs by how rays are stepped, not by an effect
    std::function<Outcome(eikonal::gpu::Device&)> run;
};

struct Scale {
    int voxels = 64; ///< along an edge
    int width = 320, rows = 240;
    std::int64_t photons = 1 << 17;
};

/// The first is refraction alone; every other adds one thing to it.
std::vector<Case> viewCases(const Scale& scale);
std::vector<Case> sharpCases(const Scale& scale);
std::vector<Case> photonCases(const Scale& scale);
/// Grey absorption alone: rays are straight.
Case straightViewCase(const Scale& scale);
Case straightPhotonCase(const Scale& scale);
/// Within sharp boundaries an index that varies.
Case curvedSharpCase(const Scale& scale);
/// Refraction with every coefficient's grid in the file, 0 all over.
Case emptyGridsCase(const Scale& scale, const std::string& kernel);

/// Bytes on a device of its own at most.
std::uint64_t peakBytesOf(const Case& one);

/// What `make effects` measures, and its page.
Json measure(const Scale& scale, int rounds, const std::string& work);
std::string pageOf(const Json& results);

} // namespace effects
