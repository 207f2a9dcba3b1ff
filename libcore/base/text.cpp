// Numbers to text and back, the same in every locale.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace eikonal {

namespace {

template<typename Number> std::string shortest(Number value) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
    return std::string(buffer, end.ptr);
}

} // namespace

std::string toText(double value) {
    return shortest(value);
}

std::string toText(float value) {
    return shortest(value);
}

std::optional<double> parseNumber(std::string_view text) {
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<std::vector<double>> parseNumbers(std::string_view text, char separator) {
    std::vector<double> numbers;
    for (const std::string& item : split(text, separator)) {
        const auto number = parseNumber(item);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> items;
    for (size_t begin = 0;;) {
        const size_t end = text.find(separator, begin);
        items.emplace_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) return items;
        begin = end + 1;
    }
}

std::string join(const std::vector<std::string>& items, std::string_view separator) {
    std::string text;
    for (const std::string& item : items) {
        if (&item != &items.front()) text += separator;
        text += item;
    }
    return text;
}

std::string_view withoutByteOrderMark(std::string_view text) {
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
}

std::string bytesText(double bytes) {
    std::string digits = std::to_string(static_cast<unsigned long long>(bytes));
    for (size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    char mebibytes[32];
    std::snprintf(mebibytes, sizeof mebibytes, "%.1f", bytes / (1024.0 * 1024.0));
    return digits + " bytes (" + mebibytes + " MiB)";
}

std::string baseName(const std::string& path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? path : path.substr(slash + 1);
}

} // namespace eikonal
