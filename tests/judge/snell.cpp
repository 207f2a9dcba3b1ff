// Snell's and Fresnel's laws at a ball, and what follows on paper: orders, caustic, fluence.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/snell.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

namespace judge {

namespace {

using std::numbers::pi;

/// Rays in a plane of the axis, on their way inside or away from the ball: all pass the centre at
/// the distance `past`, turned towards the axis by `turn`. Derivatives are by off.
struct Pencil {
    double past, dPast;
    double turn, dTurn;
};

/// In units of the radius. Of order 1, or where a bubble lets nothing in, of order 0.
Pencil pencil(double ratio, double off, bool inside) {
    const double cosI = std::sqrt(std::max(0.0, 1 - off * off));
    if (off >= ratio) return {off, 1, 2 * std::asin(off) - pi, 2 / cosI};
    const double sinT = off / ratio, cosT = std::sqrt(1 - sinT * sinT);
    const double bend = std::asin(off) - std::asin(sinT);
    const double dBend = 1 / cosI - 1 / (ratio * cosT);
    if (inside) return {sinT, 1 / ratio, bend, dBend};
    return {off, 1, 2 * bend, 2 * dBend};
}

/// Share of the power that gets inside, or away.
double passed(const BallScene& scene, double off, bool inside) {
    const double ratio = scene.index / scene.around;
    if (scene.fresnel == Fresnel::None || off >= ratio) return 1;
    if (inside) return 1 - reflectance(ratio, std::sqrt(1 - off * off)).mean();
    return ballOrders(ratio, off, scene.fresnel == Fresnel::Polarised)[1];
}

/// Fluence per irradiance at (along, across) from the centre in radii, across > 0: a sum over the
/// rays that pass there, from either side of the axis.
double pencilFluence(const BallScene& scene, double along, double across, bool inside) {
    const double ratio = scene.index / scene.around;
    // A ray's line is y cos(turn) + z sin(turn) = past.
    const auto share = [&](double off, double y) {
        const Pencil p = pencil(ratio, off, inside);
        const double c = std::cos(p.turn), s = std::sin(p.turn);
        // The line is a ray only from where it enters, or leaves, the ball on.
        if (inside ? along < -std::sqrt(1 - off * off) : along * c - y * s < 0) return 0.0;
        // dy/d(off) = (past' − turn' (z cos − y sin)) / cos, and the fluence has another 1/cos.
        const double dy = p.dPast - p.dTurn * (along * c - y * s);
        return passed(scene, off, inside) * off / (std::abs(y) * std::abs(dy));
    };
    // 500 intervals of each range, denser towards its end, where the turn has infinite slope:
    // off = sin. Within one a line passes the point once, but for two at a caustic.
    std::vector<std::array<double, 2>> ranges = {{0, std::min(1.0, ratio)}};
    if (!inside && ratio < 1) ranges.push_back({ratio, 1});
    double sum = 0;
    const int n = 500;
    for (const auto [from, to] : ranges)
        for (const double y : {across, -across}) {
            const auto offAt = [&](double a) { return from + (to - from) * std::sin(a); };
            const auto miss = [&](double a) {
                const Pencil p = pencil(ratio, offAt(a), inside);
                return p.past - along * std::sin(p.turn) - y * std::cos(p.turn);
            };
            for (int i = 0; i < n; ++i) {
                // Short of the very end by 1e-9, where derivatives are infinite.
                const double a0 = pi / 2 * i / n, a1 = pi / 2 * (i + 1 - 1e-9) / n;
                const double f0 = miss(a0), f1 = miss(a1);
                if (f0 * f1 > 0 || f0 == 0) continue;
                std::uintmax_t most = 200;
                const auto [low, high] = boost::math::tools::toms748_solve(
                    miss, a0, a1, f0, f1, boost::math::tools::eps_tolerance<double>(50), most);
                sum += share(offAt(0.5 * (low + high)), y);
            }
        }
    return sum;
}

} // namespace

Reflectance reflectance(double ratio, double cosIncidence) {
    const double sinSquared = (1 - cosIncidence * cosIncidence) / (ratio * ratio);
    if (sinSquared >= 1) return {1, 1};
    const double cosT = std::sqrt(1 - sinSquared);
    const double s = (cosIncidence - ratio * cosT) / (cosIncidence + ratio * cosT);
    const double p = (cosT - ratio * cosIncidence) / (cosT + ratio * cosIncidence);
    return {s * s, p * p};
}

double ballDeflection(double ratio, double off, int order) {
    if (!(off >= 0 && off <= 1) || order < 0 || (order > 0 && off > ratio))
        throw std::invalid_argument("no such ray");
    const double thetaT = order > 0 ? std::asin(off / ratio) : 0;
    return (order - 1) * pi + 2 * std::asin(off) - 2 * order * thetaT;
}

double ballDeflectionSlope(double ratio, double off) {
    return pencil(ratio, off, false).dTurn;
}

double ballFocus(double ratio, double radius) {
    return ratio * radius / (2 * (ratio - 1));
}

std::array<double, 4> ballOrders(double ratio, double off, bool polarised) {
    const Reflectance r = reflectance(ratio, std::sqrt(std::max(0.0, 1 - off * off)));
    const auto orders = [](double reflected) {
        const double t = (1 - reflected) * (1 - reflected);
        return std::array{reflected, t, t * reflected, t * reflected * reflected};
    };
    if (!polarised) return orders(r.mean());
    const auto s = orders(r.s), p = orders(r.p);
    return {0.5 * (s[0] + p[0]), 0.5 * (s[1] + p[1]), 0.5 * (s[2] + p[2]), 0.5 * (s[3] + p[3])};
}

Caustic ballCaustic(double ratio, double radius, double off) {
    // Of the lines z sinδ + y cosδ = b the envelope solves the derivative by b, too:
    // z cosδ − y sinδ = 1/δ'.
    const double turn = ballDeflection(ratio, off), reach = 1 / ballDeflectionSlope(ratio, off);
    const double c = std::cos(turn), s = std::sin(turn);
    return {radius * (off * s + reach * c), radius * (off * c - reach * s)};
}

double ballFluenceAt(const BallScene& scene, dvec3 x) {
    if (scene.extinction != 0 || scene.extinctionAround != 0)
        throw std::invalid_argument("no closed form for extinction");
    const dvec3 d = glm::normalize(scene.direction), r = (x - scene.centre) / scene.radius;
    const double along = glm::dot(r, d), across = glm::length(r - along * d);
    if (glm::length(r) < 1) return scene.irradiance * pencilFluence(scene, along, across, true);
    // Behind the ball its shadow, with what went through it; that may leave the shadow, too.
    const double straight = along < 0 || across >= 1 ? 1 : 0;
    return scene.irradiance * (straight + pencilFluence(scene, along, across, false));
}

double beerLambert(double irradiance, double extinction, double path) {
    return irradiance * std::exp(-extinction * path);
}

double beerLambertMean(double irradiance, double extinction, double from, double to) {
    const double depth = extinction * (to - from);
    return beerLambert(irradiance, extinction, from) *
           (depth > 0 ? -std::expm1(-depth) / depth : 1);
}

double inverseSquare(double intensity, double distance, double extinction) {
    return intensity * std::exp(-extinction * distance) / (distance * distance);
}

double inverseSquareMean(double intensity, dvec3 light, dvec3 low, double side, double extinction,
                         int parts) {
    using Rule = boost::math::quadrature::gauss<double, 4>;
    const double part = side / parts;
    // Along one axis, slice by slice.
    const auto over = [&](double from, const std::function<double(double)>& f) {
        double sum = 0;
        for (int i = 0; i < parts; ++i)
            sum += Rule::integrate(f, from + i * part, from + (i + 1) * part);
        return sum / side;
    };
    return over(low.x, [&](double x) {
        return over(low.y, [&](double y) {
            return over(low.z, [&](double z) {
                return inverseSquare(intensity, glm::length(dvec3(x, y, z) - light), extinction);
            });
        });
    });
}

} // namespace judge
