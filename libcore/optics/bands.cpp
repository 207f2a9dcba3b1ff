// The wavelengths at which light is traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/bands.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace eikonal::optics {

namespace {

using glm::dvec3;

/// Numbers below are counts, from it on wavelengths.
constexpr double kLeastWavelength = 200, kMostWavelength = 5000; // [nm]
constexpr int kMostBands = 64;

/// White light from half-way to the line before each to half-way to the next.
std::vector<Line> sharedOut(const std::vector<double>& wavelengths) {
    std::vector<Line> lines;
    dvec3 before(0);
    for (size_t k = 0; k < wavelengths.size(); ++k) {
        const bool last = k + 1 == wavelengths.size();
        const dvec3 upTo =
            last ? dvec3(1) : whiteUpTo(0.5 * (wavelengths[k] + wavelengths[k + 1]));
        lines.push_back({wavelengths[k], upTo - before});
        before = upTo;
    }
    return lines;
}

/// Lines of the same spacing [nm] through the visible range. Each has the colour of its own
/// wavelength; what they lack of white together, a few percent, is shared out as above, which would
/// by itself make every colour paler.
std::vector<Line> evenlySpaced(const std::vector<double>& wavelengths, double spacing) {
    std::vector<Line> lines = sharedOut(wavelengths);
    dvec3 lacking(1);
    for (const Line& line : lines) lacking -= spacing * whiteDensity(line.wavelength);
    for (Line& line : lines)
        line.weight = spacing * whiteDensity(line.wavelength) + lacking * line.weight;
    return lines;
}

Band bandOf(const Line& line) {
    return {line, std::vector<Line>(kLinesPerBand, line),
            std::vector<double>(kLinesPerBand, line.wavelength)};
}

/// From −1 to 1, densest at 0 as a tent of that width is: the k-th of so many.
double tentPlace(int k, int count) {
    const double u = 2 * (k + 0.5) / count - 1;
    return u < 0 ? std::sqrt(1 + u) - 1 : 1 - std::sqrt(1 - u);
}

/// At its ends the range is its first and last band's alone.
double spreadAround(double middle, double place, double spacing) {
    const bool first = middle < kShortest + spacing, last = middle > kLongest - spacing;
    double wavelength = middle + spacing * place;
    if (first && wavelength < kShortest) wavelength = 2 * kShortest - wavelength;
    if (last && wavelength > kLongest) wavelength = 2 * kLongest - wavelength;
    return wavelength;
}

} // namespace

std::string Wavelengths::text() const {
    if (!disperse()) return toText(kReferenceWavelength) + " nm";
    if (list.empty())
        return std::to_string(count) + " from " + toText(kShortest) + " to " + toText(kLongest) +
               " nm";
    std::vector<std::string> lines;
    for (const double line : list) lines.push_back(toText(line));
    return join(lines, ", ") + " nm";
}

Wavelengths parseWavelengths(const std::string& option, const std::string& text) {
    const auto fail = [&] {
        return UsageError(option + ": found '" + text +
                          "', expected how many (1 to 64), or wavelengths from 200 to 5000 nm in "
                          "ascending order, as 486.1,587.6,656.3");
    };
    const auto numbers = parseNumbers(text);
    if (!numbers || numbers->empty() || numbers->size() > static_cast<size_t>(kMostBands))
        throw fail();
    Wavelengths found;
    const double first = numbers->front();
    if (numbers->size() == 1 && first >= 1 && first <= kMostBands && first == std::floor(first)) {
        found.count = static_cast<int>(first);
        return found;
    }
    double before = 0;
    for (const double wavelength : *numbers) {
        if (!(wavelength >= kLeastWavelength && wavelength <= kMostWavelength) ||
            wavelength <= before)
            throw fail();
        before = wavelength;
    }
    found.list = *numbers;
    return found;
}

std::vector<Band> bandsOf(const Wavelengths& wavelengths, bool disperses) {
    if (!disperses || !wavelengths.disperse()) return {bandOf({})};
    std::vector<Band> bands;
    if (!wavelengths.list.empty()) {
        for (const Line& line : sharedOut(wavelengths.list)) bands.push_back(bandOf(line));
        return bands;
    }
    const int count = wavelengths.count;
    const double spacing = (kLongest - kShortest) / count;
    const auto linesAt = [&](double share) {
        std::vector<double> places;
        for (int k = 0; k < count; ++k) places.push_back(kShortest + (k + share) * spacing);
        return evenlySpaced(places, spacing);
    };
    for (const Line& middle : linesAt(0.5)) {
        Band band{middle, {}, {}};
        for (int i = 0; i < kLinesPerBand; ++i)
            band.spread.push_back(
                spreadAround(middle.wavelength, tentPlace(i, kLinesPerBand), spacing));
        bands.push_back(std::move(band));
    }
    for (int i = 0; i < kLinesPerBand; ++i) {
        const std::vector<Line> lines = linesAt((i + 0.5) / kLinesPerBand);
        for (size_t k = 0; k < bands.size(); ++k) bands[k].shifted.push_back(lines[k]);
    }
    return bands;
}

} // namespace eikonal::optics
