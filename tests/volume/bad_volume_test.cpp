// Files that are no valid volume: each is refused with the place and the reason.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/read_vdb.h"
#include "support/vdb_files.h"

#include <limits>

using namespace eikonal;
using namespace eikonal::volume;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

} // namespace

TEST_F(VolumeTest, AMissingFileIsMissing) {
    expectError(ExitStatus::missing, {"absent.vdb"}, [&] { Volume::open(at("absent.vdb")); });
    expectError(ExitStatus::data, {"directory"}, [&] { Volume::open(folder.string()); });
}

TEST_F(VolumeTest, AFileThatIsNoVdbIsRefused) {
    for (const std::string& bytes :
         {std::string(), std::string("x"), std::string(1000, 'x'), std::string(1000, '\0')}) {
        putBytes("a.vdb", bytes);
        expectError(ExitStatus::data, {"a.vdb", "VDB file"}, [&] { Volume::open(at("a.vdb")); });
    }
}

TEST_F(VolumeTest, AFileCutShortIsRefusedWhereverItIsCut) {
    // With values that do not compress, so that the trees take more than the headers.
    auto noisy = floats("ior");
    for (int i = 0; i < 512; ++i)
        noisy.set({i % 8, i / 8 % 8, i / 64}, 1 + static_cast<float>(i) / 700);
    vdb("whole.vdb", {noisy, vectors("absorption", {1, 2, 3})});
    const std::string whole = bytesOf("whole.vdb");
    ASSERT_NO_THROW(Volume::open(at("whole.vdb")));
    for (size_t cut = 1; cut < whole.size(); cut = cut * 9 / 8 + 1) {
        putBytes("cut.vdb", whole.substr(0, whole.size() - cut));
        expectError(ExitStatus::data, {"cut.vdb"}, [&] { Volume::open(at("cut.vdb")); });
    }
}

TEST_F(VolumeTest, AChangedByteNeverCrashesTheReader) {
    // Whatever it makes of the file, it ends in a volume or in a DataError.
    vdb("whole.vdb", {floats("ior"), vectors("absorption", {1, 2, 3})});
    const std::string whole = bytesOf("whole.vdb");
    const MemoryFile file;
    for (size_t place = 0; place < whole.size(); place += 1 + place / 300)
        for (const char flip : {'\x01', '\x04'}) {
            std::string changed = whole;
            changed[place] = static_cast<char>(changed[place] ^ flip);
            file.set(changed.data(), changed.size());
            EXPECT_NO_THROW(readVdb(file.path())) << "byte " << place;
        }
}

TEST_F(VolumeTest, AVolumeWithoutAnActiveVoxelIsRefused) {
    const VdbGrid empty = emptyFloats("ior", 1);
    for (const bool statistics : {true, false})
        expectError(ExitStatus::data, {"a.vdb", "no active voxel"},
                    [&] { Volume::open(vdb("a.vdb", {empty}, {}, statistics)); });
    expectError(ExitStatus::data, {"a.vdb", "no grids"}, [&] { Volume::open(vdb("a.vdb", {})); });
}

TEST_F(VolumeTest, AVolumeBeyondAllMemoryIsRefused) {
    VdbGrid far = emptyFloats("ior", 1);
    far.set({-1000000000, 0, 0}, 2);
    far.set({1500000000, 0, 0}, 2); // apart by more than an int holds
    expectError(ExitStatus::data, {"a.vdb", "2500000001 x 1 x 1"},
                [&] { Volume::open(vdb("a.vdb", {far})); });
    VdbGrid large = emptyFloats("ior", 1);
    large.set({0, 0, 0}, 2);
    large.set({1000000, 1000000, 1000000}, 2);
    vdb("b.vdb", {large});
    const Volume volume = Volume::open(at("b.vdb"));
    expectError(ExitStatus::memory, {"b.vdb", "'ior'", "bytes"},
                [&] { volume.dense("ior", volume.domain()); });
}

TEST_F(VolumeTest, AGridOnAnotherTransformIsRefusedWhereItIsAskedFor) {
    const auto refused = [this](const std::function<void(VdbGrid&)>& place,
                                const std::vector<std::string>& words) {
        VdbGrid other = floats("opacity", 0.5f, 0);
        place(other);
        const Volume volume = Volume::open(vdb("a.vdb", {other, floats("ior")}));
        EXPECT_EQ(volume.domain(), (IndexBox{glm::ivec3(0), glm::ivec3(7)}));
        expectError(ExitStatus::data, words, [&] { volume.has("opacity"); });
        expectError(ExitStatus::data, words, [&] { volume.dense("opacity", volume.domain()); });
    };
    refused(
        [](VdbGrid& grid) {
            grid.translate({0, 0.01, 0});
            grid.set({100, 0, 0}, 0.5);
        },
        {"a.vdb", "'opacity'", "'ior'", "another transform"});
    refused([](VdbGrid& grid) { grid.setVoxelSize(1.001); }, {"transform"});
    refused([](VdbGrid& grid) { grid.preScale({1, 1, 2}); }, {"'opacity'", "expected cubes"});
    VdbGrid same = floats("opacity", 0.5f, 0);
    same.translate({0, 1e-9, 0}); // what a writer in float would leave
    EXPECT_TRUE(Volume::open(vdb("b.vdb", {floats("ior"), same})).has("opacity"));
}

TEST_F(VolumeTest, VoxelsThatAreNoCubesAreRefused) {
    const auto refused = [this](const std::function<void(VdbGrid&)>& place,
                                const std::string& word) {
        VdbGrid grid = floats("ior");
        place(grid);
        expectError(ExitStatus::data, {"a.vdb", "'ior'", word},
                    [&] { Volume::open(vdb("a.vdb", {grid})); });
    };
    refused([](VdbGrid& grid) { grid.preScale({1, 1, 2}); }, "expected cubes");
    glm::dmat4 sheared(1);
    sheared[1][0] = 0.5;
    refused([&](VdbGrid& grid) { grid.setWorldFromIndex(sheared); }, "expected cubes");
    refused([](VdbGrid& grid) { grid.setFrustum(); }, "not linear");
}

TEST_F(VolumeTest, AGridOfTheWrongTypeIsRefused) {
    vdb("a.vdb", {vectors("ior", {1, 1, 1}), floats("other"),
                  block("opacity", VdbGrid::Type::int32, glm::dvec3(1), glm::dvec3(0)),
                  block("absorption", VdbGrid::Type::boolean, glm::dvec3(1), glm::dvec3(0)),
                  block("counts", VdbGrid::Type::int32, glm::dvec3(1), glm::dvec3(0))});
    const Volume volume = Volume::open(at("a.vdb"));
    expectError(ExitStatus::data, {"a.vdb: grid 'ior'", "vec3s", "expected float"},
                [&] { volume.has("ior"); });
    expectError(ExitStatus::data, {"'absorption'", "bool", "expected vec3s"},
                [&] { volume.dense("absorption", volume.domain()); });
    expectError(ExitStatus::data, {"'opacity'", "int32", "expected float"},
                [&] { volume.background("opacity", glm::vec3(0)); });
    expectError(ExitStatus::data, {"'counts'", "int32", "expected float or vec3s"},
                [&] { volume.dense("counts", volume.domain()); });
}

TEST_F(VolumeTest, AValueOutOfItsRangeIsNamedWithItsVoxel) {
    struct Case {
        const char* grid;
        float value;
        const char* says;
    };
    const Case scalars[] = {{"ior", 0, "is 0, expected > 0"},
                            {"ior", -1.5f, "is -1.5, expected > 0"},
                            {"ior", kNan, "is NaN"},
                            {"ior", kInfinity, "is infinite"},
                            {"dispersion", kNan, "is NaN"},
                            {"anisotropy", 1, "is 1, expected between -1 and 1"},
                            {"anisotropy", -1, "is -1, expected between -1 and 1"},
                            {"opacity", 1.5f, "is 1.5, expected 0 to 1"},
                            {"opacity", -0.5f, "expected 0 to 1"},
                            {"sdf", -kInfinity, "is infinite"},
                            {"sdf.wine", kNan, "is NaN"},
                            {"anything", kNan, "is NaN"}};
    for (const Case& c : scalars) {
        auto grid = floats(c.grid, 0.5f, 0.5f);
        grid.set({1, 2, 3}, c.value);
        vdb("a.vdb", {grid});
        const Volume volume = Volume::open(at("a.vdb"));
        expectError(ExitStatus::data,
                    {"a.vdb", "'" + std::string(c.grid) + "'", "voxel (1, 2, 3)", c.says},
                    [&] { volume.dense(c.grid, volume.domain()); });
    }
    const Case coefficients[] = {{"absorption", -1, "is -1, expected >= 0"},
                                 {"scattering", kNan, "is NaN"},
                                 {"emission", kInfinity, "is infinite"},
                                 {"albedo", 1.01f, "expected 0 to 1"},
                                 {"reflectance", -1, ">= 0"},
                                 {"fluence", kInfinity, "is infinite"},
                                 {"light_direction", kNan, "is NaN"}};
    for (const Case& c : coefficients)
        for (int component = 0; component < 3; ++component) {
            auto grid = vectors(c.grid, {0.5f, 0.5f, 0.5f});
            glm::dvec3 value(0.5);
            value[component] = c.value;
            grid.set({1, 2, 3}, value);
            vdb("a.vdb", {grid});
            const Volume volume = Volume::open(at("a.vdb"));
            expectError(ExitStatus::data, {c.grid, "voxel (1, 2, 3)", c.says},
                        [&] { volume.dense(c.grid, volume.domain()); });
        }
}

TEST_F(VolumeTest, TheEndsOfARangeAreWithinIt) {
    for (const float value : {0.0f, 1.0f}) {
        vdb("a.vdb", {floats("opacity", value, 0), vectors("absorption", glm::dvec3(value))});
        const Volume volume = Volume::open(at("a.vdb"));
        EXPECT_NO_THROW(volume.dense("opacity", volume.domain()));
        EXPECT_NO_THROW(volume.dense("absorption", volume.domain()));
    }
}

TEST_F(VolumeTest, BackgroundsAreHeldToTheSameRanges) {
    const auto refused = [this](const VdbGrid& grid, const std::string& says) {
        vdb("a.vdb", {grid});
        const Volume volume = Volume::open(at("a.vdb"));
        expectError(ExitStatus::data, {"a.vdb", grid.name(), "background", says},
                    [&] { volume.background(grid.name(), glm::vec3(0)); });
    };
    refused(floats("ior", 1.5f, 0), "is 0, expected > 0");
    refused(floats("ior", 1.5f, kNan), "is NaN");
    refused(floats("anisotropy", 0, -1), "expected between -1 and 1");
    refused(block("absorption", VdbGrid::Type::vector, glm::dvec3(0), {0, 0, -1}), ">= 0");
    vdb("a.vdb", {floats("ior")});
    EXPECT_EQ(Volume::open(at("a.vdb")).background("absorption", glm::vec3(7)), glm::vec3(7));
}
