// Light by wavefronts: patches of four rays that advance in equal steps of time.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// After Ihrke et al. 2007 (Eikonal Rendering, §4.2, §5.2). A patch carries a flux. Where theirs
// ends as it inverts, it goes on behind the caustic, and voxels sum up what all patches leave in
// them.
#pragma once

#include "base/progress.h"
#include "lightsim/energy.h"
#include "lightsim/front_cells.h"
#include "lightsim/media.h"
#include "lightsim/scan.h"

namespace eikonal::lightsim {

class Fronts {
public:
    Fronts(gpu::Device& device, const Plan& plan, const Params& params);

    /// The front of a source, of light of that wavelength.
    std::vector<FrontBatch> batchesOf(const Source& source, double nanometres) const;

    /// Before a source's batches: its RGB.
    void begin(const glm::dvec3& rgb);

    /// Carries a batch to its end, or until little of its flux is left; deposits in the planes that
    /// are bound, `unit` to a voxel's length at flux 1. Returns whether every sum held it, and what
    /// became of the flux [cells]. Of one that did not hold nothing has been seen.
    bool carry(gpu::Device& device, const scene::Transport& transport, const Media& media,
               const FrontBatch& batch, double unit, BatchEnergy& energy, gpu::Profiler& profiler,
               Stats& stats, const Progress& progress);

private:
    struct Run;
    void fit(gpu::Device& device, std::int64_t patches);
    void start(Run& run, const FrontBatch& batch);
    void upload();
    void traceCorners(Run& run, std::int64_t first, std::int64_t patches);
    void stepPatches(Run& run, std::int64_t patches);
    void addPatches(Run& run);
    void compact(Run& run);
    void step(Run& run, unsigned number);
    std::vector<FrontPatch> patchesLeft() const;
    std::vector<FrontQuad> quads(const FrontBatch& batch) const;
    BatchEnergy energyOf(bool few) const;

    gpu::Program mTrace, mDeposit, mList, mMark, mCompact;
    Scan mScan;
    gpu::Buffer mBlock, mCounters, mEnergy, mDepths, mHits;
    gpu::Buffer mBefore, mAfter, mPatches, mCompacted, mBacks, mPlaces; ///< of all patches
    std::int64_t mCapacity = 0, mCount = 0; ///< patches there is room for, and those there are
    std::int64_t mEnded = 0;                ///< of these
    FrontParams mParams{};
    VoxelBox mDomain;
    MapDetail mDetail;
    FrontSink mSink;
    glm::dmat4 mWorldFromVoxel;
    glm::dvec3 mRgb{1};
    double mVoxelSize, mTimeStep, mOutside, mDispersion, mThinTo;
    unsigned mMostSteps;
    bool mMeets; ///< boundaries, or opaque voxels
    bool mColour;
};

/// What wavefronts take on the device.
std::vector<gpu::Need> frontNeeds(const Plan& plan, const Params& params);

} // namespace eikonal::lightsim
