// How far a picture of a lit floor is from the exact one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "caustic/compare.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace caustic {

using eikonal::image::Image;

namespace {

std::span<const float> plane(const Image& image, const std::string& name) {
    const auto found = image.find(name);
    if (!found) throw std::invalid_argument("a picture has no channel " + name);
    return image.plane(*found);
}

} // namespace

Image imageOf(const judge::Picture& picture, const judge::View& view, double irradiance) {
    std::vector<float> samples;
    for (size_t i = 0; i < picture.radiance.size(); ++i) {
        const auto value = static_cast<float>(irradiance * picture.radiance[i]);
        samples.insert(samples.end(), {value, value, value, static_cast<float>(picture.met[i])});
    }
    Image image(view.width, view.rows);
    image.addChannels({"R", "G", "B", "meets.V"}, samples, 4);
    return image;
}

Errors errorsOf(const Image& picture, const Image& exact, judge::Meets meets) {
    if (picture.width != exact.width || picture.height != exact.height)
        throw std::invalid_argument("the pictures are not of one size");
    const auto found = plane(picture, "G"), wanted = plane(exact, "G");
    const auto met = plane(exact, "meets.V");
    const auto counts = [&](size_t i) { return met[i] == static_cast<float>(meets); };
    Errors errors;
    double sum = 0, foundSum = 0, squares = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
        if (!counts(i)) continue;
        ++errors.pixels;
        sum += wanted[i], foundSum += found[i];
    }
    if (errors.pixels == 0 || sum == 0) return errors;
    const double tenth = 0.1 * sum / errors.pixels;
    for (size_t i = 0; i < wanted.size(); ++i) {
        if (!counts(i)) continue;
        const double off = found[i] - wanted[i];
        const double square = off * off / (double{wanted[i]} * wanted[i] + tenth * tenth);
        squares += square;
        errors.within += (square <= 0.05 * 0.05) / static_cast<double>(errors.pixels);
    }
    errors.error = std::sqrt(squares / errors.pixels);
    errors.energy = foundSum / sum - 1;
    return errors;
}

} // namespace caustic
