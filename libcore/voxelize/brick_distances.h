// The distances of a brick's voxels to the faces near it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/nearest_of_four.h"
#include "mesh/triangle_mesh.h"
#include "volume/bricks.h"
#include "voxelize/near_faces.h"

#include <limits>

namespace eikonal::voxelize {

/// What bounds a solid, in index space [voxel], by the faces' places in an order: where faces that
/// lie near each other are side by side, so is what a brick asks for.
struct BoundaryFaces {
    std::vector<std::array<glm::dvec3, 3>> corners;
    std::vector<std::array<mesh::EdgeCurve, 3>> sides; ///< none: all faces are flat
    std::vector<FaceFrame> frames;
    double bulge = 0; ///< the greatest of the faces'

    BoundaryFaces(const mesh::TriangleMesh& boundary, const std::vector<std::uint32_t>& order);

    mesh::CurvedFace curved(std::uint32_t place) const { return {corners[place], sides[place]}; }
};

/// The nearest of the faces asked so far.
struct NearestFace {
    /// Faces are told apart by more than doubles' rounding [voxel].
    static constexpr double kRounding = 1e-9;

    double distance = std::numeric_limits<double>::max();
    double height = 0; ///< of the voxel above it

    /// Of two faces at whose edge the nearest point lies the one that the voxel is more before or
    /// behind tells the side.
    void take(const mesh::CurvedFace::Nearest& face);
};

/// Halves a brick twice; cubes of two measure flat faces in float, which tells the few faces that
/// may be nearest to a voxel, and those are asked in double, four at once.
class BrickDistances {
public:
    /// Voxels further off than `halfWidth` [voxel] are not measured.
    BrickDistances(const BoundaryFaces& faces, double halfWidth)
        : mFaces(faces), mHalfWidth(halfWidth) {}

    /// Of the brick at `low`, x fastest; `near` has all faces that may be nearest to a voxel of it.
    /// A voxel that is not measured, or at `end` or beyond, keeps the greatest distance there is.
    const std::array<NearestFace, volume::kBrickVoxels>&
    measure(const glm::ivec3& low, const glm::ivec3& end, const std::vector<std::uint32_t>& near);

private:
    /// A cube of two, and where its faces begin among those of all.
    struct Cube {
        glm::ivec3 offset; ///< in the brick
        size_t first, count;
        NearFaces::Nearest nearest;
        unsigned measured; ///< which of its voxels
    };
    struct Asked {
        size_t voxel;
        std::uint32_t face;
    };
    static glm::ivec3 offsetOf(unsigned voxel) {
        return {voxel & 1, voxel >> 1 & 1, voxel >> 2 & 1};
    }

    void measureQuarter(const glm::ivec3& offset, const glm::ivec3& size);
    void beginCube(const glm::ivec3& offset, const glm::ivec3& size);
    void askNearest(const Cube& cube);
    void askOthers(const Cube& cube);
    void ask(size_t voxel, std::uint32_t face);
    void answer();

    const BoundaryFaces& mFaces;
    double mHalfWidth;
    glm::ivec3 mLow{0}; ///< of the brick
    NearFaces mOfBrick, mOfQuarter;
    std::vector<std::uint32_t> mList, mLists; ///< of a cube of two, and of all in a quarter
    std::vector<EightFloats> mSquares;        ///< by the same places
    std::vector<std::uint8_t> mMasks;         ///< by the places of one cube
    std::vector<Cube> mCubes;
    Asked mAsked[4];
    int mWaiting = 0;
    std::array<NearestFace, volume::kBrickVoxels> mFound;
};

} // namespace eikonal::voxelize
