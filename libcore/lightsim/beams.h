// Light by beams: cells of a light's map whose corners' rays meet the same boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// After Barczak and Olano (hierarchical light volumes) and Liktor and Dachsbacher 2011 (adaptive
// beam tracing): a quadtree over the light's map, whose cells split until what is inside them
// follows from their corners. Every kind of path, which is a list of the branches taken at
// interfaces, is a tree of its own. No random number decides where light goes.
#pragma once

#include "lightsim/media.h"
#include "lightsim/photon_map.h"
#include "lightsim/plan.h"
#include "lightsim/surfaces.h"
#include "optics/bands.h"

namespace eikonal::lightsim {

/// What became of a light's power, as shares of what its map's weight stands for: rgb, or the first
/// component alone.
struct BeamEnergy {
    glm::dvec3 entered{0}, landed{0}, left{0}, deep{0}, trapped{0}, dim{0};
};

class Beams {
public:
    Beams(gpu::Device& device, const Plan& plan, const Params& params);

    /// The windows through which a source, one of so many of a light, sees the domain, pixels being
    /// cells. Where the light meets no body a map starts with larger ones.
    std::vector<Window> windowsOf(const Source& source, size_t sources) const;

    /// A part of a window that is carried at once: cells from `low` on.
    struct Batch {
        glm::ivec2 low{0}, cells{0};
    };
    static std::vector<Batch> batchesOf(const Window& window);

    /// Before a source's batches: its RGB over their sum, and the light's wavelengths.
    void begin(const glm::dvec3& colour, const optics::Band& band);

    /// Carries a batch to the surfaces. `unit` of fixed point stands for all power of a
    /// cell. Returns whether every sum held it, and what became of the power [cells].
    bool carry(gpu::Device& device, scene::Transport& transport, const Media& media,
               const gpu::Texture& leaves, const SurfaceReceiver& surfaces, const Window& window,
               const Batch& batch, double unit, BeamEnergy& energy, gpu::Profiler& profiler,
               Stats& stats);

private:
    struct Nodes;
    struct Rays;
    struct Generation;
    struct Run;
    std::vector<glm::dvec4> aimsIn(const Window& window) const;
    void aim(const Window& window, const Batch& batch);
    void trace(Run& run, Generation& of, std::int64_t items, std::int64_t first,
               const Generation* before);
    void dispatch(Run& run, Rays& rays, const Rays* before, std::int64_t items);
    void layDown(Run& run, const Generation& of, std::uint32_t beams);
    void level(Run& run, Generation& of, const Nodes& nodes);
    void sort(Run& run, Generation& of, const Nodes& nodes, std::int64_t begin, std::int64_t count);
    void follow(Run& run, Generation& of, bool last);
    void grow(Run& run, Generation& of, std::int64_t points);

    gpu::Program mGrid, mTrace, mSort, mSplit, mFollow, mCut, mDeposit;
    gpu::Buffer mBlock, mCounts, mBooks, mCells;
    BeamParams mParams{};
    VoxelBox mDomain;
    std::int64_t mMapCells; ///< where the map is aimed at; 0: as many as is worth it
    int mBranchBits;        ///< that tell a branch taken at an interface
    bool mManyObjects;
    bool mAimsEverywhere; ///< no part of a map is simple
    bool mShifts;         ///< a band's wavelengths land at other places than its middle does
    std::uint32_t mBeamsPerCut;
    std::vector<optics::Line> mMiddle, mShifted; ///< what rays are traced by

    struct Body {
        VoxelBox box;
        bool opaque;
    };
    std::vector<Body> mBodies;
};

/// What beams take on the device.
std::vector<gpu::Need> beamNeeds(const Plan& plan, const Params& params);

} // namespace eikonal::lightsim
