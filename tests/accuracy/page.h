// Numbers and tables as the page writes them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace accuracy {

/// Some digits that count; more where the number is large anyway.
std::string number(double value, int digits = 2);
/// "1/40" for 0.025; as it is from one half on.
std::string share(double ratio);
/// One or two numbers by a format of printf's.
std::string print(const char* format, double a, double b = 0);

using Cells = std::vector<std::string>;

void line(std::ostringstream& out, const Cells& cells);
void head(std::ostringstream& out, const Cells& cells);

} // namespace accuracy
