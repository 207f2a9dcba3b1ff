// Plain solids: box, sphere, prism.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/solids.h"

#include "base/error.h"
#include "base/text.h"
#include "mesh/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace eikonal::shapes {

using mesh::TriangleMesh;
using std::numbers::pi;

void BoxParams::check() const {
    for (int axis = 0; axis < 3; ++axis)
        requireOption(high[axis] > low[axis], "--to", toText(high[axis]) + " along " + "XYZ"[axis],
                      "more than " + toText(low[axis]) + ", which --from has there");
    const glm::dvec3 size = high - low;
    const double most = 0.5 * std::min({size.x, size.y, size.z});
    requireOption(bevel >= 0 && bevel < most, "--bevel", toText(bevel),
                  "0 or more, below half the shortest side, " + toText(most));
    requireOption(segments >= 2 && segments <= 256 && segments % 2 == 0, "--segments",
                  std::to_string(segments), "an even number from 2 to 256");
}

namespace {

/// A box of lattice lines, whose bevels' lines are as far apart in angle: each point of a face lies
/// in the direction, from the box within that is smaller by the bevel, of its place on the lattice.
class BevelledBox {
public:
    explicit BevelledBox(const BoxParams& params)
        : mLow(params.low + params.bevel), mHigh(params.high - params.bevel), mBevel(params.bevel),
          mHalf(params.segments / 2), mLast(2 * mHalf + 1) {}

    TriangleMesh make() {
        for (int axis = 0; axis < 3; ++axis)
            for (const int end : {0, mLast})
                for (int i = 0; i < mLast; ++i)
                    for (int j = 0; j < mLast; ++j) addQuad(axis, end, i, j);
        return std::move(mBox);
    }

private:
    /// Off the box within, as a share of the bevel, along one axis.
    double offset(int place) const {
        const int outward = place <= mHalf ? place - mHalf : place - mHalf - 1;
        return std::tan(pi / 4 * outward / mHalf);
    }
    std::uint32_t point(const glm::ivec3& place) {
        const auto [found, isNew] = mPoints.try_emplace({place.x, place.y, place.z},
                                                        static_cast<std::uint32_t>(mPoints.size()));
        if (!isNew) return found->second;
        glm::dvec3 base, off;
        for (int axis = 0; axis < 3; ++axis) {
            base[axis] = place[axis] <= mHalf ? mLow[axis] : mHigh[axis];
            off[axis] = offset(place[axis]);
        }
        mNormals.push_back(glm::normalize(off));
        mBox.points.push_back(base + mBevel * mNormals.back());
        return found->second;
    }
    void addQuad(int axis, int end, int i, int j) {
        std::array<std::uint32_t, 4> corners{};
        for (int k = 0; k < 4; ++k) {
            glm::ivec3 place;
            place[axis] = end;
            place[(axis + 1) % 3] = i + (k == 1 || k == 2);
            place[(axis + 2) % 3] = j + (k >= 2);
            corners[static_cast<size_t>(k)] = point(place);
        }
        if (end == 0) std::swap(corners[1], corners[3]);
        for (const auto& [b, c] : {std::pair{1u, 2u}, {2u, 3u}}) {
            mBox.triangles.emplace_back(corners[0], corners[b], corners[c]);
            mBox.normals.push_back({glm::vec3(mNormals[corners[0]]),
                                    glm::vec3(mNormals[corners[b]]),
                                    glm::vec3(mNormals[corners[c]])});
        }
    }

    glm::dvec3 mLow, mHigh;
    double mBevel;
    int mHalf, mLast; ///< lines of half a bevel, and the last line's number
    std::map<std::array<int, 3>, std::uint32_t> mPoints;
    std::vector<glm::dvec3> mNormals;
    TriangleMesh mBox;
};

} // namespace

TriangleMesh makeBox(const BoxParams& params) {
    if (params.bevel > 0) return BevelledBox(params).make();
    TriangleMesh box;
    for (unsigned corner = 0; corner < 8; ++corner)
        box.points.emplace_back((corner & 1 ? params.high : params.low).x,
                                (corner & 2 ? params.high : params.low).y,
                                (corner & 4 ? params.high : params.low).z);
    for (const auto& quad : {std::array{0u, 2u, 3u, 1u},
                             {4u, 5u, 7u, 6u},
                             {0u, 1u, 5u, 4u},
                             {2u, 6u, 7u, 3u},
                             {0u, 4u, 6u, 2u},
                             {1u, 3u, 7u, 5u}})
        mesh::appendTriangles(box.points, {quad.begin(), quad.end()}, box.triangles);
    return box;
}

void SphereParams::check() const {
    requireOption(radius > 0 && std::isfinite(radius), "--radius", toText(radius), "above 0");
    requireOption(segments >= 4 && segments <= 8192 && segments % 2 == 0, "--segments",
                  std::to_string(segments), "an even number from 4 to 8192");
}

TriangleMesh makeSphere(const SphereParams& params) {
    const auto around = static_cast<std::uint32_t>(params.segments), down = around / 2;
    TriangleMesh sphere;
    sphere.points.emplace_back(0, params.radius, 0);
    for (std::uint32_t j = 1; j < down; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const double t = pi * j / down, p = 2 * pi * i / around;
            sphere.points.push_back(params.radius * glm::dvec3(std::sin(t) * std::sin(p),
                                                               std::cos(t),
                                                               std::sin(t) * std::cos(p)));
        }
    sphere.points.emplace_back(0, -params.radius, 0);
    const std::uint32_t last = 1 + (down - 1) * around, lowest = last - around;
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t next = (i + 1) % around;
        sphere.triangles.emplace_back(0, 1 + i, 1 + next);
        for (std::uint32_t j = 0; j + 2 < down; ++j) {
            const std::uint32_t a = 1 + j * around;
            mesh::appendTriangles(sphere.points,
                                  {a + i, a + around + i, a + around + next, a + next},
                                  sphere.triangles);
        }
        sphere.triangles.emplace_back(last, lowest + next, lowest + i);
    }
    return sphere;
}

void PrismParams::check() const {
    requireOption(sides >= 3 && sides <= 4096, "--sides", std::to_string(sides), "3 to 4096");
    requireOption(side > 0 && std::isfinite(side), "--side", toText(side), "above 0");
    requireOption(length > 0 && std::isfinite(length), "--length", toText(length), "above 0");
    if (!apex) return;
    requireOption(*apex > 0 && *apex < 180, "--angle", toText(*apex), "above 0, below 180 degrees");
    if (sides != 3)
        throw UsageError("--angle: belongs to a prism of 3 sides, not " + std::to_string(sides));
}

TriangleMesh makePrism(const PrismParams& params) {
    std::vector<glm::dvec2> corners;
    if (params.apex) {
        const double height = params.side / 2 / std::tan(*params.apex * pi / 360);
        corners = {
            {0, height * 2 / 3}, {-params.side / 2, -height / 3}, {params.side / 2, -height / 3}};
    } else {
        const double radius = params.side / 2 / std::sin(pi / params.sides);
        for (int k = 0; k < params.sides; ++k) {
            const double a = pi / 2 + 2 * pi * k / params.sides;
            corners.push_back(radius * glm::dvec2(std::cos(a), std::sin(a)));
        }
    }
    const auto count = static_cast<std::uint32_t>(corners.size());
    TriangleMesh prism;
    std::vector<std::uint32_t> back, front;
    for (const double end : {-0.5, 0.5})
        for (const glm::dvec2& corner : corners)
            prism.points.emplace_back(corner, end * params.length);
    for (std::uint32_t k = 0; k < count; ++k) {
        back.push_back((count - k) % count);
        front.push_back(count + k);
    }
    mesh::appendTriangles(prism.points, back, prism.triangles);
    mesh::appendTriangles(prism.points, front, prism.triangles);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t next = (k + 1) % count;
        mesh::appendTriangles(prism.points, {k, next, count + next, count + k}, prism.triangles);
    }
    mesh::setFlatNormals(prism);
    return prism;
}

} // namespace eikonal::shapes
