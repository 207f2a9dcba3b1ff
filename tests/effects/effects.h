// The price list of effects: scenes that differ by one, and what the kernels they call for are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace effects {

/// The kernels that trace rays, as paths in the shaders folder; a scene needs a variant of one.
inline constexpr const char* kKernels[] = {"view/trace.comp.glsl", "lightsim/trace.comp.glsl",
                                           "lightsim/beam_trace.comp.glsl"};

struct Outcome {
    double gpuMs = 0; ///< of the pass that the case is about
    double steps = 0;
};

/// A scene to look at or to light.
struct Case {
    std::string name;
    std::vector<std::string> effects; ///< what of the family's effects is in it; see bindingsOf()
    bool isTracing = false;           ///< it differs by how rays are stepped, not by an effect
    std::function<Outcome(eikonal::gpu::Device&)> run{};
};

struct Scale {
    int voxels = 64; ///< along an edge
    int width = 320, rows = 240;
    std::int64_t photons = 1 << 17;
};

/// What a case's kernel is does not hang on its size.
inline constexpr Scale kSmall{16, 48, 36, 1 << 10};

enum class Family { view, sharpView, photons, sharpPhotons, beams };
inline constexpr Family kFamilies[] = {Family::view, Family::sharpView, Family::photons,
                                       Family::sharpPhotons, Family::beams};
std::string nameOf(Family family);

/// The first is refraction alone; every other adds one thing to it.
std::vector<Case> casesOf(Family family, const Scale& scale);
/// Those, and behind blurred boundaries absorption where nothing refracts: rays are straight.
std::vector<Case> casesAndStraight(Family family, const Scale& scale);
/// Refraction with every coefficient's grid in the file, 0 all over.
Case emptyGridsCase(Family family, const Scale& scale);

/// A resource that a kernel reads or writes.
struct Binding {
    enum class Kind { block, buffer, texture, image };
    Kind kind = Kind::block;
    int number = 0;
    std::string name{}; ///< as the kernel calls it; counts for nothing where two are compared

    bool operator<(const Binding& other) const {
        return kind != other.kind ? kind < other.kind : number < other.number;
    }
};
using Bindings = std::set<Binding>;
std::string textOf(const Bindings& bindings); ///< "block 0, buffer 2, texture 8"

/// What belongs to an effect alone: the kernels of scenes without it leave it unbound.
struct Owned {
    std::string effect; ///< "" of the first row: what all of the family's kernels need
    Bindings bindings;
};
std::vector<Owned> bindingsOf(Family family);

/// A kernel as the device was given it.
struct Variant {
    std::string text;
    eikonal::gpu::Switches switches;
    std::int64_t binaryBytes = 0; ///< of the linked program, 0 where the driver does not tell
};

struct Run {
    Outcome outcome;
    Variant variant; ///< of the kernel that traced
};
Run run(const Case& one, eikonal::gpu::Device& device);

/// Bytes on a device of its own at most.
std::uint64_t peakBytesOf(const Case& one);

/// A kernel as optimised SPIR-V, which no device has a say in.
struct Module {
    int instructions = 0; ///< of all functions
    Bindings bindings;    ///< those that some instruction reads or writes
};
/// None where glslang or SPIRV-Tools are not installed. Files are made in `work`.
std::optional<Module> moduleOf(const Variant& variant, const std::string& work);
/// Which they are; counts by others differ.
std::string compilerName();

} // namespace effects
