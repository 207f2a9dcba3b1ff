// Damaged VDB files: refused in words and at once, and whole ones of every kind accepted.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/mutate.h"
#include "fuzz/read_vdb.h"
#include "support/vdb_files.h"
#include "volume/vdb_check.h"
#include "volume/vdb_tree.h"

#include <ctime>

using namespace eikonal;
using namespace eikonal::volume;

namespace {

/// Files of every compression and type, as OpenVDB wrote them; with offsets and without.
std::vector<std::filesystem::path> seeds() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(EIKONAL_SOURCE_DIR "/tests/fuzz/corpus/vdb"))
        if (entry.path().extension() == ".vdb") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class DamagedVolume : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        VdbGrid ior = floats("ior");
        for (int i = 0; i < 512; ++i)
            ior.set({i % 8, i / 8 % 8, i / 64}, 1 + static_cast<float>(i) / 700);
        ior.setMeta("weight", 0.5);
        mBytes = std::make_shared<std::string>(bytesOf(vdbName({ior})));
        const auto source = memorySource(mBytes);
        mRecord = indexOf(*source).grids.at(0);
        mParts = partsOf(*source, mRecord);
    }
    std::string vdbName(const std::vector<VdbGrid>& grids) const {
        vdb("whole.vdb", grids);
        return "whole.vdb";
    }
    /// Puts `value` at a place, and expects the file to be refused for the reason.
    template<typename T>
    void refused(std::uint64_t place, const T& value, const std::string& reason) const {
        std::string changed = *mBytes;
        std::memcpy(&changed[place], &value, sizeof value);
        putBytes("a.vdb", changed);
        expectError(ExitStatus::data, {"a.vdb", reason}, [&] { Volume::open(at("a.vdb")); });
    }
    template<typename T> T valueAt(std::uint64_t place) const {
        T value;
        std::memcpy(&value, &(*mBytes)[place], sizeof value);
        return value;
    }

    std::shared_ptr<std::string> mBytes;
    VdbRecord mRecord;
    VdbParts mParts;

    // The tree: one buffer (4 bytes), background (4), tiles (4), children (4), then the one child's
    // place (12), its masks of 32³ bits, and how its inactive values are told (1).
    static constexpr std::uint64_t kUpperMask = 32 * 32 * 32 / 8;
    std::uint64_t tiles() const { return mParts.tree.begin + 8; }
    std::uint64_t children() const { return tiles() + 4; }
    std::uint64_t place() const { return children() + 4; }
    std::uint64_t childMask() const { return place() + 12; }
    std::uint64_t valueMask() const { return childMask() + kUpperMask; }
    std::uint64_t told() const { return valueMask() + kUpperMask; }
    std::uint64_t chunk() const { return told() + 1; } ///< the length of the upper node's values
};

} // namespace

TEST_F(DamagedVolume, CountsAreHeldAgainstWhatIsLeft) {
    for (const std::uint32_t count : {2u, 1000u, 0x7fffffffu, 0xffffffffu}) {
        refused(tiles(), count, "can't be read");
        refused(children(), count, "can't be read");
        refused(mParts.metadata.begin, count + 100, "can't be read");
    }
    refused(mParts.tree.begin, std::int32_t{2}, "not one buffer");
}

TEST_F(DamagedVolume, NodesHaveTheirPlaces) {
    ASSERT_EQ(valueAt<std::int32_t>(place()), 0);
    refused(place(), std::int32_t{8}, "out of place");
    const std::uint8_t both = 1; // the first place, which is a child
    ASSERT_EQ(valueAt<std::uint8_t>(childMask()), 1);
    refused(valueMask(), both, "both node and value");
    refused(childMask(), std::uint8_t{3}, "can't be read"); // one more child
    refused(told(), std::uint8_t{7}, "no known way");
}

TEST_F(DamagedVolume, ChunksHoldWhatTheirNodesHaveRoomFor) {
    const std::uint64_t leaf = mRecord.buffers + 64 + 1; // behind mask and how it is told
    const auto length = valueAt<std::int64_t>(leaf);
    ASSERT_GT(length, 16) << "it is not compressed";
    for (const std::int64_t wrong :
         {length - 1, length + 1, std::int64_t{5}, std::int64_t{0}, std::int64_t{-2047},
          std::int64_t{-2049}, std::int64_t{-1} << 40, std::int64_t{1} << 40,
          std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
        refused(leaf, wrong, "can't be read");
        refused(chunk(), wrong, "can't be read");
    }
    for (const std::uint32_t bytes : {0u, 2047u, 2049u, 0xffffffffu}) {
        refused(leaf + 12, bytes, "room for"); // decompressed
        refused(leaf + 20, bytes, "room for"); // compressed
    }
    refused(leaf + 16, 0u, "room for"); // blocks
    refused(mRecord.buffers, ~valueAt<std::uint64_t>(mRecord.buffers), "masks differ");
}

TEST_F(DamagedVolume, OffsetsAndLengthsBeforeTheTreeAreHeldToo) {
    const std::uint64_t offsets = mRecord.begin - 24;
    for (const std::uint64_t wrong : {std::uint64_t{0}, mRecord.begin + 1, mBytes->size() + 1,
                                      std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
        refused(offsets, wrong, "offset in it is wrong");
        if (wrong > mBytes->size()) refused(offsets + 16, wrong, "offset in it is wrong");
    }
    refused(mRecord.begin, 8u, "compressed in no known way");
    refused(mParts.transform.begin, 0xfffffff0u, "can't be read");
    refused(mParts.transform.begin + 4, 'X', "transform is of no known kind");
    const size_t weight = mBytes->find("double", mParts.metadata.begin);
    refused(weight + 6, 9u, "wrong length");
    refused(8, 221u, "file format 221");
    refused(8, 225u, "file format 225");
}

TEST_F(DamagedVolume, TheDomainIsThatOfTheTreesWhateverTheStatisticsSay) {
    const size_t box = mBytes->find("file_bbox_max", mParts.metadata.begin);
    const std::uint64_t value = box + 13 + 4 + 5 + 4; // name, length and name of the type, length
    ASSERT_EQ(valueAt<std::int32_t>(value), 7);
    std::string changed = *mBytes;
    changed[value] = 3;
    putBytes("a.vdb", changed);
    EXPECT_EQ(Volume::open(at("a.vdb")).domain(), (IndexBox{glm::ivec3(0), glm::ivec3(7)}));
}

TEST_F(DamagedVolume, WholeFilesOfEveryKindAreReadAndCopied) {
    ASSERT_GE(seeds().size(), 10u);
    for (const auto& path : seeds()) {
        SCOPED_TRACE(path.string());
        EXPECT_EQ(readVdb(path.string()), VdbFate::read);
        const Volume volume = Volume::open(path.string());
        write(volume, "b.vdb");
        for (const GridFacts& grid : volume.grids()) {
            const VdbGrid copy = gridIn("b.vdb", grid.name);
            // OpenVDB calls the values of masks bool.
            EXPECT_EQ(copy.type(), grid.type == "mask" ? "bool" : grid.type) << grid.name;
            EXPECT_GT(copy.activeVoxels(), 0u) << grid.name;
        }
        write(Volume::open(at("b.vdb")), "c.vdb");
        EXPECT_EQ(bytesOf("c.vdb").size(),
                  bytesOf("b.vdb").size() + std::string("\ntester in.vdb -o out.vdb").size());
    }
}

TEST_F(DamagedVolume, FilesDamagedAtRandomAreReadOrRefusedAtOnce) {
    const auto files = seeds();
    const MemoryFile file;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        std::string bytes = contentOf(files[i % files.size()]);
        mutate(bytes, i);
        file.set(bytes.data(), bytes.size());
        const std::clock_t begin = std::clock(); // of the processor: a busy machine is not to count
        EXPECT_NO_THROW(readVdb(file.path()))
            << "damage " << i << " of " << files[i % files.size()];
        const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        EXPECT_LT(took, 1.0) << "damage " << i << " of " << files[i % files.size()];
    }
}

TEST_F(DamagedVolume, ManyGridsTakeNoTime) {
    // Each as large as its descriptor alone; their number is told as it is.
    std::string bytes = mBytes->substr(0, mRecord.begin - 24);
    const size_t descriptor = bytes.rfind("ior") - 4;
    const std::string head = bytes.substr(0, descriptor - 4);
    const std::int32_t count = 50000;
    bytes = head + std::string(reinterpret_cast<const char*>(&count), 4);
    for (std::int32_t i = 0; i < count; ++i) {
        const auto text = [&](const std::string& t) {
            const auto size = static_cast<std::uint32_t>(t.size());
            bytes.append(reinterpret_cast<const char*>(&size), 4);
            bytes += t;
        };
        text(std::to_string(i));
        text("Tree_other_5_4_3");
        text("");
        const std::uint64_t end = bytes.size() + 24;
        for (int k = 0; k < 3; ++k) bytes.append(reinterpret_cast<const char*>(&end), 8);
    }
    putBytes("a.vdb", bytes);
    const std::clock_t begin = std::clock(); // of the processor: a busy machine is not to count
    expectError(ExitStatus::data, {"a.vdb", "no grid of a scene"},
                [&] { Volume::open(at("a.vdb")); });
    const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_LT(took, 1.0);
}
