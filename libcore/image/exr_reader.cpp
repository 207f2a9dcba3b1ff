// Reading OpenEXR: environment maps on their way in, renders on their way to a comparison.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "image/exr.h"
#include "image/exr_workers.h"
#include "image/input.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTestFile.h>
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <new>

namespace eikonal::image {

namespace {

long long sideOf(int low, int high) {
    return static_cast<long long>(high) - low + 1;
}

/// The bytes that OpenEXR reads of an attribute, whatever size the file claims; 0: as many as that.
std::int32_t sizeOf(const std::string& type) {
    static const std::map<std::string, std::int32_t> sizes{
        {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
        {"compression", 1}, {"double", 8},   {"envmap", 1},
        {"float", 4},       {"int", 4},      {"keycode", 28},
        {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
        {"m44f", 64},       {"m44d", 128},   {"rational", 8},
        {"timecode", 8},    {"tiledesc", 9}, {"v2i", 8},
        {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
        {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};
    const auto found = sizes.find(type);
    return found == sizes.end() ? 0 : found->second;
}

/// The bytes of a list of channels from here on: names, each with 16 bytes, and an empty name.
std::streamoff channelsLength(std::istream& file) {
    const std::streamoff begin = file.tellg();
    for (std::string name; std::getline(file, name, '\0') && !name.empty();)
        file.seekg(16, std::ios::cur);
    const std::streamoff end = file.tellg();
    file.seekg(begin);
    return end - begin;
}

/// Walks through the attributes. OpenEXR takes memory for the size that one claims, gigabytes in a
/// damaged file, before it finds the file's end.
void checkAttributes(const std::string& opened, const std::string& path) {
    std::ifstream file(opened, std::ios::binary | std::ios::ate);
    const std::streamoff size = file.tellg();
    const auto number = [&file] { // little endian
        unsigned char bytes[4] = {};
        file.read(reinterpret_cast<char*>(bytes), sizeof bytes);
        return static_cast<std::int32_t>(bytes[0] | bytes[1] << 8u | bytes[2] << 16u |
                                         static_cast<unsigned>(bytes[3]) << 24u);
    };
    file.seekg(4); // the magic number
    const bool multiPart = (number() & 0x1000) != 0;
    std::string name, type;
    // Headers end with an empty name each, their list with another.
    for (bool begun = false; std::getline(file, name, '\0');) {
        if (name.empty()) {
            if (!multiPart || !begun) return;
            begun = false;
            continue;
        }
        begun = true;
        std::getline(file, type, '\0');
        const std::int32_t length = number();
        if (!file || length < 0 || length > size - file.tellg())
            throw DataError(path + ": attribute '" + name.substr(0, 40) + "' claims " +
                            std::to_string(length) + " bytes, more than the file has left");
        const std::streamoff taken = type == "chlist" ? channelsLength(file) : sizeOf(type);
        if (taken != 0 && taken != length)
            throw DataError(path + ": attribute '" + name.substr(0, 40) + "' claims " +
                            std::to_string(length) + " bytes, but a " + type + " has " +
                            std::to_string(taken));
        file.seekg(length, std::ios::cur);
    }
}

/// Channels that make a picture: a layer of a part of the file.
struct Picture {
    int part = 0;
    std::string partName, layer;
    std::vector<std::string> channels; ///< at full resolution, the layer's name with them
};

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// "ViewLayer.Combined" of "ViewLayer.Combined.R".
std::string layerOf(const std::string& channel) {
    const size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

/// The pictures in a part, the unnamed layer first. `all` gathers the names of its channels.
std::vector<Picture> picturesOf(const Imf::Header& header, int part,
                                std::vector<std::string>& all) {
    std::vector<std::string> names;
    std::map<std::string, std::vector<std::string>> layers;
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
        names.emplace_back(at.name());
        if (at.channel().xSampling == 1 && at.channel().ySampling == 1)
            layers[layerOf(at.name())].emplace_back(at.name());
    }
    all.insert(all.end(), names.begin(), names.end());
    std::vector<Picture> pictures;
    for (const auto& [layer, channels] : layers) {
        const std::string dotted = layer.empty() ? "" : layer + ".";
        if (has(names, dotted + "RY") || has(names, dotted + "BY")) continue;
        if (has(channels, dotted + "Y") ||
            (has(channels, dotted + "R") && has(channels, dotted + "G") &&
             has(channels, dotted + "B")))
            pictures.push_back({part, header.hasName() ? header.name() : "", layer, channels});
    }
    // An unnamed picture has the layers beside it as further channels.
    if (!pictures.empty() && pictures.front().layer.empty())
        for (const auto& [layer, channels] : layers)
            if (!layer.empty())
                pictures.front().channels.insert(pictures.front().channels.end(), channels.begin(),
                                                 channels.end());
    return pictures;
}

std::string namesOf(const std::vector<Picture>& pictures) {
    std::vector<std::string> names;
    for (const Picture& picture : pictures)
        names.push_back(!picture.layer.empty()     ? picture.layer
                        : picture.partName.empty() ? "R, G, B"
                                                   : picture.partName);
    return join(names, ", ");
}

Picture choose(const std::vector<Picture>& pictures, const std::string& layer,
               const std::string& path) {
    if (!layer.empty()) {
        for (const Picture& picture : pictures)
            if (picture.layer == layer || picture.partName == layer) return picture;
        throw DataError(path + ": no layer or part '" + layer +
                        "' with colours (found: " + namesOf(pictures) + ")");
    }
    const Picture& first = pictures.front();
    const auto inPart = std::count_if(pictures.begin(), pictures.end(),
                                      [&](const Picture& one) { return one.part == first.part; });
    if (!first.layer.empty() && inPart > 1)
        throw DataError(path + ": has several layers, expected FILE:LAYER with one of " +
                        namesOf(pictures));
    return first;
}

/// The picture asked for; throws if there is none.
Picture pictureIn(Imf::MultiPartInputFile& file, const std::string& layer,
                  const std::string& path) {
    std::vector<Picture> pictures;
    std::vector<std::string> all;
    int deep = 0;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        if (header.hasType() && Imf::isDeepData(header.type())) {
            ++deep;
            continue;
        }
        const std::vector<Picture> here = picturesOf(header, part, all);
        pictures.insert(pictures.end(), here.begin(), here.end());
    }
    if (deep > 0 && deep == file.parts())
        throw DataError(path + ": is a deep EXR, expected a flat one");
    if (!pictures.empty()) return choose(pictures, layer, path);
    if (has(all, "RY") || has(all, "BY"))
        throw DataError(path + ": holds luminance and chroma, expected R, G and B or Y alone");
    throw DataError(path + ": no channels R, G and B, and no Y (found: " + join(all, ", ") + ")");
}

/// The first part that has all of these channels; throws if there is none.
Picture channelsIn(Imf::MultiPartInputFile& file, const std::vector<std::string>& channels,
                   const std::string& path) {
    std::vector<std::string> all;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        if (header.hasType() && Imf::isDeepData(header.type())) continue;
        const auto isThere = [&](const std::string& name) {
            const Imf::Channel* found = header.channels().findChannel(name);
            return found != nullptr && found->xSampling == 1 && found->ySampling == 1;
        };
        if (std::all_of(channels.begin(), channels.end(), isThere))
            return {part, header.hasName() ? header.name() : "", "", channels};
        for (auto at = header.channels().begin(); at != header.channels().end(); ++at)
            all.emplace_back(at.name());
    }
    for (const std::string& channel : channels)
        if (!has(all, channel))
            throw DataError(path + ": no channel '" + channel + "' (found: " + join(all, ", ") +
                            ")");
    throw DataError(path + ": no part has all of the channels " + join(channels, ", "));
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
void probe(Imf::InputPart& file, const std::vector<std::string>& channels,
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

std::optional<std::array<double, 8>> chromaticitiesOf(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return std::nullopt;
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    return std::array<double, 8>{c.red.x,  c.red.y,  c.green.x, c.green.y,
                                 c.blue.x, c.blue.y, c.white.x, c.white.y};
}

/// What is read of a file: a layer, "" for its picture, or else channels by their names.
struct Wanted {
    std::string layer;
    std::vector<std::string> channels;
};

Image decode(const std::string& opened, const std::string& path, const Wanted& wanted) {
    const ExrWorkers workers(0);
    Imf::MultiPartInputFile parts(opened.c_str(), 0);
    const Picture picture = wanted.channels.empty() ? pictureIn(parts, wanted.layer, path)
                                                    : channelsIn(parts, wanted.channels, path);
    Imf::InputPart file(parts, picture.part);
    const Imf::Header& header = file.header();
    const Imath::Box2i data = header.dataWindow();
    Image image;
    image.channels = picture.channels;
    image.envmap = envmapOf(header);
    image.chromaticities = chromaticitiesOf(header);
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
    if (!picture.layer.empty())
        for (std::string& channel : image.channels) channel.erase(0, picture.layer.size() + 1);
    return image;
}

Image read(const std::string& file, const Wanted& wanted, const std::string& path) {
    checkReadable(file);
    try {
        if (!Imf::isOpenExrFile(file.c_str())) throw DataError(path + ": is no OpenEXR file");
        checkAttributes(file, path);
        return decode(file, path, wanted);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw MemoryError(path + ": not enough memory for the picture");
    } catch (const std::exception& error) {
        throw DataError(path + ": is no readable EXR: " + oneLine(error.what()));
    }
}

} // namespace

Image readExr(const std::string& file, const std::string& layer, const std::string& name) {
    return read(file, {layer, {}}, name.empty() ? file : name);
}

Image readExrChannels(const std::string& file, const std::vector<std::string>& channels) {
    return read(file, {"", channels}, file);
}

} // namespace eikonal::image
