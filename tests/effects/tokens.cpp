// GLSL as a row of tokens.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tokens.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace effects {

namespace {

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// One past the token that begins at `at`.
size_t tokenEnd(const std::string& text, size_t at) {
    if (text[at] == '#') {
        size_t end = text.find('\n', at);
        while (end != text.npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
        return std::min(end, text.size());
    }
    const bool number = std::isdigit(static_cast<unsigned char>(text[at])) != 0 ||
                        (text[at] == '.' && at + 1 < text.size() &&
                         std::isdigit(static_cast<unsigned char>(text[at + 1])) != 0);
    size_t end = at + 1;
    if (number) {
        const auto continues = [&](char c) {
            const char before = text[end - 1];
            return isWord(c) || c == '.' || ((c == '+' || c == '-') && before == 'e');
        };
        while (end < text.size() && continues(text[end])) ++end;
    } else if (isWord(text[at])) {
        while (end < text.size() && isWord(text[end])) ++end;
    } else {
        static const std::string kPairs = "&& || == != <= >= += -= *= /= ++ -- << >> |= &= ^= ";
        const std::string pair = text.substr(at, 2);
        if (pair.find(' ') == pair.npos && kPairs.find(pair + " ") != kPairs.npos) ++end;
    }
    return end;
}

} // namespace

bool Token::isName() const {
    return std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_';
}

bool Token::isOneOf(const char* words) const {
    std::istringstream list(words);
    for (std::string word; list >> word;)
        if (word == text) return true;
    return false;
}

Tokens tokensOf(const std::string& text) {
    Tokens tokens;
    std::string space;
    for (size_t at = 0; at < text.size();) {
        if (text.compare(at, 2, "//") == 0) {
            at = std::min(text.find('\n', at), text.size());
        } else if (text.compare(at, 2, "/*") == 0) {
            at = std::min(text.find("*/", at), text.size() - 2) + 2;
        } else if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
            space += text[at++];
        } else {
            const size_t end = tokenEnd(text, at);
            tokens.push_back({text.substr(at, end - at), space});
            space.clear();
            at = end;
        }
    }
    return tokens;
}

std::string textOf(const Tokens& tokens) {
    std::string text;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        const bool newLine = token.isDirective() || (i > 0 && tokens[i - 1].isDirective());
        if (newLine && token.space.find('\n') == token.space.npos)
            text += '\n';
        else if (token.space.empty() && !text.empty() && isWord(text.back()) &&
                 isWord(token.text[0]))
            text += ' ';
        text += token.space + token.text;
    }
    return text + "\n";
}

size_t closeOf(const Tokens& tokens, size_t open) {
    int depth = 0;
    for (size_t i = open; i < tokens.size(); ++i) {
        if (tokens[i].isOneOf("( [ {")) ++depth;
        if (tokens[i].isOneOf(") ] }") && --depth == 0) return i;
    }
    throw std::runtime_error("a bracket is not closed");
}

size_t openOf(const Tokens& tokens, size_t close) {
    int depth = 0;
    for (size_t i = close + 1; i-- > 0;) {
        if (tokens[i].isOneOf(") ] }")) ++depth;
        if (tokens[i].isOneOf("( [ {") && --depth == 0) return i;
    }
    throw std::runtime_error("a bracket is not opened");
}

size_t statementEnd(const Tokens& tokens, size_t first) {
    if (tokens[first] == "{") return closeOf(tokens, first) + 1;
    if (tokens[first].isOneOf("if for while")) {
        const size_t end = statementEnd(tokens, closeOf(tokens, first + 1) + 1);
        if (tokens[first] == "if" && end < tokens.size() && tokens[end] == "else")
            return statementEnd(tokens, end + 1);
        return end;
    }
    size_t at = first;
    while (!(tokens[at] == ";"))
        at = tokens[at].isOneOf("( [ {") ? closeOf(tokens, at) + 1 : at + 1;
    return at + 1;
}

size_t findIn(const Tokens& tokens, const Tokens& pattern, size_t from) {
    const auto same = [](const Token& a, const Token& b) { return a.text == b.text; };
    return static_cast<size_t>(std::search(tokens.begin() + static_cast<std::ptrdiff_t>(from),
                                           tokens.end(), pattern.begin(), pattern.end(), same) -
                               tokens.begin());
}

void replace(Tokens& tokens, size_t first, size_t last, Tokens by) {
    if (!by.empty()) by.front().space = tokens[first].space;
    const auto begin = tokens.begin() + static_cast<std::ptrdiff_t>(first);
    const auto at = tokens.erase(begin, begin + static_cast<std::ptrdiff_t>(last - first));
    tokens.insert(at, by.begin(), by.end());
}

} // namespace effects
