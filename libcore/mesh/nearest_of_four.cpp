// The nearest points of four faces to four points at once.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/nearest_of_four.h"

#include "mesh/lanes.h"

#include <cmath>

namespace eikonal::mesh {

namespace {

struct Vector4 {
    Double4 x, y, z;
};

EIKONAL_LANES_PART Vector4 operator+(const Vector4& a, const Vector4& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
EIKONAL_LANES_PART Vector4 operator-(const Vector4& a, const Vector4& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
EIKONAL_LANES_PART Vector4 operator*(const Double4& s, const Vector4& a) {
    return {s * a.x, s * a.y, s * a.z};
}
EIKONAL_LANES_PART Double4 dot(const Vector4& a, const Vector4& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct Weights {
    Double4 u, v;
};

/// ½ (uu u² + 2 uv u v + vv v²) + u.right u + v.right v: what is to be least.
struct Quadratic {
    Double4 uu, uv, vv, ru, rv;

    EIKONAL_LANES_PART Double4 at(const Double4& u, const Double4& v) const {
        return u * (four(0.5) * uu * u + uv * v + ru) + v * (four(0.5) * vv * v + rv);
    }
};

EIKONAL_LANES_PART Double4 share(const Double4& x) {
    return lesser(greater(x, four(0)), four(1));
}

/// The weights, of a triangle's points, where the quadratic of their difference to `from` is least.
EIKONAL_LANES_PART Weights leastWeights(const Quadratic& q, const Weights& from) {
    const Double4 zero = four(0), one = four(1);
    const Double4 area = q.uu * q.vv - q.uv * q.uv;
    Double4 u = from.u + (q.uv * q.rv - q.vv * q.ru) / area;
    Double4 v = from.v + (q.uv * q.ru - q.uu * q.rv) / area;
    const Long4 within =
        (area > four(1e-14) * q.uu * q.vv) & (u >= zero) & (v >= zero) & (u + v <= one);
    if (!any(~within)) return {u, v};
    const Double4 toB = one - from.u;
    const Double4 alongU = share(from.u + (q.uv * from.v - q.ru) / q.uu);
    const Double4 alongV = share(from.v + (q.uv * from.u - q.rv) / q.vv);
    const Double4 across = share(((q.uu - q.uv) * toB + (q.vv - q.uv) * from.v + q.ru - q.rv) /
                                 (q.uu - four(2) * q.uv + q.vv));
    Double4 least = q.at(alongU - from.u, -from.v);
    Weights best{alongU, zero};
    const Double4 second = q.at(-from.u, alongV - from.v);
    const Long4 isSecond = second < least;
    least = isSecond ? second : least;
    best = {isSecond ? zero : best.u, isSecond ? alongV : best.v};
    const Long4 isThird = q.at(toB - across, across - from.v) < least;
    best = {isThird ? one - across : best.u, isThird ? across : best.v};
    return {within ? u : best.u, within ? v : best.v};
}

/// A cubic's coefficients, by powers of the weights u and v.
struct Cubic {
    Vector4 none, u, v, uu, uv, vv, uuu, uuv, uvv, vvv;
};

/// The point and its derivatives.
struct Slopes4 {
    Vector4 x, u, v, uu, uv, vv;
};

EIKONAL_LANES_PART Slopes4 slopesAt(const Cubic& c, const Weights& w) {
    const Double4 u = w.u, v = w.v, u2 = u + u, v2 = v + v, u3 = four(3) * u, v3 = four(3) * v;
    const Vector4 alongU = u * c.uuu + v * c.uuv, alongV = u * c.uvv + v * c.vvv,
                  mixed = u * c.uuv + v * c.uvv;
    return {c.none + u * (c.u + u * (c.uu + alongU) + v * (c.uv + v * c.uvv)) +
                v * (c.v + v * (c.vv + v * c.vvv)),
            c.u + u2 * c.uu + v * c.uv + (u3 * u) * c.uuu + v * (u2 * c.uuv + v * c.uvv),
            c.v + u * c.uv + v2 * c.vv + u * (u * c.uuv + v2 * c.uvv) + (v3 * v) * c.vvv,
            four(2) * (c.uu + u2 * c.uuu + alongU),
            c.uv + four(2) * mixed,
            four(2) * (c.vv + v2 * c.vvv + alongV)};
}

/// One number each of the four.
EIKONAL_LANES_PART Vector4 gathered(const glm::dvec3* const (&at)[4], int k) {
    const glm::dvec3 &a = at[0][k], &b = at[1][k], &c = at[2][k], &d = at[3][k];
    return {Double4{a.x, b.x, c.x, d.x}, Double4{a.y, b.y, c.y, d.y}, Double4{a.z, b.z, c.z, d.z}};
}

/// Of faces with corners `a`, and b and c from there.
EIKONAL_LANES_PART Cubic cubicOf(const FaceQuestion (&questions)[4], const Vector4& a,
                                 const Vector4& b, const Vector4& c) {
    static_assert(sizeof(EdgeCurve) == 2 * sizeof(glm::dvec3));
    const glm::dvec3* const at[4] = {&questions[0].sides->rise, &questions[1].sides->rise,
                                     &questions[2].sides->rise, &questions[3].sides->rise};
    const Vector4 rise0 = four(4) * gathered(at, 0), skew0 = gathered(at, 1),
                  rise1 = four(4) * gathered(at, 2), skew1 = gathered(at, 3),
                  rise2 = four(4) * gathered(at, 4), skew2 = gathered(at, 5);
    const Double4 two = four(2), three = four(3);
    return {a,
            b + rise0 + skew0,
            c + rise2 - skew2,
            four(-1) * rise0 - three * skew0,
            rise1 - rise0 - rise2 - two * skew0 + two * skew2,
            three * skew2 - rise2,
            two * skew0,
            skew1 + three * skew0 - skew2,
            skew0 - skew1 - three * skew2,
            four(-2) * skew2};
}

/// The unit of cross(u, v) times x; 0 where there is none.
EIKONAL_LANES_PART void heights(const Slopes4& here, CurvedFace::Nearest (&answers)[4]) {
    const Vector4 &u = here.u, &v = here.v;
    const Vector4 across{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const Double4 height = -dot(here.x, across), area = dot(across, across);
    for (int k = 0; k < 4; ++k)
        answers[k].height = area[k] > 0 ? height[k] / std::sqrt(area[k]) : 0;
}

} // namespace

EIKONAL_LANES unsigned nearestOfFour(const FaceQuestion (&questions)[4],
                                     CurvedFace::Nearest (&answers)[4]) {
    constexpr int kSteps = 8;
    constexpr double kEnough = 1e-9;
    const Double4 zero = four(0);
    const glm::dvec3* const at[4] = {questions[0].corners, questions[1].corners,
                                     questions[2].corners, questions[3].corners};
    const glm::dvec3* const xs[4] = {&questions[0].x, &questions[1].x, &questions[2].x,
                                     &questions[3].x};
    const Vector4 a = gathered(at, 0), b = gathered(at, 1) - a, c = gathered(at, 2) - a,
                  off = a - gathered(xs, 0);
    Weights uv =
        leastWeights({dot(b, b), dot(b, c), dot(c, c), dot(off, b), dot(off, c)}, {zero, zero});
    if (questions[0].sides == nullptr) {
        const Vector4 from = off + uv.u * b + uv.v * c;
        const Double4 squared = dot(from, from);
        for (int k = 0; k < 4; ++k) answers[k] = {squared[k], 0};
        return 0;
    }
    const Cubic cubic = cubicOf(questions, off, b, c);
    Slopes4 here = slopesAt(cubic, uv);
    Double4 best = dot(here.x, here.x);
    Long4 active{-1, -1, -1, -1}, worse{0, 0, 0, 0};
    for (int step = 0; step < kSteps; ++step) {
        Quadratic q{dot(here.u, here.u), dot(here.u, here.v), dot(here.v, here.v),
                    dot(here.x, here.u), dot(here.x, here.v)};
        const Double4 bentUU = q.uu + dot(here.x, here.uu), bentUV = q.uv + dot(here.x, here.uv),
                      bentVV = q.vv + dot(here.x, here.vv);
        const Double4 flat = q.uu * q.vv - q.uv * q.uv;
        const Long4 isValley =
            (bentUU > zero) & (bentUU * bentVV - bentUV * bentUV > four(1e-3) * flat);
        q.uu = isValley ? bentUU : q.uu;
        q.uv = isValley ? bentUV : q.uv;
        q.vv = isValley ? bentVV : q.vv;
        active &= q.uu * q.vv - q.uv * q.uv > four(1e-14) * q.uu * q.vv;
        const Weights goal = leastWeights(q, uv);
        const Double4 du = goal.u - uv.u, dv = goal.v - uv.v;
        active &=
            q.uu * du * du + four(2) * q.uv * du * dv + q.vv * dv * dv >= four(kEnough) * best;
        if (!any(active)) break;
        const Weights next{active ? goal.u : uv.u, active ? goal.v : uv.v};
        here = slopesAt(cubic, next);
        const Double4 found = dot(here.x, here.x);
        worse |= active & (found >= best);
        active &= ~worse;
        uv = next;
        best = found;
    }
    heights(here, answers);
    unsigned again = 0;
    for (int k = 0; k < 4; ++k) {
        answers[k].squared = best[k];
        again |= worse[k] != 0 ? 1u << k : 0u;
    }
    return again;
}

} // namespace eikonal::mesh
