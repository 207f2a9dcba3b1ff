// Faces near a few voxels, and their distances from there, eight at once and in float.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/near_faces.h"

#include "mesh/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <limits>

namespace eikonal::voxelize {

using glm::dvec3;
using mesh::eight;
using mesh::Float8;
using mesh::Int8;

namespace {

/// v over its length, or a direction where there is none.
dvec3 directionOf(const dvec3& v, const dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0 ? v / length : otherwise;
}

dvec3 acrossFrom(const dvec3& direction) {
    const dvec3 aside = std::abs(direction.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    return glm::normalize(glm::cross(direction, aside));
}

EIKONAL_LANES_PART Float8 loaded(const EightFloats& from) {
    Float8 to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

EIKONAL_LANES_PART void store(const Float8& from, EightFloats& to) {
    std::memcpy(&to, &from, sizeof from);
}

EIKONAL_LANES_PART Float8 square(const Float8& x) {
    return x * x;
}

/// How far `x` is off what is from 0 to `length`.
EIKONAL_LANES_PART Float8 past(const Float8& x, const Float8& length) {
    return x - mesh::lesser(mesh::greater(x, eight(0)), length);
}

} // namespace

FaceFrame::FaceFrame(const std::array<dvec3, 3>& corners) : origin(corners[0]) {
    size_t k = 0; // where the longest side begins
    for (size_t i = 1; i < 3; ++i)
        if (glm::distance(corners[i], corners[(i + 1) % 3]) >
            glm::distance(corners[k], corners[(k + 1) % 3]))
            k = i;
    origin = corners[k];
    const dvec3 ab = corners[(k + 1) % 3] - origin, ac = corners[(k + 2) % 3] - origin;
    const dvec3 first = directionOf(ab, dvec3(1, 0, 0)),
                third = directionOf(glm::cross(ab, ac), acrossFrom(first)),
                second = glm::cross(third, first);
    const double length = glm::length(ab), x = glm::dot(ac, first), y = glm::dot(ac, second);
    const dvec3 bc = directionOf(dvec3(x - length, y, 0), dvec3(1, 0, 0)),
                ca = directionOf(dvec3(x, y, 0), dvec3(1, 0, 0));
    const auto put = [&](size_t at, std::initializer_list<double> some) {
        for (const double number : some) numbers[at++] = static_cast<float>(number);
    };
    put(0, {first.x, first.y, first.z, second.x, second.y, second.z, third.x, third.y, third.z});
    put(9, {length, bc.x, bc.y, std::hypot(x - length, y), ca.x, ca.y, std::hypot(x, y), 0});
}

void FaceFrame::bend(const std::array<mesh::EdgeCurve, 3>& sides) {
    const auto axis = [&](size_t k) { return dvec3(numbers[k], numbers[k + 1], numbers[k + 2]); };
    const dvec3 first = axis(0), second = axis(3), third = axis(6);
    // What it is off the flat face lies among its control points as a cubic of Bézier's.
    double low = 0, high = 0;
    const auto include = [&](const dvec3& off) {
        const double height = glm::dot(off, third);
        low = std::min(low, height);
        high = std::max(high, height);
        aside = std::max(aside, std::hypot(glm::dot(off, first), glm::dot(off, second)));
    };
    for (const auto& [rise, skew] : sides) {
        include((4.0 * rise + skew) / 3.0);
        include((4.0 * rise - skew) / 3.0);
    }
    include(2.0 / 3 * (sides[0].rise + sides[1].rise + sides[2].rise));
    origin += low * third;
    numbers[16] = static_cast<float>(high - low);
}

/// The arithmetic, with one face for all lanes or one for each.
struct FaceLanes {
    struct OfEach {
        const EightFloats* numbers;
        EIKONAL_LANES_PART Float8 operator()(int k) const { return loaded(numbers[k]); }
    };
    struct OfOne {
        const EightFloats* numbers;
        std::uint32_t lane;
        EIKONAL_LANES_PART Float8 operator()(int k) const { return eight(numbers[k].at[lane]); }
    };
    /// `number(k)` is a face's or each lane's k-th.
    template<typename Number>
    EIKONAL_LANES_PART static Float8 squared(const Number& number, const Float8& x, const Float8& y,
                                             const Float8& z) {
        constexpr int k = NearFaces::kAxes;
        const Float8 dx = x - number(0), dy = y - number(1), dz = z - number(2);
        const Float8 u = dx * number(k) + dy * number(k + 1) + dz * number(k + 2);
        const Float8 v = dx * number(k + 3) + dy * number(k + 4) + dz * number(k + 5);
        const Float8 height = dx * number(k + 6) + dy * number(k + 7) + dz * number(k + 8);
        // Along each side, and how far within it.
        const Float8 length = number(k + 9), w = u - length;
        const Float8 alongSecond = w * number(k + 10) + v * number(k + 11),
                     withinSecond = v * number(k + 10) - w * number(k + 11);
        const Float8 alongThird = u * number(k + 13) + v * number(k + 14),
                     withinThird = u * number(k + 14) - v * number(k + 13);
        const Float8 first = square(past(u, length)) + square(v),
                     second = square(past(alongSecond, number(k + 12))) + square(withinSecond),
                     third = square(past(alongThird, number(k + 15))) + square(withinThird);
        const Float8 within = mesh::lesser(mesh::lesser(v, withinSecond), withinThird);
        const Float8 aside = mesh::lesser(mesh::lesser(first, second), third);
        return square(past(height, number(k + 16))) + (within >= eight(0) ? eight(0) : aside);
    }

    EIKONAL_LANES static void from(const NearFaces::Group* groups, size_t count, const float* x,
                                   EightFloats* squares) {
        const Float8 x0 = eight(x[0]), x1 = eight(x[1]), x2 = eight(x[2]);
        for (size_t i = 0; i < count; ++i) {
            store(squared(OfEach{groups[i].numbers}, x0, x1, x2), squares[i]);
        }
    }

    /// Bit k: lane k of a comparison holds.
    EIKONAL_LANES_PART static unsigned maskOf(const Int8& holds) {
        const Int8 bits = holds & Int8{1, 2, 4, 8, 16, 32, 64, 128};
        std::uint64_t pairs[4];
        std::memcpy(pairs, &bits, sizeof pairs);
        const std::uint64_t all = (pairs[0] | pairs[1]) | (pairs[2] | pairs[3]);
        return static_cast<unsigned>(all | all >> 32) & 0xff;
    }

    /// Where squared distances, less slack, are at most `reach`.
    EIKONAL_LANES_PART static unsigned within(const Float8& squares, const Float8& reach,
                                              const Float8& slack) {
        const Float8 most = reach + slack;
        return maskOf(squares <= most * most);
    }

    EIKONAL_LANES static void mark(const NearFaces::Group* groups, const EightFloats* squares,
                                   size_t count, float reach, std::uint8_t* masks) {
        const Float8 reaches = eight(reach);
        for (size_t i = 0; i < count; ++i)
            masks[i] = static_cast<std::uint8_t>(
                within(loaded(squares[i]), reaches, loaded(groups[i].numbers[NearFaces::kSlack])));
    }

    EIKONAL_LANES static void markOfCube(const NearFaces::Group* groups, const std::uint32_t* list,
                                         const EightFloats* squares, size_t count,
                                         const EightFloats& reach, std::uint8_t* masks) {
        const Float8 reaches = loaded(reach);
        for (size_t i = 0; i < count; ++i) {
            const float slack = groups[list[i] / 8].numbers[NearFaces::kSlack].at[list[i] % 8];
            masks[i] = static_cast<std::uint8_t>(within(loaded(squares[i]), reaches, eight(slack)));
        }
    }

    EIKONAL_LANES static float least(const EightFloats* squares, size_t count) {
        Float8 least = eight(std::numeric_limits<float>::max());
        for (size_t i = 0; i < count; ++i) least = mesh::lesser(loaded(squares[i]), least);
        EightFloats all;
        store(least, all);
        return *std::min_element(all.at, all.at + 8);
    }

    EIKONAL_LANES static void fromCube(const NearFaces::Group* groups, const std::uint32_t* list,
                                       size_t count, const float* low, EightFloats* squares,
                                       NearFaces::Nearest& nearest) {
        const Float8 x = eight(low[0]) + Float8{0, 1, 0, 1, 0, 1, 0, 1},
                     y = eight(low[1]) + Float8{0, 0, 1, 1, 0, 0, 1, 1},
                     z = eight(low[2]) + Float8{0, 0, 0, 0, 1, 1, 1, 1};
        Float8 least = eight(std::numeric_limits<float>::max());
        Int8 place{}, at{};
        for (size_t i = 0; i < count; ++i) {
            const OfOne number{groups[list[i] / 8].numbers, list[i] % 8};
            const Float8 own = squared(number, x, y, z);
            store(own, squares[i]);
            const Int8 isLess = own < least;
            place = isLess ? at : place;
            least = isLess ? own : least;
            at += 1;
        }
        store(least, nearest.squared);
        std::memcpy(nearest.place, &place, sizeof place);
    }
};

NearFaces::Group& NearFaces::grow(std::uint32_t face, float slack, float thickness) {
    const size_t group = mFaces.size() / 8;
    if (group == mGroups.size()) mGroups.emplace_back();
    mFaces.push_back(face);
    mMostOff = std::max(mMostOff, slack + thickness);
    return mGroups[group];
}

void NearFaces::seal() {
    // Further than any distance that counts, and its square a float.
    constexpr float kAway = 1e15f;
    for (size_t lane = mFaces.size() % 8; lane % 8 != 0; ++lane) {
        Group& group = mGroups[mFaces.size() / 8];
        for (EightFloats& number : group.numbers) number.at[lane] = 0;
        group.numbers[0].at[lane] = kAway;
        group.numbers[kAxes + 6].at[lane] = 1; // across the face
    }
}

void NearFaces::assign(const std::vector<std::uint32_t>& faces,
                       const std::vector<FaceFrame>& frames, const dvec3& place) {
    // A float's last bit is 6e-8 of it; a distance is summed from about ten products of coordinates
    // of a face and of voxels up to a brick away.
    constexpr double kRounding = 4e-6, kAway = 8;
    mFaces.clear();
    mMostOff = 0;
    for (const std::uint32_t face : faces) {
        const FaceFrame& frame = frames[face];
        const dvec3 off = frame.origin - place;
        const double size = glm::length(off) + static_cast<double>(frame.longest()) + kAway;
        const auto slack = static_cast<float>(frame.aside + kRounding * size);
        const size_t lane = mFaces.size() % 8;
        Group& group = grow(face, slack, frame.thickness());
        for (int k = 0; k < 3; ++k) group.numbers[k].at[lane] = static_cast<float>(off[k]);
        for (size_t k = 0; k < frame.numbers.size(); ++k)
            group.numbers[kAxes + k].at[lane] = frame.numbers[k];
        group.numbers[kSlack].at[lane] = slack;
    }
    seal();
}

float NearFaces::measureFrom(const glm::vec3& x) {
    if (mSquares.size() < groups()) mSquares.resize(groups());
    FaceLanes::from(mGroups.data(), groups(), &x.x, mSquares.data());
    return FaceLanes::least(mSquares.data(), groups());
}

template<typename Act> void NearFaces::forEachWithin(float reach, const Act& act) const {
    constexpr size_t kSome = 64; // groups at a time
    std::uint8_t masks[kSome];
    for (size_t first = 0; first < groups(); first += kSome) {
        const size_t count = std::min(kSome, groups() - first);
        FaceLanes::mark(mGroups.data() + first, mSquares.data() + first, count, reach, masks);
        for (size_t i = 0; i < count; ++i)
            for (unsigned left = masks[i]; left != 0; left &= left - 1)
                act(8 * (first + i) + static_cast<size_t>(std::countr_zero(left)));
    }
}

void NearFaces::keepWithin(float reach, NearFaces& near) const {
    near.mFaces.clear();
    near.mMostOff = 0;
    forEachWithin(reach, [&](size_t i) {
        const size_t lane = near.size() % 8;
        const Group& from = mGroups[i / 8];
        Group& to = near.grow(mFaces[i], slack(i), from.numbers[kThickness].at[i % 8]);
        for (int k = 0; k < kNumbers; ++k) to.numbers[k].at[lane] = from.numbers[k].at[i % 8];
    });
    near.seal();
}

void NearFaces::listWithin(float reach, std::vector<std::uint32_t>& near) const {
    near.clear();
    forEachWithin(reach, [&](size_t i) { near.push_back(static_cast<std::uint32_t>(i)); });
}

NearFaces::Nearest NearFaces::measureCube(const glm::vec3& low,
                                          const std::vector<std::uint32_t>& list,
                                          EightFloats* squares) const {
    Nearest nearest;
    FaceLanes::fromCube(mGroups.data(), list.data(), list.size(), &low.x, squares, nearest);
    return nearest;
}

void NearFaces::markWithin(const EightFloats& reach, const std::uint32_t* list, size_t count,
                           const EightFloats* squares, std::uint8_t* masks) const {
    FaceLanes::markOfCube(mGroups.data(), list, squares, count, reach, masks);
}

} // namespace eikonal::voxelize
