// The command line and --config as a newcomer writes them: what is wrong is told at once, by name.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace eikonal::tool {

/// Lets --config hold lists as the command line does: eye=0,9,24.
void acceptPlainLists(CLI::App& app);

/// Options of which one must be given, where `unless` is not there or says no after parsing.
struct Alternatives {
    std::vector<std::string> options;
    std::function<bool()> unless{};
};

/// Parses. Returns false where --help or --version was all that was asked for. Throws UsageError
/// naming every option that is missing (one of each group of `alternatives`, too) or every one that
/// is unknown, with the name that may have been meant; MissingError for a --config that can't be
/// read.
bool parseCommandLine(CLI::App& app, int argc, char** argv,
                      const std::vector<Alternatives>& alternatives);

/// The known name that is likest to one that is not, or "" if none is.
std::string likest(const std::string& unknown, const std::vector<std::string>& known);

} // namespace eikonal::tool
