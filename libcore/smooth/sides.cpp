// Where a grid's values are those of one object or of the medium alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/sides.h"

#include <algorithm>

namespace eikonal::smooth {

namespace {

constexpr double kValid = 4; // beyond a boundary, by the contract [voxel]

/// What of a grid's name stands before the dot, and behind it.
std::pair<std::string, std::string> parts(const std::string& grid) {
    const size_t dot = grid.find('.');
    return {grid.substr(0, dot), dot == std::string::npos ? "" : grid.substr(dot + 1)};
}

/// Whether the grid is one of those that objects may have of their own.
bool isMaterial(const std::string& grid) {
    static constexpr const char* kGrids[] = {"ior",        "dispersion", "absorption",
                                             "scattering", "anisotropy", "emission",
                                             "opacity",    "albedo",     "reflectance"};
    return std::find(std::begin(kGrids), std::end(kGrids), grid) != std::end(kGrids);
}

} // namespace

Sides::Sides(const volume::Volume& volume) : mVolume(volume), mObjects(volume.objects()) {}

/// 1 inside the object, or outside it (`side` 1 or -1), and as far beyond its boundary as its band
/// and the contract reach.
std::vector<float> Sides::countsBy(const volume::ObjectFacts& object, float side) const {
    const double band = mVolume.background(object.sdf, glm::vec3(0)).x;
    const auto most = static_cast<float>(std::min(band, kValid * mVolume.frame().voxelSize));
    std::vector<float> counts = mVolume.dense(object.sdf, mVolume.domain()).values;
    for (float& value : counts) value = side * value < most ? 1.0f : 0.0f;
    return counts;
}

std::vector<float> Sides::countsOf(const std::string& grid) const {
    const auto [base, name] = parts(grid);
    if (!isMaterial(base)) return {};
    std::vector<float> counts;
    for (const volume::ObjectFacts& object : mObjects) {
        // Several objects without values of their own share the unsuffixed ones.
        const bool shares = name.empty() && !mVolume.has(volume::ownGrid("ior", object.name));
        const bool around = name == volume::kMedium;
        if (!shares && !around && (name.empty() || name != object.name)) continue;
        const std::vector<float> more = countsBy(object, around ? -1.0f : 1.0f);
        counts.resize(more.size(), around ? 1.0f : 0.0f);
        for (size_t i = 0; i < more.size(); ++i)
            counts[i] = around ? std::min(counts[i], more[i]) : std::max(counts[i], more[i]);
    }
    return counts;
}

} // namespace eikonal::smooth
