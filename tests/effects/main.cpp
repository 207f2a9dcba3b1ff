// effects: what each effect costs, as a page and JSON; and how many instructions kernels have.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "counts.h"
#include "report.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace {

void countInstructions(const std::string& path, const std::string& work) {
    eikonal::gpu::Device device({eikonal::gpu::DeviceChoice::Kind::software});
    effects::Counts counts{effects::compilerName(), {}};
    for (const effects::Family family : effects::kFamilies)
        for (const effects::Case& one : effects::casesAndStraight(family, effects::kSmall)) {
            const auto module = effects::moduleOf(effects::run(one, device).variant, work);
            if (!module) throw std::runtime_error("glslang or SPIRV-Tools are not installed");
            counts.instructions.emplace_back(effects::nameOf(family) + ": " + one.name,
                                             module->instructions);
        }
    effects::writeCounts(counts, path);
}

} // namespace

int main(int argc, char** argv) {
    effects::Scale scale;
    std::string json, page, work, instructions, only;
    int rounds = 6; // prices are told to a tenth
    bool again = false;
    CLI::App app("Prices every effect.", "effects");
    app.add_option("--json", json, "file for the results");
    app.add_option("--page", page, "file for the page")->needs("--json");
    app.add_option("--work", work, "folder for kernels as SPIR-V")->required();
    app.add_option("--rounds", rounds, "of every scene");
    app.add_option("--voxels", scale.voxels, "along an edge");
    app.add_flag("--again", again, "write the page anew from the results there are");
    app.add_option("--only", only,
                   "measure this family anew, as \"beams\", of the results there are")
        ->excludes("--again");
    app.add_option("--instructions", instructions, "count them into this file, and no more")
        ->excludes("--json");
    CLI11_PARSE(app, argc, argv);
    try {
        std::filesystem::create_directories(work);
        if (!instructions.empty()) {
            countInstructions(instructions, work);
            return 0;
        }
        effects::Json results;
        if (again || !only.empty()) std::ifstream(json) >> results;
        if (!again) {
            effects::measure(results, only, scale, rounds, work);
            std::ofstream(json) << results.dump(2) << "\n";
        }
        const std::string text = effects::pageOf(results);
        std::ofstream(page) << text;
        std::printf("%s", text.c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "effects: error: %s\n", error.what());
        return 70;
    }
    return 0;
}
