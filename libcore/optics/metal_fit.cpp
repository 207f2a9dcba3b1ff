// A metal made of the colour that it mirrors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/materials.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace eikonal::optics {

namespace {

using Index = std::complex<double>; // n + i k

/// Fresnel's reflectance of unpolarised light from air.
double reflectanceAt(const Index& index, double cosine) {
    const Index inside = std::sqrt(1.0 - (1 - cosine * cosine) / (index * index));
    const double across = std::norm((cosine - index * inside) / (cosine + index * inside));
    const double along = std::norm((index * cosine - inside) / (index * cosine + inside));
    return 0.5 * (across + along);
}

/// The mean square of what parts it from Schlick 1994, "An Inexpensive BRDF Model".
double offSchlick(const Index& index, double reflectance) {
    constexpr int kAngles = 32;
    double sum = 0, weights = 0;
    for (int i = 0; i < kAngles; ++i) {
        const double cosine = (i + 0.5) / kAngles;
        const double schlick = reflectance + (1 - reflectance) * std::pow(1 - cosine, 5);
        const double off = reflectanceAt(index, cosine) - schlick;
        sum += cosine * off * off;
        weights += cosine;
    }
    return sum / weights;
}

/// Gulbrandsen's index of that reflectance; `tint` 1 has the least real part, 0 the largest.
Index indexOf(double reflectance, double tint) {
    const double root = std::sqrt(reflectance);
    const double least = (1 - reflectance) / (1 + reflectance), most = (1 + root) / (1 - root);
    const double n = tint * least + (1 - tint) * most;
    const double squared =
        (reflectance * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - reflectance);
    return {n, std::sqrt(std::max(squared, 0.0))};
}

} // namespace

NamedMetal metalOfReflectance(const glm::dvec3& reflectance) {
    NamedMetal metal{"", glm::dvec3(1), glm::dvec3(0)};
    constexpr int kTints = 64;
    for (int c = 0; c < 3; ++c) {
        // At 1 nothing is left to tell indices apart.
        const double wanted = std::clamp(reflectance[c], 0.0, 0.999);
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= kTints; ++i) {
            const Index index = indexOf(wanted, static_cast<double>(i) / kTints);
            const double off = offSchlick(index, wanted);
            if (off >= best) continue;
            best = off;
            metal.index[c] = index.real();
            metal.extinction[c] = index.imag();
        }
    }
    return metal;
}

} // namespace eikonal::optics
