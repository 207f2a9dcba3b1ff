// What the system grants a run: threads and address space, asked for before the work needs them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace eikonal {

/// How many threads can be started now, of `wanted`. They are started, all at once, and ended.
int startableThreads(int wanted);

/// Where the address space is limited (ulimit -v), keeps allocators from setting aside a part of it
/// for each thread. Called once, by main, before there are threads.
void saveAddressSpace();

/// Throws MemoryError, naming who needs them, if the system refuses so many bytes at once.
void requireMemory(const std::string& who, std::size_t bytes);

} // namespace eikonal
