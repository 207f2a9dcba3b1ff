// How a wavefront begins: a planar or spherical front of patches before the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/front_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;

// Cells of a front that are carried at a time.
constexpr std::int64_t kBatchCells = 1 << 18;

// How often a cell on the domain's outline is cut.
constexpr int kOutlineLevels = 3;

// A corner may miss the domain by rounding [voxel].
constexpr double kMissed = 1e-3;

/// A ray of the map.
struct MapRay {
    dvec3 origin, direction;
    double weight; ///< solid angle over that of a part of the map straight ahead
    double share;  ///< of the source's intensity that goes there
};

MapRay rayOf(const Window& window, const dvec2& at) {
    if (!window.point) return {at.x * window.right + at.y * window.up, window.forward, 1, 1};
    const dvec3 way = window.forward + at.x * window.right + at.y * window.up;
    const double q = 1 / (1 + glm::dot(at, at));
    const dvec3 direction = glm::normalize(way);
    return {window.origin, direction, q * std::sqrt(q), shareTowards(window.source, direction)};
}

/// Where a ray is within a box: from and to [voxel]; from > to if it misses.
dvec2 spanIn(const VoxelBox& box, const MapRay& ray) {
    dvec2 span(-std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
    for (int i = 0; i < 3; ++i) {
        const double o = ray.origin[i], d = ray.direction[i];
        if (d == 0) {
            if (o < box.low[i] || o > box.high[i]) return {1, 0};
            continue;
        }
        const double a = (box.low[i] - o) / d, b = (box.high[i] - o) / d;
        span = {std::max(span.x, std::min(a, b)), std::min(span.y, std::max(a, b))};
    }
    return span;
}

/// A light's front as it is made.
class Maker {
public:
    Maker(const Window& window, const VoxelBox& domain, double outside, double start, double factor,
          FrontBatch& batch)
        : mWindow(window), mDomain(domain), mWider{domain.low - kMissed, domain.high + kMissed},
          mOutside(outside), mStart(start), mFactor(factor), mBatch(batch) {}

    /// The patches of a cell, low and high corner.
    void add(const dvec2& low, const dvec2& high, int level = 0) {
        const std::array<dvec2, 4> corners{low, {high.x, low.y}, {low.x, high.y}, high};
        int seen = 0;
        for (const dvec2& corner : corners) seen += sees(mWider, corner) ? 1 : 0;
        const dvec2 middle = 0.5 * (low + high);
        if (seen == 4 || (level == kOutlineLevels && sees(mDomain, middle)))
            return put(corners, std::pow(0.25, level));
        if (level == kOutlineLevels || (seen == 0 && !sees(mDomain, middle))) return;
        for (int i = 0; i < 4; ++i) {
            const dvec2 part(i & 1 ? middle.x : low.x, i & 2 ? middle.y : low.y);
            add(part, part + 0.5 * (high - low), level + 1);
        }
    }

private:
    bool sees(const VoxelBox& box, const dvec2& at) const {
        const dvec2 span = spanIn(box, rayOf(mWindow, at));
        return span.x < span.y && (!mWindow.point || span.y > 0);
    }

    /// The integral of the solid angle from the view's axis to tangents, a quarter of a pyramid's.
    static double cornerAngle(double u, double v) {
        return std::atan2(u * v, std::sqrt(1 + u * u + v * v));
    }

    /// A cell's solid angle over what its corners' mean makes of it.
    double correction(const std::array<dvec2, 4>& corners, double mean) const {
        if (!mWindow.point) return 1;
        const dvec2 a = corners[0], b = corners[3];
        const double angle = cornerAngle(b.x, b.y) - cornerAngle(a.x, b.y) - cornerAngle(b.x, a.y) +
                             cornerAngle(a.x, a.y);
        return angle / ((b.x - a.x) * (b.y - a.y) * mean);
    }

    void put(const std::array<dvec2, 4>& corners, double share) {
        std::array<MapRay, 4> rays{};
        for (size_t i = 0; i < 4; ++i) rays[i] = rayOf(mWindow, corners[i]);
        double mean = 0, shines = 0;
        for (const MapRay& ray : rays) {
            mean += 0.25 * ray.weight;
            shines += 0.25 * ray.share;
        }
        if (shines == 0) return;
        const double scale = correction(corners, mean);
        for (const MapRay& ray : rays) {
            FrontCorner corner{};
            corner.place = vec4(ray.origin + mStart * ray.direction, 0);
            corner.wave = vec4(mOutside * ray.direction, 0);
            corner.weight = vec4(dvec3(scale * ray.weight * ray.share), 0);
            mBatch.corners.push_back(corner);
        }
        FrontPatch made{};
        made.state.y = kFrontGoes;
        made.flux = vec4(dvec3(scale * mean * shines * share * mFactor), 0);
        mBatch.patches.push_back(made);
        mBatch.flux += static_cast<double>(made.flux.x);
    }

    const Window& mWindow;
    VoxelBox mDomain, mWider;
    double mOutside, mStart, mFactor;
    FrontBatch& mBatch;
};

/// How far the front is from the light, or from its map's plane, when it comes to the domain
/// [voxel].
double startOf(const std::vector<Window>& windows, const VoxelBox& domain) {
    const Window& window = windows.front();
    if (window.startsAtLight) return 0;
    if (window.point)
        return glm::length(glm::clamp(window.origin, domain.low, domain.high) - window.origin);
    double nearest = std::numeric_limits<double>::max();
    for (int i = 0; i < 8; ++i) {
        const dvec3 corner(i & 1 ? domain.high.x : domain.low.x,
                           i & 2 ? domain.high.y : domain.low.y,
                           i & 4 ? domain.high.z : domain.low.z);
        nearest = std::min(nearest, glm::dot(corner, window.forward));
    }
    return nearest;
}

} // namespace

std::vector<FrontBatch> frontOf(const Source& source, const VoxelBox& domain,
                                const MapDetail& detail, double outside) {
    const std::vector<Window> windows = windowsOf(source, domain, domain, detail, dvec2(0), false);
    std::vector<FrontBatch> batches;
    if (windows.empty()) return batches;
    const double start = startOf(windows, domain), power = windows.front().pixelArea();
    std::int64_t cells = kBatchCells;
    for (const Window& window : windows) {
        const dvec2 edge = window.extent / dvec2(window.pixels);
        for (int j = 0; j < window.pixels.y; ++j)
            for (int i = 0; i < window.pixels.x; ++i) {
                if (cells++ == kBatchCells) {
                    batches.push_back({{}, {}, power, 0, window.point, window.startsAtLight});
                    cells = 1;
                }
                const dvec2 low = window.low + edge * dvec2(i, j);
                const double factor = window.pixelArea() / power;
                Maker(window, domain, outside, start, factor, batches.back()).add(low, low + edge);
            }
    }
    std::erase_if(batches, [](const FrontBatch& batch) { return batch.patches.empty(); });
    return batches;
}

} // namespace eikonal::lightsim
