// Scene volumes in memory, by formula, for the tests of light and view.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/device.h"
#include "volume/volume.h"

#include <functional>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace eikonal {

/// A volume of `size` voxels whose domain's low corner is the world's origin before `placed` moves
/// it. All voxels of every grid are active, so that the domain is the whole box.
class TestVolume {
public:
    using Scalar = std::function<double(glm::dvec3)>;
    using Vector = std::function<glm::dvec3(glm::dvec3)>;

    explicit TestVolume(glm::ivec3 size, double voxelSize = 1,
                        const glm::dmat4& placed = glm::dmat4(1))
        : mSize(size), mVoxelSize(voxelSize), mVolume(frameOf(voxelSize, placed)) {}

    /// A grid whose value at a voxel is that of the function at the voxel's centre, measured from
    /// the domain's low corner [unit], before `placed`.
    TestVolume& add(const std::string& grid, const Scalar& value, double background = 0) {
        return put(grid, 1, background, [&](glm::dvec3 p) { return glm::dvec3(value(p)); });
    }
    TestVolume& addVector(const std::string& grid, const Vector& value) {
        return put(grid, 3, grid == "reflectance" ? 1 : 0, value);
    }
    TestVolume& constant(const std::string& grid, double value) {
        return add(
            grid, [=](glm::dvec3) { return value; }, grid == "ior" ? 1 : 0);
    }
    TestVolume& constantVector(const std::string& grid, const glm::dvec3& value) {
        return addVector(grid, [=](glm::dvec3) { return value; });
    }
    /// The index, surrounded by `outside`.
    TestVolume& index(const Scalar& n, double outside = 1) { return add("ior", n, outside); }

    const volume::Volume& volume() const { return mVolume; }
    volume::Volume take() { return std::move(mVolume); }

private:
    static volume::Frame frameOf(double h, const glm::dmat4& placed) {
        volume::Frame frame;
        frame.voxelSize = h;
        frame.worldFromIndex = placed * glm::translate(glm::dmat4(1), glm::dvec3(0.5 * h)) *
                               glm::scale(glm::dmat4(1), glm::dvec3(h));
        return frame;
    }

    TestVolume& put(const std::string& grid, int components, double background,
                    const Vector& value) {
        volume::DenseGrid dense;
        dense.size = mSize;
        dense.components = components;
        for (int z = 0; z < mSize.z; ++z)
            for (int y = 0; y < mSize.y; ++y)
                for (int x = 0; x < mSize.x; ++x) {
                    const glm::dvec3 v = value((glm::dvec3(x, y, z) + 0.5) * mVoxelSize);
                    for (int c = 0; c < components; ++c)
                        dense.values.push_back(static_cast<float>(v[c]));
                }
        volume::PutOptions options;
        options.background = glm::vec3(static_cast<float>(background));
        options.allActive = true;
        mVolume.put(grid, {glm::ivec3(0), mSize - 1}, dense, options);
        return *this;
    }

    glm::ivec3 mSize;
    double mVoxelSize;
    volume::Volume mVolume;
};

/// The value of a dense grid's voxel.
inline double at(const volume::DenseGrid& grid, const glm::ivec3& p, int component = 0) {
    const size_t voxel = (static_cast<size_t>(p.z) * grid.size.y + p.y) * grid.size.x + p.x;
    return grid.values[voxel * static_cast<size_t>(grid.components) + component];
}

inline double at(const volume::BrickGrid& grid, const glm::ivec3& p, int component = 0) {
    return static_cast<double>(grid.at(p, component));
}

/// Calls `visit` with every voxel of a box of that size.
template<typename Visit> void forEachVoxel(const glm::ivec3& size, const Visit& visit) {
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) visit(glm::ivec3(x, y, z));
}

} // namespace eikonal
