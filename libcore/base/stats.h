// What a run measured: filled by the engines, written as JSON by the tools.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace eikonal {

/// One effect the engine can simulate, whether this run does, and which grid or option decided.
struct Effect {
    std::string name;
    bool on = false;
    std::string why;
};

/// One timed pass. Passes of the same name are added up.
struct PassTime {
    std::string name;
    double gpuMs = 0; ///< [ms], 0 for a pass that runs on the host alone
    double cpuMs = 0; ///< [ms], wall time on the host, waiting for the device included
};

/// Radiant power per RGB channel [W]; entered = absorbed + scattered + escaped + lost.
struct Energy {
    using Rgb = std::array<double, 3>;
    Rgb emitted{}, entered{}, absorbed{}, scattered{}, escaped{}, lost{};
};

struct Stats {
    std::vector<Effect> effects;
    std::vector<PassTime> passes;
    std::vector<std::pair<std::string, double>> counters; ///< in the order of first mention
    bool hasEnergy = false;
    Energy energy;
    std::uint64_t gpuPeakBytes = 0;
    std::vector<std::string> warnings;

    /// Adds to the pass's times, appending the pass when it is new.
    void addPass(const std::string& name, double gpuMs, double cpuMs) {
        for (PassTime& pass : passes) {
            if (pass.name != name) continue;
            pass.gpuMs += gpuMs;
            pass.cpuMs += cpuMs;
            return;
        }
        passes.push_back({name, gpuMs, cpuMs});
    }

    /// Adds to a counter, which starts at 0.
    void count(const std::string& name, double amount) {
        for (auto& [known, value] : counters) {
            if (known != name) continue;
            value += amount;
            return;
        }
        counters.emplace_back(name, amount);
    }

    /// Lifts a counter to at least that; it starts at 0.
    void raise(const std::string& name, double least) {
        count(name, std::max(least - counter(name), 0.0));
    }

    /// 0 if never mentioned.
    double counter(const std::string& name) const {
        for (const auto& [known, value] : counters)
            if (known == name) return value;
        return 0;
    }

    void effect(const std::string& name, bool on, const std::string& why) {
        effects.push_back({name, on, why});
    }
};

} // namespace eikonal
