// The voxelising stage: meshes and materials in, a scene volume out (Sun et al. 2008, §4.1).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/voxelize.h"

#include "mesh/shells.h"
#include "voxelize/coverage.h"
#include "voxelize/mixer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

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
    std::vector<std::vector<std::uint16_t>> counts(sources.size());
    for (int row = 0; row < rows; row += coverage.rowsPerStrip()) {
        const int some = std::min(coverage.rowsPerStrip(), rows - row);
        profiler.begin("voxelize");
        for (size_t k = 0; k < sources.size(); ++k)
            coverage.count(sources[k], row, some, counts[k]);
        profiler.end();
        HostPass pass(stats, "materials");
        mixer.mix(counts, row, some);
        report(progress, 0.7 * (row + some) / rows);
    }
    profiler.collect();
}

/// Fills the counters; gives a warning for each object that covers nothing.
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
        const volume::DenseGrid dense = mixer.take(grid);
        if (!shows) continue;
        volume::PutOptions options;
        options.background = backgroundOf(params, grid);
        // The index tells every reader where the domain ends.
        options.allActive = grid == Grid::ior;
        options.vectorType = componentsOf(grid) == 3 ? "color" : "";
        volume.put(nameOf(grid), plan.box, dense, options);
    }
}

/// A mesh's solids and cavities, larger ones first, so that what is nested comes after what it
/// lies in; as few groups as that allows.
std::vector<volume::Shells> shellsOf(const mesh::TriangleMesh& mesh) {
    std::vector<mesh::Shell> shells = mesh::findShells(mesh, mesh::sortedEdges(mesh));
    std::erase_if(shells, [](const mesh::Shell& shell) { return shell.flat; });
    std::stable_sort(shells.begin(), shells.end(), [](const mesh::Shell& a, const mesh::Shell& b) {
        return std::abs(a.volume) > std::abs(b.volume);
    });
    std::vector<volume::Shells> groups;
    for (const mesh::Shell& shell : shells) {
        const bool cavity = shell.volume < 0;
        if (groups.empty() || groups.back().cavity != cavity) groups.push_back({{}, cavity});
        for (std::uint32_t face : shell.faces)
            groups.back().triangles.push_back(mesh.triangles[face]);
    }
    return groups;
}

void putDistances(volume::Volume& volume, const Params& params, const Plan& plan) {
    for (const Object& object : params.objects)
        volume.putLevelSet(params.objects.size() > 1 ? "sdf." + object.name : "sdf", plan.box,
                           object.mesh.points, shellsOf(object.mesh), params.sdfBand);
}

} // namespace

Result voxelize(gpu::Device& device, const Params& params, const Plan& plan, Stats& stats,
                const Progress& progress, std::int64_t stripBytes) {
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
    report(progress, 0.9);
    if (params.sdf) {
        HostPass pass(stats, "sdf");
        putDistances(volume, params, plan);
    }
    stats.gpuPeakBytes = device.peakBytes();
    report(progress, 1.0);
    return result;
}

} // namespace eikonal::voxelize
