// The refractive index of air and of other gases, by the laws that flow visualisation uses.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace eikonal::optics {

constexpr double kStandardPressure = 101325; ///< [Pa]

/// n − 1 of dry air with 450 ppm of CO₂ at so many K, Pa and nm in vacuum: Ciddor 1996, "Refractive
/// index of air: new equations for the visible and near infrared", Applied Optics 35:1566, eqs 1,
/// 2, 5 and 12, good to 5e-8 from −40 to 100 °C and 300 to 1690 nm. Above 100 °C the virial term of
/// its compressibility keeps its value there, which changes n − 1 by less than 5e-4 of itself: what
/// is left is the gas law.
double airRefractivity(double kelvin, double pascal, double nanometres);

/// K [m³/kg] of dry air in Gladstone and Dale's law (1863), n − 1 = K ρ: its refractivity over its
/// density, both Ciddor's, at 15 °C and standard pressure.
double gladstoneDaleOfAir(double nanometres);

} // namespace eikonal::optics
