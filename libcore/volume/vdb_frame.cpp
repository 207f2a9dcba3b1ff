// OpenVDB's transforms and our frames.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/vdb_frame.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace eikonal::volume {

openvdb::math::Transform::Ptr toTransform(const Frame& frame) {
    // OpenVDB's maps refuse a determinant below 3e-15.
    if (frame.voxelSize < kLeastVoxelSize)
        throw DataError("voxels of " + toText(frame.voxelSize) +
                        " units: OpenVDB holds none below " + toText(kLeastVoxelSize) +
                        "; expected a scene in a smaller unit");
    // OpenVDB's matrices act on row vectors and are stored by rows: the column-vector matrix as it
    // stands.
    return openvdb::math::Transform::createLinearTransform(
        openvdb::math::Mat4d(glm::value_ptr(frame.worldFromIndex)));
}

Frame toFrame(const openvdb::math::Transform& transform, const std::string& where) {
    // Rotations make voxel edges uneven by rounding; anything beyond this is meant.
    const double kTolerance = 1e-5;
    if (!transform.isLinear())
        throw DataError(where + ": its transform is not linear, expected uniform voxels");
    Frame frame;
    // The transpose of a matrix on row vectors, stored by rows, read by columns: as it stands.
    try {
        frame.worldFromIndex =
            glm::make_mat4(transform.baseMap()->getAffineMap()->getMat4().asPointer());
    } catch (const openvdb::Exception&) { // of the inverse, which OpenVDB computes at once
        throw DataError(where + ": its transform has no inverse, expected uniform voxels");
    }
    glm::dvec3 axes[3], lengths;
    for (int i = 0; i < 3; ++i) {
        axes[i] = glm::dvec3(frame.worldFromIndex[i]);
        lengths[i] = glm::length(axes[i]);
    }
    frame.voxelSize = std::cbrt(lengths.x * lengths.y * lengths.z);
    const double size = frame.voxelSize;
    if (!(size > 0) || !std::isfinite(size))
        throw DataError(where + ": its voxel size is " + toText(size) + ", expected above 0");
    for (int i = 0; i < 3; ++i)
        if (std::abs(lengths[i] / size - 1) > kTolerance ||
            std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kTolerance * size * size)
            throw DataError(where + ": its voxels are " + toText(lengths.x) + " x " +
                            toText(lengths.y) + " x " + toText(lengths.z) +
                            " units or skewed, expected cubes");
    return frame;
}

bool nearlyEqual(const Frame& a, const Frame& b) {
    const double kTolerance = 1e-6; // files carry doubles; some writers go through float
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) {
            const double scale =
                column == 3 ? std::max(std::abs(a.worldFromIndex[column][row]), a.voxelSize)
                            : a.voxelSize;
            if (std::abs(a.worldFromIndex[column][row] - b.worldFromIndex[column][row]) >
                kTolerance * scale)
                return false;
        }
    return true;
}

} // namespace eikonal::volume
