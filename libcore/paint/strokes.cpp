// What is painted: parsed from options' texts.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint/strokes.h"

#include "base/error.h"
#include "base/text.h"
#include "volume/contract.h"

#include <algorithm>
#include <cmath>

namespace eikonal::paint {

namespace {

/// An option's text in parts, read one after the other.
class Parts {
public:
    Parts(std::string option, const std::string& text, std::string form, size_t least, size_t most)
        : mOption(std::move(option)), mText(text), mForm(std::move(form)),
          mParts(split(text, ':')) {
        if (mParts.size() < least || mParts.size() > most) fail(mForm);
    }

    bool atEnd() const { return mNext == mParts.size(); }
    std::string grid() {
        const std::string name = mParts[mNext++], base = name.substr(0, name.find('.'));
        const auto& known = paintable();
        if (std::find(known.begin(), known.end(), base) == known.end())
            fail("GRID one of " + join(known, ", ") + ", or one of these .NAME");
        return name;
    }
    double number(double least, double most, bool open, const std::string& wanted) {
        const auto value = parseNumber(mParts[mNext++]);
        if (!value || *value < least || *value > most || (open && *value == least)) fail(wanted);
        return *value;
    }
    int whole(double least, double most, const std::string& wanted) {
        const double value = number(least, most, false, wanted);
        if (value != std::floor(value)) fail(wanted);
        return static_cast<int>(value);
    }
    /// Three numbers, or one for all three where `grey`.
    glm::dvec3 vector(bool grey, const std::string& wanted) {
        const auto values = parseNumbers(mParts[mNext++]);
        if (!values || (values->size() != 3 && !(grey && values->size() == 1))) fail(wanted);
        return values->size() == 1 ? glm::dvec3((*values)[0])
                                   : glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
    }
    [[noreturn]] void fail(const std::string& wanted) const {
        throw UsageError(mOption + ": found '" + mText + "', expected " + wanted);
    }

private:
    std::string mOption, mText, mForm;
    std::vector<std::string> mParts;
    size_t mNext = 0;
};

constexpr double kMost = 1e30; // any number that a float holds with room to spare

} // namespace

const std::vector<std::string>& paintable() {
    static const std::vector<std::string> names = {"ior",        "dispersion", "absorption",
                                                   "scattering", "anisotropy", "emission",
                                                   "opacity",    "albedo",     "reflectance"};
    return names;
}

Noise parseNoise(const std::string& text) {
    Parts parts("--noise", text, "GRID:AMOUNT:SIZE[:OCTAVES[:SEED]]", 3, 5);
    Noise noise;
    noise.grid = parts.grid();
    noise.amount = parts.number(-kMost, kMost, false, "AMOUNT a number");
    noise.size = parts.number(0, kMost, true, "SIZE above 0");
    if (!parts.atEnd()) noise.octaves = parts.whole(1, 16, "OCTAVES from 1 to 16");
    if (!parts.atEnd())
        noise.seed = static_cast<std::uint32_t>(parts.whole(0, 2147483647, "SEED a whole number"));
    return noise;
}

Sphere parseSphere(const std::string& text) {
    Parts parts("--sphere", text, "GRID:X,Y,Z:RADIUS:VALUE[:SOFT]", 4, 5);
    Sphere sphere;
    sphere.grid = parts.grid();
    sphere.centre = parts.vector(false, "X,Y,Z three numbers");
    sphere.radius = parts.number(0, kMost, true, "RADIUS above 0");
    const bool scalar = volume::ruleFor(sphere.grid)->type == volume::GridType::scalar;
    sphere.value = parts.vector(true, "VALUE a number or R,G,B");
    if (scalar && sphere.value != glm::dvec3(sphere.value.x)) parts.fail("VALUE one number");
    if (!parts.atEnd()) sphere.soft = parts.number(0, 1, false, "SOFT from 0 to 1");
    return sphere;
}

} // namespace eikonal::paint
