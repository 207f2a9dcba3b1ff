// effects: what each effect costs when it is there, and when it is not; a page and JSON.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

int main(int argc, char** argv) {
    effects::Scale scale;
    std::string json, page, work;
    int rounds = 25;
    bool again = false;
    CLI::App app("Prices every effect.", "effects");
    app.add_option("--json", json, "file for the results")->required();
    app.add_option("--page", page, "file for the page")->required();
    app.add_option("--work", work, "folder for kernels with effects cut out")->required();
    app.add_option("--rounds", rounds, "of each comparison with a kernel cut");
    app.add_option("--voxels", scale.voxels, "along an edge");
    app.add_flag("--again", again, "write the page anew from the results there are");
    CLI11_PARSE(app, argc, argv);
    try {
        effects::Json results;
        if (again) {
            std::ifstream(json) >> results;
        } else {
            std::filesystem::create_directories(work);
            results = effects::measure(scale, rounds, work);
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
