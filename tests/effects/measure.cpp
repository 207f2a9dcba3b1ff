// Times of scenes and kernels, taken in turns; sizes beside them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace effects {

using namespace eikonal;

namespace {

struct Measured {
    std::vector<double> ms; ///< one a round
    double steps = 0;
    Variant variant;
};

/// Every case once a round, each round beginning with another one: what the machine does meanwhile
/// falls on all alike. The first round, in which kernels are compiled, does not count.
std::vector<Measured> interleaved(gpu::Device& device, const std::vector<const Case*>& cases,
                                  int rounds) {
    std::vector<Measured> results(cases.size());
    for (int round = 0; round <= rounds; ++round)
        for (size_t i = 0; i < cases.size(); ++i) {
            const size_t at = (i + static_cast<size_t>(round)) % cases.size();
            const Run made = run(*cases[at], device);
            results[at].variant = made.variant;
            results[at].steps = made.outcome.steps;
            if (round > 0) results[at].ms.push_back(made.outcome.gpuMs);
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

/// To the first case of the same round: median and the middle half of the rounds.
Json ratioOf(const Measured& one, const Measured& base) {
    std::vector<double> ratios;
    for (size_t i = 0; i < one.ms.size(); ++i) ratios.push_back(one.ms[i] / base.ms[i]);
    return {{"median", quantile(ratios, 0.5)},
            {"low", quantile(ratios, 0.25)},
            {"high", quantile(ratios, 0.75)}};
}

Json switchesOf(const Variant& variant) {
    Json switches = Json::object();
    for (const auto& [name, value] : variant.switches) switches[name] = value;
    return switches;
}

const char* kindOf(const Binding& binding) {
    const char* const kinds[] = {"block", "buffer", "texture", "image"};
    return kinds[static_cast<int>(binding.kind)];
}

Json bindingsOf(const Module& module) {
    Json all = Json::array();
    for (const Binding& one : module.bindings)
        all.push_back({{"kind", kindOf(one)}, {"number", one.number}, {"name", one.name}});
    return all;
}

Json measurePrices(const std::vector<Case>& cases, int rounds, const std::string& work) {
    std::vector<std::uint64_t> bytes;
    for (const Case& one : cases) bytes.push_back(peakBytesOf(one));
    gpu::Device device(gpu::DeviceChoice{});
    std::vector<const Case*> turns;
    for (const Case& one : cases) turns.push_back(&one);
    turns.push_back(&cases[0]); // against itself: the noise
    const std::vector<Measured> measured = interleaved(device, turns, rounds);
    Json rows = Json::array();
    for (size_t i = 0; i < turns.size(); ++i) {
        const bool isNoise = i == cases.size();
        const size_t at = isNoise ? 0 : i;
        const Variant& variant = measured[i].variant;
        const std::optional<Module> module = moduleOf(variant, work);
        rows.push_back({{"name", isNoise ? "the same again" : cases[at].name},
                        {"tracing", cases[at].isTracing},
                        {"ms", quantile(measured[i].ms, 0.5)},
                        {"ratio", ratioOf(measured[i], measured[0])},
                        {"steps", measured[i].steps},
                        {"peak_bytes", bytes[at]},
                        {"added_bytes", static_cast<std::int64_t>(bytes[at] - bytes[0])},
                        {"instructions", module ? Json(module->instructions) : Json(nullptr)},
                        {"bindings", module ? bindingsOf(*module) : Json(nullptr)},
                        {"program_bytes", variant.binaryBytes},
                        {"switches", switchesOf(variant)}});
    }
    return rows;
}

} // namespace

void measure(Json& results, const std::string& only, const Scale& scale, int rounds,
             const std::string& work) {
    const auto isMeant = [&](Family family) { return only.empty() || nameOf(family) == only; };
    if (std::none_of(std::begin(kFamilies), std::end(kFamilies), isMeant))
        throw std::runtime_error("found family '" + only + "', there is none");
    {
        const gpu::Device device(gpu::DeviceChoice{});
        results["device"] = device.info().renderer;
        results["version"] = device.info().version;
    }
    results["compiler"] = compilerName();
    results["cores"] = std::thread::hardware_concurrency();
    results["voxels"] = scale.voxels;
    results["picture"] = {scale.width, scale.rows};
    results["photons"] = scale.photons;
    results["rounds"] = rounds;
    for (const Family family : kFamilies)
        if (isMeant(family))
            results["prices"][nameOf(family)] = measurePrices(casesOf(family, scale), rounds, work);
}

} // namespace effects
