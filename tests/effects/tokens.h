// GLSL as a row of tokens: what the cutting of effects works on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace effects {

struct Token {
    std::string text;  ///< a preprocessor line is one token
    std::string space; ///< before it, without comments
    bool operator==(const std::string& other) const { return text == other; }
    bool isName() const;
    bool isOneOf(const char* words) const; ///< separated by spaces
    bool isDirective() const { return text[0] == '#'; }
};

using Tokens = std::vector<Token>;

Tokens tokensOf(const std::string& text);
std::string textOf(const Tokens& tokens);

/// Index of the bracket that closes the one at `open`, or opens the one at `close`.
size_t closeOf(const Tokens& tokens, size_t open);
size_t openOf(const Tokens& tokens, size_t close);
/// One past the statement that begins at `first`.
size_t statementEnd(const Tokens& tokens, size_t first);
/// Where `pattern` begins, at `from` or later; tokens.size() if nowhere.
size_t findIn(const Tokens& tokens, const Tokens& pattern, size_t from);
/// Replaces [first, last); the first new token takes over the spacing.
void replace(Tokens& tokens, size_t first, size_t last, Tokens by = {});

/// Folds `true` and `false` out of conditions and drops the branches not taken.
void fold(Tokens& tokens);
/// Drops functions, globals and locals that nobody reads.
void prune(Tokens& tokens);

} // namespace effects
