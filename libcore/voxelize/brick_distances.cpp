// The distances of a brick's voxels to the faces near it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/brick_distances.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

using glm::dvec3;
using glm::ivec3;
using glm::vec3;

namespace {

constexpr int kQuarter = 4;
constexpr float kMiddle = (volume::kBrick - 1) / 2.0f; // of a brick, from its first voxel

float toCornerOf(int edge) {
    return std::sqrt(3.0f) * static_cast<float>(edge - 1) / 2;
}

bool isBeyond(const ivec3& offset, const ivec3& size) {
    return glm::any(glm::greaterThanEqual(offset, size));
}

size_t placeOf(const ivec3& offset) {
    return static_cast<size_t>((offset.z * volume::kBrick + offset.y) * volume::kBrick + offset.x);
}

} // namespace

BoundaryFaces::BoundaryFaces(const mesh::TriangleMesh& boundary,
                             const std::vector<std::uint32_t>& order)
    : corners(order.size()), frames(order.size()) {
    constexpr double kFlat = 1e-6; // what floats keep of distances
    std::vector<std::array<mesh::EdgeCurve, 3>> curves;
    if (!boundary.normals.empty()) {
        curves = mesh::edgeCurves(boundary);
        sides.resize(order.size());
    }
    const auto make = [&](size_t i) {
        const glm::uvec3& face = boundary.triangles[order[i]];
        corners[i] = {boundary.points[face.x], boundary.points[face.y], boundary.points[face.z]};
        frames[i] = FaceFrame(corners[i]);
        if (curves.empty()) return;
        sides[i] = curves[order[i]];
        const double own = mesh::CurvedFace(corners[i], sides[i]).bulge();
        if (own < kFlat) return;
        frames[i].bulge = own;
        frames[i].bend(sides[i]);
    };
    tbb::parallel_for(size_t{0}, corners.size(), make);
    for (const FaceFrame& frame : frames) bulge = std::max(bulge, frame.bulge);
}

void NearestFace::take(const mesh::CurvedFace::Nearest& face) {
    const double own = std::sqrt(face.squared), apart = own - distance;
    if (apart > kRounding || (apart > -kRounding && std::abs(face.height) <= std::abs(height)))
        return;
    distance = own;
    height = face.height;
}

const std::array<NearestFace, volume::kBrickVoxels>&
BrickDistances::measure(const ivec3& low, const ivec3& end,
                        const std::vector<std::uint32_t>& near) {
    mLow = low;
    mFound.fill({});
    mOfBrick.assign(near, mFaces.frames, dvec3(low) + static_cast<double>(kMiddle));
    for (unsigned i = 0; i < 8; ++i) measureQuarter(kQuarter * offsetOf(i), end - low);
    return mFound;
}

void BrickDistances::measureQuarter(const ivec3& offset, const ivec3& size) {
    if (isBeyond(offset, size)) return;
    const vec3 middle = vec3(offset) + (kQuarter - 1) / 2.0f - kMiddle;
    const float distance = std::sqrt(mOfBrick.measureFrom(middle)), toCorner = toCornerOf(kQuarter);
    if (distance > static_cast<float>(mHalfWidth) + toCorner + mOfBrick.mostOff()) return;
    mOfBrick.keepWithin(distance + 2 * toCorner + mOfBrick.mostOff(), mOfQuarter);
    mCubes.clear();
    mLists.clear();
    mSquares.clear();
    for (unsigned i = 0; i < 8; ++i) beginCube(offset + 2 * offsetOf(i), size);
    for (const Cube& cube : mCubes) askNearest(cube);
    answer();
    for (const Cube& cube : mCubes) askOthers(cube);
    answer();
}

/// Measures a cube's faces.
void BrickDistances::beginCube(const ivec3& offset, const ivec3& size) {
    if (isBeyond(offset, size)) return;
    const vec3 middle = vec3(offset) + 0.5f - kMiddle;
    const float distance = std::sqrt(mOfQuarter.measureFrom(middle)), toCorner = toCornerOf(2),
                off = mOfQuarter.mostOff(), most = static_cast<float>(mHalfWidth) + off;
    if (distance > most + toCorner) return;
    mOfQuarter.listWithin(distance + 2 * toCorner + off, mList);
    Cube cube{offset, mLists.size(), mList.size(), {}, 0};
    mLists.insert(mLists.end(), mList.begin(), mList.end());
    mSquares.resize(mLists.size());
    cube.nearest =
        mOfQuarter.measureCube(vec3(offset) - kMiddle, mList, mSquares.data() + cube.first);
    for (unsigned k = 0; k < 8; ++k)
        if (cube.nearest.squared.at[k] <= most * most && !isBeyond(offset + offsetOf(k), size))
            cube.measured |= 1u << k;
    if (cube.measured != 0) mCubes.push_back(cube);
}

/// Asks, for each voxel of a cube, the face whose plate is nearest.
void BrickDistances::askNearest(const Cube& cube) {
    for (unsigned left = cube.measured; left != 0; left &= left - 1) {
        const auto k = static_cast<unsigned>(std::countr_zero(left));
        ask(placeOf(cube.offset + offsetOf(k)),
            mOfQuarter.face(mLists[cube.first + static_cast<size_t>(cube.nearest.place[k])]));
    }
}

/// Asks the others that may be nearer.
void BrickDistances::askOthers(const Cube& cube) {
    EightFloats reach;
    for (unsigned k = 0; k < 8; ++k)
        reach.at[k] = static_cast<float>(
            std::min(mFound[placeOf(cube.offset + offsetOf(k))].distance, mHalfWidth));
    mMasks.resize(cube.count);
    const std::uint32_t* list = mLists.data() + cube.first;
    mOfQuarter.markWithin(reach, list, cube.count, mSquares.data() + cube.first, mMasks.data());
    for (size_t i = 0; i < cube.count; ++i)
        for (unsigned left = mMasks[i] & cube.measured; left != 0; left &= left - 1) {
            const auto k = static_cast<unsigned>(std::countr_zero(left));
            if (static_cast<size_t>(cube.nearest.place[k]) != i)
                ask(placeOf(cube.offset + offsetOf(k)), mOfQuarter.face(list[i]));
        }
}

void BrickDistances::ask(size_t voxel, std::uint32_t face) {
    const auto at = static_cast<unsigned>(mWaiting++);
    mAsked[at] = {voxel, face};
    if (mWaiting == 4) answer();
}

void BrickDistances::answer() {
    if (mWaiting == 0) return;
    mesh::FaceQuestion questions[4];
    for (int k = 0; k < 4; ++k) {
        const auto& [voxel, face] = mAsked[k < mWaiting ? k : 0];
        const auto n = static_cast<int>(voxel);
        questions[k] = {mFaces.corners[face].data(),
                        mFaces.sides.empty() ? nullptr : mFaces.sides[face].data(),
                        dvec3(mLow + ivec3(n % volume::kBrick, n / volume::kBrick % volume::kBrick,
                                           n / volume::kBrick / volume::kBrick))};
    }
    mesh::CurvedFace::Nearest answers[4];
    const unsigned again = mesh::nearestOfFour(questions, answers);
    for (int k = 0; k < mWaiting; ++k) {
        if (again >> k & 1) {
            const mesh::CurvedFace face = mFaces.curved(mAsked[k].face);
            answers[k] = face.nearest(questions[k].x, face.flatNearest(questions[k].x));
        }
        mFound[mAsked[k].voxel].take(answers[k]);
    }
    mWaiting = 0;
}

} // namespace eikonal::voxelize
