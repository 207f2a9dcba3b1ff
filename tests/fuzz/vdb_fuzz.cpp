// VDB files of any bytes: read, or refused in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/read_vdb.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
    static const eikonal::MemoryFile file;
    file.set(reinterpret_cast<const char*>(data), size);
    eikonal::readVdb(file.path());
    return 0;
}
