// Many small ellipsoids: flecks in a stone, bubbles, dust.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/flecks.h"

#include "base/error.h"
#include "base/text.h"
#include "mesh/triangle_tree.h"
#include "shapes/solids.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

namespace eikonal::shapes {

void FlecksParams::check() const {
    requireOption(count >= 1 && count <= 100000, "--count", std::to_string(count), "1 to 100000");
    requireOption(radius > 0 && std::isfinite(radius), "--radius", toText(radius), "above 0");
    requireOption(least > 0 && least <= 1, "--least", toText(least), "above 0, to 1");
    requireOption(flat > 0 && flat <= 1, "--flat", toText(flat), "above 0, to 1");
    SphereParams{1, segments}.check();
}

mesh::TriangleMesh makeFlecks(const FlecksParams& params, const mesh::TriangleMesh& within) {
    std::mt19937 random(params.seed);
    const auto draw = [&] { return static_cast<double>(random()) / 4294967296.0; };
    const mesh::TriangleTree tree(within);
    const mesh::Box box = mesh::boundingBox(within);
    const mesh::TriangleMesh ball = makeSphere({1, params.segments});
    struct Placed {
        glm::dvec3 centre;
        double reach;
    };
    std::vector<Placed> placed;
    mesh::TriangleMesh flecks;
    constexpr int most = 20000; // tries in a row that find no place
    for (int missed = 0; static_cast<int>(placed.size()) < params.count; ++missed) {
        if (missed == most)
            throw UsageError("--count: found " + std::to_string(params.count) +
                             ", but no place for more than " + std::to_string(placed.size()) +
                             " of --radius " + toText(params.radius));
        glm::dvec3 axes, centre;
        const double size = params.radius * (params.least + (1 - params.least) * draw());
        for (int axis = 0; axis < 3; ++axis) {
            axes[axis] = size * (params.flat + (1 - params.flat) * draw());
            centre[axis] = glm::mix(box.min[axis], box.max[axis], draw());
        }
        glm::dquat turn(1, 0, 0, 0);
        do // uniform among all turns, where it comes from a ball
            turn = {2 * draw() - 1, 2 * draw() - 1, 2 * draw() - 1, 2 * draw() - 1};
        while (glm::dot(turn, turn) > 1 || glm::dot(turn, turn) < 0.01);
        turn = glm::normalize(turn);
        const double reach = std::max({axes.x, axes.y, axes.z});
        if (tree.nearest(centre, reach * reach).face != mesh::TriangleTree::kNone ||
            tree.winding(centre) <= 0)
            continue;
        const auto touches = [&](const Placed& other) {
            return glm::length(other.centre - centre) <= other.reach + reach;
        };
        if (std::any_of(placed.begin(), placed.end(), touches)) continue;
        placed.push_back({centre, reach});
        missed = 0;
        mesh::TriangleMesh fleck = ball;
        for (glm::dvec3& p : fleck.points) p = centre + turn * (axes * p);
        mesh::append(flecks, fleck);
    }
    return flecks;
}

} // namespace eikonal::shapes
