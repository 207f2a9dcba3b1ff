// Samples of the potential U = ½n², carried on beyond the domain's faces and made into splines.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/samples.h"

#include "scene/bias.h"
#include "scene/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tbb/parallel_for.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;

/// The lines along `axis` through the part of the array whose other axes span [low, high).
struct Span {
    ivec3 low, high;
};

template<typename Visit> void forEachSlice(int slices, const Visit& visit) {
    tbb::parallel_for(0, slices, visit);
}

template<typename Visit>
void forEachLine(ivec3 outer, int axis, const Span& span, const Visit& visit) {
    const std::ptrdiff_t strides[] = {1, outer.x, std::ptrdiff_t{outer.x} * outer.y};
    const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
    forEachSlice(span.high[c] - span.low[c], [&](int slice) {
        const std::ptrdiff_t plane = (span.low[c] + slice) * strides[c];
        for (int j = span.low[b]; j < span.high[b]; ++j)
            visit(plane + j * strides[b], strides[axis]);
    });
}

/// The second differences beyond a face, by those at the first and second sample inside.
std::array<double, kMargin> curvesBeyond(double s1, double s2) {
    std::array<double, kMargin> curves{};
    if (s1 * s2 <= 0) return curves;
    const bool smooth = std::abs(s1) <= 2 * std::abs(s2) && std::abs(s2) <= 2 * std::abs(s1);
    const double least = std::abs(s1) < std::abs(s2) ? s1 : s2;
    for (int k = 0; k < kMargin; ++k) {
        const double next = s1 + (k + 1) * (s1 - s2);
        curves[static_cast<size_t>(k)] = !smooth ? least : next * s1 > 0 ? next : 0;
    }
    return curves;
}

/// Writes the margin before `face`, whose line goes on inward by `inward` for `count` samples.
void extendBeyond(float* face, std::ptrdiff_t inward, int count, double floorOf, double zero) {
    const double f0 = face[0];
    const auto inside = [&](int i) { return static_cast<double>(face[i * inward]); };
    std::array<double, kMargin> curves{};
    if (count >= 4)
        curves =
            curvesBeyond(f0 - 2 * inside(1) + inside(2), inside(1) - 2 * inside(2) + inside(3));
    const double least = floorOf * (f0 + zero) - zero;
    double near = f0, behind = count >= 2 ? inside(1) : f0;
    for (int k = 0; k < kMargin; ++k) {
        const double next = 2 * near - behind + curves[static_cast<size_t>(k)];
        face[-(k + 1) * inward] = static_cast<float>(std::max(next, least));
        behind = near;
        near = next;
    }
}

} // namespace

Potential makePotential(const volume::BrickGrid& index, const volume::BrickGrid& rest) {
    Potential potential;
    potential.size = index.size;
    const bool plain = rest.page.empty();
    const double first = static_cast<double>(index.at(ivec3(0))) +
                         (plain ? 0.0 : static_cast<double>(rest.at(ivec3(0))));
    potential.squareAtZero = first * first;
    const ivec3 size = index.size, outer = potential.outer();
    potential.values.assign(static_cast<size_t>(outer.x) * outer.y * outer.z, 0.0f);
    const auto place = [&](int x, int y, int z) {
        return (static_cast<size_t>(z + kMargin) * outer.y + (y + kMargin)) * outer.x + kMargin + x;
    };
    forEachSlice(size.z, [&](int z) {
        std::vector<float> rests(static_cast<size_t>(size.x), 0.0f);
        for (int y = 0; y < size.y; ++y) {
            float* row = potential.values.data() + place(0, y, z);
            index.copyRow(y, z, row);
            if (!plain) rest.copyRow(y, z, rests.data());
            for (int x = 0; x < size.x; ++x) {
                const double n = static_cast<double>(row[x]) +
                                 static_cast<double>(rests[static_cast<size_t>(x)]);
                row[x] = static_cast<float>(0.5 * (n - first) * (n + first));
            }
        }
    });
    // Axis after axis, each including the margin that those before made.
    const double kFloor = 1.0 / 16; // of n²: a quarter of n
    Span span{ivec3(kMargin), ivec3(kMargin) + size};
    for (int axis = 0; axis < 3; ++axis) {
        forEachLine(outer, axis, span, [&](std::ptrdiff_t line, std::ptrdiff_t stride) {
            float* low = potential.values.data() + line + kMargin * stride;
            float* high = low + (size[axis] - 1) * stride;
            extendBeyond(low, stride, size[axis], kFloor, 0.5 * potential.squareAtZero);
            extendBeyond(high, -stride, size[axis], kFloor, 0.5 * potential.squareAtZero);
        });
        span.low[axis] = 0;
        span.high[axis] = outer[axis];
    }
    return potential;
}

void correctForVerlet(Potential& potential, double tau) {
    const ivec3 outer = potential.outer();
    const std::ptrdiff_t strides[] = {1, outer.x, std::ptrdiff_t{outer.x} * outer.y};
    const std::vector<float> u = potential.values;
    const auto square = static_cast<float>(tau * tau);
    forEachSlice(outer.z - 2, [&](int slice) {
        for (int y = 1; y < outer.y - 1; ++y) {
            const std::ptrdiff_t row = (slice + 1) * strides[2] + y * strides[1];
            for (int x = 1; x < outer.x - 1; ++x) {
                const float* p = u.data() + row + x;
                float force = 0, bend = 0;
                for (const std::ptrdiff_t s : strides) {
                    const float slope = 0.5f * (p[s] - p[-s]);
                    force += slope * slope;
                    bend = std::max(bend, std::abs(p[s] - 2 * *p + p[-s]));
                }
                // The correction is the first term of a series in τ² times U's second derivative.
                const float next = square * bend;
                potential.values[static_cast<size_t>(row + x)] +=
                    square * force / (24.0f * (1.0f + next * next));
            }
        }
    });
}

std::vector<glm::vec4> gradientSamples(const Potential& own, const Potential& stepped,
                                       bool unbiased, const ivec3& low, const ivec3& size) {
    const ivec3 outer = own.outer();
    const std::ptrdiff_t strides[] = {1, outer.x, std::ptrdiff_t{outer.x} * outer.y};
    std::vector<glm::vec4> samples(placeOf(size, 0, 0, size.z));
    const double square = own.squareAtZero; // in double, so that n comes back to its last digit
    const auto indexOf = [=](float potential) {
        return static_cast<float>(std::sqrt(square + 2 * static_cast<double>(potential)));
    };
    Bias bias;
    if (unbiased) bias = biasOf(stepped, low - 2, size + 2);
    const std::ptrdiff_t steps[] = {1, bias.size.x, std::ptrdiff_t{bias.size.x} * bias.size.y};
    forEachSlice(size.z, [&](int z) {
        for (int y = 0; y < size.y; ++y) {
            const ivec3 first = low + ivec3(0, y, z) + kMargin - 1;
            const std::ptrdiff_t row = first.z * strides[2] + first.y * strides[1] + first.x;
            glm::vec4* out = samples.data() + placeOf(size, 0, y, z);
            for (int x = 0; x < size.x; ++x) {
                const float* p = stepped.values.data() + row + x;
                for (int axis = 0; axis < 3; ++axis)
                    out[x][axis] = 0.5f * (p[strides[axis]] - p[-strides[axis]]);
                out[x].w = indexOf(own.values[static_cast<size_t>(row + x)]);
            }
            if (!unbiased) continue;
            for (int x = 0; x < size.x; ++x) {
                const glm::vec3* off = bias.values.data() + bias.at(low + ivec3(x, y, z) - 1);
                for (int axis = 0; axis < 3; ++axis)
                    out[x][axis] -= 0.5f * (off[steps[axis]][axis] - off[-steps[axis]][axis]);
                const float* p = own.values.data() + row + x;
                const float n = out[x].w;
                float curve = -6 * n;
                for (const std::ptrdiff_t s : strides) curve += indexOf(p[s]) + indexOf(p[-s]);
                // Overshoot beside a jump must not make the index vanish.
                out[x].w = std::max(n - curve / 12, 0.25f * n);
            }
        }
    });
    return samples;
}

void makeSpline(Potential& potential) {
    const ivec3 outer = potential.outer();
    std::vector<double> pivots;
    for (int axis = 0; axis < 3; ++axis) {
        const int count = outer[axis];
        // Of c[i−1] + 4 c[i] + c[i+1] = 6 s[i], eliminated from below (Thomas).
        pivots.assign(static_cast<size_t>(count), 0.25);
        for (size_t i = 3; i < pivots.size(); ++i) pivots[i] = 1 / (4 - pivots[i - 1]);
        forEachLine(outer, axis, {ivec3(0), outer}, [&](std::ptrdiff_t at, std::ptrdiff_t stride) {
            std::vector<double> line(static_cast<size_t>(count));
            float* s = potential.values.data() + at;
            const auto value = [&](int i) { return static_cast<double>(s[i * stride]); };
            // Both ends are those of a cubic: c = s − s''/6.
            const auto end = [&](int i) {
                return value(i) - (value(i - 1) - 2 * value(i) + value(i + 1)) / 6;
            };
            const int first = 1, last = count - 2;
            line[static_cast<size_t>(first)] = end(first);
            line[static_cast<size_t>(last)] = end(last);
            double before = line[static_cast<size_t>(first)];
            for (int i = first + 1; i < last; ++i) {
                const auto k = static_cast<size_t>(i);
                before = line[k] = (6 * value(i) - before) * pivots[k];
            }
            for (int i = last - 1; i > first; --i) {
                const auto k = static_cast<size_t>(i);
                line[k] -= pivots[k] * line[k + 1];
            }
            for (int i = first; i <= last; ++i)
                s[i * stride] = static_cast<float>(line[static_cast<size_t>(i)]);
        });
    }
}

} // namespace eikonal::scene
