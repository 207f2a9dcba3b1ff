// Light by beams: cells of a light's map whose corners' rays meet the same boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/beams.h"

#include "lightsim/dispatch.h"
#include "lightsim/photons.h"
#include "lightsim/spread.h"
#include "optics/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace eikonal::lightsim {

namespace {

using glm::dvec3;
using glm::ivec2;

// Cells along an edge of a batch: its points take some tens of MB with those of split cells.
constexpr int kBatchCells = 512;

// Cells along an edge of one that the map starts with.
constexpr int kStart = 1 << kAimedLevels;

// Most points of one generation that are kept at a time; beyond, cells are split in parts.
constexpr std::int64_t kMostPoints = 3 << 18;
// Cells split at a time beyond that, and sorted at a time.
constexpr std::int64_t kPart = 1 << 14, kSorted = 1 << 14;
// So many points that go on are followed before more cells are sorted: with those of the cells
// sorted last, and of one part, the next generation fits the 128 MiB that every device's storage
// buffers have.
constexpr std::int64_t kMostWanted = kMostPoints / 2;

// What one beam covers at most, along an axis [fine voxel], if it is worth more: its cells are laid
// down exactly up to that (kLongest times kMostCells in shaders/lightsim/beam_cut.comp.glsl).
constexpr int kWidest = 96;

// What --photons asks for, per cell: a beam does the work of so many.
constexpr std::int64_t kPhotonsPerCell = 64;

// The edge of a cell [voxel], and most cells, that --photons auto takes where the map is aimed at.
constexpr double kCellEdge = 1;
constexpr std::int64_t kMostCells = 1 << 16;

// The least part of a map that it is aimed at: elsewhere there are as many starting cells, then.
constexpr double kLeastAim = 1.0 / (kStart * kStart);

// Cells that beams are cut into at a time, of each 16 by 16 at most, at kMostShifts places.
constexpr std::uint32_t kCellsPerCut = 1 << 21;
constexpr std::uint32_t kCellsPerBeam = 256;
constexpr std::int64_t kCellBytes = 8;

// Most bits of the branches of a kind of path.
constexpr int kKindBits = 31;

constexpr std::int64_t kNodeBytes = sizeof(BeamNode);
constexpr std::int64_t kPointBytes = sizeof(BeamPoint);

/// The widest cell to begin with of a point's map [tangent]: within it the intensity over the map
/// is about a polynomial of second degree.
double widestCell(const Source& source) {
    const double kMost = 0.25, kLeast = 1.0 / 64;
    const double fades = 0.5 * (source.outer - source.inner);
    return source.spread == Source::Spread::cone ? std::clamp(fades, kLeast, kMost) : kMost;
}

std::int64_t cellsOf(const Params& params) {
    return params.photons > 0 ? std::max<std::int64_t>(params.photons / kPhotonsPerCell, 1) : 0;
}

gpu::Switches switchesOf(const Plan& plan, const Params& params) {
    gpu::Switches switches = scene::transportSwitches(plan.scene, params.tracing, plan.polarised);
    switches.emplace_back("CHANNELS", plan.tracedChannels());
    switches.emplace_back("MEDIUM", !plan.attenuates ? 0 : plan.dense ? 2 : 1);
    switches.emplace_back("EXTENDED", plan.sourcesDiffer);
    return switches;
}

bool shifts(const Plan& plan, const Params& params) {
    return plan.scene.disperses && params.tracing.wavelengths.spread();
}

} // namespace

/// Cells, on the device.
struct Beams::Nodes {
    gpu::Buffer list;
    std::int64_t count = 0;
};

/// Points of one wavelength.
struct Beams::Rays {
    gpu::Buffer points, objects;
};

/// All kinds of path that take as many branches: their points, and the cells that go on from an
/// interface.
struct Beams::Generation {
    int length = 0;
    Rays middle, shifted; ///< of the band's middle, and where mShifts says so of mShifted
    gpu::Buffer marks, wanted, slots;
    std::int64_t capacity = 0, count = 0; ///< points there is room for, and those there are
    std::vector<Nodes> next;              ///< that go on
    std::int64_t wantedCount = 0, branchCount = 0; ///< of points and of cells, each by a branch
};

struct Beams::Run {
    gpu::Device& device;
    scene::Transport& transport;
    const Media& media;
    const gpu::Texture& leaves;
    const SurfaceReceiver& surfaces;
    gpu::Profiler& profiler;
    double deposits = 0, missed = 0, beams = 0, points = 0, culled = 0;
    bool nearFull = false;
};

Beams::Beams(gpu::Device& device, const Plan& plan, const Params& params)
    : mGrid(device, "lightsim/beam_grid.comp.glsl", {}),
      mTrace(device, "lightsim/beam_trace.comp.glsl", switchesOf(plan, params)),
      mSort(device, "lightsim/beam_sort.comp.glsl",
            {{"CHANNELS", plan.tracedChannels()},
             {"CULLS", !plan.points.empty()},
             {"CRYSTALS", plan.polarises()},
             {"DISPERSION", shifts(plan, params)}}),
      mSplit(device, "lightsim/beam_split.comp.glsl", {}),
      mFollow(device, "lightsim/beam_follow.comp.glsl", {{"CRYSTALS", plan.polarises()}}),
      mCut(device, "lightsim/beam_cut.comp.glsl", {{"DISPERSION", shifts(plan, params)}}),
      mDeposit(device, "lightsim/beam_deposit.comp.glsl",
               {{"CHANNELS", plan.tracedChannels()},
                {"SURFACE_FLOW", plan.sumsFlow()},
                {"DISPERSION", shifts(plan, params)}}),
      mBlock(device, sizeof(BeamParams)), mCounts(device, kBeamCounts * 4),
      mBooks(device, std::int64_t{kBooks} * kBookSlots * 3 * 4),
      mCells(device, kCellBytes * kCellsPerCut), mDomain{dvec3(-0.5),
                                                         dvec3(plan.scene.size()) - 0.5},
      mMapCells(cellsOf(params)), mBranchBits(plan.polarises() ? 2 : 1),
      mManyObjects(scene::areMany(plan.scene.objects)),
      mAimsEverywhere(!plan.scene.sharp || plan.bends), mShifts(shifts(plan, params)),
      mBeamsPerCut(kCellsPerCut / kCellsPerBeam / (mShifts ? kMostShifts : 1)) {
    for (size_t k = 0; k < plan.scene.objects.size(); ++k) {
        const volume::IndexBox& box = plan.scene.objects[k].inside;
        if (box.empty()) continue;
        mBodies.push_back({{dvec3(box.min) - 1.0, dvec3(box.max) + 1.0},
                           plan.scene.regions[k].opaque && !plan.scene.regions[k].metal});
    }
    const int detail = plan.surfaces.detail;
    mParams.size = ivec4(plan.scene.size(), detail);
    mParams.limits = vec4(params.stepMin, params.beamCutoff, 0, params.beamError);
    mParams.list.w = static_cast<unsigned>(std::min(params.maxDepth, kKindBits / mBranchBits));
    mParams.generation.z = params.seed;
    mParams.levels = ivec4(2 << params.beamLevels, 0, 0, kWidest);
    mParams.right.w = static_cast<float>(params.shadowCull);
}

/// Boxes of bodies as a window sees them: corners in its own coordinates. More than kMostAims
/// become one; a map that is aimed at everywhere has its whole window.
std::vector<glm::dvec4> Beams::aimsIn(const Window& window) const {
    const glm::dvec4 whole(window.low, window.low + window.extent);
    if (mAimsEverywhere) return {whole};
    std::vector<glm::dvec4> aims;
    for (const Body& body : mBodies) {
        std::optional<glm::dvec4> seen = window.rectangleOf(body.box);
        if (!seen) seen = whole;
        glm::dvec4 rectangle(glm::max(glm::dvec2(*seen), window.low),
                             glm::min(glm::dvec2(seen->z, seen->w), window.low + window.extent));
        const glm::dvec2 edges =
            glm::max(glm::dvec2(rectangle.z, rectangle.w) - glm::dvec2(rectangle), 0.0);
        // What is opaque has edges alone, and those of large bodies are not missed.
        const bool large = edges.x * edges.y > 0.25 * window.extent.x * window.extent.y;
        if (edges.x * edges.y > 0 && !(body.opaque && large)) aims.push_back(rectangle);
    }
    if (aims.size() <= kMostAims) return aims;
    for (const glm::dvec4& aim : aims)
        aims[0] = {glm::min(glm::dvec2(aims[0]), glm::dvec2(aim)),
                   glm::max(glm::dvec2(aims[0].z, aims[0].w), glm::dvec2(aim.z, aim.w))};
    aims.resize(1);
    return aims;
}

std::vector<Window> Beams::windowsOf(const Source& source, size_t sources) const {
    const auto all = [&](const MapDetail& detail) {
        return lightsim::windowsOf(source, mDomain, mDomain, detail, glm::dvec2(0), false);
    };
    double aimed = 0, area = 0;
    for (const Window& window : all({1 << 20})) {
        area += window.extent.x * window.extent.y;
        for (const glm::dvec4& aim : aimsIn(window)) aimed += (aim.z - aim.x) * (aim.w - aim.y);
    }
    if (area == 0) return {};
    // Sources of a light have fewer cells each, and more in all: errors of beams that overlap even
    // out.
    const double share = std::clamp(aimed / area, kLeastAim, 1.0);
    const double fewer = std::sqrt(static_cast<double>(sources));
    const auto spread = [&](std::int64_t cells) {
        return static_cast<std::int64_t>(std::ceil(static_cast<double>(cells) / (share * fewer)));
    };
    std::vector<Window> windows =
        all({spread(mMapCells), kCellEdge * std::sqrt(fewer), spread(kMostCells)});
    for (Window& window : windows) {
        ivec2 starting = (window.pixels + kStart - 1) / kStart;
        if (window.point)
            starting = glm::max(starting, ivec2(glm::ceil(window.extent / widestCell(source))));
        window.pixels = kStart * starting;
    }
    return windows;
}

std::vector<Beams::Batch> Beams::batchesOf(const Window& window) {
    std::vector<Batch> batches;
    for (int j = 0; j < window.pixels.y; j += kBatchCells)
        for (int i = 0; i < window.pixels.x; i += kBatchCells)
            batches.push_back({{i, j}, glm::min(window.pixels - ivec2(i, j), ivec2(kBatchCells))});
    return batches;
}

/// Tells the kernels where a batch is aimed at [finest cell].
void Beams::aim(const Window& window, const Batch& batch) {
    const std::vector<glm::dvec4> aims = aimsIn(window);
    const glm::dvec2 scale = glm::dvec2(window.pixels) / window.extent;
    const auto onMap = [&](const glm::dvec2& at) {
        return ((at - window.low) * scale - glm::dvec2(batch.low)) *
               static_cast<double>(mParams.levels.x);
    };
    for (size_t i = 0; i < kMostAims; ++i)
        mParams.aims[i] = i < aims.size()
                              ? vec4(onMap(glm::dvec2(aims[i])), onMap({aims[i].z, aims[i].w}))
                              : vec4(0);
}

/// Makes room for so many points, and keeps those there are.
void Beams::grow(Run& run, Generation& of, std::int64_t points) {
    if (points <= of.capacity) return;
    const std::int64_t capacity = std::max(points, of.capacity * 3 / 2);
    const auto enlarge = [&](gpu::Buffer& buffer, std::int64_t each, bool zero) {
        gpu::Buffer larger(run.device, capacity * each);
        if (zero) larger.clear();
        if (of.count > 0) larger.copyFrom(buffer, of.count * each);
        buffer = std::move(larger);
    };
    for (Rays* rays : {&of.middle, &of.shifted}) {
        if (rays == &of.shifted && !mShifts) continue;
        enlarge(rays->points, kPointBytes, false);
        if (mManyObjects) enlarge(rays->objects, kBytesPerSet, false);
    }
    enlarge(of.marks, 4, true);
    enlarge(of.slots, std::int64_t{4} << mBranchBits, false);
    enlarge(of.wanted, std::int64_t{4} << mBranchBits, false);
    of.capacity = capacity;
}

/// Traces `items` points from the first on: from the light, or from those of the generation before.
void Beams::trace(Run& run, Generation& of, std::int64_t items, std::int64_t first,
                  const Generation* before) {
    mParams.list.x = static_cast<unsigned>(items);
    mParams.list.y = static_cast<unsigned>(first);
    mParams.generation.x = static_cast<unsigned>(of.length);
    mParams.generation.y = before != nullptr;
    mBlock.upload(&mParams, sizeof mParams);
    mBlock.bindUniform(kParamsBlock);
    run.transport.bind();
    run.media.bind();
    if (run.leaves.name() != 0) run.leaves.bindSampler(kLeavesUnit);
    if (before != nullptr) before->wanted.bindStorage(kWantedBuffer);
    dispatch(run, of.middle, before != nullptr ? &before->middle : nullptr, items);
    if (mShifts) {
        if (before == nullptr)
            of.shifted.points.copyFrom(of.middle.points, items * kPointBytes, first * kPointBytes);
        run.transport.setLines(mShifted);
        dispatch(run, of.shifted, before != nullptr ? &before->shifted : nullptr, items);
        run.transport.setLines(mMiddle);
    }
    run.device.check("beams");
}

void Beams::dispatch(Run& run, Rays& rays, const Rays* before, std::int64_t items) {
    rays.points.bindStorage(kPointsBuffer);
    if (mManyObjects) rays.objects.bindStorage(kObjectsBuffer);
    if (before != nullptr) {
        before->points.bindStorage(kParentsBuffer);
        if (mManyObjects) before->objects.bindStorage(kParentObjectsBuffer);
    }
    run.profiler.begin("beam rays");
    dispatchList(mTrace, items);
    run.profiler.end();
    run.points += static_cast<double>(items);
}

/// Lays the beams of the list that is bound down, some thousands at a time.
void Beams::layDown(Run& run, const Generation& of, std::uint32_t beams) {
    const uvec4 list = mParams.list;
    run.surfaces.bind();
    mCells.bindStorage(kCellsBuffer);
    if (mShifts) of.shifted.points.bindStorage(kShiftedBuffer);
    for (std::uint32_t first = 0; first < beams; first += mBeamsPerCut) {
        std::array<std::uint32_t, kBeamCounts> counts{};
        mCounts.upload(counts.data(), mCounts.bytes());
        mParams.list = uvec4(std::min(beams - first, mBeamsPerCut), first, kCellsPerCut, list.w);
        mBlock.upload(&mParams, sizeof mParams);
        dispatchList(mCut, mParams.list.x);
        mCounts.download(counts.data(), mCounts.bytes());
        const std::uint32_t whole = counts[kCellCount], broken = counts[kBrokenCellCount];
        mParams.list = uvec4(whole + broken, whole, kCellsPerCut, list.w);
        mBlock.upload(&mParams, sizeof mParams);
        dispatchList(mDeposit, mParams.list.x);
        mCounts.download(counts.data(), mCounts.bytes());
        run.deposits += counts[kDepositCount];
        run.missed += counts[kMissedCount];
        run.nearFull |= counts[kNearFullCount] != 0;
    }
    run.beams += beams;
    mParams.list = list;
}

/// Lays cells down or lets them go on, and splits those that call for it, level by level.
void Beams::level(Run& run, Generation& of, const Nodes& nodes) {
    for (std::int64_t first = 0; first < nodes.count && !run.nearFull; first += kSorted) {
        sort(run, of, nodes, first, std::min(kSorted, nodes.count - first));
        if (of.wantedCount > kMostWanted) follow(run, of, false);
    }
}

/// What becomes of some cells: those that are split are followed to their smallest parts.
void Beams::sort(Run& run, Generation& of, const Nodes& nodes, std::int64_t begin,
                 std::int64_t count) {
    gpu::Buffer beams(run.device, count * 4), splits(run.device, count * 4);
    Nodes next{gpu::Buffer(run.device, count * kNodeBytes), 0};
    std::array<std::uint32_t, kBeamCounts> counts{};
    counts[kWantedCount] = static_cast<std::uint32_t>(of.wantedCount);
    mCounts.upload(counts.data(), mCounts.bytes());
    mParams.list.x = static_cast<unsigned>(count);
    mParams.list.y = static_cast<unsigned>(begin);
    mParams.generation.x = static_cast<unsigned>(of.length);
    mBlock.upload(&mParams, sizeof mParams);
    mBlock.bindUniform(kParamsBlock);
    of.middle.points.bindStorage(kPointsBuffer);
    if (mShifts) of.shifted.points.bindStorage(kShiftedBuffer);
    of.marks.bindStorage(kBranchesBuffer);
    of.wanted.bindStorage(kWantedBuffer);
    of.slots.bindStorage(kSlotsBuffer);
    run.surfaces.bindReceiving();
    nodes.list.bindStorage(kNodesBuffer);
    beams.bindStorage(kBeamsBuffer);
    splits.bindStorage(kSplitsBuffer);
    next.list.bindStorage(kNextNodesBuffer);
    mCounts.bindStorage(kBeamCountsBuffer);
    mBooks.bindStorage(kBooksBuffer);
    run.profiler.begin("beam cells");
    dispatchList(mSort, count);
    mCounts.download(counts.data(), mCounts.bytes());
    run.profiler.end();
    run.culled += counts[kCulledCount];
    of.wantedCount = counts[kWantedCount];
    of.branchCount += counts[kBranchCount];
    next.count = counts[kNextCount];
    if (next.count > 0) of.next.push_back(std::move(next));
    if (counts[kBeamCount] > 0) {
        run.profiler.begin("beams");
        layDown(run, of, counts[kBeamCount]);
        run.profiler.end();
    }
    const std::int64_t all = counts[kSplitCount], kept = of.count;
    // Where its points would be too many, cells are split part by part: each is followed to its end
    // before its points give way to the next one's.
    const bool whole = kept + kNewPoints * all <= kMostPoints;
    if (!whole && all > 0) follow(run, of, false);
    for (std::int64_t first = 0; first < all && !run.nearFull;) {
        const std::int64_t part = whole ? all : std::min(kPart, all - first);
        grow(run, of, kept + kNewPoints * part);
        Nodes children{gpu::Buffer(run.device, 4 * part * kNodeBytes), 4 * part};
        mParams.list = uvec4(part, first, kept, mParams.list.w);
        mBlock.upload(&mParams, sizeof mParams);
        mBlock.bindUniform(kParamsBlock);
        of.middle.points.bindStorage(kPointsBuffer);
        nodes.list.bindStorage(kNodesBuffer);
        splits.bindStorage(kSplitsBuffer);
        children.list.bindStorage(kNextNodesBuffer);
        dispatchList(mSplit, part);
        trace(run, of, kNewPoints * part, kept, nullptr);
        of.count = kept + kNewPoints * part;
        level(run, of, children);
        if (!whole) {
            follow(run, of, false);
            of.count = kept;
        }
        first += part;
    }
}

/// Goes on from the interfaces where cells of this generation wait. At the last call for it its
/// memory is freed.
void Beams::follow(Run& run, Generation& of, bool last) {
    if (of.next.empty() || run.nearFull) return;
    Nodes nodes{gpu::Buffer(run.device, of.branchCount * kNodeBytes), of.branchCount};
    std::array<std::uint32_t, kBeamCounts> counts{};
    mCounts.upload(counts.data(), mCounts.bytes());
    mCounts.bindStorage(kBeamCountsBuffer);
    of.slots.bindStorage(kSlotsBuffer);
    nodes.list.bindStorage(kNextNodesBuffer);
    mParams.generation.x = static_cast<unsigned>(of.length);
    for (const Nodes& waiting : of.next) {
        mParams.list.x = static_cast<unsigned>(waiting.count);
        mBlock.upload(&mParams, sizeof mParams);
        mBlock.bindUniform(kParamsBlock);
        waiting.list.bindStorage(kNodesBuffer);
        dispatchList(mFollow, waiting.count);
    }
    Generation after;
    after.length = of.length + 1;
    grow(run, after, of.wantedCount);
    after.count = of.wantedCount;
    trace(run, after, after.count, 0, &of);
    of.next.clear();
    of.wantedCount = 0;
    of.branchCount = 0;
    if (last)
        of = {};
    else
        of.marks.clear();
    level(run, after, nodes);
    nodes = {};
    follow(run, after, true);
}

bool Beams::carry(gpu::Device& device, scene::Transport& transport, const Media& media,
                  const gpu::Texture& leaves, const SurfaceReceiver& surfaces, const Window& window,
                  const Batch& batch, double unit, BeamEnergy& energy, gpu::Profiler& profiler,
                  Stats& stats) {
    Run run{device, transport, media, leaves, surfaces, profiler};
    transport.setLines(mMiddle);
    mParams.limits.z = static_cast<float>(unit);
    mParams.levels.y = batch.cells.x / kStart;
    mParams.levels.z = batch.cells.y / kStart;
    aim(window, batch);
    mParams.window = vec4(window.low, window.extent);
    mParams.right = vec4(window.right, mParams.right.w);
    mParams.up = vec4(window.up, 0);
    mParams.forward = vec4(window.forward, window.point ? 1 : 0);
    mParams.origin = vec4(window.origin, window.startsAtLight ? 1 : 0);
    mParams.axis = axisOf(window.source);
    mParams.cone = coneOf(window.source);
    mParams.polarizer = vec4(window.source.polarizer, 0);
    const glm::dvec2 cell = 1.0 / glm::dvec2(window.pixels);
    mParams.batch =
        vec4(glm::dvec2(batch.low) * cell, cell / static_cast<double>(mParams.levels.x));
    const double away = window.point ? std::max(0.5 * (window.near + window.far), 1.0) : 1.0;
    mParams.map.x = static_cast<float>(window.pixelArea() * away * away);
    mBooks.clear();

    Generation first;
    const std::int64_t cells = std::int64_t{mParams.levels.y} * mParams.levels.z;
    const std::int64_t points = std::int64_t{2 * mParams.levels.y + 1} * (2 * mParams.levels.z + 1);
    grow(run, first, points);
    first.count = points;
    Nodes nodes{gpu::Buffer(device, cells * kNodeBytes), cells};
    mBlock.upload(&mParams, sizeof mParams);
    mBlock.bindUniform(kParamsBlock);
    first.middle.points.bindStorage(kPointsBuffer);
    nodes.list.bindStorage(kNodesBuffer);
    dispatchList(mGrid, points);
    trace(run, first, points, 0, nullptr);
    level(run, first, nodes);
    follow(run, first, true);
    if (run.nearFull) return false;

    std::vector<std::uint32_t> books(static_cast<size_t>(kBooks) * kBookSlots * 3);
    mBooks.download(books.data(), mBooks.bytes());
    std::array<dvec3, kBooks> sums{};
    for (size_t i = 0; i < books.size(); ++i)
        sums[i / 3 % kBooks][static_cast<int>(i % 3)] += books[i] / double{kBookUnit};
    energy = {sums[kBookEntered], sums[kBookLanded],  sums[kBookLeft],
              sums[kBookDeep],    sums[kBookTrapped], sums[kBookDim]};
    stats.count("beams", run.beams);
    stats.count("beam_points", run.points);
    stats.count("beam_deposits", run.deposits);
    if (run.culled > 0) stats.count("beams_culled", run.culled);
    if (run.missed > 0) stats.count("beam_deposits_missed", run.missed);
    return true;
}

void Beams::begin(const glm::dvec3& colour, const optics::Band& band) {
    mParams.map = vec4(0, colour);
    mMiddle.assign(optics::kLinesPerBand, band.middle);
    if (!mShifts) return;
    std::vector<double> wavelengths = band.spread;
    std::sort(wavelengths.begin(), wavelengths.end());
    const auto termFrom = [&](double wavelength) {
        return optics::cauchyTerm(wavelength) - optics::cauchyTerm(band.middle.wavelength);
    };
    mShifted.assign(optics::kLinesPerBand, {wavelengths.back(), band.middle.weight});
    static_assert(2 * kMostShifts == optics::kLinesPerBand);
    for (int i = 0; i < optics::kLinesPerBand; ++i)
        mParams.shifts[i / 4][i % 4] = static_cast<float>(
            termFrom(wavelengths[static_cast<size_t>(i)]) / termFrom(wavelengths.back()));
}

std::vector<gpu::Need> beamNeeds(const Plan& plan, const Params& params) {
    const std::int64_t wanted = cellsOf(params);
    const std::int64_t cells =
        std::min<std::int64_t>(wanted > 0 ? wanted : kMostCells, kBatchCells * kBatchCells);
    const std::int64_t branches = plan.polarises() ? 4 : 2;
    const std::int64_t rays = kPointBytes + (scene::areMany(plan.scene.objects) ? kBytesPerSet : 0);
    const std::int64_t points = std::min(16 * 4 * cells, kMostPoints);
    // Of one generation, with those of cells that are split, and of the next.
    const std::int64_t generation = points * (rays + 4 + 2 * 4 * branches);
    const std::int64_t shifted = shifts(plan, params) ? 2 * points * rays : 0;
    return {{"the beams", generation, true, 0},
            {"the beams that go on", generation, true, 0},
            {"the beams of a second wavelength", shifted, false, 0},
            {"the beams' cells", kCellBytes * kCellsPerCut, true, 0}};
}

} // namespace eikonal::lightsim
