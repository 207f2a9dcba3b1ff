// Lines and words of a mesh file, and errors that name the place.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "mesh/formats.h"

#include <algorithm>
#include <charconv>

namespace eikonal::mesh {

FileText::FileText(const std::string& path, std::string_view bytes) : mPath(path), mRest(bytes) {
    // Where lines end by carriage returns alone, a line feed may be the first byte of data.
    const size_t end = bytes.find_first_of("\r\n");
    mPairs = end == std::string_view::npos || bytes[end] == '\n' ||
             (end + 1 < bytes.size() && bytes[end + 1] == '\n');
}

std::string_view FileText::takeLine() {
    ++mLine;
    const size_t end = std::min(mRest.find_first_of("\r\n"), mRest.size());
    std::string_view line = mRest.substr(0, end);
    const bool pair = mPairs && mRest.substr(end, 2) == "\r\n";
    mRest.remove_prefix(std::min(end + (pair ? 2 : 1), mRest.size()));
    return withoutByteOrderMark(line);
}

void FileText::split(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\f\v";
    for (size_t at = line.find_first_not_of(kBlanks); at < line.size();
         at = line.find_first_not_of(kBlanks, at)) {
        const size_t wordEnd = std::min(line.find_first_of(kBlanks, at), line.size());
        mWords.push_back(line.substr(at, wordEnd - at));
        at = wordEnd;
    }
}

bool FileText::nextLine(char comment) {
    mWords.clear();
    if (mRest.empty()) return false;
    const std::string_view line = takeLine();
    split(comment == '\0' ? line : line.substr(0, std::min(line.find(comment), line.size())));
    return true;
}

bool FileText::nextJoinedLine(char comment) {
    if (!nextLine(comment)) return false;
    while (!mWords.empty() && mWords.back().back() == '\\') {
        mWords.back().remove_suffix(1);
        if (mWords.back().empty()) mWords.pop_back();
        if (mRest.empty()) fail("the end of the file", "the rest of a line");
        const std::string_view line = takeLine();
        split(line.substr(0, std::min(line.find(comment), line.size())));
    }
    return true;
}

void FileText::nextWords(char comment, const std::string& what) {
    while (nextLine(comment))
        if (!mWords.empty()) return;
    fail("the end of the file", what);
}

glm::dvec3 FileText::point(size_t first) const {
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) {
        const size_t word = first + static_cast<size_t>(k);
        const auto number = word < mWords.size() ? parseNumber(mWords[word]) : std::nullopt;
        if (!number) fail(quoted(word), "a finite coordinate");
        p[k] = *number;
    }
    return p;
}

std::int64_t FileText::integer(size_t word, const std::string& what) const {
    // More than any file can list, and far from where sums of two would overflow.
    constexpr std::int64_t kLargest = std::int64_t(1) << 53;
    std::int64_t value = 0;
    if (word < mWords.size()) {
        const std::string_view text = mWords[word];
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && value >= -kLargest && value <= kLargest) return value;
    }
    fail(quoted(word), what);
}

void FileText::fail(const std::string& found, const std::string& expected) const {
    throw DataError(mPath + ":" + std::to_string(mLine) + ": found " + found + ", expected " +
                    expected);
}

std::string FileText::quoted(size_t word) const {
    if (word >= mWords.size()) return "the end of the line";
    // A binary file may reach this: the message stays one short line of plain letters.
    std::string text = "'";
    for (char c : mWords[word].substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + "'";
}

} // namespace eikonal::mesh
