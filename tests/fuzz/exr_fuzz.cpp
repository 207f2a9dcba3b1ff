// Any bytes as an environment map: refused in words, or finite radiance.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "image/picture.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

using namespace eikonal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, size_t size) {
    static const int file = ::memfd_create("map.exr", 0);
    // The first byte may ask for a layer.
    const std::string layer = size > 0 && bytes[0] == 'L' ? "sky" : "";
    const size_t skipped = layer.empty() ? 0 : 1;
    if (::ftruncate(file, 0) != 0 || ::lseek(file, 0, SEEK_SET) != 0 ||
        ::write(file, bytes + skipped, size - skipped) != static_cast<ssize_t>(size - skipped))
        return -1;
    const std::string path = "/proc/self/fd/" + std::to_string(file);
    // Other formats are OpenImageIO's, which has targets of its own.
    if (size < skipped + 4 || bytes[skipped] != 0x76 || bytes[skipped + 1] != 0x2f) return -1;
    try {
        const image::Image map = image::readEnvironment({path, layer}).map;
        for (const float sample : map.pixels)
            if (!std::isfinite(sample) || sample < 0) std::abort();
        if (map.channels.size() != 3 || map.pixels.size() != 3 * map.area()) std::abort();
    } catch (const Error& error) {
        const ExitStatus status = error.status();
        if (status != ExitStatus::data && status != ExitStatus::memory &&
            status != ExitStatus::missing)
            std::abort();
    }
    return 0;
}
