// What the readers of this room share: looking at a path before a vendor's library does.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/input.h"

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace eikonal::image {

void checkReadable(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw MissingError(path + ": is a directory, expected a picture");
    if (isStream(path)) return; // to open it would take its writer's reader away
    errno = 0;
    if (!std::ifstream(path, std::ios::binary))
        throw MissingError(path + ": can't open: " + std::strerror(errno));
}

bool beginsAsExr(const std::string& path) {
    constexpr char kMagic[4] = {0x76, 0x2f, 0x31, 0x01}; // ImfVersion.h
    char start[4] = {};
    std::ifstream(path, std::ios::binary).read(start, sizeof start);
    return std::memcmp(start, kMagic, sizeof kMagic) == 0;
}

std::string oneLine(std::string message) {
    std::replace_if(
        message.begin(), message.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    while (!message.empty() && message.back() == ' ') message.pop_back();
    return message;
}

std::string extensionOf(const std::string& path) {
    const std::string name = baseName(path);
    const size_t dot = name.rfind('.');
    if (dot == std::string::npos) return {};
    std::string extension = name.substr(dot + 1);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return extension;
}

} // namespace eikonal::image
