// Where rays meet planes, cones, balls and tori around the y axis, and where Snell's law sends
// them. SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/revolved.h"

#include "judge/boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <istream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

namespace judge {

namespace {

constexpr double kPi = std::numbers::pi;

dvec2 unit(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

/// (distance from the axis, y).
dvec2 profiled(const dvec3& x) {
    return {std::hypot(x.x, x.z), x.y};
}

double slopeOf(const double* coefficients, int degree, double s) {
    double sum = 0;
    for (int k = degree; k > 0; --k) sum = sum * s + k * coefficients[k];
    return sum;
}

double valueOf(const double* coefficients, int degree, double s) {
    double sum = 0;
    for (int k = degree; k >= 0; --k) sum = sum * s + coefficients[k];
    return sum;
}

/// Zeros of a polynomial in [low, high], each enclosed between two zeros of its derivative.
std::vector<double> zerosOf(const std::vector<double>& coefficients, double low, double high) {
    const int degree = static_cast<int>(coefficients.size()) - 1;
    std::vector<double> ends{low};
    if (degree > 1) {
        std::vector<double> derivative;
        for (int k = 1; k <= degree; ++k) derivative.push_back(k * coefficients[k]);
        for (const double zero : zerosOf(derivative, low, high)) ends.push_back(zero);
    }
    ends.push_back(high);
    std::vector<double> zeros;
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
        double a = ends[i], b = ends[i + 1];
        const bool rises = valueOf(coefficients.data(), degree, a) < 0;
        if (rises == (valueOf(coefficients.data(), degree, b) < 0)) continue;
        // Newton's step where it stays between, else the middle.
        double s = 0.5 * (a + b);
        for (int k = 0; k < 200 && a < b; ++k) {
            const double value = valueOf(coefficients.data(), degree, s);
            ((value < 0) == rises ? a : b) = s;
            double next = s - value / slopeOf(coefficients.data(), degree, s);
            if (!(next > a && next < b)) next = 0.5 * (a + b);
            if (next == s) break;
            s = next;
        }
        zeros.push_back(s);
    }
    return zeros;
}

/// Zeros of a t² + 2 b t + c.
void quadratic(double a, double b, double c, std::vector<double>& zeros) {
    if (a == 0) {
        if (b != 0) zeros.push_back(-0.5 * c / b);
        return;
    }
    const double under = b * b - a * c;
    if (!(under > 0)) return;
    const double q = -(b + std::copysign(std::sqrt(under), b));
    zeros.push_back(q / a);
    if (q != 0) zeros.push_back(c / q);
}

/// Candidates on the whole plane, cylinder or cone.
void meetLine(const ProfilePiece& piece, const dvec3& x, const dvec3& d, std::vector<double>& t) {
    const dvec2 normal = piece.outward(piece.from);
    if (normal.x == 0) {
        if (d.y != 0) t.push_back((piece.from.y - x.y) / d.y);
        return;
    }
    // Distance from the axis = a + b y.
    const double b = -normal.y / normal.x;
    const double a = glm::dot(normal, piece.from) / normal.x + b * x.y;
    quadratic(d.x * d.x + d.z * d.z - b * b * d.y * d.y, x.x * d.x + x.z * d.z - a * b * d.y,
              x.x * x.x + x.z * x.z - a * a, t);
}

/// Candidates on the whole ball or torus.
void meetArc(const ProfilePiece& piece, const dvec3& x, const dvec3& d, std::vector<double>& t) {
    // From the place nearest to the middle, and over the reach, so that no power grows large.
    const dvec3 middle(0, piece.centre.y, 0);
    const double nearest = glm::dot(middle - x, d), reach = piece.centre.x + piece.radius;
    const dvec3 m = (x + nearest * d - middle) / reach;
    const double mm = glm::dot(m, m), ring = piece.centre.x / reach, r = piece.radius / reach;
    if (mm > 1) return;
    if (piece.centre.x == 0) {
        const double half = std::sqrt(1 - mm) * reach;
        t.push_back(nearest - half), t.push_back(nearest + half);
        return;
    }
    // (|p|² + ring² − r²)² = 4 ring² (|p|² − p.y²), p = m + s d, m ⊥ d.
    const double a = mm + ring * ring - r * r, four = 4 * ring * ring;
    const std::vector<double> quartic{a * a - four * (mm - m.y * m.y), 2 * four * m.y * d.y,
                                      2 * a - four * (1 - d.y * d.y), 0, 1};
    for (double s : zerosOf(quartic, -1.001, 1.001)) {
        s = nearest + s * reach;
        for (int k = 0; k < 4; ++k) { // the quartic's zeros have lost digits where two are near
            const dvec3 p = x + s * d;
            const dvec2 at = profiled(p), off = at - piece.centre;
            const double rate =
                (off.x * (p.x * d.x + p.z * d.z) / at.x + off.y * d.y) / glm::length(off);
            const double step = (glm::length(off) - piece.radius) / rate;
            if (!(std::abs(step) < 1e-3 * reach)) break;
            s -= step;
        }
        t.push_back(s);
    }
}

} // namespace

dvec2 ProfilePiece::at(double share) const {
    if (!curved) return from + share * (to - from);
    return centre + radius * unit(fromAngle + share * (toAngle - fromAngle));
}

dvec2 ProfilePiece::outward(const dvec2& point) const {
    if (curved) return (toAngle > fromAngle ? 1.0 : -1.0) * glm::normalize(point - centre);
    const dvec2 along = glm::normalize(to - from);
    return {along.y, -along.x};
}

double ProfilePiece::distance(const dvec2& point) const {
    if (!curved) return glm::dot(outward(from), point - from);
    return (toAngle > fromAngle ? 1.0 : -1.0) * (glm::length(point - centre) - radius);
}

bool ProfilePiece::reaches(const dvec2& point) const {
    if (!curved) {
        const dvec2 way = to - from;
        const double along = glm::dot(point - from, way) / glm::length(way);
        return along > -kTouching && along < glm::length(way) + kTouching;
    }
    const dvec2 off = point - centre;
    const double middle = 0.5 * (fromAngle + toAngle), half = 0.5 * std::abs(toAngle - fromAngle);
    const double angle = std::remainder(std::atan2(off.y, off.x) - middle, 2 * kPi);
    return std::abs(angle) * radius < half * radius + kTouching;
}

Revolved readProfile(std::istream& in, double index) {
    Revolved solid{{}, index};
    const auto fail = [&](const std::string& why) {
        throw std::invalid_argument("profile, piece " + std::to_string(solid.pieces.size() + 1) +
                                    ": " + why);
    };
    std::string row;
    while (std::getline(in, row)) {
        std::istringstream words(row);
        std::string kind;
        ProfilePiece piece;
        words >> kind;
        piece.curved = kind == "arc";
        if (piece.curved) {
            words >> piece.centre.x >> piece.centre.y >> piece.radius >> piece.fromAngle >>
                piece.toAngle;
            piece.from = piece.at(0), piece.to = piece.at(1);
        } else if (kind == "line") {
            words >> piece.from.x >> piece.from.y >> piece.to.x >> piece.to.y;
        }
        if (!words || (!piece.curved && kind != "line")) fail("found '" + row + "'");
        if (!solid.pieces.empty()) {
            const ProfilePiece& last = solid.pieces.back();
            if (glm::length(last.to - piece.from) > 1e-9) fail("begins elsewhere");
            if (glm::length(last.outward(last.to) - piece.outward(piece.from)) > 1e-9)
                fail("begins at a corner");
        }
        solid.pieces.push_back(piece);
    }
    if (solid.pieces.empty() || std::abs(solid.pieces.front().from.x) > 1e-9 ||
        std::abs(solid.pieces.back().to.x) > 1e-9)
        fail("the profile does not reach the axis at both ends");
    return solid;
}

std::vector<Crossing> crossingsOf(const Revolved& solid, const dvec3& x, const dvec3& direction) {
    std::vector<Crossing> all;
    std::vector<double> candidates;
    for (const ProfilePiece& piece : solid.pieces) {
        candidates.clear();
        if (piece.curved)
            meetArc(piece, x, direction, candidates);
        else
            meetLine(piece, x, direction, candidates);
        for (const double t : candidates) {
            const dvec3 p = x + t * direction;
            const dvec2 at = profiled(p);
            // A cone has another half, and a torus that meets itself an inner side.
            if (std::abs(piece.distance(at)) > kTouching || !piece.reaches(at)) continue;
            const dvec2 outward = piece.outward(at);
            const dvec3 ring = at.x > 0 ? dvec3(p.x, 0, p.z) / at.x : dvec3(0);
            all.push_back({t, outward.x * ring + dvec3(0, outward.y, 0)});
        }
    }
    std::ranges::sort(all, {}, &Crossing::t);
    const auto same = [](const Crossing& a, const Crossing& b) { return b.t - a.t < kTouching; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    return all;
}

Path followTransmitted(const Revolved& solid, const Ray& ray, int mostMet) {
    Path path{{ray.x, glm::normalize(ray.direction)}, false, 0, 0, {}};
    bool within = false, first = true;
    while (static_cast<int>(path.met.size()) <= mostMet) {
        const dvec3 x = path.ray.x, d = path.ray.direction;
        const std::vector<Crossing> all = crossingsOf(solid, x, d);
        const auto next =
            std::ranges::find_if(all, [](const Crossing& c) { return c.t > kTouching; });
        if (next == all.end()) {
            if (within) throw std::runtime_error("a ray leaves a solid through no boundary");
            path.left = true;
            break;
        }
        const bool leaves = glm::dot(next->normal, d) > 0;
        if (first) within = leaves, first = false;
        if (leaves != within) throw std::runtime_error("a ray meets the same side twice");
        const double cosine = std::abs(glm::dot(next->normal, d));
        const double ratio = within ? 1 / solid.index : solid.index;
        const Met met{x + next->t * d,
                      within ? -next->normal : next->normal,
                      within ? 0 : kAround,
                      within ? kAround : 0,
                      ratio,
                      cosine,
                      reflectance(ratio, cosine).mean()};
        const bool total = met.reflected == 1;
        path.pathLength += next->t;
        path.opticalLength += (within ? solid.index : 1) * next->t;
        path.ray = {met.x, total ? reflected(d, met) : refracted(d, met)};
        if (!total) within = !within;
        path.met.push_back(met);
    }
    return path;
}

} // namespace judge
