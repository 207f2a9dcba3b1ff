// The lights of a scene, as people give them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/lights.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>
#include <vector>

namespace eikonal::scene {

const char* const kLightSpecs =
    "directional:DX,DY,DZ[:R,G,B[:DEG]], point:X,Y,Z[:R,G,B], "
    "spot:X,Y,Z:DX,DY,DZ:ANGLE[:SOFT][:R,G,B], rect:CX,CY,CZ:UX,UY,UZ:VX,VY,VZ[:R,G,B], "
    "sphere:X,Y,Z:RADIUS[:R,G,B] or environment:FILE, each as NAME=SPEC if wanted, and with "
    ":polarizer=X,Y,Z behind it, but of an environment";

namespace {

using glm::dvec3;
using Kind = Light::Kind;

constexpr double kPi = 3.14159265358979323846;

/// The parts of a spec behind its kind, read one after the other.
class Parts {
public:
    explicit Parts(std::string spec) : mSpec(std::move(spec)) {}

    UsageError bad(const std::string& why) const {
        return UsageError("--light: found '" + mSpec + "' (" + why + "), expected " + kLightSpecs);
    }
    void read(const std::string& text) { mParts = split(text, ':'); }
    /// The direction of a polariser, which may be the last part; 0 if it is not there.
    dvec3 takePolarizer() {
        const std::string key = "polarizer=";
        if (mParts.empty() || mParts.back().rfind(key, 0) != 0) return dvec3(0);
        mParts.back().erase(0, key.size());
        const size_t before = std::exchange(mNext, mParts.size() - 1);
        const dvec3 along = direction();
        mNext = before;
        mParts.pop_back();
        return along;
    }
    size_t left() const { return mParts.size() - mNext; }
    void expectEnd() const {
        if (left() > 0) throw bad("too many parts");
    }
    dvec3 vector() {
        const std::vector<double> numbers = next();
        if (numbers.size() != 3) throw bad("no three numbers");
        return {numbers[0], numbers[1], numbers[2]};
    }
    dvec3 direction() {
        const dvec3 given = vector();
        const double length = glm::length(given);
        if (!(length > 0) || !std::isfinite(length)) throw bad("the direction has no length");
        return given / length;
    }
    double number() {
        const std::vector<double> numbers = next();
        if (numbers.size() != 1) throw bad("not one number");
        return numbers[0];
    }
    /// Three numbers, or one of a grey light.
    dvec3 colour() {
        const std::vector<double> numbers = next();
        if (numbers.size() != 3 && numbers.size() != 1) throw bad("no three numbers");
        const size_t last = numbers.size() - 1;
        const dvec3 rgb(numbers[0], numbers[last / 2], numbers[last]);
        if (rgb.x < 0 || rgb.y < 0 || rgb.z < 0) throw bad("a colour below 0");
        return rgb;
    }
    /// Whether a single number comes next.
    bool numberIsNext() const {
        if (left() == 0) return false;
        const auto numbers = parseNumbers(mParts[mNext]);
        return numbers && numbers->size() == 1;
    }

private:
    std::vector<double> next() {
        if (left() == 0) throw bad("too few parts");
        const auto numbers = parseNumbers(mParts[mNext++]);
        if (!numbers) throw bad("no numbers");
        return *numbers;
    }
    std::string mSpec;
    std::vector<std::string> mParts;
    size_t mNext = 0;
};

void parseDirectional(Parts& parts, Light& light) {
    light.vector = parts.direction();
    if (parts.left() > 0) light.rgb = parts.colour();
    if (parts.left() > 0) light.angle = parts.number();
    if (!(light.angle >= 0 && light.angle <= 180)) throw parts.bad("a diameter beyond 0 to 180");
}

void parsePoint(Parts& parts, Light& light) {
    light.vector = parts.vector();
    if (parts.left() > 0) light.rgb = parts.colour();
}

void parseSpot(Parts& parts, Light& light) {
    light.vector = parts.vector();
    light.axis = parts.direction();
    light.angle = parts.number();
    if (parts.numberIsNext()) light.soft = parts.number();
    if (parts.left() > 0) light.rgb = parts.colour();
    if (!(light.angle > 0 && light.angle <= 180)) throw parts.bad("an angle beyond 0 to 180");
    if (!(light.soft >= 0 && light.soft <= light.angle && light.angle + light.soft <= 180))
        throw parts.bad("a soft edge beyond 0 or 180 degrees");
}

void parseRect(Parts& parts, Light& light) {
    light.vector = parts.vector();
    for (dvec3& edge : light.edges) edge = parts.vector();
    const double area = glm::length(glm::cross(light.edges[0], light.edges[1]));
    if (!(area > 0) || !std::isfinite(area)) throw parts.bad("its edges span no area");
    if (parts.left() > 0) light.rgb = parts.colour();
}

void parseSphere(Parts& parts, Light& light) {
    light.vector = parts.vector();
    light.radius = parts.number();
    if (!(light.radius > 0) || !std::isfinite(light.radius * light.radius))
        throw parts.bad("a radius that is not above 0");
    if (parts.left() > 0) light.rgb = parts.colour();
}

/// The share of a spot's intensity at so many degrees from its axis.
double spotShare(const Light& light, double degrees) {
    if (light.soft == 0) return degrees < light.angle ? 1 : 0;
    const double t = std::clamp((light.angle + light.soft - degrees) / (2 * light.soft), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// The solid angle that a spot of that intensity would fill evenly [sr].
double solidAngleOf(const Light& spot) {
    const double inner = spot.angle - spot.soft;
    double angle = 2 * kPi * (1 - std::cos(glm::radians(inner)));
    const int kPieces = 512; // where it fades, by midpoints
    const double piece = 2 * spot.soft / kPieces;
    for (int i = 0; i < kPieces; ++i) {
        const double at = inner + (i + 0.5) * piece;
        angle += 2 * kPi * spotShare(spot, at) * std::sin(glm::radians(at)) * glm::radians(piece);
    }
    return angle;
}

bool isName(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
}

} // namespace

bool Light::isExtended() const {
    return kind == Kind::rect || kind == Kind::sphere || kind == Kind::environment ||
           (kind == Kind::directional && angle > 0);
}

Light parseLight(const std::string& spec) {
    Parts parts(spec);
    Light light;
    light.spec = spec;
    std::string rest = spec;
    const size_t equals = spec.find('='), colon = spec.find(':');
    if (equals < colon && equals != std::string::npos) {
        light.name = spec.substr(0, equals);
        if (!isName(light.name)) throw parts.bad("a name of other signs than A-Z a-z 0-9 _ -");
        rest = spec.substr(equals + 1);
    }
    const std::string kind = rest.substr(0, rest.find(':'));
    const std::string values = kind.size() < rest.size() ? rest.substr(kind.size() + 1) : "";
    if (kind == "environment") {
        if (values.empty()) throw parts.bad("no file");
        if (values.find(":polarizer=") != std::string::npos)
            throw parts.bad("an environment has no polarizer");
        light.kind = Kind::environment;
        light.file = values;
        return light;
    }
    const struct {
        const char* name;
        Kind kind;
        void (*parse)(Parts&, Light&);
    } kinds[] = {{"directional", Kind::directional, parseDirectional},
                 {"point", Kind::point, parsePoint},
                 {"spot", Kind::spot, parseSpot},
                 {"rect", Kind::rect, parseRect},
                 {"sphere", Kind::sphere, parseSphere}};
    for (const auto& known : kinds) {
        if (kind != known.name) continue;
        if (values.empty()) throw parts.bad("wrong number of parts");
        parts.read(values);
        light.kind = known.kind;
        light.polarizer = parts.takePolarizer();
        known.parse(parts, light);
        parts.expectEnd();
        if (light.polarizer != dvec3(0)) light.rgb *= 0.5;
        return light;
    }
    throw UsageError("--light: found '" + spec + "' (no such kind of light as '" + kind +
                     "'), expected directional, point, spot, rect, sphere or environment and its "
                     "parts, which --help lists");
}

dvec3 powerOf(const Light& light) {
    switch (light.kind) {
    case Kind::point:
        return 4 * kPi * light.rgb;
    case Kind::spot:
        return solidAngleOf(light) * light.rgb;
    case Kind::rect:
        return kPi * glm::length(glm::cross(light.edges[0], light.edges[1])) * light.rgb;
    case Kind::sphere:
        return 4 * kPi * kPi * light.radius * light.radius * light.rgb;
    case Kind::directional:
    case Kind::environment:
        break;
    }
    throw InternalError("a light without a place has no power of its own");
}

} // namespace eikonal::scene
