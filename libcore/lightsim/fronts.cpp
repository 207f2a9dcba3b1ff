// Light by wavefronts: patches of four rays that advance in equal steps of time.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/fronts.h"

#include "lightsim/dispatch.h"
#include "lightsim/voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;

// Patches whose corners are traced at a time.
constexpr std::int64_t kPart = 1 << 14;

// Beyond so many patches they are split no more.
constexpr std::int64_t kMostPatches = 1 << 21;

// The edge of a patch [voxel]: the sources' one voxel, beyond which it splits, and the least, below
// which it is a single ray where its corners disagree.
constexpr double kPatchEdge = 1;
constexpr double kLeastEdge = 1.0 / 8;

// How far behind each other the corners of a patch may come to a boundary [voxel].
constexpr double kReach = 3;

// Rays along an edge of a patch of one voxel.
constexpr double kRays = 3;

// The flux of a patch below which it does not split for its size, and that a ray has at least [cell
// of one voxel].
constexpr double kFaintPatch = 1.0 / 32;
constexpr double kFaintRay = 1.0 / 128;

// The flux of a patch below which all of it goes one way at an interface.
constexpr double kFaintPart = 1.0 / 4096;

// A patch splits that will be as wide so much farther on [voxel]: the sooner it does, the less new
// corners between the old ones are off.
constexpr double kForesight = 32;

// A step of the front where the index is least [voxel].
constexpr double kStep = 4;

constexpr std::int64_t kCornerBytes = sizeof(FrontCorner);
constexpr std::int64_t kPatchBytes = sizeof(FrontPatch);
constexpr std::int64_t kBackBytes = sizeof(FrontBack);

bool meetsAnything(const Plan& plan) {
    return !plan.scene.objects.empty() || plan.opaque;
}

gpu::Switches switchesOf(const Plan& plan, const Params& params) {
    gpu::Switches switches = scene::transportSwitches(plan.scene, params.tracing);
    switches.emplace_back("CHANNELS", plan.tracedChannels());
    switches.emplace_back("MEDIUM", !plan.attenuates ? 0 : plan.dense ? 2 : 1);
    return switches;
}

gpu::Switches depositSwitchesOf(const Plan& plan, const Params& params) {
    gpu::Switches switches = switchesOf(plan, params);
    std::erase_if(switches, [](const auto& item) { return item.first == "INTEGRATOR"; });
    switches.emplace_back("DIRECTION", plan.wants(Output::direction));
    switches.emplace_back("SPARSE", atlasOf(plan).sparse);
    return switches;
}

/// Cells of a map for so many photons: a cell has the rays of so many.
std::int64_t cellsOf(const Params& params) {
    const double each = kRays * kRays;
    return params.photons > 0
               ? std::max<std::int64_t>(std::llround(static_cast<double>(params.photons) / each), 1)
               : 0;
}

} // namespace

struct Fronts::Run {
    gpu::Device& device;
    const scene::Transport& transport;
    const Media& media;
    gpu::Profiler& profiler;
    std::array<std::uint32_t, kFrontCounts> counters{};
    double patches = 0;    ///< steps of them
    std::int64_t most = 0; ///< at once
};

Fronts::Fronts(gpu::Device& device, const Plan& plan, const Params& params)
    : mTrace(device, "lightsim/front_trace.comp.glsl", switchesOf(plan, params)),
      mDeposit(device, "lightsim/front_deposit.comp.glsl", depositSwitchesOf(plan, params)),
      mList(device, "lightsim/front_list.comp.glsl", {}),
      mMark(device, "lightsim/front_compact.comp.glsl", {{"MARKS", 1}}),
      mCompact(device, "lightsim/front_compact.comp.glsl", {{"MARKS", 0}}), mScan(device),
      mBlock(device, sizeof(FrontParams)), mCounters(device, 4 * kFrontCounts),
      mEnergy(device, kPart * static_cast<std::int64_t>(sizeof(FrontEnergy))),
      mDepths(device, 4 * kPart * static_cast<std::int64_t>(sizeof(FrontDepth))),
      mDomain{dvec3(-0.5), dvec3(plan.scene.size()) - 0.5}, mDetail{cellsOf(params), kPatchEdge,
                                                                    1 << 24},
      mSink(params.seeFront), mWorldFromVoxel(glm::inverse(plan.scene.voxelFromWorld())),
      mVoxelSize(plan.scene.voxelSize()), mOutside(plan.scene.index.background),
      mDispersion(plan.scene.index.backgroundDispersion), mThinTo(params.thinTo),
      mMostSteps(static_cast<unsigned>(params.maxSteps)), mMeets(meetsAnything(plan)),
      mColour(plan.colour) {
    if (mMeets)
        mHits = gpu::Buffer(device, 4 * kPart * static_cast<std::int64_t>(sizeof(FrontHit)));
    const double least = std::min<double>(plan.scene.index.least, mOutside);
    mTimeStep = least * (params.tracing.step > 0 ? params.tracing.step : kStep);
    mParams.size = ivec4(plan.scene.size(), 0);
    mParams.first = ivec4(-plan.receiving.first, 0);
    const glm::ivec3 bricks = plan.receiving.bricks;
    const AtlasLayout atlas = atlasOf(plan);
    mParams.bricks =
        ivec4(bricks.x, bricks.x * bricks.y, atlas.apart(plan.planes()), atlas.planesApart());
    mParams.list.z = static_cast<unsigned>(params.maxDepth);
    mParams.limits = vec4(params.beamCutoff, params.dropBelow, 0, 0);
    mParams.faint = vec4(kFaintPatch, kFaintRay, kForesight, kFaintPart);
    mParams.time.y = static_cast<float>(kReach);
    mParams.detail = vec4(kRays, 1.001 * kPatchEdge, kLeastEdge, 0);
}

std::vector<FrontBatch> Fronts::batchesOf(const Source& source, double nanometres) const {
    return frontOf(source, mDomain, mDetail,
                   mOutside + mDispersion * optics::cauchyTerm(nanometres));
}

void Fronts::begin(const dvec3& rgb) {
    mRgb = rgb;
    mParams.colour = vec4(rgb / (rgb.x + rgb.y + rgb.z), 0);
}

/// Makes room for so many patches, and keeps those there are.
void Fronts::fit(gpu::Device& device, std::int64_t patches) {
    if (patches <= mCapacity) return;
    mCapacity = std::max(patches, mCapacity * 3 / 2);
    const auto enlarge = [&](gpu::Buffer& buffer, std::int64_t each, bool keep) {
        if (!keep) buffer = gpu::Buffer();
        gpu::Buffer larger(device, mCapacity * each);
        if (keep && mCount > 0) larger.copyFrom(buffer, mCount * each);
        buffer = std::move(larger);
    };
    enlarge(mBefore, 4 * kCornerBytes, true);
    enlarge(mAfter, 4 * kCornerBytes, true);
    enlarge(mPatches, kPatchBytes, true);
    enlarge(mCompacted, kPatchBytes, false);
    enlarge(mPlaces, 4, true);
    if (mMeets) enlarge(mBacks, 4 * kBackBytes, true);
}

void Fronts::start(Run& run, const FrontBatch& batch) {
    mCount = 0;
    mEnded = 0;
    const auto count = static_cast<std::int64_t>(batch.patches.size());
    fit(run.device, count);
    mCount = count;
    mBefore.upload(batch.corners.data(), 4 * count * kCornerBytes);
    mPatches.upload(batch.patches.data(), count * kPatchBytes);
    mEnergy.clear();
    mParams.time.z = batch.startsAtLight ? 1 : 0;
    mParams.limits.w = static_cast<float>(std::exp2(30) / std::max(batch.flux, 1.0));
}

void Fronts::upload() {
    mBlock.upload(&mParams, sizeof mParams);
    mBlock.bindUniform(kParamsBlock);
}

/// The corners of a part of the list through a step.
void Fronts::traceCorners(Run& run, std::int64_t first, std::int64_t patches) {
    mParams.list.x = static_cast<unsigned>(patches);
    mParams.list.y = static_cast<unsigned>(first);
    upload();
    run.transport.bind();
    run.media.bind();
    mBefore.bindStorage(kFrontBeforeBuffer);
    mAfter.bindStorage(kFrontAfterBuffer);
    mPatches.bindStorage(kFrontPatchesBuffer);
    mDepths.bindStorage(kFrontDepthsBuffer);
    if (mMeets) mHits.bindStorage(kFrontHitsBuffer);
    run.profiler.begin("front corners");
    dispatchList(mTrace, 4 * patches);
    run.profiler.end();
    run.device.check("wavefront corners");
}

/// What the step does to the patches whose corners have just been traced.
void Fronts::stepPatches(Run& run, std::int64_t patches) {
    if (mMeets) mBacks.bindStorage(kFrontBacksBuffer);
    mEnergy.bindStorage(kFrontEnergyBuffer);
    mCounters.bindStorage(kFrontCountersBuffer);
    mPlaces.bindStorage(kFrontPlacesBuffer);
    run.profiler.begin("front patches");
    dispatchList(mDeposit, patches);
    run.profiler.end();
    run.device.check("wavefront patches");
}

/// Adds the patches into which some part.
void Fronts::addPatches(Run& run) {
    const std::int64_t more = mScan.run(run.device, mPlaces, mCount);
    fit(run.device, mCount + more);
    mParams.list.x = static_cast<unsigned>(mCount);
    mParams.list.w = static_cast<unsigned>(mCount);
    upload();
    mBefore.bindStorage(kFrontBeforeBuffer);
    mAfter.bindStorage(kFrontAfterBuffer);
    mPatches.bindStorage(kFrontPatchesBuffer);
    mPlaces.bindStorage(kFrontPlacesBuffer);
    if (mMeets) mBacks.bindStorage(kFrontBacksBuffer);
    dispatchList(mList, mCount);
    mCount += more;
}

/// Puts the patches that have not ended together.
void Fronts::compact(Run& run) {
    mParams.list.x = static_cast<unsigned>(mCount);
    upload();
    mPatches.bindStorage(kFrontPatchesBuffer);
    mPlaces.bindStorage(kFrontPlacesBuffer);
    dispatchList(mMark, mCount);
    const std::int64_t left = mScan.run(run.device, mPlaces, mCount);
    upload();
    mBefore.bindStorage(kFrontBeforeBuffer);
    mAfter.bindStorage(kFrontAfterBuffer);
    mPatches.bindStorage(kFrontPatchesBuffer);
    mCompacted.bindStorage(kFrontCompactedBuffer);
    mPlaces.bindStorage(kFrontPlacesBuffer);
    dispatchList(mCompact, mCount);
    std::swap(mPatches, mCompacted);
    std::swap(mBefore, mAfter);
    mCount = left;
    mEnded = 0;
}

void Fronts::step(Run& run, unsigned number) {
    mParams.time.x = static_cast<float>(number * mTimeStep);
    mParams.list.w = mCount < kMostPatches ? 1 : 0;
    mCounters.clear();
    for (std::int64_t first = 0; first < mCount; first += kPart) {
        const std::int64_t patches = std::min(mCount - first, kPart);
        traceCorners(run, first, patches);
        stepPatches(run, patches);
    }
    run.patches += static_cast<double>(mCount - mEnded);
    run.most = std::max(run.most, mCount - mEnded);
    mCounters.download(run.counters.data(), mCounters.bytes());
    mEnded += run.counters[kFrontEnded];
    run.profiler.begin("front lists");
    if (run.counters[kFrontChanged] != 0) addPatches(run);
    std::swap(mBefore, mAfter);
    if (2 * mEnded > mCount) compact(run);
    run.profiler.end();
    run.device.check("wavefront lists");
}

std::vector<FrontPatch> Fronts::patchesLeft() const {
    std::vector<FrontPatch> patches(static_cast<size_t>(mCount));
    if (mCount > 0) mPatches.download(patches.data(), mCount * kPatchBytes);
    return patches;
}

/// The front as it stands.
std::vector<FrontQuad> Fronts::quads(const FrontBatch& batch) const {
    const std::vector<FrontPatch> patches = patchesLeft();
    std::vector<FrontCorner> corners(4 * patches.size());
    if (mCount > 0) mBefore.download(corners.data(), 4 * mCount * kCornerBytes);
    const double watts = batch.power * (batch.point ? 1 : mVoxelSize * mVoxelSize);
    std::vector<FrontQuad> front;
    front.reserve(patches.size());
    for (size_t i = 0; i < patches.size(); ++i) {
        if (patches[i].state.y == kFrontEnds) continue;
        FrontQuad quad;
        constexpr size_t kRound[4] = {0, 1, 3, 2}; // corners one after the other round it
        for (size_t k = 0; k < 4; ++k)
            quad.corners[k] =
                dvec3(mWorldFromVoxel * glm::dvec4(dvec3(corners[4 * i + kRound[k]].place), 1.0));
        const dvec3 flux(patches[i].flux);
        quad.power = watts * mRgb * (mColour ? flux : dvec3(flux.x));
        quad.singleRay = patches[i].flux.w != 0;
        front.push_back(quad);
    }
    return front;
}

/// What became of a batch's flux; `few`: what is left was too little to follow.
BatchEnergy Fronts::energyOf(bool few) const {
    std::vector<FrontEnergy> slots(static_cast<size_t>(kPart));
    mEnergy.download(slots.data(), mEnergy.bytes());
    BatchEnergy energy;
    dvec3 deep(0), dim(0), left(0);
    for (const FrontEnergy& slot : slots) {
        energy.absorbed += dvec3(slot.absorbed);
        energy.scattered += dvec3(slot.scattered);
        energy.escaped += dvec3(slot.escaped);
        deep += dvec3(slot.deep);
        dim += dvec3(slot.dim);
        energy.counts[2] += static_cast<double>(slot.scattered.w);
    }
    for (const FrontPatch& patch : patchesLeft())
        if (patch.state.y != kFrontEnds) left += dvec3(patch.flux);
    energy.remaining = energy.escaped + deep + dim + left;
    const auto mean = [&](const dvec3& flux) {
        return mColour ? (flux.x + flux.y + flux.z) / 3 : flux.x;
    };
    energy.dropped = {mean(deep), few ? 0 : mean(left), few ? mean(left) : 0, mean(dim)};
    return energy;
}

bool Fronts::carry(gpu::Device& device, const scene::Transport& transport, const Media& media,
                   const FrontBatch& batch, double unit, BatchEnergy& energy,
                   gpu::Profiler& profiler, Stats& stats, const Progress& progress) {
    Run run{device, transport, media, profiler};
    mParams.limits.z = static_cast<float>(unit);
    start(run, batch);
    std::vector<std::vector<FrontQuad>> fronts;
    bool few = false;
    unsigned number = 0;
    while (mCount > mEnded && !few && number < mMostSteps) {
        step(run, ++number);
        if (run.counters[kFrontNearFull] != 0) return false;
        const double left = static_cast<double>(run.counters[kFrontFlux]) /
                            static_cast<double>(mParams.limits.w) / batch.flux;
        few = left < mThinTo;
        if (mSink) fronts.push_back(quads(batch));
        report(progress, 1 - std::min(left, 1.0));
    }
    energy = energyOf(few);
    for (size_t i = 0; i < fronts.size(); ++i) mSink(static_cast<int>(i) + 1, fronts[i]);
    stats.count("front_steps", number);
    stats.count("front_patches", run.patches);
    stats.raise("front_patches_at_once", static_cast<double>(run.most));
    return true;
}

std::vector<gpu::Need> frontNeeds(const Plan& plan, const Params& params) {
    const double wanted = static_cast<double>(cellsOf(params));
    const glm::dvec3 size(plan.scene.size());
    const double seen = std::max({size.x * size.y, size.y * size.z, size.z * size.x}) * 2;
    const auto patches =
        static_cast<std::int64_t>(std::min(std::max(wanted, seen), double{1 << 18}));
    const std::int64_t each = 4 * kCornerBytes + kPatchBytes + 4;
    const std::int64_t back = meetsAnything(plan) ? 4 * kBackBytes : 0;
    const auto steps = static_cast<std::int64_t>(sizeof(FrontDepth) +
                                                 (meetsAnything(plan) ? sizeof(FrontHit) : 0));
    // This step's and the next one's, which may be as many again where the front is bent.
    return {{"the wavefront", 2 * 2 * patches * (each + back), true, 0},
            {"its corners' steps", 4 * kPart * steps, true, 0}};
}

} // namespace eikonal::lightsim
