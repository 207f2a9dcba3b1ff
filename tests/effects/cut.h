// A kernel's text with an effect cut out of it, as if the code had never been written.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace effects {

/// How one effect leaves one kernel. Texts are compared token by token, so spacing and comments do
/// not matter. Everything named must be found, or cut() throws: a list that no longer fits its
/// kernel is an error, not a measurement of nothing.
struct Cut {
    std::string effect;
    std::string kernel; ///< path of the entry file in the shaders folder
    /// Conditions that are constant without the effect. The branches not taken are removed, then
    /// all functions, globals and locals that nobody reads any more.
    std::vector<std::pair<std::string, bool>> constants;
    /// Conditions of #if or #elif whose branches are dropped.
    std::vector<std::string> branches = {};
    /// What only it writes: statements that begin so are dropped.
    std::vector<std::string> writes = {};
    /// Replacements, before all else; each text stands there exactly once.
    std::vector<std::pair<std::string, std::string>> edits = {};
    /// Identifiers of the effect: each is in the text before, none after.
    std::vector<std::string> gone = {};
};

/// `text` is the kernel with its includes expanded; comments do not survive. Throws
/// std::runtime_error naming effect and passage if a cut does not fit or leaves something behind.
std::string cut(const std::string& text, const std::vector<Cut>& cuts);

} // namespace effects
