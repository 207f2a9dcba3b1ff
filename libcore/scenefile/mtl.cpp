// Materials of an OBJ file: its .mtl.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenefile/mtl.h"

#include "base/error.h"
#include "base/text.h"
#include "scenefile/appearance.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

namespace eikonal::scenefile {

namespace {

/// A material's lines, by keyword.
using Lines = std::map<std::string, std::vector<double>>;

// A line whose value is this says nothing.
const std::map<std::string, double> kIdle{{"Ps", 0}, {"Pc", 0}, {"aniso", 0}, {"anisor", 0}};

bool isTaken(const std::string& keyword) {
    static const std::array<std::string, 9> kTaken{"Ni", "Tf", "Kd", "Ke",   "Pr",
                                                   "Pm", "d",  "Tr", "illum"};
    return std::find(kTaken.begin(), kTaken.end(), keyword) != kTaken.end();
}

double oneOf(const Lines& lines, const std::string& keyword, double fallback) {
    const auto found = lines.find(keyword);
    return found == lines.end() ? fallback : found->second[0];
}

glm::dvec3 threeOf(const Lines& lines, const std::string& keyword, double fallback) {
    const auto found = lines.find(keyword);
    if (found == lines.end()) return glm::dvec3(fallback);
    const std::vector<double>& n = found->second; // one of them is grey
    return n.size() < 3 ? glm::dvec3(n[0]) : glm::dvec3(n[0], n[1], n[2]);
}

bool letsThrough(const Lines& lines) {
    const double illum = oneOf(lines, "illum", 2);
    const bool byBlender = lines.contains("Tf") && (lines.contains("Pr") || lines.contains("Pm"));
    return oneOf(lines, "d", 1) < 1 || oneOf(lines, "Tr", 0) > 0 || illum == 4 || illum == 6 ||
           illum == 7 || illum == 9 || threeOf(lines, "Tf", 1) != glm::dvec3(1) || byBlender;
}

Material materialOf(const std::string& name, const Lines& lines, Materials& found) {
    Material material;
    material.name = name;
    material.colour = threeOf(lines, "Kd", 0.8);
    material.ior = oneOf(lines, "Ni", 1.5);
    material.roughness = alphaOf(oneOf(lines, "Pr", 0));
    if (oneOf(lines, "Pm", 0) >= 0.5) {
        material.kind = Material::Kind::metal;
    } else if (letsThrough(lines)) {
        material.kind = Material::Kind::glass;
        material.colour = threeOf(lines, "Tf", 1);
    } else if (!lines.contains("Pr")) {
        material.ior = 1; // no word of a coat
    }
    const glm::dvec3 glow = threeOf(lines, "Ke", 0);
    if (!takeGlow(material, glow) && glow != glm::dvec3(0)) {
        const std::string weak = "Ke that is weaker than Kd";
        if (std::find(found.unknown.begin(), found.unknown.end(), weak) == found.unknown.end())
            found.unknown.push_back(weak);
    }
    return material;
}

/// Of which a line's numbers must be.
std::pair<double, double> rangeOf(const std::string& keyword) {
    if (keyword == "Ni") return {1e-3, 100};
    if (keyword == "Ke" || keyword == "illum") return {0, 1e9};
    return {0, 1};
}

} // namespace

Materials readMtl(const std::string& path, std::string_view bytes) {
    Materials found;
    std::vector<std::pair<std::string, Lines>> all;
    std::istringstream text{std::string(withoutByteOrderMark(bytes))};
    size_t number = 0;
    for (std::string line; std::getline(text, line);) {
        ++number;
        std::istringstream words(line.substr(0, line.find('#')));
        std::string keyword;
        if (!(words >> keyword)) continue;
        const auto fail = [&](const std::string& fault) {
            throw DataError(path + ":" + std::to_string(number) + ": " + fault);
        };
        if (keyword == "newmtl") {
            std::string name, word;
            while (words >> word) name += (name.empty() ? "" : " ") + word;
            all.push_back({name, {}});
            continue;
        }
        std::vector<double> numbers;
        std::string word;
        const bool taken = isTaken(keyword);
        while (words >> word) {
            const auto value = parseNumber(word);
            if (!value && taken && numbers.empty())
                fail("found '" + word.substr(0, 40) + "' behind " + keyword +
                     ", expected a number");
            if (!value) break;
            numbers.push_back(*value);
        }
        const auto idle = kIdle.find(keyword);
        if (!taken && (idle == kIdle.end() || numbers.empty() || numbers[0] != idle->second) &&
            keyword != "Pcr" && // of a coat that Pc makes
            std::find(found.unknown.begin(), found.unknown.end(), keyword) == found.unknown.end())
            found.unknown.push_back(keyword.substr(0, 40));
        if (!taken) continue;
        if (numbers.empty()) fail("found nothing behind " + keyword + ", expected a number");
        const auto [low, high] = rangeOf(keyword);
        for (const double value : numbers)
            if (!(value >= low && value <= high))
                fail("found " + toText(value) + " behind " + keyword + ", expected " + toText(low) +
                     " to " + toText(high));
        if (all.empty()) fail("found " + keyword + " before the first newmtl");
        all.back().second[keyword] = numbers;
    }
    for (const auto& [name, lines] : all) found.materials.push_back(materialOf(name, lines, found));
    return found;
}

} // namespace eikonal::scenefile
