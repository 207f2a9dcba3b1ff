// Reading OpenEXR: environment maps on their way in, renders on their way to a comparison.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "image/exr.h"
#include "image/input.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTestFile.h>
#include <algorithm>
#include <new>

namespace eikonal::image {

namespace {

long long sideOf(int low, int high) {
    return static_cast<long long>(high) - low + 1;
}

void checkKind(const std::string& path) {
    bool tiled = false, deep = false, multiPart = false;
    if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, multiPart))
        throw DataError(path + ": is no OpenEXR file");
    if (deep) throw DataError(path + ": is a deep EXR, expected a flat one");
    if (multiPart) throw DataError(path + ": is a multi-part EXR, expected a single part");
}

/// The channels at full resolution; throws if there is no picture among them.
std::vector<std::string> channelsOf(const Imf::Header& header, const std::string& path) {
    std::vector<std::string> all, full;
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
        all.emplace_back(at.name());
        if (at.channel().xSampling == 1 && at.channel().ySampling == 1)
            full.emplace_back(at.name());
    }
    const auto has = [](const std::vector<std::string>& names, const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (has(all, "RY") || has(all, "BY"))
        throw DataError(path + ": holds luminance and chroma, expected R, G and B or Y alone");
    if (!has(full, "Y") && !(has(full, "R") && has(full, "G") && has(full, "B")))
        throw DataError(path + ": no channels R, G and B, and no Y (found: " + join(all, ", ") +
                        ")");
    return full;
}

/// Slices into planar samples that cover the window.
Imf::FrameBuffer planesOf(std::vector<float>& samples, const std::vector<std::string>& channels,
                          const Imath::Box2i& window) {
    const size_t width = static_cast<size_t>(sideOf(window.min.x, window.max.x));
    const size_t area = width * static_cast<size_t>(sideOf(window.min.y, window.max.y));
    Imf::FrameBuffer planes;
    for (size_t k = 0; k < channels.size(); ++k)
        planes.insert(channels[k], Imf::Slice::Make(Imf::FLOAT, samples.data() + k * area, window,
                                                    sizeof(float), sizeof(float) * width));
    return planes;
}

/// Reads the first and the last line into one line's memory. A damaged header can claim any size;
/// this shows that the file has such lines before the memory for all of them is touched.
void probe(Imf::InputFile& file, const std::vector<std::string>& channels,
           const Imath::Box2i& window) {
    std::vector<float> line(channels.size() *
                            static_cast<size_t>(sideOf(window.min.x, window.max.x)));
    for (const int y : {window.min.y, window.max.y}) {
        Imath::Box2i one = window;
        one.min.y = one.max.y = y;
        file.setFrameBuffer(planesOf(line, channels, one));
        file.readPixels(y);
    }
}

/// The part of `data` (samples of the window `from`) that lies in the window `to`, 0 elsewhere.
std::vector<float> moved(const std::vector<float>& data, size_t channels, const Imath::Box2i& from,
                         const Imath::Box2i& to) {
    const long long fromWidth = sideOf(from.min.x, from.max.x);
    const long long fromHeight = sideOf(from.min.y, from.max.y);
    const long long toWidth = sideOf(to.min.x, to.max.x);
    const long long toHeight = sideOf(to.min.y, to.max.y);
    std::vector<float> out(channels * static_cast<size_t>(toWidth * toHeight));
    const int left = std::max(from.min.x, to.min.x), right = std::min(from.max.x, to.max.x);
    const int top = std::max(from.min.y, to.min.y), bottom = std::min(from.max.y, to.max.y);
    if (left > right) return out;
    for (long long k = 0; k < static_cast<long long>(channels); ++k) {
        for (long long y = top; y <= bottom; ++y) {
            const auto begin =
                data.begin() + (k * fromHeight + y - from.min.y) * fromWidth + (left - from.min.x);
            std::copy(begin, begin + sideOf(left, right),
                      out.begin() + (k * toHeight + y - to.min.y) * toWidth + (left - to.min.x));
        }
    }
    return out;
}

Envmap envmapOf(const Imf::Header& header) {
    if (!Imf::hasEnvmap(header)) return Envmap::none;
    return Imf::envmap(header) == Imf::ENVMAP_LATLONG ? Envmap::latLong : Envmap::cube;
}

Image decode(const std::string& path) {
    Imf::InputFile file(path.c_str());
    const Imf::Header& header = file.header();
    const Imath::Box2i data = header.dataWindow();
    Image image;
    image.channels = channelsOf(header, path);
    image.envmap = envmapOf(header);
    const Imath::Box2i window =
        image.envmap == Envmap::none ? header.displayWindow() : header.dataWindow();
    const long long height = sideOf(data.min.y, data.max.y);
    checkSize(sideOf(data.min.x, data.max.x), height, image.channels.size(), path);
    checkSize(sideOf(window.min.x, window.max.x), sideOf(window.min.y, window.max.y),
              image.channels.size(), path);
    image.width = static_cast<int>(sideOf(window.min.x, window.max.x));
    image.height = static_cast<int>(sideOf(window.min.y, window.max.y));

    probe(file, image.channels, data);
    image.pixels.resize(image.channels.size() *
                        static_cast<size_t>(sideOf(data.min.x, data.max.x) * height));
    file.setFrameBuffer(planesOf(image.pixels, image.channels, data));
    file.readPixels(data.min.y, data.max.y);
    if (data != window) image.pixels = moved(image.pixels, image.channels.size(), data, window);
    return image;
}

} // namespace

Image readExr(const std::string& path) {
    checkReadable(path);
    try {
        checkKind(path);
        return decode(path);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw MemoryError(path + ": not enough memory for the picture");
    } catch (const std::exception& error) {
        throw DataError(path + ": is no readable EXR: " + oneLine(error.what()));
    }
}

} // namespace eikonal::image
