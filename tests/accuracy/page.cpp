// Numbers and tables as the page writes them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace accuracy {

std::string number(double value, int digits) {
    char text[40];
    if (value >= 100)
        std::snprintf(text, sizeof text, "%.0f", value);
    else if (value != 0 && std::abs(value) < 1e-2)
        std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    else
        std::snprintf(text, sizeof text, "%.*g", std::max(digits, 3), value);
    return text;
}

std::string share(double ratio) {
    return ratio > 0 && ratio < 0.5 ? "1/" + number(1 / ratio) : number(ratio);
}

std::string print(const char* format, double a, double b) {
    char text[200];
    std::snprintf(text, sizeof text, format, a, b);
    return text;
}

void line(std::ostringstream& out, const Cells& cells) {
    out << '|';
    for (const std::string& cell : cells) out << ' ' << cell << " |";
    out << '\n';
}

void head(std::ostringstream& out, const Cells& cells) {
    line(out, cells);
    out << '|';
    for (size_t i = 0; i < cells.size(); ++i) out << "---|";
    out << '\n';
}

} // namespace accuracy
