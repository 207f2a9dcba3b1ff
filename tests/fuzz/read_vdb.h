// Reads whatever a VDB file holds and writes it again, as stages would.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "base/error.h"
#include "volume/volume.h"

#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace eikonal {

/// A file in memory, by name.
class MemoryFile {
public:
    MemoryFile() : mFile(::memfd_create("vdb", MFD_CLOEXEC)) {}
    ~MemoryFile() { ::close(mFile); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(mFile); }
    void set(const char* bytes, size_t count) const {
        if (::ftruncate(mFile, 0) != 0 ||
            ::pwrite(mFile, bytes, count, 0) != static_cast<ssize_t>(count))
            throw std::runtime_error("no memory file");
    }

private:
    int mFile;
};

/// What became of a file: read, or refused as no valid data or too large. Any other error passes.
enum class VdbFate { read, refused };

inline VdbFate readVdb(const std::string& path) {
    constexpr std::int64_t kMostVoxels = 1 << 18; // larger domains take their time
    try {
        const volume::Volume volume = volume::Volume::open(path);
        const bool small = volume.domain().voxels() < kMostVoxels;
        AtomicFile out("/dev/null");
        volume.write(out, {"fuzz", "1", "fuzz"});
        for (const volume::GridFacts& grid : volume.grids()) {
            try {
                volume.objects();
                volume.background(grid.name, glm::vec3(0));
                if (small) volume.dense(grid.name, volume.domain());
            } catch (const DataError&) { // of this grid; there may be others
            }
        }
    } catch (const DataError&) {
        return VdbFate::refused;
    } catch (const MemoryError&) {
        return VdbFate::refused;
    }
    return VdbFate::read;
}

} // namespace eikonal
