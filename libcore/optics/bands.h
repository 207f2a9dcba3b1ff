// The wavelengths at which light is traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "optics/spectrum.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::optics {

/// What light a scene that disperses is traced by. One part alone is light of 587.6 nm.
struct Wavelengths {
    int count = 8;            ///< parts of the visible range, where nothing is listed
    std::vector<double> list; ///< lines [nm], ascending

    /// Whether light of more than the reference's wavelength is traced.
    bool disperse() const { return !list.empty() || count > 1; }
    /// Whether a part of the light has more than one.
    bool spread() const { return list.empty() && count > 1; }
    double shortest() const { return list.empty() ? kShortest : list.front(); } ///< [nm]
    double longest() const { return list.empty() ? kLongest : list.back(); }    ///< [nm]
    /// "8 from 380 to 730 nm", "486.1 nm".
    std::string text() const;
};

/// "8", or a list of wavelengths in nm, "486.1,587.6". Throws UsageError naming the option.
Wavelengths parseWavelengths(const std::string& option, const std::string& text);

/// Light of one wavelength.
struct Line {
    double wavelength = kReferenceWavelength; ///< [nm]
    glm::dvec3 weight{1};                     ///< share of white light, linear RGB
};

/// Engines trace a scene once for every band and add up what they find. A band is a part of the
/// visible range, or a single line.
struct Band {
    /// Its middle, which stands for all of it.
    Line middle;
    /// Rays beside each other take one of these each, from the band's short end to its long one: so
    /// that they show no steps of colour. The k-th of all bands add up to white.
    std::vector<Line> shifted;
    /// Rays that all have the middle's weight take one of these wavelengths each [nm]: from half a
    /// band before the band to half a band behind it, most often near the middle, so that colours
    /// of neighbours pass over into each other.
    std::vector<double> spread;
};

/// How many lines a band of some width has.
constexpr int kLinesPerBand = 64;

/// Where the index does not depend on the wavelength one band carries all light; so it does, at
/// 587.6 nm, where `count` is 1. The weights of all bands add up to (1, 1, 1), to rounding: what
/// does not disperse looks as if traced once. A line of a list has the light from half-way to the
/// one before to half-way to the next.
std::vector<Band> bandsOf(const Wavelengths& wavelengths, bool disperses);

} // namespace eikonal::optics
