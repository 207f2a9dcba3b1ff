// Colours of wavelengths, and the parts that white light is cut into.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "optics/bands.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

using namespace eikonal;
using namespace eikonal::optics;
using glm::dvec2;
using glm::dvec3;

namespace {

/// CIE chromaticity of a linear Rec. 709 colour, by the primaries of Rec. 709 and D65.
dvec2 chromaticityOf(const dvec3& rgb) {
    // Columns: XYZ of the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06), scaled to add up to
    // white.
    const auto xyz = [](double x, double y) { return dvec3(x / y, 1, (1 - x - y) / y); };
    const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
    const dvec3 share = glm::inverse(primaries) * xyz(0.3127, 0.3290);
    const dvec3 found = primaries * (share * rgb);
    const double sum = found.x + found.y + found.z;
    return {found.x / sum, found.y / sum};
}

/// White light within [from, to], by its density alone.
dvec3 integral(double from, double to) {
    const int steps = 20000;
    dvec3 sum(0);
    for (int i = 0; i < steps; ++i)
        sum += whiteDensity(from + (to - from) * (i + 0.5) / steps) * ((to - from) / steps);
    return sum;
}

void expectNear(const dvec3& found, const dvec3& wanted, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], tolerance) << "component " << c;
}

Wavelengths parts(int count) {
    return {count, {}};
}

} // namespace

TEST(Spectrum, WavelengthsHaveTheChromaticitiesOfTheSpectralLocus) {
    // CIE 15, table T.5 of the standard observer of 1931. Our white is not equal energy but D65,
    // cut at 730 nm and made exactly (1, 1, 1): what moves all colours by some 2e-3.
    const std::pair<double, dvec2> locus[] = {{450, {0.1566, 0.0177}}, {480, {0.0913, 0.1327}},
                                              {520, {0.0743, 0.8338}}, {560, {0.3731, 0.6245}},
                                              {600, {0.6270, 0.3725}}, {650, {0.7260, 0.2740}}};
    for (const auto& [wavelength, wanted] : locus) {
        const dvec2 found = chromaticityOf(whiteDensity(wavelength));
        EXPECT_NEAR(found.x, wanted.x, 4e-3) << wavelength;
        EXPECT_NEAR(found.y, wanted.y, 4e-3) << wavelength;
    }
}

TEST(Spectrum, AllOfItIsWhite) {
    expectNear(whiteUpTo(kShortest), dvec3(0), 0);
    expectNear(whiteUpTo(kLongest), dvec3(1), 1e-15);
    // Midpoints of 20,000 pieces of a polygon of 70: exact but where a corner lies within a piece.
    expectNear(integral(kShortest, 487.3), whiteUpTo(487.3), 1e-6);
    expectNear(integral(kShortest, kLongest), dvec3(1), 1e-6);
    expectNear(whiteDensity(300), dvec3(0), 0);
    expectNear(whiteDensity(800), dvec3(0), 0);
}

TEST(Spectrum, CauchysTermIsZeroAtTheYellowLine) {
    EXPECT_EQ(cauchyTerm(587.6), 0);
    // 1/0.25 − 1/0.34527376 on paper.
    EXPECT_NEAR(cauchyTerm(500), 4 - 2.8962525, 1e-6);
}

TEST(Bands, AddUpToWhiteHoweverManyAndShifted) {
    for (const int count : {2, 3, 5, 8, 16, 64}) {
        const std::vector<Band> bands = bandsOf(parts(count), true);
        ASSERT_EQ(bands.size(), static_cast<size_t>(count));
        dvec3 middles(0);
        for (const Band& band : bands) middles += band.middle.weight;
        expectNear(middles, dvec3(1), 1e-14);
        for (size_t line = 0; line < static_cast<size_t>(kLinesPerBand); ++line) {
            dvec3 sum(0);
            for (size_t k = 0; k < bands.size(); ++k) {
                sum += bands[k].shifted[line].weight;
                const double width = (kLongest - kShortest) / count;
                const double low = kShortest + static_cast<double>(k) * width;
                EXPECT_GT(bands[k].shifted[line].wavelength, low);
                EXPECT_LT(bands[k].shifted[line].wavelength, low + width);
            }
            expectNear(sum, dvec3(1), 1e-14);
        }
    }
}

TEST(Bands, ColourAWavelengthAsItsOwnDensityDoes) {
    // Eight parts: the mean over all shifts of what lands within 20 nm is the white light there.
    // What the parts lack of white, up to 3 % at some shifts, is shared out over all wavelengths.
    const std::vector<Band> bands = bandsOf(parts(8), true);
    for (double from = 400; from < 680; from += 20) {
        dvec3 sum(0);
        for (const Band& band : bands)
            for (const Line& line : band.shifted)
                if (line.wavelength >= from && line.wavelength < from + 20)
                    sum += line.weight / double{kLinesPerBand};
        // Lines lie 0.68 nm apart: 20 nm hold one more or less of 29.
        expectNear(sum, whiteUpTo(from + 20) - whiteUpTo(from), 0.012);
    }
}

TEST(Bands, SpreadOverEachOtherAndCoverTheRangeEvenly) {
    // Photons of all bands together are as many at every wavelength: tents that overlap by half.
    for (const int count : {2, 8}) {
        std::vector<int> seen(10, 0);
        for (const Band& band : bandsOf(parts(count), true))
            for (const double wavelength : band.spread) {
                ASSERT_GE(wavelength, kShortest);
                ASSERT_LE(wavelength, kLongest);
                const double place = (wavelength - kShortest) / (kLongest - kShortest);
                ++seen[std::min(static_cast<size_t>(place * 10), size_t{9})];
            }
        for (const int lines : seen) EXPECT_NEAR(lines, 6.4 * count, 0.08 * 64 * count / 10 + 1);
    }
}

TEST(Bands, AListsLinesHaveTheLightHalfWayToTheNext) {
    const std::vector<Band> bands = bandsOf({8, {486.1, 587.6, 656.3}}, true);
    ASSERT_EQ(bands.size(), 3u);
    expectNear(bands[0].middle.weight, integral(kShortest, 536.85), 1e-6);
    expectNear(bands[1].middle.weight, integral(536.85, 621.95), 1e-6);
    expectNear(bands[2].middle.weight, integral(621.95, kLongest), 1e-6);
    for (const Band& band : bands)
        for (const Line& line : band.shifted) EXPECT_EQ(line.wavelength, band.middle.wavelength);
    // One line alone has all light, and no colour.
    const std::vector<Band> one = bandsOf({8, {486.1}}, true);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].middle.weight, dvec3(1));
    EXPECT_EQ(one[0].middle.wavelength, 486.1);
}

TEST(Bands, AreOneWhereNothingDisperses) {
    for (const Wavelengths& asked : {parts(8), parts(1), Wavelengths{8, {400, 500}}}) {
        const std::vector<Band> bands = bandsOf(asked, false);
        ASSERT_EQ(bands.size(), 1u);
        EXPECT_EQ(bands[0].middle.wavelength, 587.6);
        EXPECT_EQ(bands[0].middle.weight, dvec3(1));
    }
    EXPECT_EQ(bandsOf(parts(1), true).size(), 1u);
}

TEST(Wavelengths, AreCountedOrListed) {
    EXPECT_EQ(parseWavelengths("--wavelengths", "12").count, 12);
    EXPECT_TRUE(parseWavelengths("--wavelengths", "12").list.empty());
    EXPECT_EQ(parseWavelengths("--wavelengths", "486.1").list, std::vector<double>{486.1});
    EXPECT_EQ(parseWavelengths("--wavelengths", "486,656.3").list,
              (std::vector<double>{486, 656.3}));
    for (const char* wrong :
         {"", "0", "65", "2.5", "-8", "100", "656,486", "500,500", "a", "500,", "6000"})
        EXPECT_THROW(parseWavelengths("--wavelengths", wrong), UsageError) << wrong;
}
