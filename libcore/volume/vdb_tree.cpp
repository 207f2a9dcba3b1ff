// The trees of VDB grids as they lie in files. Knows nothing of OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/vdb_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

namespace eikonal::volume {

namespace {

// The compression flags of a grid.
constexpr std::uint32_t kZip = 1, kActiveMask = 2, kBlosc = 4;

// A root over nodes of 32³ over nodes of 16³ over leaves of 8³.
constexpr int kUpperLog2 = 5, kLowerLog2 = 4, kLeafLog2 = 3;
constexpr int kLowerEdge = 1 << (kLowerLog2 + kLeafLog2);
constexpr int kUpperEdge = kLowerEdge << kUpperLog2;
constexpr int kLeafEdge = 1 << kLeafLog2;
constexpr std::uint64_t kLeafVoxels = kLeafEdge * kLeafEdge * kLeafEdge;

/// A bit for each place of a node.
class Mask {
public:
    Mask(ByteReader& in, std::uint64_t places) : mWords(places / 64) {
        std::memcpy(mWords.data(), in.take(places / 8), places / 8);
    }
    bool isOn(std::uint64_t place) const { return mWords[place / 64] >> (place % 64) & 1; }
    std::uint64_t count() const {
        std::uint64_t on = 0;
        for (std::uint64_t word : mWords) on += static_cast<std::uint64_t>(std::popcount(word));
        return on;
    }
    bool overlaps(const Mask& other) const {
        for (size_t i = 0; i < mWords.size(); ++i)
            if (mWords[i] & other.mWords[i]) return true;
        return false;
    }
    template<typename Act> void forEachOn(const Act& act) const {
        for (size_t i = 0; i < mWords.size(); ++i)
            for (std::uint64_t word = mWords[i]; word; word &= word - 1)
                act(i * 64 + static_cast<std::uint64_t>(std::countr_zero(word)));
    }

private:
    std::vector<std::uint64_t> mWords;
};

using LeafMask = std::array<std::uint64_t, kLeafVoxels / 64>;

LeafMask leafMask(ByteReader& in) {
    LeafMask mask;
    std::memcpy(mask.data(), in.take(sizeof mask), sizeof mask);
    return mask;
}

std::uint64_t countOn(const LeafMask& mask) {
    std::uint64_t on = 0;
    for (std::uint64_t word : mask) on += static_cast<std::uint64_t>(std::popcount(word));
    return on;
}

IndexBox cube(const glm::ivec3& origin, int edge) {
    return {origin, origin + (edge - 1)};
}

/// A leaf's words are its slices in x, of eight rows in y of eight voxels in z.
IndexBox activeIn(const LeafMask& mask, const glm::ivec3& origin) {
    IndexBox box;
    std::uint64_t all = 0;
    glm::ivec3 low(kLeafEdge), high(-1);
    for (int x = 0; x < kLeafEdge; ++x) {
        if (mask[static_cast<size_t>(x)] == 0) continue;
        low.x = std::min(low.x, x);
        high.x = x;
        all |= mask[static_cast<size_t>(x)];
    }
    if (all == 0) return box;
    for (int bit = 0; bit < 64; ++bit)
        if (all >> bit & 1) {
            low.y = std::min(low.y, bit / 8);
            high.y = bit / 8;
            low.z = std::min(low.z, bit % 8);
            high.z = std::max(high.z, bit % 8);
        }
    return {origin + low, origin + high};
}

bool contains(const IndexBox& box, const IndexBox& other) {
    return !box.empty() && box.min.x <= other.min.x && box.min.y <= other.min.y &&
           box.min.z <= other.min.z && box.max.x >= other.max.x && box.max.y >= other.max.y &&
           box.max.z >= other.max.z;
}

/// Reads through a tree, and throws where it says what can't be.
class TreeReader {
public:
    TreeReader(ByteReader& in, const TreeLayout& layout) : mIn(in), mLayout(layout) {}

    TreeFacts tree() {
        if (mIn.value<std::int32_t>() != 1) throw VdbDamage("a tree has not one buffer");
        mIn.skip(mLayout.valueBytes); // the background
        const auto tiles = mIn.value<std::uint32_t>(), children = mIn.value<std::uint32_t>();
        for (std::uint32_t i = 0; i < tiles; ++i) rootTile();
        // OpenVDB keeps the children by their places, and reads the leaves' buffers in that order.
        for (std::uint32_t i = 0; i < children; ++i) {
            const glm::ivec3 origin = rootPlace();
            if (i > 0 && !before(mLast, origin))
                throw VdbDamage("nodes of a tree are out of order");
            mLast = origin;
            upperNode(origin);
        }
        const std::uint64_t buffers = mIn.position();
        for (const LeafMask& mask : mLeaves) leafBuffer(mask);
        return {mActive, buffers};
    }

private:
    static bool before(const glm::ivec3& a, const glm::ivec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }

    glm::ivec3 rootPlace() {
        glm::ivec3 origin;
        for (int i = 0; i < 3; ++i) origin[i] = mIn.value<std::int32_t>();
        for (int i = 0; i < 3; ++i)
            if (origin[i] & (kUpperEdge - 1)) throw VdbDamage("a node of a tree is out of place");
        return origin;
    }

    void rootTile() {
        const glm::ivec3 origin = rootPlace();
        mIn.skip(mLayout.valueBytes);
        if (isOn()) mActive.include(cube(origin, kUpperEdge));
    }

    bool isOn() {
        const auto flag = mIn.value<std::uint8_t>();
        if (flag > 1) throw VdbDamage("a flag in a tree is neither on nor off");
        return flag == 1;
    }

    /// Masks and tiles of an inner node; `child` is called with each child's origin.
    template<typename Child>
    void innerNode(const glm::ivec3& origin, int log2, int edge, const Child& child) {
        const std::uint64_t places = std::uint64_t{1} << (3 * log2);
        const Mask children(mIn, places), values(mIn, places);
        if (children.overlaps(values)) throw VdbDamage("a place in a tree is both node and value");
        nodeValues(places, values.count(), places / 8);
        const auto originOf = [&](std::uint64_t place) {
            const auto p = static_cast<int>(place);
            const int last = (1 << log2) - 1;
            return origin + edge * glm::ivec3(p >> (2 * log2), p >> log2 & last, p & last);
        };
        values.forEachOn(
            [&](std::uint64_t place) { mActive.include(cube(originOf(place), edge)); });
        children.forEachOn([&](std::uint64_t place) { child(originOf(place)); });
    }

    void upperNode(const glm::ivec3& origin) {
        innerNode(origin, kUpperLog2, kLowerEdge, [this](const glm::ivec3& at) { lowerNode(at); });
    }

    void lowerNode(const glm::ivec3& origin) {
        innerNode(origin, kLowerLog2, kLeafEdge, [this](const glm::ivec3& at) {
            mLeaves.push_back(leafMask(mIn));
            if (!contains(mActive, cube(at, kLeafEdge)))
                mActive.include(activeIn(mLeaves.back(), at));
        });
    }

    void leafBuffer(const LeafMask& mask) {
        // OpenVDB takes the number of values from one of the two or the other.
        if (leafMask(mIn) != mask) throw VdbDamage("a leaf's two masks differ");
        constexpr std::uint64_t kOriginBytes = 12;
        switch (mLayout.leaves) {
        case TreeLayout::Leaves::values:
            nodeValues(kLeafVoxels, countOn(mask), sizeof mask);
            break;
        case TreeLayout::Leaves::bits:
            mIn.skip(kOriginBytes + sizeof mask);
            break;
        case TreeLayout::Leaves::mask:
            mIn.skip(kOriginBytes);
            break;
        }
    }

    /// A node's array, where it may be stored without inactive values.
    void nodeValues(std::uint64_t places, std::uint64_t active, std::uint64_t maskBytes) {
        // How the inactive values are told: 0 to 5 as so many values and a mask that selects, 6
        // all.
        struct Told {
            std::uint64_t values;
            bool mask;
        };
        constexpr Told kTold[] = {{0, false}, {0, false}, {1, false}, {0, true},
                                  {1, true},  {2, true},  {0, false}};
        constexpr std::uint8_t kAll = 6;
        const auto told = mIn.value<std::uint8_t>();
        if (told > kAll) throw VdbDamage("a node tells its inactive values in no known way");
        mIn.skip(kTold[told].values * mLayout.valueBytes + (kTold[told].mask ? maskBytes : 0));
        const bool without = mLayout.compression & kActiveMask && told != kAll;
        chunk(without ? active : places);
    }

    void chunk(std::uint64_t values) {
        if (values == 0 && mLayout.half) return; // nothing is stored, not even a length
        const std::uint64_t wanted = values * mLayout.storedBytes;
        if (!(mLayout.compression & (kZip | kBlosc))) return mIn.skip(wanted);
        const auto length = mIn.value<std::int64_t>();
        if (length <= 0) { // stored as they are
            if (static_cast<std::uint64_t>(-(length + 1)) + 1 != wanted)
                throw VdbDamage("a node holds more or less values than it has room for");
            return mIn.skip(wanted);
        }
        const auto stored = static_cast<std::uint64_t>(length);
        if (mLayout.compression & kBlosc) return bloscChunk(stored, wanted);
        mIn.skip(stored); // zlib holds itself to the room it is given
    }

    /// Blosc trusts the header of a chunk for the chunk's length.
    void bloscChunk(std::uint64_t stored, std::uint64_t wanted) {
        struct Header {
            std::uint8_t version, codecVersion, flags, typeBytes;
            std::uint32_t bytes, blockBytes, compressedBytes;
        };
        if (stored < sizeof(Header)) throw VdbDamage("a compressed chunk has no header");
        const auto header = mIn.value<Header>();
        // A chunk of no bytes has blocks of one.
        if (header.bytes != wanted || header.compressedBytes != stored || header.typeBytes == 0 ||
            header.blockBytes == 0 || header.blockBytes > std::max(header.bytes, 1u))
            throw VdbDamage("a compressed chunk does not hold what its node has room for");
        mIn.skip(stored - sizeof(Header));
    }

    ByteReader& mIn;
    TreeLayout mLayout;
    IndexBox mActive;
    glm::ivec3 mLast{0};
    std::vector<LeafMask> mLeaves;
};

} // namespace

std::optional<TreeLayout> layoutOf(const std::string& type, bool half, std::uint32_t compression) {
    struct Known {
        const char* type;
        std::uint64_t bytes, halfBytes;
        TreeLayout::Leaves leaves;
    };
    using enum TreeLayout::Leaves;
    constexpr Known kKnown[] = {
        {"float", 4, 2, values},  {"double", 8, 2, values}, {"vec3s", 12, 6, values},
        {"vec3d", 24, 6, values}, {"int32", 4, 0, values},  {"int64", 8, 0, values},
        {"vec3i", 12, 0, values}, {"bool", 1, 0, bits},     {"mask", 1, 0, mask}};
    for (const Known& known : kKnown)
        if (type == "Tree_" + std::string(known.type) + "_5_4_3") {
            const bool inHalf = half && known.halfBytes > 0;
            return TreeLayout{known.leaves, known.bytes, inHalf ? known.halfBytes : known.bytes,
                              inHalf, compression};
        }
    return std::nullopt;
}

TreeFacts walkTree(ByteReader& in, const TreeLayout& layout) {
    return TreeReader(in, layout).tree();
}

} // namespace eikonal::volume
