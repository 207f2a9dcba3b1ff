// The file of instruction counts.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "counts.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace effects {

namespace {

const std::string kHead = "# Instructions of every case's kernel as optimised SPIR-V, by ";
const std::string kTail = "; `make instructions` counts them anew.";

} // namespace

int Counts::of(const std::string& name) const {
    for (const auto& [known, count] : instructions)
        if (known == name) return count;
    return 0;
}

Counts readCounts(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("no " + path);
    Counts counts;
    std::string line;
    std::getline(file, line);
    if (line.rfind(kHead, 0) == 0)
        counts.compiler = line.substr(kHead.size(), line.find(kTail) - kHead.size());
    while (std::getline(file, line)) {
        std::istringstream words(line);
        int count = 0;
        std::string name;
        words >> count >> std::ws;
        std::getline(words, name);
        counts.instructions.emplace_back(name, count);
    }
    return counts;
}

void writeCounts(const Counts& counts, const std::string& path) {
    std::ofstream file(path);
    file << kHead << counts.compiler << kTail << '\n';
    for (const auto& [name, count] : counts.instructions) file << count << ' ' << name << '\n';
    if (!file.flush()) throw std::runtime_error("can't write " + path);
}

} // namespace effects
