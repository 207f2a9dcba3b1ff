// Objects' distances as splines on the device, where rays look them up.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/distance_atlas.h"

#include "scene/block_table.h"
#include "scene/lattice.h"
#include "scene/shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec3;
using volume::kBrick;

// Coefficients along an edge of a block: a cell's spline has one before it and two behind.
constexpr int kCoefficients = kBrick + 3;
static_assert(kCoefficients == kBlockRows && kBrick == kBlockCells);
// Samples that they are made from: two more on either side.
constexpr int kSamples = kCoefficients + 4;
// Rows that fill more than this are packed [byte].
constexpr std::int64_t kPlainBytes = std::int64_t{128} << 20;

std::int64_t blocksOf(const std::vector<Object>& objects) {
    std::int64_t blocks = 0;
    for (const Object& object : objects) blocks += static_cast<std::int64_t>(object.cells.size());
    return blocks;
}

/// The texels of a block.
ivec3 texelsOf(bool packed) {
    return {packed ? kPackedTexels : kBlockCells, kCoefficients, kCoefficients};
}

// A second difference above this is a kink's: a ball of two voxels' radius has it.
constexpr float kKink = 0.5f;

/// The second difference of samples along an axis. Where walls are thin distances have a kink
/// between both faces, which is not theirs to bend by: there it is the lesser of the neighbours'.
float bendOf(const float* s, size_t stride) {
    const auto at = [&](int i) { return s[i * static_cast<std::ptrdiff_t>(stride)]; };
    const auto second = [&](int i) { return at(i - 1) - 2 * at(i) + at(i + 1); };
    const float own = second(0);
    if (std::abs(own) <= kKink) return own;
    const float before = second(-1), behind = second(1);
    const float least = std::abs(before) < std::abs(behind) ? before : behind;
    return std::abs(least) <= kKink ? least : 0.0f;
}

/// Whether a sample in an edge or corner of its box is as near to boundaries on all of the box's
/// faces there: an edge of the object, where differences of distances tell no slope. `inner` is
/// the distance a voxel further in from all those faces.
bool isEdge(ivec3 p, ivec3 size, float distance, float inner, const vec3& rise) {
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis) faces += p[axis] == 0 || p[axis] == size[axis] - 1;
    const vec3 steep = glm::abs(rise);
    return faces > 1 && std::abs(distance) < kCornerWay && std::abs(distance - inner) > 0.5f &&
           std::max({steep.x, steep.y, steep.z}) < 0.5f;
}

/// An object's distances, carried on beyond the domain's faces.
class Samples {
public:
    explicit Samples(const volume::BrickGrid& grid) : mGrid(grid) {}

    /// Of a cube of voxels, x fastest.
    void copyCube(ivec3 low, int edge, float* out) const {
        mGrid.copyBox(low, ivec3(edge), out);
        const ivec3 last = mGrid.size - 1;
        if (low == glm::max(low, ivec3(0)) && low + edge - 1 == glm::min(low + edge - 1, last))
            return;
        for (int z = 0; z < edge; ++z)
            for (int y = 0; y < edge; ++y)
                for (int x = 0; x < edge; ++x, ++out) {
                    const ivec3 p = low + ivec3(x, y, z), in = glm::clamp(p, ivec3(0), last);
                    if (p != in) *out = beyond(p, in);
                }
    }

private:
    /// Linearly, from the voxel `in` on a face.
    float beyond(ivec3 p, ivec3 in) const {
        const ivec3 size = mGrid.size;
        const float own = mGrid.at(in);
        ivec3 side(0); // of the faces that `in` is on
        for (int axis = 0; axis < 3; ++axis)
            side[axis] = (in[axis] == size[axis] - 1) - (in[axis] == 0);
        const auto behind = [&](ivec3 step) {
            return mGrid.at(glm::clamp(in - step, ivec3(0), size - 1));
        };
        vec3 rise(0); // outward, over a voxel
        for (int axis = 0; axis < 3; ++axis) {
            ivec3 step(0);
            step[axis] = side[axis] == 0 ? 1 : side[axis];
            rise[axis] = own - behind(step);
        }
        const vec3 off(glm::abs(p - in));
        return own + (isEdge(in, size, own, behind(side), rise)
                          ? std::copysign(std::max({off.x, off.y, off.z}), -own)
                          : glm::dot(off, rise));
    }

    const volume::BrickGrid& mGrid;
};

/// A row of coefficients as if distances had no kink. Returns whether they have none there.
bool makeRow(const float* samples, float* out) {
    constexpr std::ptrdiff_t strides[] = {1, kSamples, kSamples * kSamples};
    float most = 0;
    for (int x = 0; x < kCoefficients; ++x) {
        const float* at = samples + x;
        float sum = *at;
        for (const std::ptrdiff_t stride : strides) {
            const float bend = at[-stride] - 2 * *at + at[stride];
            most = std::max(most, std::abs(bend));
            sum -= bend / 6;
        }
        out[x] = sum;
    }
    return most <= kKink;
}

/// The coefficients of a block's cells: c = s − δ²s/6 along each axis. Each is made from its
/// neighbours alone: they make a spline that follows any cubic exactly, and a crease or the band's
/// edge is felt no further off.
std::array<float, kCoefficients * kCoefficients * kCoefficients>
coefficientsOf(const Samples& samples, ivec3 block) {
    std::array<float, kSamples * kSamples * kSamples> s;
    samples.copyCube(kBrick * block - 4, kSamples, s.data());
    std::array<float, kCoefficients * kCoefficients * kCoefficients> c;
    for (int z = 0; z < kCoefficients; ++z)
        for (int y = 0; y < kCoefficients; ++y) {
            const float* from = s.data() + placeOf(ivec3(kSamples), 2, y + 2, z + 2);
            float* row = c.data() + placeOf(ivec3(kCoefficients), 0, y, z);
            if (makeRow(from, row)) continue;
            for (int x = 0; x < kCoefficients; ++x) {
                row[x] = from[x];
                for (const size_t stride : {1, kSamples, kSamples * kSamples})
                    row[x] -= bendOf(from + x, stride) / 6;
            }
        }
    return c;
}

/// Texel (x, y, z) of a block holds the coefficients x … x + 3 of row (y, z), or 4 x … 4 x + 3.
void writeBlock(const Samples& samples, ivec3 block, bool packed, float* texels, ivec3 slab) {
    const auto c = coefficientsOf(samples, block);
    for (int z = 0; z < kCoefficients; ++z)
        for (int y = 0; y < kCoefficients; ++y) {
            const float* row = c.data() + placeOf(ivec3(kCoefficients), 0, y, z);
            float* out = texels + 4 * placeOf(slab, 0, y, z);
            if (packed) std::copy(row, row + kCoefficients, out);
            for (int x = 0; !packed && x < kBlockCells; ++x, ++row, out += 4)
                std::copy(row, row + 4, out);
        }
}

struct Block {
    const Object* object;
    ivec3 place; ///< among the object's blocks
};

std::vector<Block> listBlocks(const std::vector<Object>& objects) {
    std::vector<Block> list;
    for (const Object& object : objects) {
        const ivec3 blocks = cellBlocks(object.distance.size);
        for (const std::uint32_t cell : object.cells)
            list.push_back({&object, atPlace(blocks, cell)});
    }
    return list;
}

/// The table of blocks as if none were near a boundary.
std::vector<std::uint32_t> farBlocks(const std::vector<Object>& objects, const BlockTable& table) {
    std::vector<std::uint32_t> places(table.entries(), kFarBlock);
    tbb::parallel_for(size_t{0}, objects.size(), [&](size_t k) {
        const volume::BrickGrid& grid = objects[k].distance;
        const ivec3 low = table.boxes[k].low, high = low + table.boxes[k].size;
        for (int z = low.z; z < high.z; ++z)
            for (int y = low.y; y < high.y; ++y)
                for (int x = low.x; x < high.x; ++x) {
                    const ivec3 first = glm::min(kBrick * ivec3(x, y, z), grid.size - 1);
                    if (grid.at(first) < 0) ++places[table.at(k, {x, y, z})];
                }
    });
    return places;
}

} // namespace

bool isPacked(const std::vector<Object>& objects) {
    const ivec3 texels = texelsOf(false);
    return blocksOf(objects) * texels.x * texels.y * texels.z * 16 > kPlainBytes;
}

DistanceAtlas::DistanceAtlas(gpu::Device& device, const std::vector<Object>& objects) {
    const bool packed = isPacked(objects);
    const ivec3 block = texelsOf(packed);
    const std::vector<Block> list = listBlocks(objects);
    const ivec3 atlas = atlasOf(static_cast<std::int64_t>(list.size()), block);
    const BlockTable table(objects);
    std::vector<std::uint32_t> places = farBlocks(objects, table);
    mCoefficients =
        gpu::Texture(device, atlas * block, gpu::TexelFormat::rgba32f, gpu::Filter::nearest);
    const ivec3 slab(atlas.x * block.x, atlas.y * block.y, block.z);
    std::vector<float> texels(4 * placeOf(slab, 0, 0, slab.z));
    const size_t inSlab = static_cast<size_t>(atlas.x) * atlas.y;
    for (int z = 0; z < atlas.z; ++z) {
        const size_t first = static_cast<size_t>(z) * inSlab;
        const size_t count = std::min(inSlab, list.size() - std::min(first, list.size()));
        tbb::parallel_for(size_t{0}, count, [&](size_t i) {
            const Block& one = list[first + i];
            const auto x = static_cast<int>(i) % atlas.x, y = static_cast<int>(i) / atlas.x;
            const auto k = static_cast<size_t>(one.object - objects.data());
            places[table.at(k, one.place)] = static_cast<std::uint32_t>(x | y << 10 | z << 20);
            writeBlock(Samples(one.object->distance), one.place, packed,
                       texels.data() + 4 * placeOf(slab, x * block.x, y * block.y, 0), slab);
        });
        mCoefficients.uploadSlices(z * block.z, block.z, texels.data());
    }
    mBlocks = gpu::Texture(device, table.size, gpu::TexelFormat::r32ui, gpu::Filter::nearest);
    mBlocks.upload(places.data());
}

void DistanceAtlas::bind() const {
    mBlocks.bindSampler(kBlocksUnit);
    mCoefficients.bindSampler(kDistancesUnit);
}

std::vector<gpu::Need> atlasNeeds(const std::vector<Object>& objects) {
    const ivec3 block = texelsOf(isPacked(objects));
    const ivec3 atlas = block * atlasOf(blocksOf(objects), block), table = BlockTable(objects).size;
    return {{"the boundaries' distances", std::int64_t{atlas.x} * atlas.y * atlas.z * 16, false,
             std::max({atlas.x, atlas.y, atlas.z})},
            {"the table of their blocks", std::int64_t{table.x} * table.y * table.z * 4, false,
             std::max({table.x, table.y, table.z})}};
}

} // namespace eikonal::scene
