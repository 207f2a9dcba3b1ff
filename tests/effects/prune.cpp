// What nobody reads any more, dropped from a row of tokens.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tokens.h"

#include <algorithm>

namespace effects {

namespace {

size_t timesIn(const Tokens& tokens, const std::string& name, size_t first, size_t last) {
    const auto at = [&](size_t index) {
        return tokens.begin() + static_cast<std::ptrdiff_t>(index);
    };
    return static_cast<size_t>(std::count(at(first), at(last), name));
}

size_t times(const Tokens& tokens, const std::string& name) {
    return timesIn(tokens, name, 0, tokens.size());
}

/// A declaration at file level: [first, last), and what it declares.
struct Global {
    enum class Kind { function, block, structure, variable } kind = Kind::variable;
    size_t first = 0, last = 0;
    std::string name;
    size_t open = 0, close = 0; ///< of a function's, block's or struct's braces
};

/// The declaration at `first`, which is no directive.
Global globalAt(const Tokens& t, size_t first) {
    Global global;
    global.first = first;
    size_t at = first;
    while (!t[at].isOneOf("{ ; =") && !(t[at] == "(" && !(t[at - 1] == "layout")))
        at = t[at].isOneOf("( [") ? closeOf(t, at) + 1 : at + 1;
    size_t name = at - 1;
    if (t[name] == "]") name = openOf(t, name) - 1;
    global.name = t[name].text;
    if (t[at] == "(") {
        global.kind = Global::Kind::function;
        const size_t after = closeOf(t, at) + 1;
        if (t[after] == "{") global.open = after, global.close = closeOf(t, after);
        global.last = (t[after] == "{" ? global.close : after) + 1;
        return global;
    }
    if (t[at] == "{") {
        global.open = at;
        global.close = closeOf(t, at);
        global.kind = t[first] == "struct" ? Global::Kind::structure : Global::Kind::block;
    }
    global.last = statementEnd(t, at == global.open ? global.close : at);
    if (t[at] == "{") global.last = global.close + 1;
    while (!(t[global.last - 1] == ";")) ++global.last;
    return global;
}

/// A block is read if its instance is, or, without one, a member.
bool blockIsRead(const Tokens& t, const Global& block) {
    if (!(t[block.close + 1] == ";")) return times(t, t[block.close + 1].text) > 1;
    for (size_t i = block.open; i < block.close; ++i)
        if (t[i + 1].isOneOf("; [") && t[i].isName() && times(t, t[i].text) > 1) return true;
    return false;
}

/// Drops what is unread of `const int kA = 0, kB = 1;`. All of it if all is.
bool pruneConstants(Tokens& t, const Global& global) {
    for (size_t i = global.first; i + 3 < global.last; ++i) {
        const bool one = t[i].isName() && t[i + 1] == "=" && t[i + 3].isOneOf(", ;");
        if (!one || times(t, t[i].text) > 1) continue;
        if (t[i - 1] == ",")
            replace(t, i - 1, i + 3);
        else if (t[i + 3] == ",")
            replace(t, i, i + 4);
        else
            replace(t, global.first, global.last);
        return true;
    }
    return false;
}

bool pruneGlobal(Tokens& t, const Global& global) {
    using Kind = Global::Kind;
    const bool isMany = t[global.first] == "const" && global.kind == Kind::variable;
    if (isMany && pruneConstants(t, global)) return true;
    bool unread = false;
    if (global.kind == Kind::block)
        unread = !blockIsRead(t, global);
    else if (global.kind == Kind::function)
        unread = times(t, global.name) == 1;
    else if (global.kind == Kind::structure)
        unread = times(t, t[global.first + 1].text) == 1;
    else
        unread = global.name != "in" && times(t, global.name) == 1;
    if (!unread || global.name == "main") return false;
    replace(t, global.first, global.last);
    return true;
}

/// The prototype of a function that is defined, too, counts as no reader.
bool prunePrototype(Tokens& t, const Global& global) {
    if (global.kind != Global::Kind::function || global.open != 0) return false;
    if (times(t, global.name) > 2) return false;
    replace(t, global.first, global.last);
    return true;
}

/// A local that stands nowhere but in its own declaration, whose value has no side effect.
bool pruneLocal(Tokens& t, const Global& function) {
    for (size_t i = function.open + 2; i + 1 < function.close; ++i) {
        const bool declares = t[i].isName() && t[i - 1].isName() && t[i + 1].isOneOf("= ;") &&
                              t[i - 2].isOneOf("; { }") && !t[i - 1].isOneOf("return else const");
        if (!declares || timesIn(t, t[i].text, function.open, function.close) > 1) continue;
        const size_t end = statementEnd(t, i);
        bool acts = false;
        for (size_t j = i; j < end; ++j) acts = acts || t[j].text.rfind("atomic", 0) == 0;
        if (acts) continue;
        replace(t, i - 1, end);
        return true;
    }
    return false;
}

} // namespace

void prune(Tokens& tokens) {
    for (size_t at = 0; at < tokens.size();) {
        if (tokens[at].isDirective()) {
            ++at;
            continue;
        }
        const Global global = globalAt(tokens, at);
        const bool changed = pruneGlobal(tokens, global) || prunePrototype(tokens, global) ||
                             (global.kind == Global::Kind::function && global.open != 0 &&
                              pruneLocal(tokens, global));
        at = changed ? 0 : global.last; // whatever read it may be next
    }
}

} // namespace effects
