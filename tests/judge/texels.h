// Light laid down on a plane's texels by patches, each texel getting its share of their area.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <thread>
#include <vector>

namespace judge {

using glm::dvec2;
using glm::dvec3;

/// A rectangle of a plane y = const in square texels, by x and z.
struct Texels {
    dvec2 low{-1};                ///< corner of the first texel [unit]
    double edge = 1;              ///< of a texel [unit]
    glm::ivec2 size{0};           ///< in texels
    std::vector<double> values{}; ///< x fastest; irradiance, where it is not said to be power

    Texels(dvec2 low, dvec2 high, double texelsPerUnit);
    bool holds(const dvec2& at) const;
    /// Of the texel that holds a place; 0 beyond.
    double at(const dvec2& place) const;
    double mean() const;
};

/// Adds power that is even over a triangle. One without an area gives it all along its longest
/// side.
void layTriangle(Texels& power, dvec2 a, dvec2 b, dvec2 c, double amount);

/// Where light with the coordinates (u, v) lands, and the power per du dv that it brings.
struct Landing {
    dvec2 at{0};
    double density = 0;
    bool lands = false; ///< false: it is shadowed, or does not come to the plane
};

/// How fine patches are: they are split while their middle is off the mean of their corners by more
/// than `bend`, while they are larger than `largest`, and where only some of their corners land,
/// but not once they bring less than `faint`.
struct Patching {
    glm::ivec2 cells{128};                 ///< before splitting
    double bend = 1.0 / 1024, largest = 4; ///< [texel]
    double faint = 1e-4;                   ///< [texel's area, at irradiance 1]
    int mostSplits = 9;
};

namespace detail {

template<typename Map> class Patches {
public:
    Patches(Texels& power, const Map& map, const Patching& how)
        : mPower(power), mMap(map), mHow(how) {}

    /// Corners: (low, low), (high, low), (low, high), (high, high).
    void lay(dvec2 low, dvec2 high, const Landing (&c)[4], int splits) {
        const int landed = c[0].lands + c[1].lands + c[2].lands + c[3].lands;
        const dvec2 middle = 0.5 * (low + high);
        if (landed == 0) return;
        const double area = (high.x - low.x) * (high.y - low.y);
        const double densest =
            std::max(std::max(c[0].density, c[1].density), std::max(c[2].density, c[3].density));
        const bool splittable =
            splits < mHow.mostSplits && area * densest > mHow.faint * mPower.edge * mPower.edge;
        if (landed < 4) {
            if (splittable) return split(low, high, c, splits);
            const Landing m = mMap(middle);
            if (m.lands) layTriangle(mPower, m.at, m.at, m.at, area * m.density);
            return;
        }
        const dvec2 least = glm::min(glm::min(c[0].at, c[1].at), glm::min(c[2].at, c[3].at));
        const dvec2 most = glm::max(glm::max(c[0].at, c[1].at), glm::max(c[2].at, c[3].at));
        // What is curved may bulge, by no more than it is wide.
        const dvec2 wide = most - least + mPower.edge;
        const dvec2 end = mPower.low + mPower.edge * dvec2(mPower.size);
        if (most.x + wide.x < mPower.low.x || most.y + wide.y < mPower.low.y ||
            least.x - wide.x > end.x || least.y - wide.y > end.y)
            return;
        if (splittable) {
            const double across = std::max(most.x - least.x, most.y - least.y);
            if (across > mHow.largest * mPower.edge) return split(low, high, c, splits);
            const Landing m = mMap(middle);
            const dvec2 off = m.at - 0.25 * (c[0].at + c[1].at + c[2].at + c[3].at);
            if (!m.lands || std::max(std::abs(off.x), std::abs(off.y)) > mHow.bend * mPower.edge)
                return split(low, high, c, splits);
        }
        triangle(c[0], c[1], c[2], area);
        triangle(c[3], c[2], c[1], area);
    }

private:
    void triangle(const Landing& a, const Landing& b, const Landing& c, double area) {
        layTriangle(mPower, a.at, b.at, c.at, area / 6 * (a.density + b.density + c.density));
    }

    void split(dvec2 low, dvec2 high, const Landing (&c)[4], int splits) {
        const dvec2 m = 0.5 * (low + high);
        const Landing bottom = mMap({m.x, low.y}), top = mMap({m.x, high.y});
        const Landing left = mMap({low.x, m.y}), right = mMap({high.x, m.y}), middle = mMap(m);
        lay(low, m, {c[0], bottom, left, middle}, splits + 1);
        lay({m.x, low.y}, {high.x, m.y}, {bottom, c[1], middle, right}, splits + 1);
        lay({low.x, m.y}, {m.x, high.y}, {left, middle, c[2], top}, splits + 1);
        lay(m, high, {middle, right, top, c[3]}, splits + 1);
    }

    Texels& mPower;
    const Map& mMap;
    const Patching& mHow;
};

} // namespace detail

/// Adds the power of all light with coordinates between `low` and `high`. `map` is a function from
/// coordinates to where that light lands.
template<typename Map>
void layPatches(Texels& power, dvec2 low, dvec2 high, const Patching& how, const Map& map) {
    const dvec2 cell = (high - low) / dvec2(how.cells);
    const auto layRow = [&](Texels& part, int j) {
        detail::Patches<Map> patches(part, map, how);
        const auto corner = [&](int i, int k) { return low + cell * dvec2(i, k); };
        Landing before = map(corner(0, j)), above = map(corner(0, j + 1));
        for (int i = 0; i < how.cells.x; ++i) {
            const Landing next = map(corner(i + 1, j)), aboveNext = map(corner(i + 1, j + 1));
            patches.lay(corner(i, j), corner(i + 1, j + 1), {before, next, above, aboveNext}, 0);
            before = next, above = aboveNext;
        }
    };
    // By so many parts, whatever threads there are, so that sums are the same.
    constexpr int kParts = 4;
    std::vector<Texels> parts(kParts, power);
    std::vector<std::thread> threads;
    for (int part = 0; part < kParts; ++part)
        threads.emplace_back([&, part] {
            Texels& own = parts[static_cast<size_t>(part)];
            own.values.assign(own.values.size(), 0);
            for (int j = part; j < how.cells.y; j += kParts) layRow(own, j);
        });
    for (std::thread& thread : threads) thread.join();
    for (const Texels& part : parts)
        for (size_t i = 0; i < power.values.size(); ++i) power.values[i] += part.values[i];
}

} // namespace judge
