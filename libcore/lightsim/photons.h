// Photons on the device: one batch of them, and how they are traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"
#include "lightsim/media.h"
#include "lightsim/plan.h"
#include "lightsim/shared.h"
#include "scene/transport.h"

namespace eikonal::lightsim {

/// A photon, two entries of lists, a pixel of the photon map.
constexpr std::int64_t kBytesPerPhoton = sizeof(Photon) + 2 * 4 + 16;

/// More where there are many objects: the set of those that it is in.
constexpr std::int64_t kBytesPerSet = 8;

/// More where there are crystals: its mode and polarisation.
constexpr std::int64_t kBytesPerPolarisation = 16;

/// The photons of one batch: a slot for each pixel of the map, and lists of those that go on.
struct Photons {
    std::int64_t pixels = 0; ///< of all maps of a batch
    glm::ivec2 mapSize{0};   ///< of the largest
    gpu::Texture map;
    gpu::Buffer slots, list, nextList, count;
    gpu::Buffer objects;       ///< of many: those that each photon is in
    gpu::Buffer polarisations; ///< where there are crystals

    /// Makes room for a batch, if it has not got that already.
    void fit(gpu::Device& device, std::int64_t all, const glm::ivec2& largest, bool manyObjects,
             bool crystals);
    /// What emission and tracing both write, at the bindings of shaders/shared/bindings.h.
    void bind() const;
};

/// Traces photons by runs of steps, thinning the list in between.
class PhotonTracer {
public:
    /// One of light that surfaces have reflected leaves nothing before that.
    PhotonTracer(gpu::Device& device, const Plan& plan, const Params& params, bool bounced);

    /// What tells a batch's photons from those of others, beside their pixels.
    void begin(const glm::dvec3& colour, unsigned batch);
    /// One run of steps, as long as `leaves`, the octree, let them be (none where nothing varies);
    /// deposits in the planes that are bound, `unit` to a voxel's length at
    /// weight 1. `count` photons are on the list. Returns how many then are on the next one, with
    /// which it is swapped.
    std::uint32_t run(gpu::Device& device, const scene::Transport& transport, const Media& media,
                      const gpu::Texture& leaves, Photons& photons, std::uint32_t count,
                      double unit);
    /// Whether a sum came near its end.
    static bool overflowed(const Photons& photons);

private:
    gpu::Program mProgram;
    gpu::Buffer mBlock;
    PhotonParams mParams{};
};

} // namespace eikonal::lightsim
