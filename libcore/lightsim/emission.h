// How photons leave a light: one for every pixel of its photon map (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/aims.h"
#include "lightsim/photon_map.h"
#include "lightsim/photons.h"

#include <memory>

namespace eikonal::lightsim {

/// A part of a window of a source's photon map.
struct Part {
    Window window;
    glm::ivec4 place{0, 0, 1, 0}; ///< its pixels are every z-th of the window's, from x, y on
    unsigned number = 0;          ///< of its source, of those that stand for a light
    double area = 0;              ///< of a pixel of the window, straight ahead [voxel² or sr]
    glm::dvec3 weight{1};         ///< of a photon straight ahead
    std::shared_ptr<const AimedMap> aimed{}; ///< of the window; none: photons go everywhere
    std::int64_t pixels() const { return std::int64_t{window.pixels.x} * window.pixels.y; }
};

/// Photons that are sent at a time: one, or of an extended light the parts of many sources.
struct Batch {
    std::vector<Part> parts;
    Unit unit; ///< of a photon of weight 1
    std::int64_t pixels() const;
};

class Emission {
public:
    Emission(gpu::Device& device, const Plan& plan, const Params& params);

    /// The batches of a light that these stand for, none of more than kBatchPixels; of so many
    /// photons as receivers, so many along an edge of a voxel, want.
    /// `aimed`: none where light meets nothing, if that is worth it.
    std::vector<Batch> batchesOf(const std::vector<Source>& sources, const Params& params,
                                 double receivers, bool aimed) const;

    /// Fills `photons` and its list. Returns how many there are.
    std::uint32_t emit(gpu::Device& device, const scene::Transport& transport, const Batch& batch,
                       Photons& photons);

    /// Tells kernels of light that meets nothing how a light sees the domain, and where it does.
    void bindPlain(const AimedMap& map);

private:
    std::vector<Part> partsOf(const std::vector<Source>& sources, const Params& params,
                              double receivers, bool aimed) const;
    EmissionParams paramsOf(const Window& window) const;
    void bindTiles(const AimedMap* map);

    void emit(gpu::Device& device, const Part& part, std::int64_t first, Photons& photons);

    gpu::Program mMapProgram, mProgram;
    gpu::Device& mDevice;
    gpu::Buffer mSurface, mBlock, mTiles;
    Aims mAims;
    vec4 mAbsorption{0}, mScattering{0}; ///< of the medium round all objects [1/voxel]
    std::int64_t mCorners = 0;
    VoxelBox mDomain, mTarget;
    double mVoxelSize;
    std::uint32_t mSeed = 0;
    bool mManyObjects;    ///< more than a photon's own bits tell
    bool mPolarises;      ///< photons have modes and polarisations
    bool mSourcesDiffer;  ///< in weight, or by direction
    bool mStartsOnDomain; ///< there is no proxy
};

} // namespace eikonal::lightsim
