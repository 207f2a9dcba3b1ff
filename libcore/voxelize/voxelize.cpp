// The voxelising stage: meshes and materials in, a scene volume out (Sun et al. 2008, §4.1).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/voxelize.h"

#include "voxelize/coverage.h"
#include "voxelize/distances.h"
#include "voxelize/mixer.h"

#include <algorithm>
#include <chrono>

namespace eikonal::voxelize {

namespace {

/// Times a pass on the host from its making to its end.
class HostPass {
public:
    HostPass(Stats& stats, const char* name) : mStats(stats), mName(name) {}
    ~HostPass() { mStats.addPass(mName, 0, gpu::millisecondsSince(mBegin)); }
    HostPass(const HostPass&) = delete;
    HostPass& operator=(const HostPass&) = delete;

private:
    Stats& mStats;
    const char* mName;
    std::chrono::steady_clock::time_point mBegin = std::chrono::steady_clock::now();
};

/// Counts and mixes strip by strip, so that the device need not hold the volume.
void fill(gpu::Device& device, const Params& params, const Plan& plan, Mixer& mixer, Stats& stats,
          const Progress& progress, std::int64_t stripBytes) {
    gpu::Profiler profiler(stats);
    profiler.begin("voxelize");
    Coverage coverage(device, plan.lattice, stripBytes);
    std::vector<FacetSource> sources;
    for (const Object& object : params.objects) sources.emplace_back(object.mesh, plan.lattice);
    profiler.end();
    const int rows = plan.lattice.size.y;
    std::vector<Counts> counts(sources.size());
    for (int row = 0; row < rows; row += coverage.rowsPerStrip()) {
        const int some = std::min(coverage.rowsPerStrip(), rows - row);
        profiler.begin("voxelize");
        for (size_t k = 0; k < sources.size(); ++k)
            counts[k] = coverage.count(sources[k], row, some);
        profiler.end();
        HostPass pass(stats, "materials");
        mixer.mix(counts, row);
        report(progress, 0.7 * (row + some) / rows);
    }
    profiler.collect();
}

/// Fills the counters; gives a warning for each object that covers nothing or has thin walls.
std::vector<std::string> countAll(const Params& params, const Plan& plan, const Mixer& mixer,
                                  Stats& stats) {
    std::vector<std::string> warnings;
    for (size_t k = 0; k < params.objects.size(); ++k) {
        const Object& object = params.objects[k];
        stats.count("triangles", static_cast<double>(object.mesh.triangles.size()));
        if (mixer.covered(k) == 0)
            warnings.push_back("'" + object.name +
                               "' covers no voxel: it lies outside the domain, or is too "
                               "small for --resolution and --supersample");
    }
    stats.count("voxels", static_cast<double>(plan.box.voxels()));
    stats.count("occupied_voxels", static_cast<double>(mixer.occupied()));
    if (const auto wall = thinnestWallVoxels(plan)) stats.count("thinnest_wall_voxels", *wall);
    const std::vector<std::string> thin = thinWallWarnings(params, plan);
    warnings.insert(warnings.end(), thin.begin(), thin.end());
    return warnings;
}

void putGrids(volume::Volume& volume, const Params& params, const Plan& plan, Mixer& mixer,
              Stats& stats) {
    for (Grid grid : plan.grids) {
        const bool shows = grid == Grid::ior || mixer.showsSomething(grid);
        if (!shows)
            for (Effect& effect : stats.effects)
                if (effect.name == nameOf(grid))
                    effect = {effect.name, false, effect.why + ", but fills no voxel"};
        const volume::BrickGrid bricks = mixer.take(grid);
        if (!shows) continue;
        volume::PutOptions options;
        options.background = backgroundOf(params, grid);
        // The index tells every reader where the domain ends.
        options.allActive = grid == Grid::ior;
        options.vectorType = componentsOf(grid) == 3 ? "color" : "";
        volume.put(nameOf(grid), plan.box, bricks, options);
    }
}

/// Each material alone, as grids that are one value everywhere: an object's where it is not what
/// readers take for granted, the medium's where the mixed grid's background is another.
void putOwnValues(volume::Volume& volume, const Params& params) {
    for (Grid grid : kGrids) {
        const std::string name = nameOf(grid);
        for (const Object& object : params.objects) {
            const glm::dvec3 value = valueOf(object.material, grid);
            if (grid == Grid::ior || value != absentValue(grid))
                volume.putConstant(volume::ownGrid(name, object.name), value);
        }
        const glm::dvec3 around = valueOf(params.medium, grid);
        if (around != backgroundOf(params, grid))
            volume.putConstant(volume::ownGrid(name, volume::kMedium), around);
    }
}

void putDistances(volume::Volume& volume, const Params& params, const Plan& plan) {
    for (size_t k = 0; k < params.objects.size(); ++k) {
        const Object& object = params.objects[k];
        volume::ObjectFacts facts{object.name,
                                  "sdf",
                                  object.priority,
                                  static_cast<int>(k),
                                  static_cast<float>(object.material.roughness),
                                  object.material.metal,
                                  object.material.crystal};
        if (params.objects.size() > 1) facts.sdf = volume::ownGrid("sdf", object.name);
        volume.putLevelSet(facts, plan.box,
                           signedDistances(object.mesh, plan.lattice, params.sdfBand),
                           params.sdfBand);
    }
}

} // namespace

Result voxelize(gpu::Device& device, const Params& params, const Plan& plan, Stats& stats,
                const Progress& progress, std::int64_t stripBytes) {
    stripBytes = std::min(stripBytes, stripBytesFor(params.objects.size()));
    device.requireFit(coverageNeeds(plan.lattice, stripBytes));
    stats.effects = plan.effects;
    Mixer mixer(params, plan.grids, plan.lattice);
    fill(device, params, plan, mixer, stats, progress, stripBytes);
    Result result{volume::Volume(plan.frame), countAll(params, plan, mixer, stats)};
    volume::Volume& volume = result.volume;
    {
        HostPass pass(stats, "grids");
        putGrids(volume, params, plan, mixer, stats);
    }
    if (params.ground) volume.setMetadata(volume::kGroundKey, volume::textOf(*params.ground));
    report(progress, 0.9);
    if (params.sharp) {
        HostPass pass(stats, "sdf");
        putDistances(volume, params, plan);
        putOwnValues(volume, params);
    }
    stats.gpuPeakBytes = device.peakBytes();
    report(progress, 1.0);
    return result;
}

} // namespace eikonal::voxelize
