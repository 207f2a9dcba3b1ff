// Stages as whole processes: fixed cost, share of files, and the tables of Sun et al. 2008.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "base/error.h"

#include <chrono>
#include <cstdlib>
#include <fstream>

namespace bench {

using namespace eikonal;

namespace {

struct Run {
    double wallMs = 0; ///< from outside: the process's start and end included
    Json stats;
};

/// Runs a tool with --stats, without its messages.
Run run(const Settings& s, const std::string& tool, const std::string& arguments,
        const std::string& environment = "") {
    const std::string statsPath = s.work + "/stats.json";
    const std::string command = environment + " '" + s.bin + "/" + tool + "' " + arguments +
                                " --quiet --device " + s.device + " --stats " + statsPath;
    const auto begin = std::chrono::steady_clock::now();
    if (std::system(command.c_str()) != 0) throw InternalError("failed: " + command);
    Run result;
    result.wallMs =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    std::ifstream(statsPath) >> result.stats;
    return result;
}

double pass(const Json& stats, const std::vector<std::string>& names) {
    double ms = 0;
    for (const Json& item : stats["passes"])
        for (const std::string& name : names)
            if (item["name"] == name) ms += item["cpu_ms"].get<double>();
    return ms;
}

/// The passes that read, check, convert or write VDB files: mesh2vol reads a mesh, render writes
/// EXR.
std::vector<std::string> volumePasses(const std::string& tool) {
    if (tool == "mesh2vol") return {"grids", "write"};
    if (tool == "render") return {"read"};
    return {"read", "grids", "write"};
}

/// All passes but those that read and write files and open the device: what 003 times.
double work(const Json& stats) {
    double ms = 0;
    for (const Json& item : stats["passes"])
        if (item["name"] != "read" && item["name"] != "write" && item["name"] != "device" &&
            item["name"] != "check")
            ms += item["cpu_ms"].get<double>();
    return ms;
}

const char* kCamera = " --eye 0.2,0.4,3.2 --target 0,0,0 --fov 28 --size ";

enum class Edge { blurred, sharp };

/// The commands on a mesh, as file names in the work folder. Distances need no smoothing.
std::vector<std::pair<std::string, std::string>> chain(const Settings& s, const std::string& mesh,
                                                       const std::string& volume,
                                                       const std::string& photons, Edge edge,
                                                       const std::string& size = "640x480") {
    const std::string w = s.work + "/";
    const bool sharp = edge == Edge::sharp;
    std::vector<std::pair<std::string, std::string>> all{
        {"mesh2vol", mesh + " -o " + w + "a.vdb --ior 1.3 --medium-scattering 0.3 --boundary " +
                         (sharp ? "sharp " : "blurred ") + volume}};
    if (!sharp) all.emplace_back("volsmooth", w + "a.vdb -o " + w + "b.vdb");
    all.emplace_back("lightsim", w + (sharp ? "a" : "b") + ".vdb -o " + w +
                                     "c.vdb --light directional:0.2,-1,0.1 --photons " + photons);
    all.emplace_back("render", w + "c.vdb -o " + w + "d.exr" + kCamera + size);
    return all;
}

struct Row {
    double steps = 0, photons = 0, voxelization = 0, tracing = 0, total = 0, view = 0, rss = 0;
};

Row runChain(const Settings& s, const std::string& mesh, const std::string& volume,
             const std::string& photons, Edge edge = Edge::blurred) {
    Row row;
    for (const auto& [tool, arguments] : chain(s, mesh, volume, photons, edge)) {
        const Json stats = run(s, tool, arguments).stats;
        row.total += work(stats);
        row.rss = std::max(row.rss, stats["memory"]["rss_peak_bytes"].get<double>());
        if (tool == "mesh2vol") row.voxelization = pass(stats, {"voxelize", "materials"});
        if (tool == "render") row.view = pass(stats, {"view"});
        if (tool != "lightsim") continue;
        row.tracing = pass(stats, {"photon emission", "photons", "resolve", "energy"});
        row.steps = stats["counters"]["steps"].get<double>();
        row.photons = stats["counters"]["photons"].get<double>();
    }
    return row;
}

/// The passes that measure distances, and walls to plan them by.
std::vector<std::string> distancePasses(const std::string& tool) {
    if (tool == "mesh2vol") return {"plan", "sdf"};
    return {};
}

/// Fixed costs, times and shares of each command.
void addStages(const Settings& s, const std::string& mesh, Edge edge, Json& result) {
    // The driver's own cache of compiled shaders would hide what compiling costs.
    const std::string cold = "MESA_SHADER_CACHE_DISABLE=true __GL_SHADER_DISK_CACHE=0";
    std::vector<Json> fixed;
    for (const auto& [tool, arguments] : chain(s, mesh, "--resolution 32", "1024", edge, "64x48")) {
        std::vector<double> compiled, cached;
        for (int i = 0; i < s.repeats; ++i) {
            compiled.push_back(run(s, tool, arguments, cold).wallMs);
            cached.push_back(run(s, tool, arguments).wallMs);
        }
        fixed.push_back({{"fixed_ms", median(compiled)}, {"fixed_cached_ms", median(cached)}});
    }
    size_t i = 0;
    for (const auto& [tool, arguments] : chain(s, mesh, "--resolution 128", "1048576", edge)) {
        std::vector<double> wall, share, distances, rss, device;
        for (int k = 0; k < std::max(1, s.repeats / 2); ++k) {
            const Run r = run(s, tool, arguments);
            wall.push_back(r.wallMs);
            share.push_back(pass(r.stats, volumePasses(tool)) / r.wallMs);
            distances.push_back(pass(r.stats, distancePasses(tool)) / r.wallMs);
            rss.push_back(r.stats["memory"]["rss_peak_bytes"].get<double>());
            device.push_back(r.stats["memory"]["gpu_peak_bytes"].get<double>());
        }
        result.push_back({{"stage", tool},
                          {"boundary", edge == Edge::sharp ? "sharp" : "blurred"},
                          {"fixed_ms_32", fixed[i]["fixed_ms"]},
                          {"fixed_cached_ms_32", fixed[i]["fixed_cached_ms"]},
                          {"wall_ms_128", median(wall)},
                          {"file_share_128", median(share)},
                          {"distance_share_128", median(distances)},
                          {"rss_peak_bytes", median(rss)},
                          {"gpu_peak_bytes", median(device)}});
        ++i;
    }
}

} // namespace

Json measureStages(const Settings& s) {
    Json result = Json::array();
    const std::string mesh = s.work + "/ball.obj";
    writeObj(bumpySphere(20000), mesh);
    for (const Edge edge : {Edge::blurred, Edge::sharp}) addStages(s, mesh, edge, result);
    return result;
}

Json measureTables(const Settings& s) {
    Json table1 = Json::array();
    const auto row = [&](int triangles, int occupied, int photons) {
        const std::string mesh = s.work + "/table.obj";
        const mesh::TriangleMesh shape = bumpySphere(triangles);
        writeObj(shape, mesh);
        // The object takes `occupied` voxels of the 128 along an edge.
        const mesh::Box box = mesh::boundingBox(shape);
        const glm::dvec3 size = box.max - box.min, centre = 0.5 * (box.min + box.max);
        const double half = 0.5 * std::max({size.x, size.y, size.z}) * 128 / occupied;
        const auto corner = [&](double sign) {
            return std::to_string(centre.x + sign * half) + "," +
                   std::to_string(centre.y + sign * half) + "," +
                   std::to_string(centre.z + sign * half);
        };
        const Row r = runChain(s, mesh, "--resolution 128 --bounds=" + corner(-1) + "," + corner(1),
                               std::to_string(photons * photons));
        table1.push_back({{"triangles", shape.triangles.size()},
                          {"occupied_voxels", std::to_string(occupied) + "^3"},
                          {"initial_photons", std::to_string(photons) + "^2"},
                          {"million_steps", r.steps / 1e6},
                          {"voxelization_ms", r.voxelization},
                          {"photon_tracing_ms", r.tracing},
                          {"total_ms", r.total}});
    };
    for (int triangles : {10000, 20000, 40000, 80000}) row(triangles, 103, 1024);
    for (int occupied : {64, 77, 90, 103}) row(20000, occupied, 1024);
    for (int photons : {256, 512, 1024}) row(20000, 103, photons);

    Json table2 = Json::array();
    if (!s.bunny.empty()) {
        for (const Edge edge : {Edge::blurred, Edge::sharp}) {
            const Row r = runChain(s, s.bunny, "--resolution 128 --cube", "1048576", edge);
            // What a change of the light costs: 003's frame of an interactive session.
            const double frame = r.tracing + r.view;
            table2.push_back({{"scene", edge == Edge::sharp ? "bunny, sharp" : "bunny, blurred"},
                              {"triangles", 75408},
                              {"photons", r.photons},
                              {"million_steps", r.steps / 1e6},
                              {"frames_per_second", 1e3 / frame},
                              {"rss_peak_bytes", r.rss}});
        }
    }
    return {{"table1", table1}, {"table2", table2}};
}

} // namespace bench
