// Times of scenes and kernels, taken in turns; sizes beside them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include <algorithm>
#include <thread>

namespace effects {

using namespace eikonal;

namespace {

/// A scene to be run with the kernels of a folder, "" for those built in.
struct Job {
    const Case* scene;
    std::string folder;
};

struct Measured {
    std::vector<double> ms; ///< one a round
    double steps = 0;
    Variant variant;
};

/// Every job once a round, each round beginning with another one: what the machine does meanwhile
/// falls on all alike. The first round, in which kernels are compiled, does not count.
std::vector<Measured> interleaved(gpu::Device& device, const std::vector<Job>& jobs, int rounds) {
    std::vector<Measured> results(jobs.size());
    for (int round = 0; round <= rounds; ++round)
        for (size_t i = 0; i < jobs.size(); ++i) {
            const size_t at = (i + static_cast<size_t>(round)) % jobs.size();
            const ShaderFolder use(jobs[at].folder);
            const Outcome outcome = jobs[at].scene->run(device);
            results[at].variant = lastVariant(jobs[at].scene->kernel);
            results[at].steps = outcome.steps;
            if (round > 0) results[at].ms.push_back(outcome.gpuMs);
        }
    return results;
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<size_t>(at);
    const size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

/// To the first job of the same round: median and the middle half of the rounds.
Json ratioOf(const Measured& one, const Measured& base) {
    std::vector<double> ratios;
    for (size_t i = 0; i < one.ms.size(); ++i) ratios.push_back(one.ms[i] / base.ms[i]);
    return {{"median", quantile(ratios, 0.5)},
            {"low", quantile(ratios, 0.25)},
            {"high", quantile(ratios, 0.75)},
            // Whatever else the machine does only adds.
            {"fastest", quantile(one.ms, 0) / quantile(base.ms, 0)}};
}

Json switchesOf(const Variant& variant) {
    Json switches = Json::object();
    for (const auto& [name, value] : variant.switches) switches[name] = value;
    return switches;
}

Json instructions(const Variant& variant, const std::string& work) {
    const std::optional<Instructions> all = instructionsOf(variant.text, work);
    return all ? Json(all->size()) : Json(nullptr);
}

Json measurePrices(const std::vector<Case>& cases, int rounds, const std::string& work) {
    std::vector<std::uint64_t> bytes;
    for (const Case& one : cases) bytes.push_back(peakBytesOf(one));
    gpu::Device device(gpu::DeviceChoice{});
    std::vector<Job> jobs;
    for (const Case& one : cases) jobs.push_back({&one, ""});
    jobs.push_back({&cases[0], ""}); // against itself: the noise
    const std::vector<Measured> measured = interleaved(device, jobs, rounds);
    Json rows = Json::array();
    for (size_t i = 0; i < jobs.size(); ++i) {
        const bool isNoise = i == cases.size();
        const size_t at = isNoise ? 0 : i;
        const Variant& variant = measured[i].variant;
        rows.push_back({{"name", isNoise ? "the same again" : cases[at].name},
                        {"tracing", cases[at].isTracing},
                        {"ms", quantile(measured[i].ms, 0.5)},
                        {"ratio", ratioOf(measured[i], measured[0])},
                        {"steps", measured[i].steps},
                        {"peak_bytes", bytes[at]},
                        {"added_bytes", static_cast<std::int64_t>(bytes[at] - bytes[0])},
                        {"instructions", instructions(variant, work)},
                        {"program_bytes", variant.binaryBytes},
                        {"switches", switchesOf(variant)}});
    }
    return rows;
}

Json measureAbsence(const Case& scene, const std::vector<Cut>& cuts, int rounds,
                    const std::string& work) {
    gpu::Device device(gpu::DeviceChoice{});
    std::vector<Job> jobs{{&scene, ""}, {&scene, ""}};
    std::vector<std::string> names{"", "nothing (the full text again)"};
    const auto add = [&](const std::string& name, const std::vector<Cut>& some) {
        std::string folder = work + "/without " + name;
        std::replace(folder.begin(), folder.end(), ' ', '_');
        writeWithout(some, folder);
        jobs.push_back({&scene, folder});
        names.push_back(name);
    };
    for (const Cut& one : cuts) add(one.effect, {one});
    if (cuts.size() > 1) add("all of these", cuts);
    const std::vector<Measured> measured = interleaved(device, jobs, rounds);
    Json rows = Json::array();
    for (size_t i = 1; i < jobs.size(); ++i)
        rows.push_back({{"without", names[i]},
                        // The full text's time to that without: what the absent effect costs.
                        {"ratio", ratioOf(measured[0], measured[i])},
                        {"instructions_full", instructions(measured[0].variant, work)},
                        {"instructions_without", instructions(measured[i].variant, work)},
                        {"same_instructions", instructionsOf(measured[0].variant.text, work) ==
                                                  instructionsOf(measured[i].variant.text, work)},
                        {"program_bytes_full", measured[0].variant.binaryBytes},
                        {"program_bytes_without", measured[i].variant.binaryBytes}});
    return {{"scene", scene.name}, {"kernel", scene.kernel}, {"rows", rows}};
}

} // namespace

Json measure(const Scale& scale, int rounds, const std::string& work) {
    watchPrograms();
    Json results;
    {
        const gpu::Device device(gpu::DeviceChoice{});
        results["device"] = device.info().renderer;
        results["version"] = device.info().version;
    }
    results["cores"] = std::thread::hardware_concurrency();
    results["voxels"] = scale.voxels;
    results["picture"] = {scale.width, scale.rows};
    results["photons"] = scale.photons;
    // Absence is to be told to a percent, prices to a tenth: those take a quarter of the rounds.
    results["rounds"] = rounds;
    results["price_rounds"] = std::max(5, rounds / 4);
    const int few = results["price_rounds"];
    const std::vector<Case> views = viewCases(scale), sharp = sharpCases(scale),
                            photons = photonCases(scale);
    results["view"] = measurePrices(views, few, work);
    results["sharp"] = measurePrices(sharp, few, work);
    results["photon"] = measurePrices(photons, few, work);
    results["absent"] = {
        measureAbsence(views[0], viewCuts(), rounds, work + "/view"),
        measureAbsence(straightViewCase(scale), straightViewCuts(), rounds, work + "/view"),
        measureAbsence(sharp[0], sharpCuts(), rounds, work + "/sharp"),
        measureAbsence(curvedSharpCase(scale), curvedSharpCuts(), rounds, work + "/sharp"),
        measureAbsence(photons[0], photonCuts(), rounds, work + "/photons"),
        measureAbsence(straightPhotonCase(scale), straightPhotonCuts(), rounds, work + "/photons")};
    return results;
}

} // namespace effects
