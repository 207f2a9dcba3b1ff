// accuracy: what every knob that trades accuracy for time costs and gives, and whether bars are
// met. SPDX-License-Identifier: GPL-3.0-or-later
#include "image_space.h"
#include "report.h"

#include "base/error.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

using namespace accuracy;

namespace {

constexpr int kProgram = 1; // raised when what a row means changes

void write(const std::string& path, const std::string& text) {
    std::ofstream out(path);
    out << text;
    if (!out) throw eikonal::InternalError("can't write " + path);
}

void run(const std::string& work, const std::string& json, const std::string& page,
         const std::string& effort, const std::string& deviceName, const std::string& only) {
    std::filesystem::create_directories(work);
    eikonal::gpu::Device device(eikonal::gpu::parseDeviceChoice(deviceName));
    const Json version{
        {"library", libraryVersion()}, {"device", device.info().renderer}, {"program", kProgram}};
    Bench bench{device, work, effort == "full", version};
    std::vector<Task> tasks;
    for (const auto& part :
         {rayTasks, orderTasks, chainTasks, sharpTasks, glassTasks, imageTasks, lightTasks})
        for (Task& task : part(bench))
            if (task.label.find(only) != std::string::npos) tasks.push_back(std::move(task));
    const std::vector<Json> rows = runTasks(tasks, work + "/rows.jsonl");
    const Summary summary = summarise(rows);
    Json result{
        {"effort", effort}, {"device", device.info().renderer}, {"library", version["library"]}};
    result["bars"] = summary.bars;
    result["frontier"] = summary.frontier;
    result["rows"] = rows;
    write(json, result.dump(1) + "\n");
    for (const auto& [name, text] : plotData(rows, summary)) write(work + "/" + name, text);
    if (!page.empty()) write(page, pageOf(rows, summary, bench));
    for (const Json& bar : summary.bars)
        std::printf("%-4s %s: %s\n", bar["met"].get<bool>() ? "met" : "MISS",
                    bar["bar"].get<std::string>().c_str(), bar["found"].get<std::string>().c_str());
}

} // namespace

int main(int argc, char** argv) {
    std::string work, json, page, effort = "full", device = "auto", only;
    CLI::App app("Measures accuracy against time.", "accuracy");
    app.add_option("--work", work, "folder for rows and plots")->required();
    app.add_option("--json", json, "file for the results")->required();
    app.add_option("--page", page, "file for the page of tables");
    app.add_option("--effort", effort, "quick or full")->check(CLI::IsMember({"quick", "full"}));
    app.add_option("--only", only, "measure only what has this in its label; bars lack the rest");
    app.add_option("--device", device, "as the tools' option");
    CLI11_PARSE(app, argc, argv);
    try {
        run(work, json, page, effort, device, only);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "accuracy: error: %s\n", error.what());
        return 70;
    }
    return 0;
}
