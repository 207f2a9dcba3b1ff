// Inputs of any kind: regular files, FIFOs, process substitutions, "-" for standard input.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace eikonal {

/// Whether what `path` names can be read but once, from its start to its end: a FIFO, a socket, a
/// terminal, or "-", which is standard input. False where there is nothing of that name.
bool isStream(const std::string& path);

/// An input for readers that seek, or open it more than once, by a path: a stream's bytes are kept
/// in memory for as long as this lives. Throws as readWhole().
class SeekableInput {
public:
    explicit SeekableInput(const std::string& path);
    ~SeekableInput();
    SeekableInput(const SeekableInput&) = delete;
    SeekableInput& operator=(const SeekableInput&) = delete;

    /// What to open: the path itself, if it can be.
    const std::string& path() const { return mPath; }

private:
    std::string mPath;
    int mDescriptor = -1;
};

/// The bytes of a file or stream, whole. Throws MissingError with the system's reason if the path
/// can't be opened or read or is a folder.
std::string readWhole(const std::string& path);

} // namespace eikonal
