// Wavelengths of light: how the index follows them, and what colour they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>

namespace eikonal::optics {

namespace {

using glm::dvec3;

constexpr double kSpacing = 5; // of the tables [nm]
constexpr size_t kRows = 71;   // 380 to 730 nm

/// x̄, ȳ, z̄ of CIE's standard observer of 1931 (CIE 15:2004, table T.4).
constexpr double kObserver[kRows][3] = {
    {0.001368, 0.000039, 0.006450}, {0.002236, 0.000064, 0.010550}, {0.004243, 0.000120, 0.020050},
    {0.007650, 0.000217, 0.036210}, {0.014310, 0.000396, 0.067850}, {0.023190, 0.000640, 0.110200},
    {0.043510, 0.001210, 0.207400}, {0.077630, 0.002180, 0.371300}, {0.134380, 0.004000, 0.645600},
    {0.214770, 0.007300, 1.039050}, {0.283900, 0.011600, 1.385600}, {0.328500, 0.016840, 1.622960},
    {0.348280, 0.023000, 1.747060}, {0.348060, 0.029800, 1.782600}, {0.336200, 0.038000, 1.772110},
    {0.318700, 0.048000, 1.744100}, {0.290800, 0.060000, 1.669200}, {0.251100, 0.073900, 1.528100},
    {0.195360, 0.090980, 1.287640}, {0.142100, 0.112600, 1.041900}, {0.095640, 0.139020, 0.812950},
    {0.057950, 0.169300, 0.616200}, {0.032010, 0.208020, 0.465180}, {0.014700, 0.258600, 0.353300},
    {0.004900, 0.323000, 0.272000}, {0.002400, 0.407300, 0.212300}, {0.009300, 0.503000, 0.158200},
    {0.029100, 0.608200, 0.111700}, {0.063270, 0.710000, 0.078250}, {0.109600, 0.793200, 0.057250},
    {0.165500, 0.862000, 0.042160}, {0.225750, 0.914850, 0.029840}, {0.290400, 0.954000, 0.020300},
    {0.359700, 0.980300, 0.013400}, {0.433450, 0.994950, 0.008750}, {0.512050, 1.000000, 0.005750},
    {0.594500, 0.995000, 0.003900}, {0.678400, 0.978600, 0.002750}, {0.762100, 0.952000, 0.002100},
    {0.842500, 0.915400, 0.001800}, {0.916300, 0.870000, 0.001650}, {0.978600, 0.816300, 0.001400},
    {1.026300, 0.757000, 0.001100}, {1.056700, 0.694900, 0.001000}, {1.062200, 0.631000, 0.000800},
    {1.045600, 0.566800, 0.000600}, {1.002600, 0.503000, 0.000340}, {0.938400, 0.441200, 0.000240},
    {0.854450, 0.381000, 0.000190}, {0.751400, 0.321000, 0.000100}, {0.642400, 0.265000, 0.000050},
    {0.541900, 0.217000, 0.000030}, {0.447900, 0.175000, 0.000020}, {0.360800, 0.138200, 0.000010},
    {0.283500, 0.107000, 0.000000}, {0.218700, 0.081600, 0.000000}, {0.164900, 0.061000, 0.000000},
    {0.121200, 0.044580, 0.000000}, {0.087400, 0.032000, 0.000000}, {0.063600, 0.023200, 0.000000},
    {0.046770, 0.017000, 0.000000}, {0.032900, 0.011920, 0.000000}, {0.022700, 0.008210, 0.000000},
    {0.015840, 0.005723, 0.000000}, {0.011359, 0.004102, 0.000000}, {0.008111, 0.002929, 0.000000},
    {0.005790, 0.002091, 0.000000}, {0.004109, 0.001484, 0.000000}, {0.002899, 0.001047, 0.000000},
    {0.002049, 0.000740, 0.000000}, {0.001440, 0.000520, 0.000000}};

/// Relative power of CIE's illuminant D65 (CIE 15:2004, table T.1).
constexpr double kD65[kRows] = {
    49.9755, 52.3118, 54.6482, 68.7015, 82.7549, 87.1204, 91.4860, 92.4589, 93.4318, 90.0570,
    86.6823, 95.7736, 104.865, 110.936, 117.008, 117.410, 117.812, 116.336, 114.861, 115.392,
    115.923, 112.367, 108.811, 109.082, 109.354, 108.578, 107.802, 106.296, 104.790, 106.239,
    107.689, 106.047, 104.405, 104.225, 104.046, 102.023, 100.000, 98.1671, 96.3342, 96.0611,
    95.7880, 92.2368, 88.6856, 89.3459, 90.0062, 89.8026, 89.5991, 88.6489, 87.6987, 85.4936,
    83.2886, 83.4939, 83.6992, 81.8630, 80.0268, 80.1207, 80.2146, 81.2462, 82.2778, 80.2810,
    78.2842, 74.0027, 69.7213, 70.6652, 71.6091, 72.9790, 74.3490, 67.9765, 61.6040, 65.7448,
    69.8856};

/// Linear Rec. 709 from XYZ (IEC 61966-2-1).
const glm::dmat3 kRec709FromXyz = glm::dmat3(3.2406, -0.9689, 0.0557,  //
                                             -1.5372, 1.8758, -0.2040, //
                                             -0.4986, 0.0415, 1.0570);

/// Densities at the tables' wavelengths, and their integrals up to them.
struct White {
    std::array<dvec3, kRows> density, upTo;

    White() {
        for (size_t i = 0; i < kRows; ++i)
            density[i] = kRec709FromXyz *
                         (kD65[i] * dvec3(kObserver[i][0], kObserver[i][1], kObserver[i][2]));
        upTo[0] = dvec3(0);
        for (size_t i = 1; i < kRows; ++i)
            upTo[i] = upTo[i - 1] + 0.5 * kSpacing * (density[i - 1] + density[i]);
        const dvec3 all = upTo.back();
        for (size_t i = 0; i < kRows; ++i) {
            density[i] /= all;
            upTo[i] /= all;
        }
    }
};

const White& white() {
    static const White kWhite;
    return kWhite;
}

/// Of the tables: the row before a wavelength within their range, and how far behind it that is.
struct Row {
    size_t before;
    double share;
};

Row rowOf(double nanometres) {
    const double at = (nanometres - kShortest) / kSpacing;
    const double before = std::clamp(std::floor(at), 0.0, static_cast<double>(kRows - 2));
    return {static_cast<size_t>(before), at - before};
}

} // namespace

double cauchyTerm(double nanometres) {
    const double micrometres = nanometres / 1000, reference = kReferenceWavelength / 1000;
    return 1 / (micrometres * micrometres) - 1 / (reference * reference);
}

dvec3 whiteDensity(double nanometres) {
    if (nanometres < kShortest || nanometres > kLongest) return dvec3(0);
    const Row row = rowOf(nanometres);
    const auto& density = white().density;
    return density[row.before] + row.share * (density[row.before + 1] - density[row.before]);
}

dvec3 whiteUpTo(double nanometres) {
    const double within = std::clamp(nanometres, kShortest, kLongest);
    const Row row = rowOf(within);
    const dvec3 from = white().density[row.before];
    return white().upTo[row.before] +
           0.5 * kSpacing * row.share * (from + whiteDensity(within));
}

} // namespace eikonal::optics
