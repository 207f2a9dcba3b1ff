// Rays solved on paper, with no stepping: what the judge's own tracer is judged by.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/closed.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace judge {

namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One coordinate of a harmonic oscillator of frequency f, from x with speed w, after time t.
struct Swing {
    double x, w;
    double speedSquared; // ∫ w² dt
};

Swing swing(double x, double w, double f, double t) {
    const double c = std::cos(f * t), s = std::sin(f * t);
    const double half = t / 2, wave = s * c / (2 * f); // sin 2ft / 4f
    return {x * c + w / f * s, w * c - x * f * s,
            x * x * f * f * (half - wave) + w * w * (half + wave) - x * w * s * s};
}

double rootBetween(const std::function<double(double)>& f, double low, double high) {
    std::uintmax_t most = 200;
    // 52 bits: down to neighbouring doubles.
    const auto [a, b] = boost::math::tools::toms748_solve(
        f, low, high, boost::math::tools::eps_tolerance<double>(52), most);
    return 0.5 * (a + b);
}

/// The first parameter t ≥ 0 at which x + t d meets the sphere from outside.
std::optional<double> sphereAhead(const dvec3& x, const dvec3& d, double radius) {
    const double along = glm::dot(x, d);
    const dvec3 nearest = x - along * d;
    const double under = radius * radius - glm::dot(nearest, nearest);
    if (under < 0 || along > 0) return {};
    return -along - std::sqrt(under);
}

/// ∫ f(r) dr / √(n²r² − m²) from the turning radius to outer. With r = turning + t² the root's
/// singularity goes.
double alongPass(const Profile& n, const Profile& slope, const std::function<double(double)>& f,
                 double m, double turning, double outer) {
    const auto integrand = [&](double t) {
        const double r = turning + t * t;
        // n r − m loses all its digits near the turning point; its slope at the middle between
        // keeps them. Past 1e-5 of the radius the difference has eleven digits and the slope's
        // error, of third order, would be as much.
        double excess = n(r) * r - m;
        if (t * t < 1e-5 * turning) {
            const double middle = turning + t * t / 2;
            excess = (n(middle) + middle * slope(middle)) * t * t;
        }
        return f(r) * 2 * t / std::sqrt(excess * (n(r) * r + m));
    };
    // Depth 15 of bisection: an edge of 1/30000 of the radius is still found.
    return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        integrand, 0.0, std::sqrt(outer - turning), 15, 1e-13);
}

} // namespace

Point parabola(double n0sq, dvec3 a, const Ray& ray, double tau) {
    const dvec3 w0 = std::sqrt(n0sq + 2 * glm::dot(a, ray.x)) * glm::normalize(ray.direction);
    return {ray.x + tau * (w0 + tau / 2 * a), w0 + tau * a,
            tau * (glm::dot(w0, w0) + tau * (glm::dot(w0, a) + tau / 3 * glm::dot(a, a)))};
}

double parabolaLength(double n0sq, dvec3 a, const Ray& ray, double tau) {
    // |w|² = |a|² (t² + c²), t = τ + a·w0/|a|²: the integral of its root, between two t.
    const dvec3 w0 = parabola(n0sq, a, ray, 0).w;
    const double aa = glm::dot(a, a), shift = glm::dot(a, w0) / aa;
    const double cc = glm::dot(w0, w0) / aa - shift * shift;
    const auto primitive = [&](double t) {
        return 0.5 *
               (t * std::sqrt(t * t + cc) + (cc > 0 ? cc * std::asinh(t / std::sqrt(cc)) : 0));
    };
    return std::sqrt(aa) * (primitive(shift + tau) - primitive(shift));
}

std::optional<double> parabolaTau(double n0sq, dvec3 a, const Ray& ray, int axis, double value) {
    const double w = parabola(n0sq, a, ray, 0).w[axis];
    const double c = ray.x[axis] - value, under = w * w - 2 * a[axis] * c;
    if (under < 0) return {};
    // Both roots of ½aτ² + wτ + c without a difference of near numbers.
    const double q = -(w + std::copysign(std::sqrt(under), w));
    double first = kInfinity;
    for (const double tau :
         {a[axis] != 0 ? q / a[axis] : kInfinity, q != 0 ? 2 * c / q : kInfinity})
        if (tau > 0 && tau < first) first = tau;
    return first < kInfinity ? std::optional(first) : std::nullopt;
}

Point grinRodAt(double n0, double g, dvec3 centre, const Ray& ray, double z) {
    const dvec3 r = ray.x - centre;
    const double n = n0 * std::sqrt(1 - g * g * (r.x * r.x + r.y * r.y));
    const dvec3 w = n * glm::normalize(ray.direction);
    const double tau = (z - ray.x.z) / w.z;
    const Swing x = swing(r.x, w.x, n0 * g, tau), y = swing(r.y, w.y, n0 * g, tau);
    return {{centre.x + x.x, centre.y + y.x, z},
            {x.w, y.w, w.z},
            x.speedSquared + y.speedSquared + w.z * w.z * tau};
}

Point luneburgCoreAt(dvec3 centre, double radius, const Ray& ray, double tau) {
    const dvec3 r = ray.x - centre;
    const dvec3 w =
        std::sqrt(2 - glm::dot(r, r) / (radius * radius)) * glm::normalize(ray.direction);
    Point end{centre, {}, 0};
    for (int i = 0; i < 3; ++i) {
        const Swing axis = swing(r[i], w[i], 1 / radius, tau);
        end.x[i] += axis.x, end.w[i] = axis.w, end.opticalLength += axis.speedSquared;
    }
    return end;
}

std::optional<Point> luneburgExit(dvec3 centre, double radius, const Ray& ray) {
    const dvec3 d = glm::normalize(ray.direction), r = ray.x - centre;
    const auto toRim = sphereAhead(r, d, radius);
    if (!toRim) return {};
    const dvec3 rim = r + *toRim * d;
    return Point{centre + radius * d, -rim / radius, *toRim + pi * radius / 2 - glm::dot(rim, d)};
}

Point fishEyeAt(dvec3 centre, double radius, const Ray& ray, double opticalLength) {
    // The point (p, h) of the unit sphere, p = 2ξ/(1 + ξ²), h = (ξ² − 1)/(1 + ξ²), and its unit
    // tangent (dp, dh), where ξ moves by (1 + ξ²)/2 for each unit of arc.
    const dvec3 xi = (ray.x - centre) / radius, t = glm::normalize(ray.direction);
    const double one = 1 + glm::dot(xi, xi), along = glm::dot(xi, t);
    const dvec3 p = 2.0 / one * xi, dp = t - 2 * along / one * xi;
    const double h = 1 - 2 / one, dh = 2 * along / one;

    const double angle = opticalLength / radius, c = std::cos(angle), s = std::sin(angle);
    const dvec3 q = c * p + s * dp, dq = c * dp - s * p;
    const double under = 1 - (c * h + s * dh), dUnder = s * h - c * dh;
    const dvec3 end = q / under;
    const double n = 2 / (1 + glm::dot(end, end));
    return {centre + radius * end, n * glm::normalize(dq / under - q / (under * under) * dUnder),
            opticalLength};
}

double fishEyePeriod(double radius) {
    return 2 * pi * radius;
}

std::pair<dvec3, double> fishEyeCircle(dvec3 centre, double radius, const Ray& ray) {
    // Curvature is the part of ∇ln n = −2r/(R² + r²) across the ray.
    const dvec3 r = ray.x - centre, t = glm::normalize(ray.direction);
    const dvec3 across = r - glm::dot(r, t) * t;
    const double off = glm::length(across);
    if (off == 0) return {centre, kInfinity};
    const double rho = (radius * radius + glm::dot(r, r)) / (2 * off);
    return {ray.x - rho / off * across, rho};
}

dvec3 fishEyeImage(dvec3 centre, double radius, dvec3 x) {
    const dvec3 r = x - centre;
    return centre - radius * radius / glm::dot(r, r) * r;
}

dvec3 layeredInvariant(dvec3 w) {
    return {w.x, 0, w.z};
}

double turningHeight(const Profile& n, double invariant, double low, double high) {
    const auto f = [&](double y) { return n(y) - invariant; };
    if (f(low) * f(high) > 0) throw std::invalid_argument("no turning height between low and high");
    return rootBetween(f, low, high);
}

Point layeredExponentialAt(double n0sq, double gain, double y0, double scale, const Ray& ray,
                           double tau) {
    const double n = std::sqrt(n0sq - gain * std::expm1(-(ray.x.y - y0) / scale));
    const dvec3 w = n * glm::normalize(ray.direction), along = layeredInvariant(w);
    const double e = n0sq + gain - glm::dot(along, along), root = std::sqrt(e);
    const double start = std::atanh(w.y / root), q = start + root * tau / (2 * scale);
    return {{ray.x.x + w.x * tau, y0 + scale * (std::log(gain / e) + 2 * std::log(std::cosh(q))),
             ray.x.z + w.z * tau},
            {w.x, root * std::tanh(q), w.z},
            // ∫ n² dτ = ∫ (invariant² + E tanh² q) dτ
            (glm::dot(along, along) + e) * tau - 2 * scale * root * (std::tanh(q) - w.y / root)};
}

double layeredExponentialTurn(double n0sq, double gain, double y0, double scale, dvec3 w) {
    const dvec3 along = layeredInvariant(w);
    return y0 + scale * std::log(gain / (n0sq + gain - glm::dot(along, along)));
}

dvec3 radialInvariant(dvec3 centre, dvec3 x, dvec3 w) {
    return glm::cross(x - centre, w);
}

RadialPass radialPass(const Profile& n, const Profile& slope, double b, double outer) {
    if (!(b >= 0 && b < outer)) throw std::invalid_argument("impact parameter outside the sphere");
    const double m = n(outer) * b;
    const auto excess = [&](double r) { return n(r) * r - m; };
    // The turning point is the first that is met from outside; 4096 parts will not step over a dip
    // of an edge that the quadrature resolves.
    double turning = 0;
    for (int i = 4096; i > 0 && turning == 0; --i)
        if (const double low = outer * (i - 1) / 4096; excess(low) <= 0 && m > 0)
            turning = rootBetween(excess, low, outer * i / 4096);
    const auto bend = [&](double r) { return -slope(r) / n(r); };
    const auto square = [&](double r) { return n(r) * n(r) * r; };
    return {turning, m > 0 ? 2 * m * alongPass(n, slope, bend, m, turning, outer) : 0,
            2 * alongPass(n, slope, square, m, turning, outer)};
}

Ray radialExit(dvec3 centre, const Ray& ray, const RadialPass& pass, double outer) {
    const dvec3 d = glm::normalize(ray.direction), r = ray.x - centre;
    const dvec3 nearest = r - glm::dot(r, d) * d;
    const double b = glm::length(nearest);
    // A ray through the centre has no side to turn to, and does not turn.
    const dvec3 up = b > 0 ? nearest / b : dvec3(0);
    const double c = std::cos(pass.deflection), s = std::sin(pass.deflection);
    const dvec3 out = c * d - s * up, outUp = c * up + s * d;
    return {centre + b * outUp + std::sqrt(outer * outer - b * b) * out, out};
}

} // namespace judge
