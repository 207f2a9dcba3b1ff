// Metals made of the colour that they mirror.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/materials.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>

namespace eikonal {
namespace {

/// Of unpolarised light, by refractive indices as admittances across and along the plane of
/// incidence.
double reflectance(double n, double k, double cosine) {
    const std::complex<double> index(n, k);
    const std::complex<double> part = std::sqrt(index * index - (1 - cosine * cosine));
    const auto off = [](std::complex<double> a, std::complex<double> b) {
        return std::norm((a - b) / (a + b));
    };
    return 0.5 * (off(cosine, part) + off(1 / cosine, index * index / part));
}

TEST(MetalFit, HasItsColourAtNormalIncidenceAndSchlicksCurveBeside) {
    for (const double colour : {0.04, 0.3, 0.5, 0.77, 0.9, 0.99}) {
        const optics::NamedMetal metal = optics::metalOfReflectance(glm::dvec3(colour));
        const double n = metal.index.y, k = metal.extinction.y;
        EXPECT_GT(n, 0);
        EXPECT_NEAR(reflectance(n, k, 1), colour, 1e-9);
        double squares = 0, weights = 0;
        for (int i = 0; i < 100; ++i) {
            const double cosine = (i + 0.5) / 100;
            const double schlick = colour + (1 - colour) * std::pow(1 - cosine, 5);
            squares += cosine * std::pow(reflectance(n, k, cosine) - schlick, 2);
            weights += cosine;
        }
        EXPECT_LT(std::sqrt(squares / weights), 0.04) << colour;
    }
}

TEST(MetalFit, AWhiteOneMirrorsNearlyAll) {
    const optics::NamedMetal metal = optics::metalOfReflectance(glm::dvec3(1));
    EXPECT_NEAR(reflectance(metal.index.x, metal.extinction.x, 1), 0.999, 1e-9);
}

} // namespace
} // namespace eikonal
