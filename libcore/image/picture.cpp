// Pictures in any format: environment maps in, tone-mapped pictures for the eye out.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/picture.h"

#include "base/error.h"
#include "base/input_file.h"
#include "image/exr.h"
#include "image/input.h"
#include "image/picture_module.h"
#include "image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>

namespace eikonal::image {

namespace {

std::uint8_t byteOf(double value) {
    return static_cast<std::uint8_t>(std::floor(255 * value + 0.5));
}

/// Narkowicz's fit; 1 is reached at about 7.
double filmic(double x) {
    return std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
}

/// What a decode leaves behind; errors travel here, around the C functions.
struct Decoding {
    const std::string& path;
    Image image;
    std::vector<float> samples;
    std::exception_ptr failure;
};

float* allocateSamples(void* context, int width, int height, int channels) {
    Decoding& decoding = *static_cast<Decoding*>(context);
    try {
        // Twice: interleaved as they come, and planar as they go.
        checkSize(width, height, 2 * static_cast<size_t>(channels), decoding.path);
        decoding.image = Image(width, height);
        decoding.samples.resize(decoding.image.area() * static_cast<size_t>(channels));
        return decoding.samples.data();
    } catch (...) {
        decoding.failure = std::current_exception();
        return nullptr;
    }
}

bool appendBytes(void* context, const void* bytes, size_t size) {
    std::ostream& stream = *static_cast<std::ostream*>(context);
    stream.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    return static_cast<bool>(stream);
}

Image decodeByModule(const std::string& opened, const std::string& path) {
    const PictureModule& module = pictureModule();
    Decoding decoding{path, {}, {}, nullptr};
    std::array<char, 512> message{};
    const bool decoded =
        module.decode(opened.c_str(), allocateSamples, &decoding, message.data(), message.size());
    if (decoding.failure) std::rethrow_exception(decoding.failure);
    if (!decoded) throw DataError(path + ": is no readable picture: " + oneLine(message.data()));
    const size_t channels = decoding.samples.size() / decoding.image.area();
    const std::vector<std::string> grey = {"Y", "A"}, colour = {"R", "G", "B", "A"};
    const std::vector<std::string>& names = channels <= 2 ? grey : colour;
    const auto count = static_cast<std::ptrdiff_t>(channels);
    decoding.image.addChannels({names.begin(), names.begin() + count}, decoding.samples, channels);
    return std::move(decoding.image);
}

} // namespace

double toneMapped(double radiance, const ToneMap& toneMap) {
    const double exposed = std::max(0.0, radiance * std::exp2(toneMap.exposure));
    return toneMap.curve == ToneCurve::filmic ? filmic(exposed) : std::min(1.0, exposed);
}

std::vector<std::uint8_t> displayBytes(const Image& linear, const ToneMap& toneMap) {
    const size_t channels = toneMap.alpha ? 4 : 3;
    const std::vector<float> rgb = interleaved(linear, {"R", "G", "B"});
    const auto alphaChannel = toneMap.alpha ? linear.find("A") : std::nullopt;
    const std::span<const float> coverage =
        alphaChannel ? linear.plane(*alphaChannel) : std::span<const float>();
    std::vector<std::uint8_t> bytes(linear.area() * channels);
    for (size_t i = 0; i < linear.area(); ++i) {
        const double alpha = coverage.empty() ? 1 : std::clamp<double>(coverage[i], 0, 1);
        // Colour without coverage has no straight form; it is dropped, as everywhere.
        const double straight = alpha > 0 ? 1 / alpha : 0;
        for (size_t k = 0; k < 3; ++k)
            bytes[i * channels + k] =
                byteOf(srgbFromLinear(toneMapped(rgb[3 * i + k] * straight, toneMap)));
        if (toneMap.alpha) bytes[i * channels + 3] = byteOf(alpha);
    }
    return bytes;
}

bool isDisplayPicture(const std::string& path) {
    constexpr std::array kExtensions = {"png", "jpg", "jpeg", "tga"};
    return std::find(kExtensions.begin(), kExtensions.end(), extensionOf(path)) !=
           kExtensions.end();
}

void requirePictureModule() {
    pictureModule();
}

void writePicture(const Image& linear, AtomicFile& out, const ToneMap& toneMap) {
    if (!isDisplayPicture(out.path()))
        throw UsageError(out.path() + ": expected a name ending in .png, .jpg, .jpeg or .tga");
    checkFinite(linear, out.path());
    const PictureModule& module = pictureModule();
    const std::string extension = extensionOf(out.path());
    ToneMap supported = toneMap;
    if (extension == "jpg" || extension == "jpeg") supported.alpha = false;
    const std::vector<std::uint8_t> bytes = displayBytes(linear, supported);
    std::array<char, 512> message{};
    const bool encoded =
        module.encode(extension.c_str(), linear.width, linear.height, supported.alpha ? 4 : 3,
                      bytes.data(), appendBytes, &out.stream(), message.data(), message.size());
    out.finish(); // knows the system's reason, if that is what went wrong
    if (!encoded) throw IoError(out.path() + ": can't encode: " + oneLine(message.data()));
}

Image readPicture(const std::string& path, const std::string& layer) {
    checkReadable(path);
    const SeekableInput input(path);
    // By the name too, so that a damaged EXR is called that.
    if (beginsAsExr(input.path()) || extensionOf(path) == "exr")
        return readExr(input.path(), layer, path);
    if (!layer.empty())
        throw DataError(path + ": is no OpenEXR file, which alone have layers (found: " + layer +
                        ")");
    return decodeByModule(input.path(), path);
}

PictureName parsePictureName(const std::string& text) {
    std::error_code ignored;
    const size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon + 1 == text.size() ||
        std::filesystem::exists(text, ignored))
        return {text, ""};
    return {text.substr(0, colon), text.substr(colon + 1)};
}

Environment readPlate(const PictureName& name) {
    const Image picture = readPicture(name.path, name.layer);
    if (picture.envmap == Envmap::cube)
        throw DataError(name.path + ": is a cube map, expected a lat-long map");
    const bool grey = !picture.find("R");
    Environment environment;
    Image& map = environment.map;
    map = Image(picture.width, picture.height);
    map.envmap = picture.envmap;
    map.addChannels({"R", "G", "B"},
                    interleaved(picture, grey ? std::vector<std::string>{"Y", "Y", "Y"}
                                              : std::vector<std::string>{"R", "G", "B"}),
                    3);
    if (!grey) map.chromaticities = picture.chromaticities;
    environment.warnings = makeRadiance(map, name.path);
    return environment;
}

Environment readEnvironment(const PictureName& name) {
    Environment environment = readPlate(name);
    const Image& map = environment.map;
    if (std::abs(map.width - 2 * map.height) > 2) // maps by edges have a column and a row more
        environment.warnings.push_back(
            name.path + ": found " + std::to_string(map.width) + " x " +
            std::to_string(map.height) +
            " pixels, expected a lat-long map, twice as wide as high; it is stretched to one");
    return environment;
}

} // namespace eikonal::image
