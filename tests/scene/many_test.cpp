// What tables of boundaries hold of many objects: which are near, and which hold a place.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/block_table.h"
#include "scene/clearance.h"
#include "support/test_volume.h"

#include <bit>
#include <glm/geometric.hpp>
#include <glm/integer.hpp>
#include <gtest/gtest.h>
#include <random>

// The shaders' own sets, of 64 objects.
namespace sets {
using glm::bitCount;
using glm::findLSB;
using glm::uint;
using glm::uvec2;
#define OBJECTS 64
#define NEAR 8
#define inout
#include "transport/object_set.glsl"
#undef inout
} // namespace sets

using namespace eikonal;
using namespace eikonal::scene;
using glm::dvec3;
using glm::ivec3;

namespace {

// As shaders/shared/limits.h has it [voxel].
constexpr float kNear = 3.5f;

/// Balls of all sizes anywhere, cut by the domain's faces too, in bands of 6 voxels.
std::vector<Object> ballsIn(const ivec3& size, int count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> from0To1;
    TestVolume scene(size);
    scene.index([](dvec3) { return 1.5; });
    volume::Volume made = scene.take();
    const volume::IndexBox box{ivec3(0), size - 1};
    std::vector<Object> objects;
    for (int k = 0; k < count; ++k) {
        const dvec3 centre =
            dvec3(size) * dvec3(from0To1(random), from0To1(random), from0To1(random));
        const double radius = 3 + 9 * from0To1(random);
        volume::DenseGrid distances{size, 1, {}};
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    distances.values.push_back(
                        static_cast<float>(glm::length(dvec3(x, y, z) - centre) - radius));
        const std::string sdf = "sdf.b" + std::to_string(k);
        made.putLevelSet({"b" + std::to_string(k), sdf, 0, k}, box, distances, 6);
        objects.push_back(readObject(made, sdf, box));
    }
    return objects;
}

} // namespace

TEST(ManyObjects, EachCubeHasTheSetsOfWhatIsNearItAndHoldsIt) {
    const ivec3 size(40, 33, 26);
    for (const int count : {3, 4, 5, 64}) {
        const std::vector<Object> objects = ballsIn(size, count);
        const BoundaryTable table = tabulate(objects, size);
        ASSERT_EQ(table.edge, 1);
        EXPECT_EQ(areMany(objects), !table.sets.empty());
        int most = 0;
        size_t i = 0;
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x, ++i) {
                    ObjectSets wanted;
                    float nearest = 1e9f;
                    for (size_t k = 0; k < objects.size(); ++k) {
                        const float d = objects[k].distance.at({x, y, z});
                        nearest = std::min(nearest, std::abs(d));
                        if (std::abs(d) < kNear) wanted.near |= std::uint64_t{1} << k;
                        if (d < 0) wanted.inside |= std::uint64_t{1} << k;
                    }
                    const std::uint32_t entry = table.objects[i];
                    const ObjectSets found = areMany(objects)
                                                 ? table.sets[entry]
                                                 : ObjectSets{entry >> 16u, entry & 0xFFFFu};
                    ASSERT_EQ(found, wanted) << x << " " << y << " " << z;
                    most = std::max(most, std::popcount(wanted.near));
                    // Exact within the bands, but at the faces, where it is held back.
                    const ivec3 p(x, y, z);
                    if (nearest < 4 && p == glm::clamp(p, ivec3(1), size - 2)) {
                        ASSERT_EQ(table.clearance[i], nearest);
                    }
                }
        EXPECT_LE(most, mostNear(objects)); // what kernels have room for
        // Each pair of sets is there once.
        for (size_t a = 0; a < table.sets.size(); ++a)
            for (size_t b = 0; b < a; ++b) ASSERT_FALSE(table.sets[a] == table.sets[b]);
    }
}

TEST(ManyObjects, TablesOfBlocksReachAsFarAsEachObject) {
    const ivec3 size(40, 33, 26), blocks = cellBlocks(size);
    const std::vector<Object> objects = ballsIn(size, 40);
    const BlockTable table(objects);
    std::vector<bool> taken(table.entries());
    for (size_t k = 0; k < objects.size(); ++k) {
        const BlockRange& box = table.boxes[k];
        for (int z = 0; z < blocks.z; ++z)
            for (int y = 0; y < blocks.y; ++y)
                for (int x = 0; x < blocks.x; ++x) {
                    const ivec3 block(x, y, z), in = block - box.low;
                    const bool within = in == glm::clamp(in, ivec3(0), box.size - 1);
                    const auto number =
                        static_cast<std::uint32_t>((z * blocks.y + y) * blocks.x + x);
                    const auto& cells = objects[k].cells;
                    if (!within) { // it is outside, and its boundary is not near
                        EXPECT_EQ(std::count(cells.begin(), cells.end(), number), 0);
                        EXPECT_GT(objects[k].distance.at(glm::min(8 * block, size - 1)), 0);
                        continue;
                    }
                    const size_t entry = table.at(k, block);
                    ASSERT_LT(entry, table.entries());
                    EXPECT_FALSE(taken[entry]);
                    taken[entry] = true;
                }
    }
    // Of few objects each has the whole domain.
    const std::vector<Object> few(objects.begin(), objects.begin() + 2);
    EXPECT_EQ(BlockTable(few).size, ivec3(blocks.x, blocks.y, 2 * blocks.z));
}

TEST(ManyObjects, ListsFillRowsThenLayers) {
    EXPECT_EQ(rowsFor(0), ivec3(1));
    EXPECT_EQ(rowsFor(1024), ivec3(1024, 1, 1));
    EXPECT_EQ(rowsFor(1025), ivec3(1024, 2, 1));
    EXPECT_EQ(rowsFor((size_t{1} << 20) + 1), ivec3(1024, 1024, 2));
}

TEST(ManyObjects, SetsOfTwoWordsAreSetsOfSixtyFourBits) {
    std::mt19937_64 random(1);
    for (int times = 0; times < 1000; ++times) {
        // Some of few objects, some of most.
        std::uint64_t bits = random() & random();
        if (times % 2) bits &= random() & random();
        const glm::uvec2 set(static_cast<unsigned>(bits), static_cast<unsigned>(bits >> 32));
        EXPECT_EQ(sets::slotsOf(set), std::popcount(bits));
        EXPECT_EQ(sets::firstOf(set), std::countr_zero(bits)); // 64 of none
        for (int k = 0; k < 64; ++k) {
            const std::uint64_t bit = std::uint64_t{1} << k;
            const auto halves = [](std::uint64_t word) {
                return glm::uvec2(static_cast<unsigned>(word), static_cast<unsigned>(word >> 32));
            };
            EXPECT_EQ(sets::contains(set, k), (bits & bit) != 0);
            EXPECT_EQ(sets::toggled(set, k), halves(bits ^ bit));
            EXPECT_EQ(sets::changed(set, k, true), halves(bits | bit));
            EXPECT_EQ(sets::changed(set, k, false), halves(bits & ~bit));
            EXPECT_EQ(sets::slotOf(set, k), std::popcount(bits & (bit - 1)));
        }
    }
}
