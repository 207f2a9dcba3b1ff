// Inputs of any kind: regular files, FIFOs, process substitutions, "-" for standard input.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace eikonal {

/// Whether what `path` names can be read but once, from its start to its end: a FIFO, a socket, a
/// terminal, or "-", which is standard input. False where there is nothing of that name.
bool isStream(const std::string& path);

/// The bytes of a file or stream, whole. Throws MissingError with the system's reason if the path
/// can't be opened or read or is a folder.
std::string readWhole(const std::string& path);

} // namespace eikonal
