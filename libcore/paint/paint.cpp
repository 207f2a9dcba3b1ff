// A volume's materials changed by hand: noise, brushes, other volumes' grids.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint/paint.h"

#include "base/error.h"
#include "base/text.h"
#include "paint/noise.h"
#include "volume/contract.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <tbb/parallel_for.h>

namespace eikonal::paint {

namespace {

using volume::DenseGrid;
using volume::Volume;

/// Grids that a brush has, and that add up where media mix.
const std::vector<std::string> kStamped = {"absorption", "scattering", "emission"};

/// Where a voxel's values are among the grid's.
size_t placeOf(const DenseGrid& grid, const glm::ivec3& p) {
    const size_t voxel =
        (static_cast<size_t>(p.z) * static_cast<size_t>(grid.size.y) + static_cast<size_t>(p.y)) *
            static_cast<size_t>(grid.size.x) +
        static_cast<size_t>(p.x);
    return voxel * static_cast<size_t>(grid.components);
}

/// One grid of the volume while it is painted.
class Canvas {
public:
    Canvas(const Volume& volume, const std::string& name)
        : mName(name), mFrame(volume.frame()), mBox(volume.domain()) {
        const std::string base = name.substr(0, name.find('.'));
        const bool one = base == "ior" || base == "reflectance";
        mBackground = volume.background(name, glm::vec3(one ? 1.0f : 0.0f));
        const bool vector = volume::ruleFor(base)->type == volume::GridType::vector;
        mGrid.size = mBox.size();
        mGrid.components = vector ? 3 : 1;
        const auto count =
            static_cast<size_t>(mBox.voxels()) * static_cast<size_t>(mGrid.components);
        DenseGrid held;
        if (volume.has(name)) held = volume.dense(name, mBox);
        if (held.components == mGrid.components && !held.values.empty()) {
            mGrid = std::move(held);
            return;
        }
        mGrid.values.resize(count);
        for (size_t i = 0; i < count; ++i) // grey, or none
            mGrid.values[i] = held.values.empty()
                                  ? mBackground[static_cast<int>(i % 3) * (vector ? 1 : 0)]
                                  : held.values[i / 3];
    }

    /// Calls `stroke(world, values, components)` for every voxel of a box of the world, or of all.
    template<typename Stroke>
    void paint(const Stroke& stroke, const glm::dvec3* low = nullptr,
               const glm::dvec3* high = nullptr) {
        glm::ivec3 from(0), to = mGrid.size;
        if (low) {
            glm::dvec3 least(1e30), most(-1e30);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 x(corner & 1 ? high->x : low->x, corner & 2 ? high->y : low->y,
                                   corner & 4 ? high->z : low->z);
                const glm::dvec3 i = mFrame.indexFromWorld() * glm::dvec4(x, 1);
                least = glm::min(least, i - glm::dvec3(mBox.min));
                most = glm::max(most, i - glm::dvec3(mBox.min));
            }
            const glm::dvec3 size(mGrid.size);
            from = glm::ivec3(glm::floor(glm::clamp(least, glm::dvec3(0), size)));
            to = glm::ivec3(glm::ceil(glm::clamp(most + 1.0, glm::dvec3(0), size)));
        }
        tbb::parallel_for(from.z, std::max(to.z, from.z), [&](int z) {
            for (int y = from.y; y < to.y; ++y)
                for (int x = from.x; x < to.x; ++x) {
                    const glm::dvec3 world =
                        mFrame.worldFromIndex *
                        glm::dvec4(glm::dvec3(mBox.min + glm::ivec3(x, y, z)), 1);
                    stroke(world, mGrid.values.data() + placeOf(mGrid, {x, y, z}));
                }
        });
    }

    int components() const { return mGrid.components; }

    /// Cuts to the contract's range, where its ends are valid, and puts the grid back; gives how
    /// many voxels were cut. Throws DataError where a value is beyond an end that is not valid.
    std::int64_t finish(Volume& volume) {
        const volume::GridRule& rule = *volume::ruleFor(mName);
        const float infinity = std::numeric_limits<float>::infinity();
        const float least = rule.leastOpen ? -infinity : rule.least;
        const float most = rule.mostOpen ? infinity : rule.most;
        std::atomic<std::int64_t> cut = 0;
        const auto components = static_cast<size_t>(mGrid.components);
        tbb::parallel_for(size_t(0), mGrid.voxels(), [&](size_t voxel) {
            bool changed = false;
            for (size_t c = 0; c < components; ++c) {
                float& value = mGrid.values[voxel * components + c];
                const float inside = std::clamp(value, least, most);
                changed |= inside != value;
                value = inside;
            }
            if (changed) ++cut;
        });
        if (const auto fault = volume::findFault(&rule, mGrid, mBox.min))
            throw DataError(volume.path() + ": painted, '" + mName + "' " + *fault);
        volume::PutOptions options;
        options.background = mBackground;
        options.allActive = true;
        if (components == 3) options.vectorType = "color";
        volume.put(mName, mBox, mGrid, options);
        return cut;
    }

private:
    std::string mName;
    volume::Frame mFrame;
    volume::IndexBox mBox;
    glm::vec3 mBackground;
    DenseGrid mGrid;
};

void paintNoise(Canvas& canvas, const Noise& noise) {
    canvas.paint([&](const glm::dvec3& world, float* values) {
        const double factor = std::max(
            0.0, 1 + noise.amount * fractalNoise(world / noise.size, noise.octaves, noise.seed));
        for (int c = 0; c < canvas.components(); ++c)
            values[c] = static_cast<float>(factor * static_cast<double>(values[c]));
    });
}

void paintSphere(Canvas& canvas, const Sphere& sphere) {
    const glm::dvec3 low = sphere.centre - sphere.radius, high = sphere.centre + sphere.radius;
    canvas.paint(
        [&](const glm::dvec3& world, float* values) {
            const double away = glm::length(world - sphere.centre) / sphere.radius;
            if (away >= 1) return;
            const double t = sphere.soft > 0 ? std::min((1 - away) / sphere.soft, 1.0) : 1;
            const double weight = t * t * (3 - 2 * t);
            for (int c = 0; c < canvas.components(); ++c)
                values[c] += static_cast<float>(weight * sphere.value[c]);
        },
        &low, &high);
}

/// A brush's grid, open for look-ups.
class Brush {
public:
    Brush(const Volume& volume, const std::string& grid, const glm::dmat4& worldFromBrush)
        : mBox(volume.domain()), mGrid(volume.dense(grid, mBox)),
          mBackground(volume.background(grid, glm::vec3(0))),
          mWorldFromIndex(worldFromBrush * volume.frame().worldFromIndex),
          mIndexFromWorld(glm::inverse(mWorldFromIndex)) {}

    /// What its values are above its background at a place, linear between voxels; 0 beyond them.
    glm::dvec3 at(const glm::dvec3& world) const {
        const glm::dvec3 x =
            glm::dvec3(mIndexFromWorld * glm::dvec4(world, 1)) - glm::dvec3(mBox.min);
        const glm::dvec3 low = glm::floor(x), t = x - low;
        glm::dvec3 sum(0);
        if (glm::any(glm::lessThan(low, glm::dvec3(-1))) ||
            glm::any(glm::greaterThanEqual(low, glm::dvec3(mGrid.size))))
            return sum;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 d(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::ivec3 p = glm::ivec3(low) + d;
            if (glm::any(glm::lessThan(p, glm::ivec3(0))) ||
                glm::any(glm::greaterThanEqual(p, mGrid.size)))
                continue;
            double weight = 1;
            for (int axis = 0; axis < 3; ++axis) weight *= d[axis] ? t[axis] : 1 - t[axis];
            const float* values = mGrid.values.data() + placeOf(mGrid, p);
            for (int c = 0; c < 3; ++c)
                sum[c] += weight * static_cast<double>(values[mGrid.components == 1 ? 0 : c] -
                                                       mBackground[c]);
        }
        return sum;
    }

    /// The box of the world beyond which it is 0.
    void bounds(glm::dvec3& low, glm::dvec3& high) const {
        low = glm::dvec3(1e30);
        high = -low;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 index(corner & 1 ? mBox.max.x + 1 : mBox.min.x - 1,
                                   corner & 2 ? mBox.max.y + 1 : mBox.min.y - 1,
                                   corner & 4 ? mBox.max.z + 1 : mBox.min.z - 1);
            const glm::dvec3 world = mWorldFromIndex * glm::dvec4(index, 1);
            low = glm::min(low, world);
            high = glm::max(high, world);
        }
    }

private:
    volume::IndexBox mBox;
    DenseGrid mGrid;
    glm::vec3 mBackground;
    glm::dmat4 mWorldFromIndex, mIndexFromWorld;
};

void paintStamp(Canvas& canvas, const Brush& brush) {
    glm::dvec3 low, high;
    brush.bounds(low, high);
    canvas.paint(
        [&](const glm::dvec3& world, float* values) {
            const glm::dvec3 more = brush.at(world);
            for (int c = 0; c < canvas.components(); ++c) values[c] += static_cast<float>(more[c]);
        },
        &low, &high);
}

/// Whose grids may be named: objects with values of their own, and what surrounds them.
class Owners {
public:
    Owners(const Volume& volume, std::string object)
        : mPath(volume.path()), mObject(std::move(object)) {
        for (const volume::ObjectFacts& facts : volume.objects())
            if (volume.has(volume::ownGrid("ior", facts.name))) mNames.push_back(facts.name);
        if (!mNames.empty()) mNames.push_back(volume::kMedium);
        if (!mObject.empty()) requireName(mObject);
    }

    /// A grid's name in the file.
    std::string whole(const std::string& grid) const {
        const size_t dot = grid.find('.');
        if (dot != std::string::npos) {
            requireName(grid.substr(dot + 1));
            return grid;
        }
        if (!mObject.empty()) return volume::ownGrid(grid, mObject);
        if (mNames.empty()) return grid;
        std::vector<std::string> own;
        for (const std::string& name : mNames) own.push_back(volume::ownGrid(grid, name));
        throw DataError(mPath + ": found objects with values of their own, expected one of " +
                        join(own, ", ") + ", or --object");
    }

private:
    void requireName(const std::string& name) const {
        if (std::find(mNames.begin(), mNames.end(), name) == mNames.end())
            throw DataError(mPath + ": no object '" + name + "' with values of its own (found: " +
                            (mNames.empty() ? "none" : join(mNames, ", ")) + ")");
    }

    std::string mPath, mObject;
    std::vector<std::string> mNames;
};

} // namespace

void Params::check() const {
    if (noises.empty() && spheres.empty() && stamps.empty())
        throw UsageError("nothing to paint: expected --noise, --sphere or --stamp");
}

std::vector<std::string> run(Volume& volume, const Params& params, Stats& stats) {
    const Owners owners(volume, params.object);
    std::vector<std::string> warnings;
    std::vector<std::pair<std::string, Canvas>> canvases;
    const auto canvasOf = [&](const std::string& grid) -> Canvas& {
        const std::string name = owners.whole(grid);
        for (auto& [known, canvas] : canvases)
            if (known == name) return canvas;
        canvases.emplace_back(name, Canvas(volume, name));
        return canvases.back().second;
    };
    for (const Noise& noise : params.noises) {
        if (!volume.has(owners.whole(noise.grid)))
            warnings.push_back("--noise " + noise.grid +
                               ": there is no such grid: its default is multiplied");
        paintNoise(canvasOf(noise.grid), noise);
    }
    for (const Sphere& sphere : params.spheres) paintSphere(canvasOf(sphere.grid), sphere);
    for (const Stamp& stamp : params.stamps) {
        const Volume brush = Volume::open(stamp.path);
        bool any = false;
        for (const std::string& grid : kStamped) {
            if (!brush.has(grid)) continue;
            any = true;
            paintStamp(canvasOf(grid), Brush(brush, grid, stamp.worldFromBrush));
        }
        if (!any)
            throw DataError(stamp.path + ": found no grid of a brush, expected one of " +
                            join(kStamped, ", ") + " (sim2vol makes them of a density)");
    }
    for (auto& [name, canvas] : canvases) {
        const std::int64_t cut = canvas.finish(volume);
        stats.count("grids", 1);
        if (cut == 0) continue;
        stats.count("voxels_cut", static_cast<double>(cut));
        warnings.push_back("'" + name + "' was cut to its range in " + std::to_string(cut) +
                           (cut == 1 ? " voxel" : " voxels"));
    }
    return warnings;
}

} // namespace eikonal::paint
