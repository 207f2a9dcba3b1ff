// Standard error belongs to the tool: what libraries write there would stand before its one line.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace eikonal {

/// From now on descriptor 2, where OpenVDB, Mesa, TBB or libpng write, leads nowhere, and tell()
/// alone reaches what was standard error. Called once, by main, unless the user wants to hear them.
void keepStandardError();

/// Writes to standard error, in one piece. Failures are ignored: there is nobody to tell.
void tell(std::string_view text);

/// Whether what tell() writes to is a terminal.
bool tellsTerminal();

} // namespace eikonal
