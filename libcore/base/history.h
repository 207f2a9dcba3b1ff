// How a file tells how it was made: one command line per stage passed, oldest first.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace eikonal {

/// What a stage writes into the files it makes.
struct History {
    std::string tool;
    std::string version;
    std::string command; ///< this stage's own command line, from commandLine()
};

/// The command as one line for a history: words joined by blanks, those with blanks quoted,
/// and every path cut to its base name, so that a file does not tell on whose machine it was made.
/// A word counts as a path if it has a slash, behind an '=' in an option too.
std::string commandLine(const std::vector<std::string>& arguments);

/// `earlier` (lines, possibly empty) with `line` appended.
std::string appendHistory(const std::string& earlier, const std::string& line);

} // namespace eikonal
