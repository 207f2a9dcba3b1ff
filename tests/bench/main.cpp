// bench: what the toolchain costs, as ratios within one run; tables for people, JSON for machines.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

using namespace bench;

namespace {

void printTable(const char* title, const Json& rows) {
    std::printf("\n%s\n", title);
    if (rows.empty()) return;
    for (const auto& [name, value] : rows[0].items()) std::printf("  %s", name.c_str());
    std::printf("\n");
    for (const Json& row : rows) {
        for (const auto& [name, value] : row.items()) {
            const int width = static_cast<int>(name.size());
            if (value.is_string())
                std::printf("  %*s", width, value.get<std::string>().c_str());
            else
                std::printf("  %*.*f", width, value.get<double>() < 100 ? 2 : 0,
                            value.get<double>());
        }
        std::printf("\n");
    }
}

} // namespace

int main(int argc, char** argv) {
    Settings settings;
    settings.device = "auto";
    std::string json,
        parts = "kernels,sharp,stages,steps,surfaces,fronts,hierarchy,images,sparse,tables";
    CLI::App app("Times the toolchain.", "bench");
    app.add_option("--bin", settings.bin, "folder of the tools")->required();
    app.add_option("--work", settings.work, "folder for scratch files")->required();
    app.add_option("--json", json, "file for the results")->required();
    app.add_option("--device", settings.device, "as the tools' option");
    app.add_option("--bunny", settings.bunny, "mesh for table 2");
    app.add_option("--meshes", settings.meshes, "folder of meshes, for images");
    app.add_option("--repeats", settings.repeats, "of each measurement");
    app.add_option(
        "--parts", parts,
        "which of kernels,sharp,stages,steps,surfaces,fronts,hierarchy,images,sparse,tables");
    CLI11_PARSE(app, argc, argv);
    try {
        std::filesystem::create_directories(settings.work);
        Json result;
        result["cores"] = std::thread::hardware_concurrency();
        if (parts.find("kernels") != parts.npos) {
            result["kernels"] = measureKernels(settings);
            printTable("kernels, rates per second", Json::array({result["kernels"]}));
        }
        if (parts.find("sharp") != parts.npos) {
            result["sharp"] = measureSharp(settings);
            printTable("sharp boundaries against blurred ones", result["sharp"]);
        }
        if (parts.find("stages") != parts.npos) {
            result["stages"] = measureStages(settings);
            printTable("stages", result["stages"]);
        }
        if (parts.find("steps") != parts.npos) {
            result["steps"] = measureSteps(settings);
            printTable("photon steps", result["steps"]);
        }
        if (parts.find("surfaces") != parts.npos) {
            result["surfaces"] = measureSurfaces(settings);
            printTable("light on a floor under a ball of glass and under waves",
                       result["surfaces"]);
        }
        if (parts.find("fronts") != parts.npos) {
            result["fronts"] = measureFronts(settings);
            printTable("light in volumes by wavefronts and by photons", result["fronts"]);
        }
        if (parts.find("hierarchy") != parts.npos) {
            result["hierarchy"] = measureHierarchy(settings);
            printTable("tables 1 and 2 of Barczak and Olano", result["hierarchy"]);
        }
        if (parts.find("images") != parts.npos) {
            result["images"] = measureImageSpace(settings);
            printTable("table 1 of Oliveira and Brauwers 2007", result["images"]);
        }
#ifdef EIKONAL_NANOVDB_HEADER
        if (parts.find("sparse") != parts.npos) {
            result["sparse"] = measureSparse(settings);
            printTable("look-ups of sparse distances", result["sparse"]);
        }
#else
        if (parts.find("sparse") != parts.npos)
            std::fprintf(stderr,
                         "bench: warning: no NanoVDB here (Debian: libnanovdb-dev): no sparse\n");
#endif
        if (parts.find("tables") != parts.npos) {
            result["tables"] = measureTables(settings);
            printTable("table 1 of Sun et al. 2008", result["tables"]["table1"]);
            printTable("table 2 of Sun et al. 2008", result["tables"]["table2"]);
        }
        std::ofstream(json) << result.dump(2) << "\n";
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench: error: %s\n", error.what());
        return 70;
    }
    return 0;
}
