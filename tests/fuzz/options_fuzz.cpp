// Any text as the value of an option: refused as wrong usage, or within what the option allows.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "gpu/device.h"
#include "image/picture.h"
#include "optics/tracing.h"
#include "scene/lights.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>

using namespace eikonal;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void refusedOrRight(const std::function<void()>& parse) {
    try {
        parse();
    } catch (const UsageError&) {
        // As it should be.
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    if (const auto number = parseNumber(text)) {
        require(std::isfinite(*number));
        require(parseNumber(toText(*number)) == number);
    }
    for (const char separator : {',', 'x', ':'})
        if (const auto numbers = parseNumbers(text, separator))
            require(numbers->size() == split(text, separator).size());
    require(join(split(text, ','), ",") == text);
    const image::PictureName name = image::parsePictureName(text);
    require(name.layer.empty() ? name.path == text : name.path + ":" + name.layer == text);
    refusedOrRight([&] { require(gpu::parseDeviceChoice(text).index >= 0); });
    refusedOrRight([&] { optics::parseIntegrator(text); });
    refusedOrRight([&] { optics::parseInterpolation(text); });
    refusedOrRight([&] { optics::parseBoundary(text); });
    refusedOrRight([&] {
        const scene::Light light = scene::parseLight(text);
        for (int c = 0; c < 3; ++c)
            require(std::isfinite(light.rgb[c]) && light.rgb[c] >= 0 &&
                    std::isfinite(light.vector[c]));
    });
    return 0;
}
