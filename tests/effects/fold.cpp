// Constant conditions and what hangs on them, folded out of a row of tokens.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tokens.h"

namespace effects {

namespace {

bool isConstant(const Token& token) {
    return token == "true" || token == "false";
}

/// One past the operand chain that begins at `at`: the first of `stops` outside its brackets.
size_t chainEnd(const Tokens& tokens, size_t at, const char* stops) {
    while (!tokens[at].isOneOf(stops))
        at = tokens[at].isOneOf("( [ {") ? closeOf(tokens, at) + 1 : at + 1;
    return at;
}

/// The begin of the operand chain that ends before `end`.
size_t chainBegin(const Tokens& tokens, size_t end, const char* stops) {
    size_t at = end;
    while (!tokens[at - 1].isOneOf(stops))
        at = tokens[at - 1].isOneOf(") ] }") ? openOf(tokens, at - 1) : at - 1;
    return at;
}

constexpr const char* kAfterAnd = "|| ? : , ; ) ]";
constexpr const char* kBeforeAnd = "|| ? : , ; ( [ { = return";
constexpr const char* kAfterOr = "? : , ; ) ]";
constexpr const char* kBeforeOr = "? : , ; ( [ { = return";

bool isOperand(const Tokens& t, size_t i) {
    return t[i - 1].isOneOf("( || && = ? : , return") && t[i + 1].isOneOf(") || && ? : , ;");
}

bool foldAnd(Tokens& t, size_t i) {
    if (!isOperand(t, i)) return false;
    const bool value = t[i] == "true";
    if (t[i + 1] == "&&") {
        if (value)
            replace(t, i, i + 3, {t[i + 2]});
        else
            replace(t, i + 1, chainEnd(t, i + 1, kAfterAnd));
        return true;
    }
    if (t[i - 1] == "&&") {
        if (value)
            replace(t, i - 1, i + 1);
        else
            replace(t, chainBegin(t, i, kBeforeAnd), i + 1, {t[i]});
        return true;
    }
    return false;
}

bool foldOr(Tokens& t, size_t i) {
    if (!isOperand(t, i)) return false;
    const bool value = t[i] == "true";
    if (t[i + 1] == "||") {
        if (value)
            replace(t, i + 1, chainEnd(t, i + 1, kAfterOr));
        else
            replace(t, i, i + 3, {t[i + 2]});
        return true;
    }
    if (t[i - 1] == "||") {
        if (value)
            replace(t, chainBegin(t, i, kBeforeOr), i + 1, {t[i]});
        else
            replace(t, i - 1, i + 1);
        return true;
    }
    return false;
}

/// !true; (true), but not the brackets of if, while or a call.
bool foldAround(Tokens& t, size_t i) {
    if (t[i - 1] == "!") {
        replace(t, i - 1, i + 1, {{t[i] == "true" ? "false" : "true", ""}});
        return true;
    }
    if (t[i - 1] == "(" && t[i + 1] == ")" && !t[i - 2].isName()) {
        replace(t, i - 1, i + 2, {t[i]});
        return true;
    }
    return false;
}

bool foldChoice(Tokens& t, size_t i) {
    if (!t[i - 1].isOneOf("( = ? : , return") || !(t[i + 1] == "?")) return false;
    size_t colon = i + 2;
    for (int nested = 0; nested > 0 || !(t[colon] == ":");) {
        if (t[colon] == "?") ++nested;
        if (t[colon] == ":") --nested;
        colon = t[colon].isOneOf("( [ {") ? closeOf(t, colon) + 1 : colon + 1;
    }
    Tokens taken;
    size_t end = colon + 1;
    for (int nested = 0; nested > 0 || !t[end].isOneOf(": , ; ) ]");) {
        if (t[end] == "?") ++nested;
        if (t[end] == ":") --nested;
        end = t[end].isOneOf("( [ {") ? closeOf(t, end) + 1 : end + 1;
    }
    const auto at = [&](size_t index) { return t.begin() + static_cast<std::ptrdiff_t>(index); };
    if (t[i] == "true")
        taken.assign(at(i + 2), at(colon));
    else
        taken.assign(at(colon + 1), at(end));
    replace(t, i, end, taken);
    return true;
}

bool foldIf(Tokens& t, size_t i) {
    if (!(t[i - 1] == "(") || !(t[i - 2] == "if") || !(t[i + 1] == ")")) return false;
    const size_t first = i - 2, then = i + 2, thenEnd = statementEnd(t, then);
    const bool hasElse = thenEnd < t.size() && t[thenEnd] == "else";
    const size_t end = hasElse ? statementEnd(t, thenEnd + 1) : thenEnd;
    const auto at = [&](size_t index) { return t.begin() + static_cast<std::ptrdiff_t>(index); };
    Tokens taken;
    if (t[i] == "true")
        taken.assign(at(then), at(thenEnd));
    else if (hasElse)
        taken.assign(at(thenEnd + 1), at(end));
    if (taken.empty() && t[first - 1] == "else") {
        replace(t, first - 1, end);
        return true;
    }
    if (taken.empty() && t[first - 1] == ")") taken = {{"{", ""}, {"}", ""}};
    replace(t, first, end, taken);
    return true;
}

/// What follows a return in its block.
bool foldAfterReturn(Tokens& t, size_t i) {
    if (!(t[i] == "return") || !t[i - 1].isOneOf("; { }")) return false;
    const size_t end = statementEnd(t, i);
    size_t last = end;
    while (!(t[last] == "}")) last = statementEnd(t, last);
    if (last == end) return false;
    replace(t, end, last);
    return true;
}

} // namespace

void fold(Tokens& tokens) {
    // && binds before ||, so all of the former go first; every change may enable others.
    bool changed = true;
    while (changed) {
        changed = false;
        for (const auto rule : {foldAround, foldAnd, foldOr, foldChoice, foldIf}) {
            for (size_t i = 2; i + 2 < tokens.size() && !changed; ++i)
                changed = isConstant(tokens[i]) && rule(tokens, i);
            if (changed) break;
        }
    }
    for (size_t i = 1; i + 2 < tokens.size(); ++i) foldAfterReturn(tokens, i);
}

} // namespace effects
