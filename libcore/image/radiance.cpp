// Radiance from what pictures hold: other primaries, infinite suns, negative edges.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace eikonal::image {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr std::array<double, 8> kRec709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
constexpr float kLargestHalf = 65504;

/// X, Y, Z of a chromaticity, at Y = 1.
dvec3 xyzOf(double x, double y) {
    return {x / y, 1, (1 - x - y) / y};
}

dvec3 whiteOf(const std::array<double, 8>& c) {
    return xyzOf(c[6], c[7]);
}

/// The primaries, so scaled that 1, 1, 1 is white (SMPTE RP 177).
dmat3 xyzFromRgb(const std::array<double, 8>& c) {
    const dmat3 primaries(xyzOf(c[0], c[1]), xyzOf(c[2], c[3]), xyzOf(c[4], c[5]));
    const dvec3 scale = glm::inverse(primaries) * whiteOf(c);
    return {primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z};
}

/// Bradford's adaptation of one white to another: cones' responses, scaled one by one.
dmat3 adaptation(const dvec3& from, const dvec3& to) {
    const dmat3 cones = glm::transpose(
        dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const dvec3 ratio = (cones * to) / (cones * from);
    return glm::inverse(cones) * dmat3(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z) * cones;
}

dmat3 rec709From(const std::array<double, 8>& chromaticities) {
    return glm::inverse(xyzFromRgb(kRec709)) *
           adaptation(whiteOf(chromaticities), whiteOf(kRec709)) * xyzFromRgb(chromaticities);
}

/// Samples that are not what radiance is, and the worst of them.
struct Found {
    size_t count = 0;
    size_t worst = 0;
};

template<typename Wrong> Found change(Image& image, const Wrong& wrong, float instead) {
    Found found;
    float least = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        float& sample = image.pixels[i];
        if (!wrong(sample)) continue;
        if (found.count++ == 0 || sample < least) {
            least = sample;
            found.worst = i;
        }
        sample = instead;
    }
    return found;
}

std::string placeText(const Image& image, size_t index) {
    const size_t width = static_cast<size_t>(image.width), pixel = index % image.area();
    return "channel '" + image.channels[index / image.area()] + "', pixel (" +
           std::to_string(pixel % width) + ", " + std::to_string(pixel / width) + ")";
}

void toRec709(Image& image) {
    const dmat3 matrix = rec709From(*image.chromaticities);
    const auto r = image.plane(*image.find("R")), g = image.plane(*image.find("G")),
               b = image.plane(*image.find("B"));
    for (size_t i = 0; i < image.area(); ++i) {
        const dvec3 rgb = matrix * dvec3(r[i], g[i], b[i]);
        r[i] = static_cast<float>(rgb.x);
        g[i] = static_cast<float>(rgb.y);
        b[i] = static_cast<float>(rgb.z);
    }
}

/// Whether chromaticities are Rec. 709's, to the digits that programs write.
bool isRec709(const std::array<double, 8>& c) {
    for (size_t i = 0; i < c.size(); ++i)
        if (std::abs(c[i] - kRec709[i]) > 2e-4) return false;
    return true;
}

} // namespace

std::vector<std::string> makeRadiance(Image& image, const std::string& path) {
    std::vector<std::string> warnings;
    const auto nan = std::find_if(image.pixels.begin(), image.pixels.end(),
                                  [](float sample) { return std::isnan(sample); });
    if (nan != image.pixels.end())
        throw DataError(path + ": nan in " +
                        placeText(image, static_cast<size_t>(nan - image.pixels.begin())) +
                        ", expected a radiance");
    const Found infinite = change(
        image, [](float sample) { return sample > 0 && std::isinf(sample); }, kLargestHalf);
    if (infinite.count > 0)
        warnings.push_back(path + ": " + std::to_string(infinite.count) +
                           " infinite samples are taken as 65504 (" +
                           placeText(image, infinite.worst) + ")");
    if (image.chromaticities && !isRec709(*image.chromaticities) && image.find("R")) {
        const double determinant = glm::determinant(rec709From(*image.chromaticities));
        if (!std::isfinite(determinant) || determinant == 0)
            throw DataError(path + ": its chromaticities span no colours");
        toRec709(image);
    }
    image.chromaticities.reset();
    float least = 0;
    for (const float sample : image.pixels) least = std::min(least, sample);
    const Found negative = change(
        image, [](float sample) { return sample < 0; }, 0);
    if (negative.count > 0)
        warnings.push_back(path + ": " + std::to_string(negative.count) +
                           " negative samples are taken as 0 (down to " + toText(least) + ", " +
                           placeText(image, negative.worst) + ")");
    return warnings;
}

} // namespace eikonal::image
