// Materials by name: how they bend and disperse light, and what they absorb of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/materials.h"

#include <algorithm>
#include <limits>

namespace eikonal::optics {

namespace {

// Fraunhofer's F and C, lines of hydrogen [µm].
constexpr double kF = 0.48613, kC = 0.65627;
constexpr double kBetweenFAndC = 1 / (kF * kF) - 1 / (kC * kC); // [1/µm²]

std::string plain(std::string name) {
    for (char& c : name) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        if (c == '_') c = '-';
    }
    return name;
}

} // namespace

const std::vector<NamedMaterial>& namedMaterials() {
    // Numbers come from the published formula or table that the comment names, at 20 °C where it
    // says nothing else: tests/optics/materials_test.cpp has these, and works the numbers out.
    static const std::vector<NamedMaterial> kMaterials{
        // Beadie et al., Appl. Opt. 54, F139 (2015): poly(methyl methacrylate).
        {"acrylic", 1.49253, 0.0043445},
        // What the others were measured against: theirs are indices relative to it.
        {"air", 1, 0},
        // SCHOTT optical glass, data sheet N-BK7.
        {"bk7", 1.51680, 0.0042175, {0.23, 0.18, 0.30}},
        // Ghosh, Opt. Commun. 163, 95 (1999).
        {"calcite", 1.65846, 0.0069081, {}, {{1.48618, 0.0032160}}},
        // Peter, Z. Phys. 15, 358 (1923).
        {"diamond", 2.41749, 0.0134227},
        // Rheims, Köser and Wriedt, Meas. Sci. Technol. 8, 601 (1997).
        {"ethanol", 1.36168, 0.0031911},
        // SCHOTT optical glass, data sheet F2.
        {"f2", 1.62004, 0.0089283, {0.086, 0.079, 0.27}},
        // Malitson, J. Opt. Soc. Am. 55, 1205 (1965).
        {"fused-silica", 1.45846, 0.0035399},
        // Warren and Brandt, J. Geophys. Res. 113, D14220 (2008), at -7 °C, free of bubbles; n_e −
        // n_o
        // of 0.0014 from C to F as Dorsey, Properties of Ordinary Water-Substance (1940), has it.
        {"ice", 1.30974, 0.003043, {0.20, 0.043, 0}, {{1.31114, 0.003043}}},
        // Sultanova, Kasarova and Nikolov, Acta Phys. Pol. A 116, 585 (2009): n_d and V_d.
        {"polycarbonate", 1.585, 0.010527},
        // Ghosh, as calcite.
        {"quartz", 1.54428, 0.0040899, {}, {{1.55338, 0.0042301}}},
        // DeVore, J. Opt. Soc. Am. 41, 416 (1951).
        {"rutile", 2.61427, 0.0856600, {}, {{2.91035, 0.1084811}}},
        // Malitson and Dodge, J. Opt. Soc. Am. 62, 1405 (1972).
        {"sapphire", 1.76817, 0.0055631, {}, {{1.76010, 0.0054534}}},
        // SCHOTT optical glass, data sheet SF10.
        {"sf10", 1.72825, 0.0134233, {0.33, 0.15, 1.6}},
        // Gemmology's tables: 1.624 to 1.644, 0.017 between the lines B and G (Schumann, Gemstones
        // of the World); of both rays.
        {"tourmaline", 1.644, 0.0052018, {}, {{1.624, 0.0052018}}},
        // Daimon and Masumura, Appl. Opt. 46, 3811 (2007); Pope and Fry, Appl. Opt. 36, 8710
        // (1997).
        {"water", 1.33340, 0.0031311, {0.30, 0.047, 0}},
        // Anthony et al., Handbook of Mineralogy: ω; Schumann, Gemstones of the World: n_F − n_C.
        {"zircon", 1.925, 0.01152},
    };
    return kMaterials;
}

std::vector<std::string> materialNames() {
    std::vector<std::string> names;
    for (const NamedMaterial& material : namedMaterials()) names.push_back(material.name);
    return names;
}

const NamedMaterial* findMaterial(const std::string& name) {
    std::string wanted = plain(name);
    if (wanted == "n-bk7") wanted = "bk7"; // as SCHOTT calls what is melted today
    const std::vector<NamedMaterial>& all = namedMaterials();
    const auto found = std::find_if(all.begin(), all.end(), [&](const NamedMaterial& material) {
        return material.name == wanted;
    });
    return found == all.end() ? nullptr : &*found;
}

const std::vector<NamedMetal>& namedMetals() {
    // At 611.4, 549.1 and 464.2 nm, where the lines from D65 through Rec. 709's primaries leave the
    // spectrum, between the nearest of the published wavelengths; at room temperature.
    static const std::vector<NamedMetal> kMetals{
        // McPeak et al., ACS Photonics 2, 326 (2015): smooth films.
        {"aluminium", {1.045, 0.786, 0.526}, {6.481, 5.842, 4.934}},
        // Johnson and Christy, Phys. Rev. B 6, 4370 (1972).
        {"copper", {0.362, 1.015, 1.247}, {3.127, 2.579, 2.453}},
        {"gold", {0.222, 0.428, 1.335}, {3.208, 2.461, 1.872}},
        // Johnson and Christy, Phys. Rev. B 9, 5056 (1974).
        {"iron", {2.890, 2.950, 2.643}, {3.040, 2.930, 2.803}},
        // As copper.
        {"silver", {0.058, 0.060, 0.047}, {4.106, 3.590, 2.795}},
    };
    return kMetals;
}

std::vector<std::string> metalNames() {
    std::vector<std::string> names;
    for (const NamedMetal& metal : namedMetals()) names.push_back(metal.name);
    return names;
}

const NamedMetal* findMetal(const std::string& name) {
    std::string wanted = plain(name);
    if (wanted == "aluminum") wanted = "aluminium";
    const std::vector<NamedMetal>& all = namedMetals();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const NamedMetal& metal) { return metal.name == wanted; });
    return found == all.end() ? nullptr : &*found;
}

double dispersionOf(double ior, double abbe) {
    return abbe == 0 ? 0 : (ior - 1) / (abbe * kBetweenFAndC);
}

double abbeOf(double ior, double dispersion) {
    if (dispersion == 0) return std::numeric_limits<double>::infinity();
    return (ior - 1) / (dispersion * kBetweenFAndC);
}

} // namespace eikonal::optics
