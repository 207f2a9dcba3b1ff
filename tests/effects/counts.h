// How many instructions each case's kernel has: counted, and as instructions.txt has it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace effects {

struct Counts {
    std::string compiler;                                  ///< that they were counted by
    std::vector<std::pair<std::string, int>> instructions; ///< by "family: case", in their order

    /// 0 if it has no such case.
    int of(const std::string& name) const;
};

/// Throws std::runtime_error where there is no such file.
Counts readCounts(const std::string& path);
void writeCounts(const Counts& counts, const std::string& path);

} // namespace effects
