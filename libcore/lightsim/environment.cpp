// An environment map as a light: directions that stand for parts of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/environment.h"

#include "image/lat_long.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;

constexpr double kPi = 3.14159265358979323846;

// Cells along a map's height at least: a map of few pixels is cut between them, too.
constexpr int kLeastCells = 256;

/// A rectangle of cells.
struct Part {
    ivec2 low{0}, high{0}; ///< the upper bounds are excluded
    double power = 0;      ///< mean of rgb [W/m²]
    double worth = 0;      ///< the one of most is cut first; 0: it can't be cut
};

/// The power that comes from each cell of a map, which is as fine as its pixels or finer, and sums
/// of it.
class PowerMap {
public:
    explicit PowerMap(const image::Image& map)
        : mSize(std::max(map.width, 2 * kLeastCells), std::max(map.height, kLeastCells)) {
        const auto cells = static_cast<size_t>(mSize.x) * static_cast<size_t>(mSize.y);
        mPower.reserve(cells);
        for (int y = 0; y < mSize.y; ++y)
            for (int x = 0; x < mSize.x; ++x)
                mPower.emplace_back(solidAngle(y) * image::radianceAt(map, middleOf({x, y})));
        mSums.assign(static_cast<size_t>(mSize.x + 1) * static_cast<size_t>(mSize.y + 1), 0);
        for (int y = 0; y < mSize.y; ++y) {
            double row = 0;
            for (int x = 0; x < mSize.x; ++x) {
                const dvec3 power = powerOf({x, y});
                row += (power.x + power.y + power.z) / 3;
                mSums[at(x + 1, y + 1)] = mSums[at(x + 1, y)] + row;
            }
        }
    }
    ivec2 size() const { return mSize; }
    /// Radiance times solid angle [W/m²].
    dvec3 powerOf(const ivec2& cell) const {
        return mPower[static_cast<size_t>(cell.y) * static_cast<size_t>(mSize.x) +
                      static_cast<size_t>(cell.x)];
    }
    /// The middle of a cell, in the map's frame.
    dvec3 directionOf(const ivec2& cell) const { return image::directionOf(middleOf(cell)); }
    double sum(const ivec2& low, const ivec2& high) const {
        return mSums[at(high.x, high.y)] - mSums[at(low.x, high.y)] - mSums[at(high.x, low.y)] +
               mSums[at(low.x, low.y)];
    }
    /// How far a part extends along and across circles of latitude [rad].
    dvec2 edgesOf(const Part& part) const {
        const dvec2 shares = dvec2(part.high - part.low) / dvec2(mSize);
        const double middle = 0.5 * (part.low.y + part.high.y) / mSize.y;
        return {2 * kPi * shares.x * std::sin(kPi * middle), kPi * shares.y};
    }
    Part part(const ivec2& low, const ivec2& high) const {
        Part part{low, high, sum(low, high), 0};
        const dvec2 edges = edgesOf(part);
        const ivec2 cells = high - low;
        if (cells.x > 1 || cells.y > 1) part.worth = part.power * std::max(edges.x, edges.y);
        return part;
    }

private:
    size_t at(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(mSize.x + 1) + static_cast<size_t>(x);
    }
    dvec2 middleOf(const ivec2& cell) const { return (dvec2(cell) + 0.5) / dvec2(mSize); }
    double solidAngle(int row) const {
        const double heights = std::cos(kPi * row / mSize.y) - std::cos(kPi * (row + 1) / mSize.y);
        return 2 * kPi / mSize.x * heights;
    }
    ivec2 mSize;
    std::vector<glm::vec3> mPower;
    std::vector<double> mSums;
};

/// Both halves of a part: as much power in one as in the other, as far as cells let.
std::array<Part, 2> cut(const PowerMap& map, const Part& part) {
    const dvec2 edges = map.edgesOf(part);
    const ivec2 cells = part.high - part.low;
    const int axis = cells.y == 1 || (cells.x > 1 && edges.x >= edges.y) ? 0 : 1;
    const auto upTo = [&](int place) {
        ivec2 high = part.high;
        high[axis] = place;
        return high;
    };
    int low = part.low[axis] + 1, high = part.high[axis] - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (2 * map.sum(part.low, upTo(middle)) < part.power)
            low = middle + 1;
        else
            high = middle;
    }
    ivec2 from = part.low;
    from[axis] = low;
    return {map.part(part.low, upTo(low)), map.part(from, part.high)};
}

Source sourceOf(const PowerMap& map, const Part& part, const Light& light, Keep keep) {
    dvec3 power(0), towards(0);
    for (int y = part.low.y; y < part.high.y; ++y)
        for (int x = part.low.x; x < part.high.x; ++x) {
            const dvec3 its = map.powerOf({x, y});
            power += its;
            towards += (its.x + its.y + its.z) * map.directionOf({x, y});
        }
    Source source;
    source.vector = -(glm::transpose(light.mapFromWorld) * glm::normalize(towards));
    const double share = glm::length(towards) / (power.x + power.y + power.z);
    source.rgb = light.rgb * power * (keep == Keep::irradiance ? share : 1.0);
    return source;
}

} // namespace

std::vector<Source> environmentSources(const Light& light, int count, Keep keep) {
    const PowerMap map(*light.map);
    const auto isLess = [](const Part& a, const Part& b) { return a.worth < b.worth; };
    // Four quarters of the horizon first: the middle of a whole circle is no direction.
    std::vector<Part> parts;
    const ivec2 size = map.size();
    for (int k = 0; k < 4; ++k)
        parts.push_back(map.part({size.x * k / 4, 0}, {size.x * (k + 1) / 4, size.y}));
    while (static_cast<int>(parts.size()) < count) {
        const auto most = std::max_element(parts.begin(), parts.end(), isLess);
        if (!(most->worth > 0)) break;
        const std::array<Part, 2> halves = cut(map, *most);
        *most = halves[0];
        parts.push_back(halves[1]);
    }
    std::vector<Source> sources;
    for (const Part& part : parts)
        if (part.power > 0) sources.push_back(sourceOf(map, part, light, keep));
    return sources;
}

dvec3 upwardIrradiance(const Light& environment) {
    const PowerMap map(*environment.map);
    const dvec3 up = environment.mapFromWorld * dvec3(0, 1, 0);
    dvec3 sum(0);
    for (int y = 0; y < map.size().y; ++y)
        for (int x = 0; x < map.size().x; ++x)
            sum += map.powerOf({x, y}) * std::max(glm::dot(map.directionOf({x, y}), up), 0.0);
    return environment.rgb * sum;
}

} // namespace eikonal::lightsim
