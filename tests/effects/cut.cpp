// A kernel's text with an effect cut out of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut.h"

#include "tokens.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace effects {

namespace {

[[noreturn]] void fail(const Cut& cut, const std::string& passage, const std::string& what) {
    throw std::runtime_error(cut.kernel + ", without " + cut.effect + ": '" + passage + "' " +
                             what);
}

std::string condition(const Token& directive) {
    const Tokens words = tokensOf(directive.text.substr(1));
    std::string text;
    for (size_t i = 1; i < words.size(); ++i) text += (i > 1 ? " " : "") + words[i].text;
    return text;
}

bool begins(const Token& token, const char* directive) {
    return token.text.rfind(std::string("#") + directive, 0) == 0;
}

/// One branch of a conditional passage of the preprocessor.
struct Branch {
    Token head;
    Tokens body;
};

/// Drops the branches whose condition is in `dropped`, which counts them, and guards of switches.
Tokens withoutBranches(const Tokens& tokens, size_t& at, std::map<std::string, int>& dropped) {
    Tokens out;
    while (at < tokens.size() && !begins(tokens[at], "el") && !begins(tokens[at], "endif")) {
        if (!begins(tokens[at], "if")) {
            out.push_back(tokens[at++]);
            continue;
        }
        std::vector<Branch> branches;
        while (!begins(tokens[at], "endif")) {
            Branch branch{tokens[at++], {}};
            branch.body = withoutBranches(tokens, at, dropped);
            const auto drop = dropped.find(condition(branch.head));
            const bool guard = branch.body.size() == 1 && begins(branch.body[0], "error");
            if (drop != dropped.end())
                ++drop->second;
            else if (!guard)
                branches.push_back(branch);
        }
        const Token end = tokens[at++];
        const bool bare = !branches.empty() && begins(branches[0].head, "else");
        for (size_t i = 0; i < branches.size(); ++i) {
            if (i == 0 && begins(branches[0].head, "elif")) branches[0].head.text.erase(1, 2);
            if (!bare) out.push_back(branches[i].head);
            out.insert(out.end(), branches[i].body.begin(), branches[i].body.end());
        }
        if (!bare && !branches.empty()) out.push_back(end);
    }
    return out;
}

void edit(Tokens& tokens, const Cut& cut) {
    for (const auto& [from, to] : cut.edits) {
        const Tokens pattern = tokensOf(from);
        const size_t at = findIn(tokens, pattern, 0);
        if (at == tokens.size()) fail(cut, from, "is not there");
        if (findIn(tokens, pattern, at + 1) != tokens.size()) fail(cut, from, "is there twice");
        replace(tokens, at, at + pattern.size(), tokensOf(to));
    }
}

void dropWrites(Tokens& tokens, const Cut& cut) {
    for (const std::string& write : cut.writes) {
        const Tokens pattern = tokensOf(write);
        int dropped = 0;
        for (size_t at = findIn(tokens, pattern, 1); at < tokens.size();
             at = findIn(tokens, pattern, at + 1)) {
            const bool assigns = tokens[at + pattern.size()].isOneOf("= += -= *= /=");
            if (!assigns || !tokens[at - 1].isOneOf("; { }")) continue;
            replace(tokens, at, statementEnd(tokens, at));
            ++dropped;
        }
        if (dropped == 0) fail(cut, write, "is nowhere written");
    }
}

void dropBranches(Tokens& tokens, const std::vector<Cut>& cuts) {
    std::map<std::string, int> dropped;
    for (const Cut& cut : cuts)
        for (const std::string& branch : cut.branches) dropped[branch] = 0;
    size_t at = 0;
    tokens = withoutBranches(tokens, at, dropped);
    for (const Cut& cut : cuts)
        for (const std::string& branch : cut.branches)
            if (dropped[branch] == 0) fail(cut, branch, "is no condition of #if or #elif");
}

/// The longest first, so that no text is replaced within another.
void setConstants(Tokens& tokens, const std::vector<Cut>& cuts) {
    struct Constant {
        std::string text;
        Tokens pattern;
        bool value;
        const Cut* cut;
    };
    std::map<std::string, Constant> byText;
    for (const Cut& cut : cuts)
        for (const auto& [text, value] : cut.constants) {
            const auto [known, isNew] = byText.insert({text, {text, tokensOf(text), value, &cut}});
            if (!isNew && known->second.value != value) fail(cut, text, "is both true and false");
        }
    std::vector<Constant> constants;
    for (const auto& [text, constant] : byText) constants.push_back(constant);
    std::stable_sort(constants.begin(), constants.end(), [](const auto& a, const auto& b) {
        return a.pattern.size() > b.pattern.size();
    });
    for (const Constant& constant : constants) {
        const size_t length = constant.pattern.size();
        int found = 0;
        for (size_t at = findIn(tokens, constant.pattern, 0); at < tokens.size();
             at = findIn(tokens, constant.pattern, at)) {
            ++found;
            // Its own declaration goes.
            if (at > 1 && tokens[at - 2] == "const" && tokens[at + 1] == "=")
                replace(tokens, at - 2, statementEnd(tokens, at));
            else
                replace(tokens, at, at + length, {{constant.value ? "true" : "false", ""}});
        }
        if (found == 0) fail(*constant.cut, constant.text, "is no condition");
    }
}

bool contains(const Tokens& tokens, const std::string& name) {
    for (const Token& token : tokens) {
        if (token.text == name) return true;
        if (!token.isDirective()) continue;
        const Tokens words = tokensOf(token.text.substr(1));
        if (std::count(words.begin(), words.end(), name) > 0) return true;
    }
    return false;
}

} // namespace

std::string cut(const std::string& text, const std::vector<Cut>& cuts) {
    Tokens tokens = tokensOf(text);
    for (const Cut& one : cuts)
        for (const std::string& name : one.gone)
            if (!contains(tokens, name)) fail(one, name, "is no identifier of the kernel");
    for (const Cut& one : cuts) edit(tokens, one);
    for (const Cut& one : cuts) dropWrites(tokens, one);
    dropBranches(tokens, cuts);
    setConstants(tokens, cuts);
    // Pruning needs whole declarations, which conditional passages may cut in two; none does here.
    fold(tokens);
    prune(tokens);
    for (const Cut& one : cuts)
        for (const std::string& name : one.gone)
            if (contains(tokens, name)) fail(one, name, "is left");
    return textOf(tokens);
}

} // namespace effects
