// Pictures in memory: named planes of floats, as they come from a file and go to one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unistd.h>

namespace eikonal::image {

namespace {

constexpr long long kMaxSide = 1 << 17; // [pixel], see checkSize()

/// "channel 'R' is nan at pixel (3, 7)" for the sample at `index` of all samples.
std::string sampleText(const Image& image, size_t index) {
    const size_t width = static_cast<size_t>(image.width);
    const size_t inPlane = index % image.area();
    return "channel '" + image.channels[index / image.area()] + "' is " +
           toText(image.pixels[index]) + " at pixel (" + std::to_string(inPlane % width) + ", " +
           std::to_string(inPlane / width) + ")";
}

/// Why the image is none, or "".
std::string contradiction(const Image& image) {
    if (image.width < 1 || image.height < 1) return "the picture has no pixels";
    if (image.channels.empty()) return "the picture has no channels";
    if (image.pixels.size() != image.channels.size() * image.area())
        return "the picture has " + std::to_string(image.pixels.size()) + " samples, expected " +
               std::to_string(image.channels.size() * image.area());
    const std::set<std::string> names(image.channels.begin(), image.channels.end());
    if (names.size() != image.channels.size()) return "the picture has a channel twice";
    if (names.count("") != 0) return "the picture has a channel without a name";
    return {};
}

} // namespace

Image::Image(int w, int h) : width(w), height(h) {
    if (w < 1 || h < 1)
        throw InternalError("a picture of " + std::to_string(w) + "x" + std::to_string(h) +
                            " pixels was asked for, expected at least 1x1");
}

std::optional<size_t> Image::find(std::string_view name) const {
    const auto at = std::find(channels.begin(), channels.end(), name);
    if (at == channels.end()) return std::nullopt;
    return static_cast<size_t>(at - channels.begin());
}

void Image::addChannels(const std::vector<std::string>& names, std::span<const float> interleaved,
                        size_t stride) {
    if (names.size() > stride || interleaved.size() != area() * stride)
        throw InternalError("channel '" + join(names, ",") + "': " +
                            std::to_string(interleaved.size()) + " samples at a stride of " +
                            std::to_string(stride) + " for " + std::to_string(area()) + " pixels");
    for (size_t k = 0; k < names.size(); ++k) {
        if (names[k].empty() || find(names[k]))
            throw InternalError("channel '" + names[k] + "' was added twice or has no name");
        channels.push_back(names[k]);
        pixels.resize(channels.size() * area());
        float* const plane = pixels.data() + (channels.size() - 1) * area();
        for (size_t i = 0; i < area(); ++i) plane[i] = interleaved[i * stride + k];
    }
}

std::vector<float> interleaved(const Image& image, const std::vector<std::string>& names) {
    std::vector<float> samples(image.area() * names.size());
    for (size_t k = 0; k < names.size(); ++k) {
        const auto channel = image.find(names[k]);
        if (!channel)
            throw InternalError("no channel '" + names[k] +
                                "' in the picture (it has: " + join(image.channels, ", ") + ")");
        const auto plane = image.plane(*channel);
        for (size_t i = 0; i < plane.size(); ++i) samples[i * names.size() + k] = plane[i];
    }
    return samples;
}

void checkFinite(const Image& image, const std::string& path) {
    const std::string wrong = contradiction(image);
    if (!wrong.empty()) throw InternalError(path + ": " + wrong);
    const auto at = std::find_if(image.pixels.begin(), image.pixels.end(),
                                 [](float sample) { return !std::isfinite(sample); });
    if (at == image.pixels.end()) return;
    throw InternalError(path + ": " +
                        sampleText(image, static_cast<size_t>(at - image.pixels.begin())) +
                        ", expected a finite number");
}

void checkSize(long long width, long long height, size_t channels, const std::string& path) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
        throw DataError(path + ": is " + size + " pixels, expected 1 to " +
                        std::to_string(kMaxSide) + " on a side");
    const double needed = static_cast<double>(width) * static_cast<double>(height) *
                          static_cast<double>(channels) * static_cast<double>(sizeof(float));
    const double present = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
                           static_cast<double>(::sysconf(_SC_PAGESIZE));
    if (needed > present)
        throw MemoryError(path + ": " + size + " pixels take " + bytesText(needed) +
                          ", the machine has " + bytesText(present));
}

} // namespace eikonal::image
