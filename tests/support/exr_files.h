// EXR files of a test, in a folder of its own.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "image/exr.h"
#include "support/scratch.h"

#include <string>
#include <vector>

namespace eikonal::image {

class ExrFilesTest : public ScratchTest {
protected:
    /// Writes and commits an EXR of that name in the folder.
    void exr(const std::string& name, const Image& image, const ImageAttributes& attributes = {},
             int threads = 1) const {
        AtomicFile out(at(name));
        writeExr(image, attributes, out, threads);
        out.commit();
    }
};

/// An image whose every sample tells its channel and pixel: 100 k + y + x / 64, exact in float.
inline Image numbered(int width, int height, const std::vector<std::string>& names) {
    Image image(width, height);
    std::vector<float> samples;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (size_t k = 0; k < names.size(); ++k)
                samples.push_back(100 * static_cast<float>(k) + static_cast<float>(y) +
                                  static_cast<float>(x) / 64);
    image.addChannels(names, samples, names.size());
    return image;
}

} // namespace eikonal::image
