// How a file tells how it was made: one command line per stage passed, oldest first.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/history.h"

#include "base/text.h"

namespace eikonal {

namespace {

std::string shortWord(const std::string& word) {
    const size_t equals = word.rfind("--", 0) == 0 ? word.find('=') : std::string::npos;
    if (equals != std::string::npos)
        return word.substr(0, equals + 1) + baseName(word.substr(equals + 1));
    return baseName(word);
}

std::string quoted(std::string word) {
    for (char& c : word)
        if (c == '\n' || c == '\r') c = ' ';
    if (!word.empty() && word.find_first_of(" \t'\"\\$&;|<>()*?") == std::string::npos) return word;
    std::string out = "'";
    for (char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

} // namespace

std::string commandLine(const std::vector<std::string>& arguments) {
    std::vector<std::string> words;
    for (const std::string& word : arguments) words.push_back(quoted(shortWord(word)));
    return join(words, " ");
}

std::string appendHistory(const std::string& earlier, const std::string& line) {
    return earlier.empty() ? line : earlier + "\n" + line;
}

} // namespace eikonal
