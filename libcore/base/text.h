// Numbers to text and back, the same in every locale.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eikonal {

/// The shortest text that reads back as the same number; never "0.000006" for 5.8e-6.
std::string toText(double value);
std::string toText(float value);

/// The whole text as one finite number, or nothing.
std::optional<double> parseNumber(std::string_view text);

/// "a,b,c" as finite numbers, or nothing if an item is empty or no number.
std::optional<std::vector<double>> parseNumbers(std::string_view text, char separator = ',');

std::vector<std::string> split(std::string_view text, char separator);
std::string join(const std::vector<std::string>& items, std::string_view separator);

/// The text without the UTF-8 byte order mark that some editors begin files with.
std::string_view withoutByteOrderMark(std::string_view text);

/// "1,234,567 bytes (1.2 MiB)".
std::string bytesText(double bytes);

/// The last component of a path; "-" and "" stay as they are.
std::string baseName(const std::string& path);

} // namespace eikonal
