// Materials by name against what their sources publish: formulas, data sheets, tables.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/materials.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <sstream>

using namespace eikonal;
using optics::NamedMaterial;

namespace {

// Helium's d line, hydrogen's F and C [µm].
constexpr double kD = 0.5875618, kF = 0.4861327, kC = 0.6562725;

const NamedMaterial& named(const std::string& name) {
    const NamedMaterial* found = optics::findMaterial(name);
    if (found == nullptr) throw std::runtime_error("no " + name);
    return *found;
}

/// What the tracers make of it, at a wavelength [µm].
double indexOf(const NamedMaterial& m, double wavelength) {
    return m.ior + m.dispersion * (1 / (wavelength * wavelength) - 1 / (0.5876 * 0.5876));
}

using Formula = std::function<double(double)>; // of a wavelength [µm]
struct Term {
    double strength, at;
};

/// n² = 1 + Σ B λ² / (λ² − C), C in µm².
Formula sellmeier(const std::vector<Term>& terms) {
    return [terms](double wavelength) {
        const double square = wavelength * wavelength;
        double n2 = 1;
        for (const Term& term : terms) n2 += term.strength * square / (square - term.at);
        return std::sqrt(n2);
    };
}

/// The same with resonances at wavelengths in µm.
Formula sellmeierAt(std::vector<Term> terms) {
    for (Term& term : terms) term.at *= term.at;
    return sellmeier(terms);
}

/// n² = Σ a λ^p
Formula powers(const std::vector<Term>& terms) {
    return [terms](double wavelength) {
        double n2 = 0;
        for (const Term& term : terms) n2 += term.strength * std::pow(wavelength, term.at);
        return std::sqrt(n2);
    };
}

struct Published {
    std::string name;
    Formula index;
    double shortest;     ///< from where the formula holds, or 400 [nm]
    double largestError; ///< of Cauchy's law from there to 700 nm, as docs/materials.md has it
};

std::vector<Published> published() {
    return {
        {"bk7",
         sellmeier(
             {{1.03961212, 0.00600069867}, {0.231792344, 0.0200179144}, {1.01046945, 103.560653}}),
         400, 0.00013},
        {"sf10",
         sellmeier(
             {{1.61625977, 0.0127534559}, {0.259229334, 0.0581983954}, {1.07762317, 116.60768}}),
         400, 0.0050},
        {"f2",
         sellmeier(
             {{1.34533359, 0.00997743871}, {0.209073176, 0.0470450767}, {0.937357162, 111.886764}}),
         400, 0.0022},
        {"fused-silica",
         sellmeierAt({{0.6961663, 0.0684043}, {0.4079426, 0.1162414}, {0.8974794, 9.896161}}), 400,
         0.00022},
        {"water",
         sellmeier({{0.5684027565, 0.005101829712},
                    {0.1726177391, 0.01821153936},
                    {0.02086189578, 0.02620722293},
                    {0.1130748688, 10.69792721}}),
         400, 0.00035},
        {"ethanol",
         [](double wavelength) {
             return 1.35265 + 0.00306 / std::pow(wavelength, 2) + 0.00002 / std::pow(wavelength, 4);
         },
         477, 0.00003},
        {"acrylic",
         powers({{2.1778, 0},
                 {6.1209e-3, 2},
                 {-1.5004e-3, 4},
                 {2.3678e-2, -2},
                 {-4.2137e-3, -4},
                 {7.3417e-4, -6},
                 {-4.5042e-5, -8}}),
         420, 0.00038},
        {"diamond", sellmeierAt({{0.3306, 0.1750}, {4.3356, 0.1060}}), 400, 0.0017},
        {"calcite", sellmeier({{0.73358749, 0}, {0.96464345, 1.94325203e-2}, {1.82831454, 120}}),
         400, 0.00038},
        {"quartz", sellmeier({{0.28604141, 0}, {1.07044083, 1.00585997e-2}, {1.10202242, 100}}),
         400, 0.00027},
        {"rutile",
         [](double wavelength) {
             return std::sqrt(5.913 + 0.2441 / (wavelength * wavelength - 0.0803));
         },
         450, 0.0234},
        {"sapphire",
         sellmeierAt({{1.4313493, 0.0726631}, {0.65054713, 0.1193242}, {5.3414021, 18.028251}}),
         400, 0.00032},
    };
}

struct Sample {
    double wavelength, value; ///< [nm]
};

/// Between two samples along a straight line, beyond them the nearest.
double at(const std::vector<Sample>& samples, double wavelength) {
    for (size_t i = 1; i < samples.size(); ++i) {
        const Sample &a = samples[i - 1], &b = samples[i];
        if (wavelength <= b.wavelength)
            return a.value + (b.value - a.value) * std::max(0.0, wavelength - a.wavelength) /
                                 (b.wavelength - a.wavelength);
    }
    return samples.back().value;
}

/// From 400 to 700 nm in steps of 10.
std::vector<Sample> everyTen(const std::vector<double>& values) {
    std::vector<Sample> samples;
    for (size_t i = 0; i < values.size(); ++i)
        samples.push_back({400 + 10 * static_cast<double>(i), values[i]});
    return samples;
}

/// Absorption σ = 4πk/λ [1/m] by extinction coefficients k.
std::vector<Sample> absorptionBy(std::vector<Sample> extinctions) {
    for (Sample& sample : extinctions) sample.value *= 4 * M_PI / (sample.wavelength * 1e-9);
    return extinctions;
}

/// CIE 1931's x̄, ȳ, z̄ as Wyman, Sloan and Shirley fit them (J. Comput. Graph. Tech. 2(2), 2013).
glm::dvec3 matchingAt(double wavelength) {
    const auto lobe = [&](double height, double middle, double below, double above) {
        const double t = (wavelength - middle) * (wavelength < middle ? below : above);
        return height * std::exp(-t * t / 2);
    };
    return {lobe(1.056, 599.8, 0.0264, 0.0323) + lobe(0.362, 442.0, 0.0624, 0.0374) +
                lobe(-0.065, 501.1, 0.0490, 0.0382),
            lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
            lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725)};
}

/// How much of D65's light at a wavelength counts as red, green and blue of Rec. 709.
glm::dvec3 weightAt(double wavelength) {
    static const std::vector<Sample> kD65 = everyTen(
        {82.75,  91.49,  93.43,  86.68,  104.86, 117.01, 117.81, 114.86, 115.92, 108.81, 109.35,
         107.80, 104.79, 107.69, 104.41, 104.05, 100.00, 96.33,  95.79,  88.69,  90.01,  89.60,
         87.70,  83.29,  83.70,  80.03,  80.21,  82.28,  78.28,  69.72,  71.61});
    const glm::dvec3 xyz = at(kD65, wavelength) * matchingAt(wavelength);
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

/// The part of white light's red, green and blue that a medium takes a metre, at first.
glm::dvec3 takenFromWhite(const std::vector<Sample>& absorption) {
    glm::dvec3 taken(0), all(0);
    for (double wavelength = 400; wavelength <= 700; wavelength += 5) {
        const glm::dvec3 weight = weightAt(wavelength);
        taken += weight * at(absorption, wavelength);
        all += weight;
    }
    return taken / all;
}

/// Tables are held to two digits. Blue of which red is taken gains: no absorption can do that.
void expectAbsorbs(const std::string& name, const std::vector<Sample>& absorption) {
    const glm::dvec3 wanted = takenFromWhite(absorption), found = named(name).absorption;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], std::max(0.0, wanted[c]), 0.03 * std::abs(wanted[c]) + 1e-4)
            << name << ", channel " << c;
}

} // namespace

TEST(Materials, IndexAndDispersionAreThoseOfTheFormula) {
    for (const Published& source : published()) {
        const NamedMaterial& m = named(source.name);
        // Five decimals, as glass catalogues have them.
        EXPECT_NEAR(m.ior, source.index(kD), 1e-5) << source.name;
        EXPECT_NEAR(indexOf(m, kF) - indexOf(m, kC), source.index(kF) - source.index(kC), 1e-5)
            << source.name;
    }
}

TEST(Materials, ExtraordinaryIndicesAreThoseOfTheFormula) {
    const std::vector<std::pair<std::string, Formula>> formulas{
        {"calcite", sellmeier({{0.35859695, 0}, {0.82427830, 1.06689543e-2}, {0.14429128, 120}})},
        {"quartz", sellmeier({{0.28851804, 0}, {1.09509924, 1.02101864e-2}, {1.15662475, 100}})},
        {"rutile", [](double l) { return std::sqrt(7.197 + 0.3322 / (l * l - 0.0843)); }},
        {"sapphire",
         sellmeierAt({{1.5039759, 0.0740288}, {0.55069141, 0.1216529}, {6.5927379, 20.072248}})}};
    for (const auto& [name, index] : formulas) {
        NamedMaterial m = named(name);
        ASSERT_TRUE(m.extraordinary) << name;
        m.ior = m.extraordinary->ior;
        m.dispersion = m.extraordinary->dispersion;
        EXPECT_NEAR(m.ior, index(kD), 1e-5) << name;
        EXPECT_NEAR(indexOf(m, kF) - indexOf(m, kC), index(kF) - index(kC), 1e-5) << name;
    }
    // By tables alone: Dorsey's differences of ice, gemmology's of tourmaline.
    EXPECT_NEAR(named("ice").extraordinary->ior - named("ice").ior, 0.0014, 1e-6);
    EXPECT_NEAR(named("tourmaline").ior - named("tourmaline").extraordinary->ior, 0.020, 1e-6);
    const double betweenBAndG = 1 / (0.4308 * 0.4308) - 1 / (0.6867 * 0.6867);
    EXPECT_NEAR(named("tourmaline").dispersion * betweenBAndG, 0.017, 1e-5);
}

TEST(Materials, CauchysLawIsOffByNoMoreThanIsSaid) {
    for (const Published& source : published()) {
        double error = 0;
        for (double nm = source.shortest; nm <= 700; ++nm)
            error = std::max(
                error, std::abs(indexOf(named(source.name), nm / 1000) - source.index(nm / 1000)));
        EXPECT_LE(error, source.largestError) << source.name;
        EXPECT_GE(error, 0.9 * source.largestError) << source.name << ": less than is said";
    }
}

TEST(Materials, AbbeNumbersAreThePublishedOnes) {
    const std::vector<std::pair<std::string, double>> published{
        {"bk7", 64.17},          // SCHOTT
        {"sf10", 28.41},         // SCHOTT
        {"f2", 36.37},           // SCHOTT
        {"fused-silica", 67.82}, // Malitson 1965
        {"polycarbonate", 29.1}, // Sultanova et al. 2009
    };
    for (const auto& [name, abbe] : published)
        // Half a unit of the coarsest's last digit.
        EXPECT_NEAR(optics::abbeOf(named(name).ior, named(name).dispersion), abbe, 0.05) << name;
    EXPECT_EQ(named("polycarbonate").ior, 1.585);
}

// Warren and Brandt's table has four decimals.
TEST(Materials, IceFollowsItsTable) {
    const std::vector<Sample> table = everyTen(
        {1.3194, 1.3185, 1.3177, 1.3170, 1.3163, 1.3157, 1.3151, 1.3145, 1.3140, 1.3135, 1.3130,
         1.3126, 1.3121, 1.3117, 1.3114, 1.3110, 1.3106, 1.3103, 1.3100, 1.3097, 1.3094, 1.3091,
         1.3088, 1.3085, 1.3083, 1.3080, 1.3078, 1.3076, 1.3073, 1.3071, 1.3069});
    const NamedMaterial& ice = named("ice");
    EXPECT_NEAR(ice.ior, at(table, 1000 * kD), 0.5e-4);
    EXPECT_NEAR(indexOf(ice, kF) - indexOf(ice, kC), at(table, 1000 * kF) - at(table, 1000 * kC),
                1e-4); // half a digit twice
    for (const Sample& row : table)
        EXPECT_NEAR(indexOf(ice, row.wavelength / 1000), row.value, 0.00055) << row.wavelength;
}

// Measured to ±0.001: Sultanova et al. 2009.
TEST(Materials, PolycarbonateFollowsWhatWasMeasured) {
    for (const Sample& row : std::vector<Sample>{
             {436.8, 1.612}, {486.1, 1.599}, {587.6, 1.585}, {632.8, 1.580}, {703, 1.575}})
        EXPECT_NEAR(indexOf(named("polycarbonate"), row.wavelength / 1000), row.value, 0.0024)
            << row.wavelength;
}

// Gemmology tells dispersion between the sun's lines B and G (Schumann): 0.039, to three decimals,
// of which Cauchy's law leaves out what rises towards the blue.
TEST(Materials, ZirconHasItsFire) {
    const NamedMaterial& zircon = named("zircon");
    EXPECT_NEAR(indexOf(zircon, kF) - indexOf(zircon, kC), 0.022, 1e-5);
    EXPECT_NEAR(indexOf(zircon, 0.4308) - indexOf(zircon, 0.6867), 0.039, 0.0015);
}

// The weights themselves: D65 is white.
TEST(Materials, WhiteIsWhite) {
    glm::dvec3 white(0);
    for (double wavelength = 380; wavelength <= 780; wavelength += 5) white += weightAt(wavelength);
    // Wyman's fit is good to about a percent.
    EXPECT_NEAR(white.x / white.y, 1, 0.01);
    EXPECT_NEAR(white.z / white.y, 1, 0.01);
}

TEST(Materials, WaterAndIceAbsorbAsMeasured) {
    // Pope and Fry 1997 [1/m]
    expectAbsorbs("water",
                  everyTen({0.00663, 0.00473, 0.00454, 0.00495, 0.00635, 0.00922, 0.00979, 0.0106,
                            0.0127,  0.0150,  0.0204,  0.0325,  0.0409,  0.0434,  0.0474,  0.0565,
                            0.0619,  0.0695,  0.0896,  0.1351,  0.2224,  0.2644,  0.2755,  0.2916,
                            0.3108,  0.340,   0.410,   0.439,   0.465,   0.516,   0.624}));
    // Warren and Brandt 2008: k
    expectAbsorbs(
        "ice",
        absorptionBy(everyTen(
            {2.365e-11, 2.669e-11, 3.135e-11, 4.140e-11, 6.268e-11, 9.239e-11, 1.325e-10, 1.956e-10,
             2.861e-10, 4.172e-10, 5.889e-10, 8.036e-10, 1.076e-9,  1.409e-9,  1.813e-9,  2.289e-9,
             2.839e-9,  3.461e-9,  4.159e-9,  4.930e-9,  5.730e-9,  6.890e-9,  8.580e-9,  1.040e-8,
             1.220e-8,  1.430e-8,  1.660e-8,  1.890e-8,  2.090e-8,  2.400e-8,  2.900e-8})));
}

// SCHOTT's catalogue of 2017: internal transmittances of 10 and 25 mm, as k.
TEST(Materials, GlassAbsorbsAsItsDataSheetSays) {
    expectAbsorbs("bk7", absorptionBy({{400, 1.0227e-8},
                                       {405, 9.0558e-9},
                                       {420, 9.3912e-9},
                                       {436, 1.1147e-8},
                                       {460, 1.0286e-8},
                                       {500, 9.5781e-9},
                                       {546, 6.9658e-9},
                                       {580, 9.2541e-9},
                                       {620, 1.1877e-8},
                                       {660, 1.2643e-8},
                                       {700, 8.9305e-9}}));
    expectAbsorbs("f2", absorptionBy({{400, 1.9243e-8},
                                      {405, 1.6869e-8},
                                      {420, 1.2087e-8},
                                      {436, 9.7490e-9},
                                      {460, 8.8118e-9},
                                      {500, 4.7818e-9},
                                      {546, 3.4794e-9},
                                      {580, 3.6961e-9},
                                      {620, 3.9510e-9},
                                      {660, 6.3120e-9},
                                      {700, 4.4608e-9}}));
    expectAbsorbs("sf10", absorptionBy({{400, 4.7245e-7},
                                        {405, 3.0388e-7},
                                        {420, 1.1147e-7},
                                        {436, 5.5209e-8},
                                        {460, 3.2573e-8},
                                        {500, 1.7604e-8},
                                        {546, 8.7117e-9},
                                        {580, 9.2541e-9},
                                        {620, 1.3863e-8},
                                        {660, 1.4758e-8},
                                        {700, 1.1169e-8}}));
}

TEST(Materials, AbbeNumberAndCauchysB) {
    // (1.5 − 1) / 50 between F and C, by the definition.
    const NamedMaterial flat{"", 1.5, optics::dispersionOf(1.5, 50)};
    EXPECT_NEAR(indexOf(flat, kF) - indexOf(flat, kC), 0.01, 1e-6); // lines to five digits
    EXPECT_NEAR(optics::abbeOf(1.5, flat.dispersion), 50, 1e-9);
    EXPECT_EQ(optics::dispersionOf(1.5, 0), 0);
    EXPECT_TRUE(std::isinf(optics::abbeOf(1.5, 0)));
}

TEST(Materials, NamesAreFoundHoweverTheyAreWritten) {
    for (const std::string name : {"fused-silica", "Fused_Silica", "FUSED-SILICA"})
        EXPECT_EQ(named(name).name, "fused-silica");
    for (const std::string name : {"N-BK7", "n_bk7", "BK7"}) EXPECT_EQ(named(name).name, "bk7");
    for (const std::string name : {"", "glass", "bk", "bk77", "n-sf10", "fused silica", "none"})
        EXPECT_EQ(optics::findMaterial(name), nullptr) << name;
    const std::vector<std::string> names = optics::materialNames();
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    for (const std::string& name : names) EXPECT_EQ(named(name).name, name);
}

/// The table of docs/materials.md has every material's numbers.
TEST(Materials, TheirPageHasTheSameNumbers) {
    std::ifstream file(EIKONAL_SOURCE_DIR "/docs/materials.md");
    std::stringstream page;
    page << file.rdbuf();
    for (const NamedMaterial& m : optics::namedMaterials()) {
        const double abbe = std::round(100 * optics::abbeOf(m.ior, m.dispersion)) / 100;
        const std::string row = "| `" + m.name + "` | " + toText(m.ior) + " | " +
                                (std::isinf(abbe) ? "-" : toText(abbe)) + " | " +
                                toText(m.dispersion) + " |";
        EXPECT_NE(page.str().find(row), std::string::npos) << "no line with: " << row;
        if (m.absorption == glm::dvec3(0)) continue;
        const std::string absorption = "| `" + m.name + "` | " + toText(m.absorption.x) + " | " +
                                       toText(m.absorption.y) + " | " + toText(m.absorption.z) +
                                       " |";
        EXPECT_NE(page.str().find(absorption), std::string::npos) << "no line: " << absorption;
    }
}
