// Faces near a few voxels, and their distances from there, eight at once and in float.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/curved_face.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::voxelize {

/// A triangle in axes of its own, the first along its longest side, the third across it, and how
/// thick a plate on it holds the curved face [voxel].
struct FaceFrame {
    glm::dvec3 origin; ///< the corner where the longest side begins, on the plate's lower side
    /// Three axes; the longest side's length; direction and length of the side from its end to the
    /// third corner, then of that from the origin to the third corner, along the first two axes;
    /// the plate's thickness.
    std::array<float, 17> numbers;
    double aside = 0; ///< how far the curved face may be off the plate
    double bulge = 0; ///< how far it may be off the triangle

    FaceFrame() = default;
    explicit FaceFrame(const std::array<glm::dvec3, 3>& corners);
    /// Makes the plate as thick as the curved face needs it.
    void bend(const std::array<mesh::EdgeCurve, 3>& sides);
    float longest() const { return numbers[9]; }
    float thickness() const { return numbers[16]; }
};

/// Eight numbers, of which a processor takes one each for eight voxels or faces.
struct alignas(32) EightFloats {
    float at[8];
};

/// Faces about a place, by which all positions are told. A distance in float, and to the plate, is
/// more than the true one by at most the face's slack, and less by that and the plate's thickness.
class NearFaces {
public:
    /// Takes others, of those with frames, about a place.
    void assign(const std::vector<std::uint32_t>& faces, const std::vector<FaceFrame>& frames,
                const glm::dvec3& place);

    size_t size() const { return mFaces.size(); }
    std::uint32_t face(size_t i) const { return mFaces[i]; }
    float slack(size_t i) const { return mGroups[i / 8].numbers[kSlack].at[i % 8]; }
    /// By how much a distance may be off the true one, over all faces.
    float mostOff() const { return mMostOff; }

    /// Measures from x to all plates and gives the square of the least distance.
    float measureFrom(const glm::vec3& x);
    /// Makes `near` those that, as last measured, may be as near as `reach`.
    void keepWithin(float reach, NearFaces& near) const;
    /// The same by their numbers.
    void listWithin(float reach, std::vector<std::uint32_t>& near) const;

    /// The nearest of some faces for each of eight places.
    struct Nearest {
        EightFloats squared;
        std::int32_t place[8]; ///< in the list
    };
    /// From the eight voxels of a cube of two, x fastest, the first at `low`; of each face of the
    /// list the squared distances go to `squares`.
    Nearest measureCube(const glm::vec3& low, const std::vector<std::uint32_t>& list,
                        EightFloats* squares) const;
    /// Which of `count` faces of a list may be as near as `reach` to each of the eight: bit k of a
    /// face's mask for the k-th.
    void markWithin(const EightFloats& reach, const std::uint32_t* list, size_t count,
                    const EightFloats* squares, std::uint8_t* masks) const;

private:
    static constexpr int kAxes = 3; ///< behind the origin
    static constexpr int kThickness = kAxes + 16;
    static constexpr int kSlack = kAxes + 17; ///< behind the frame's numbers
    static constexpr int kNumbers = kSlack + 1;

    struct Group {
        EightFloats numbers[kNumbers];
    };
    friend struct FaceLanes;

    size_t groups() const { return (mFaces.size() + 7) / 8; }
    /// Takes faces' numbers after the others'; `seal` ends that.
    Group& grow(std::uint32_t face, float slack, float thickness);
    /// Fills the last group up with faces far away.
    void seal();
    /// Calls `act` with the places of those that, as last measured, may be as near as `reach`.
    template<typename Act> void forEachWithin(float reach, const Act& act) const;

    std::vector<Group> mGroups; ///< may be more than are used
    std::vector<std::uint32_t> mFaces;
    std::vector<EightFloats> mSquares; ///< as last measured, and more
    float mMostOff = 0;
};

} // namespace eikonal::voxelize
