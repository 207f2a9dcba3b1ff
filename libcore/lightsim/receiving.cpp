// Which voxels receive light: those where something scatters it, and what is round them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/receiving.h"

#include <algorithm>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;
using scene::Object;
using scene::Region;
using volume::BrickGrid;
using volume::kBrick;
using volume::kBrickVoxels;

// Light is looked up between voxels [voxel].
constexpr int kLookUps = 1;
// A round of smoothing draws from so many voxels on either side.
constexpr int kSmoothing = 2;

struct Range {
    float least, most;
};

/// Of a brick's values, those outside the domain included.
Range rangeOf(const BrickGrid& grid, size_t brick) {
    const auto components = static_cast<size_t>(grid.components);
    const bool even = grid.page[brick] < 0;
    const float* first = even ? grid.even.data() + brick * components
                              : grid.values.data() + static_cast<size_t>(grid.page[brick]) *
                                                         kBrickVoxels * components;
    const auto [least, most] =
        std::minmax_element(first, first + (even ? 1 : kBrickVoxels) * components);
    return {*least, *most};
}

bool isAnywhere(const scene::Values& values, size_t brick) {
    return values.varies() ? rangeOf(values.grid, brick).most > 0 : !values.isZero();
}

/// Whether something that scatters light is in a brick, of sharp boundaries within `reach`
/// of it, as far as distances are known.
bool isLit(const scene::Scene& scene, size_t brick, float reach) {
    const Region& medium = scene.medium();
    if (!scene.sharp) return isAnywhere(medium.scattering, brick);
    bool outside = true; // of all objects, somewhere
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        const Object& object = scene.objects[k];
        const Region& region = scene.regions[k];
        const Range range = rangeOf(object.distance, brick);
        const float near = std::min(reach, object.band);
        outside &= range.most > -near;
        if (range.least >= near) continue;
        if (!region.opaque && !region.scattering.isZero()) return true;
    }
    return outside && !medium.scattering.isZero();
}

/// How many bricks round those that are lit receive, too.
int bricksRound(const scene::Scene& scene, int reach) {
    float known = scene.sharp ? static_cast<float>(reach) : 0.0f;
    for (const Object& object : scene.objects) known = std::min(known, object.band);
    return (reach - static_cast<int>(known) + kBrick - 1) / kBrick;
}

/// Marks what is at most so many bricks off a marked one, along each axis.
void widen(std::vector<std::uint8_t>& marks, ivec3 bricks, int by) {
    const std::ptrdiff_t strides[] = {1, bricks.x, std::ptrdiff_t{bricks.x} * bricks.y};
    for (int axis = 0; axis < 3; ++axis)
        for (int round = 0; round < by; ++round) {
            const std::vector<std::uint8_t> old = marks;
            for (size_t i = 0; i < old.size(); ++i) {
                const auto place =
                    static_cast<int>(static_cast<std::ptrdiff_t>(i) / strides[axis]) % bricks[axis];
                const auto stride = static_cast<size_t>(strides[axis]);
                if (place > 0) marks[i] |= old[i - stride];
                if (place + 1 < bricks[axis]) marks[i] |= old[i + stride];
            }
        }
}

} // namespace

std::int64_t ReceivingBricks::voxels() const {
    return static_cast<std::int64_t>(list.size()) * kBrickVoxels;
}

ReceivingBricks receivingBricks(const scene::Scene& scene, const Params& params) {
    const ivec3 first = scene.domain.firstBrick();
    ReceivingBricks found{first, (scene.size() - first + kBrick - 1) / kBrick, {}};
    std::vector<std::uint8_t> marks(static_cast<size_t>(found.bricks.x) * found.bricks.y *
                                    found.bricks.z);
    const int reach = kLookUps + kSmoothing * params.smoothing;
    tbb::parallel_for(size_t{0}, marks.size(), [&](size_t brick) {
        marks[brick] = !params.automaticOutputs || isLit(scene, brick, static_cast<float>(reach));
    });
    if (params.automaticOutputs) widen(marks, found.bricks, bricksRound(scene, reach));
    for (size_t brick = 0; brick < marks.size(); ++brick)
        if (marks[brick] != 0) found.list.push_back(static_cast<std::uint32_t>(brick));
    return found;
}

} // namespace eikonal::lightsim
