// A scene on the device, as shaders/transport reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "scene/boundaries.h"
#include "scene/field.h"
#include "scene/scene.h"

namespace eikonal::scene {

/// How long an engine's steps may be.
struct StepLengths {
    double longest = 1e6;   ///< [voxel]
    double shortest = 1e-3; ///< adaptive: floats hold no position much better [voxel]
    double first = 1e6;     ///< adaptive [voxel]
    bool equal = false;     ///< Verlet's are all of the longest, so that the field is made for them
    double unit = 0; ///< of the scene [m]: weak crystals' waves keep their phases; 0: none do
};

/// The switches INTEGRATOR, FIELD, FAINT, DISPERSION, PAGED, OBJECTS, NEAR, PACKED, VARIES, OPAQUE
/// and so on of every kernel that traces. `polarised`: light is, whether or not there are crystals.
gpu::Switches transportSwitches(const Scene& scene, const optics::Tracing& tracing,
                                bool polarised = false);

/// What a scene takes on the device.
std::vector<gpu::Need> transportNeeds(const Scene& scene, const optics::Tracing& tracing);

/// Index field, boundaries, and what the core is told. Coefficients of blurred media are the
/// engines', who each read them in a form of their own.
class Transport {
public:
    Transport() = default;
    /// Throws MemoryError if the device can't hold it.
    Transport(gpu::Device& device, const Scene& scene, const optics::Tracing& tracing,
              const StepLengths& steps);

    /// What light the next rays are of, kLines lines as Band::shifted has them; without dispersion
    /// it does nothing.
    void setLines(const std::vector<optics::Line>& lines);
    /// At the units and bindings of shaders/shared/bindings.h.
    void bind() const;

private:
    Field mField;
    Boundaries mBoundaries;
    gpu::Buffer mParams, mSpectrum;
    gpu::Texture mVoxelTable;
    bool mSharp = false;
};

} // namespace eikonal::scene
