// What format bytes are of, whatever the file is called.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/formats.h"

#include <algorithm>
#include <array>

namespace eikonal::mesh {

namespace {

bool isObjKeyword(std::string_view word) {
    constexpr std::array<std::string_view, 10> kKeywords = {"v", "vt", "vn", "vp",     "f",
                                                            "o", "g",  "s",  "mtllib", "usemtl"};
    return std::find(kKeywords.begin(), kKeywords.end(), word) != kKeywords.end();
}

/// "8 6" or "8 6 0", as an OFF file without a head begins.
bool areCounts(const std::vector<std::string_view>& words) {
    return (words.size() == 2 || words.size() == 3) &&
           std::all_of(words.begin(), words.end(), [](std::string_view word) {
               return word.find_first_not_of("0123456789") == std::string_view::npos;
           });
}

bool isSolid(std::string_view word) {
    return word.size() == 5 && std::equal(word.begin(), word.end(), "solid",
                                          [](char a, char b) { return (a | 0x20) == b; });
}

} // namespace

std::string foreignFormat(std::string_view bytes) {
    const auto begins = [&](std::string_view magic) {
        return bytes.substr(0, magic.size()) == magic;
    };
    if (begins("\x1f\x8b")) return "data compressed by gzip";
    if (begins("\xfd"
               "7zXZ"))
        return "data compressed by xz";
    if (begins("\x28\xb5\x2f\xfd")) return "data compressed by zstd";
    if (begins("BZh") && bytes.substr(4, 6) == "1AY&SY") return "data compressed by bzip2";
    if (begins("PK\x03\x04")) return "a zip archive";
    if (begins("\xff\xfe") || begins("\xfe\xff")) return "text in UTF-16";
    if (begins("glTF\x02")) return "a glTF scene";
    if (begins(" BDV")) return "a VDB volume";
    return "";
}

std::optional<Format> formatOf(std::string_view bytes) {
    FileText text("", bytes);
    bool more = text.nextLine('#');
    while (more && text.words().empty()) more = text.nextLine('#');
    if (more) {
        const std::string_view word = text.words()[0];
        if (word == "ply") return Format::ply;
        if (offHeadOf(word) > 0 || areCounts(text.words())) return Format::off;
        if (isSolid(word)) return Format::stl;
        if (isObjKeyword(word)) return Format::obj;
    }
    // The title of a binary STL file may be anything.
    constexpr size_t kHeadBytes = 84;
    if (bytes.size() > kHeadBytes && isBinaryStl(bytes) && foreignFormat(bytes).empty() &&
        bytes.find('\0', kHeadBytes - 1) != std::string_view::npos)
        return Format::stl;
    return std::nullopt;
}

} // namespace eikonal::mesh
