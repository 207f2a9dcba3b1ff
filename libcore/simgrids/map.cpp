// How one grid of the contract is made of one grid of a simulation: parsed from an option's text.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simgrids/map.h"

#include "base/error.h"
#include "base/text.h"
#include "optics/air.h"
#include "optics/spectrum.h"
#include "volume/contract.h"

#include <optional>

namespace eikonal::simgrids {

namespace {

const char* const kGladstoneDale = "gladstone-dale";
const char* const kAir = "air";

std::string expectedOf(const std::string& to) {
    return to == "ior" ? "GRID:gladstone-dale[:K], GRID:air[:PRESSURE] or GRID:SCALE[:OFFSET]"
                       : "GRID:SCALE[:OFFSET]";
}

std::string vectorText(const glm::dvec3& v) {
    if (v.x == v.y && v.y == v.z) return toText(v.x);
    return toText(v.x) + "," + toText(v.y) + "," + toText(v.z);
}

/// Whether the contract wants three numbers a voxel.
bool wantsVector(const std::string& to) {
    return volume::ruleFor(to)->type == volume::GridType::vector;
}

class Parser {
public:
    Parser(const std::string& to, const std::string& text)
        : mTo(to), mText(text), mOption("--" + to + "-from"), mParts(split(text, ':')) {}

    Map map() const {
        Map map;
        map.to = mTo;
        if (mParts.size() < 2 || mParts.size() > 3 || mParts[0].empty()) fail(expectedOf(mTo));
        map.from = mParts[0];
        if (mTo == "ior" && mParts[1] == kGladstoneDale) {
            map.kind = Kind::gladstoneDale;
            map.constant =
                positive("K [m³/kg]", optics::gladstoneDaleOfAir(optics::kReferenceWavelength));
        } else if (mTo == "ior" && mParts[1] == kAir) {
            map.kind = Kind::air;
            map.pressure = positive("PRESSURE [Pa]", optics::kStandardPressure);
        } else {
            map.scale = vector(1);
            if (mParts.size() == 3) map.offset = vector(2);
            // A level set is told by its sign and its band: only its unit may change.
            if (mTo == "sdf" && (map.scale.x <= 0 || map.offset.x != 0))
                fail("GRID:SCALE with a SCALE above 0 and no OFFSET");
        }
        return map;
    }

private:
    [[noreturn]] void fail(const std::string& expected) const {
        throw UsageError(mOption + ": found '" + mText + "', expected " + expected);
    }
    double positive(const std::string& what, double absent) const {
        if (mParts.size() < 3) return absent;
        const std::optional<double> value = parseNumber(mParts[2]);
        if (!value || *value <= 0) fail("a " + what + " above 0 behind the law");
        return *value;
    }
    glm::dvec3 vector(size_t part) const {
        const auto values = parseNumbers(mParts[part]);
        if (!values || (values->size() != 1 && (values->size() != 3 || !wantsVector(mTo))))
            fail(expectedOf(mTo) + ", SCALE and OFFSET numbers" +
                 (wantsVector(mTo) ? " or R,G,B" : ""));
        const std::vector<double>& v = *values;
        return v.size() == 1 ? glm::dvec3(v[0]) : glm::dvec3(v[0], v[1], v[2]);
    }

    const std::string &mTo, &mText;
    std::string mOption;
    std::vector<std::string> mParts;
};

} // namespace

std::string Map::text() const {
    switch (kind) {
    case Kind::gladstoneDale:
        return "1 + " + toText(constant) + " x, x in kg/m³";
    case Kind::air:
        return "that of dry air at x K and " + toText(pressure) + " Pa";
    default:
        break;
    }
    const std::string shift = offset == glm::dvec3(0) ? "" : " + " + vectorText(offset);
    return vectorText(scale) + " x" + shift;
}

const std::vector<std::string>& targets() {
    static const std::vector<std::string> all = {
        "ior",      "dispersion", "absorption", "scattering",  "anisotropy",
        "emission", "opacity",    "albedo",     "reflectance", "sdf"};
    return all;
}

Map parseMap(const std::string& to, const std::string& text) {
    return Parser(to, text).map();
}

} // namespace eikonal::simgrids
