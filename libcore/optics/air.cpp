// The refractive index of air and of other gases, by the laws that flow visualisation uses.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/air.h"

#include <algorithm>

namespace eikonal::optics {

namespace {

constexpr double kZeroCelsius = 273.15;    // [K]
constexpr double kStandardKelvin = 288.15; // Ciddor's standard air is at 15 °C
constexpr double kMolarMass =
    28.9635e-3 + 6.01e-7;                 // of air with 450 ppm of CO₂ [kg/mol], below eq. 4
constexpr double kGasConstant = 8.314510; // [J/(mol K)], the value that Ciddor used
constexpr double kColdest = -40, kHottest = 100; // where the virial term is known [°C]

/// Of dry air (eq. 12): p V = Z n R T.
double compressibility(double kelvin, double pascal) {
    const double t = std::clamp(kelvin - kZeroCelsius, kColdest, kHottest);
    const double ratio = pascal / kelvin; // [Pa/K]
    return 1 - ratio * (1.58123e-6 - 2.9331e-8 * t + 1.1043e-10 * t * t) + ratio * ratio * 1.83e-11;
}

/// n − 1 of dry air at 15 °C and standard pressure (eq. 1).
double standardRefractivity(double nanometres) {
    const double square = 1e6 / (nanometres * nanometres); // of the wave number [1/µm²]
    return 1e-8 * (5792105 / (238.0185 - square) + 167917 / (57.362 - square));
}

} // namespace

double airRefractivity(double kelvin, double pascal, double nanometres) {
    const double standard = compressibility(kStandardKelvin, kStandardPressure);
    const double density = pascal / kStandardPressure * kStandardKelvin / kelvin * standard /
                           compressibility(kelvin, pascal); // of the standard one
    return density * standardRefractivity(nanometres);
}

double gladstoneDaleOfAir(double nanometres) {
    const double density = kStandardPressure * kMolarMass /
                           (compressibility(kStandardKelvin, kStandardPressure) * kGasConstant *
                            kStandardKelvin); // [kg/m³]
    return standardRefractivity(nanometres) / density;
}

} // namespace eikonal::optics
