// What a volume keeps on its way through a file or a stream.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/vdb_files.h"

#include <fcntl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace eikonal;
using namespace eikonal::volume;

namespace {

const IndexBox kBox{{-3, 2, 5}, {8, 10, 19}};

Frame turnedFrame() {
    Frame frame;
    frame.voxelSize = 0.25;
    frame.worldFromIndex = glm::scale(glm::rotate(glm::translate(glm::dmat4(1), {3, -4, 50}), 0.7,
                                                  glm::normalize(glm::dvec3(1, 2, 3))),
                                      glm::dvec3(0.25));
    return frame;
}

Volume numberedVolume() {
    Volume volume(turnedFrame());
    volume.put("ior", kBox, numbered(kBox, 1), {.background = glm::vec3(1), .allActive = true});
    volume.put("absorption", kBox, numbered(kBox, 3, 0), {.vectorType = "color"});
    volume.setMetadata("scene", "a glass");
    return volume;
}

void expectNumbered(const Volume& volume) {
    EXPECT_EQ(volume.domain(), kBox);
    // Exact: values are stored as they are.
    EXPECT_EQ(volume.dense("ior", kBox).values, numbered(kBox, 1).values);
    EXPECT_EQ(volume.dense("absorption", kBox).values, numbered(kBox, 3, 0).values);
    EXPECT_EQ(volume.dense("absorption", kBox).components, 3);
    EXPECT_EQ(volume.background("ior", glm::vec3(7)), glm::vec3(1));
    EXPECT_EQ(volume.metadata("scene"), "a glass");
    EXPECT_EQ(volume.metadata("eikonal:tool"), "tester");
    EXPECT_EQ(volume.metadata("eikonal:version"), "1.2");
    const Frame wanted = turnedFrame();
    // The matrix is stored in double; the cube root for the size rounds a few times.
    EXPECT_NEAR(volume.frame().voxelSize, wanted.voxelSize, 1e-15);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR(volume.frame().worldFromIndex[column][row],
                        wanted.worldFromIndex[column][row], 1e-14);
}

} // namespace

TEST_F(VolumeTest, ComesBackFromAFile) {
    expectNumbered(Volume::open(write(numberedVolume(), "a.vdb")));
}

TEST_F(VolumeTest, ComesBackFromAStreamWithoutSeeking) {
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = bytesOf("pipe"); });
    write(numberedVolume(), "pipe");
    reader.join();
    putBytes("streamed.vdb", received);
    expectNumbered(Volume::open(at("streamed.vdb")));
    const int before = ::dup(STDIN_FILENO);
    const int file = ::open(at("streamed.vdb").c_str(), O_RDONLY);
    ::dup2(file, STDIN_FILENO);
    EXPECT_NO_THROW({
        const Volume volume = Volume::open("-");
        expectNumbered(volume);
        EXPECT_EQ(volume.path(), "standard input");
    });
    ::dup2(before, STDIN_FILENO);
    ::close(before);
    ::close(file);
}

TEST_F(VolumeTest, ComesFromAFifoByName) {
    write(numberedVolume(), "a.vdb");
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(at("pipe"), std::ios::binary) << bytesOf("a.vdb"); });
    EXPECT_NO_THROW({
        const Volume volume = Volume::open(at("pipe"));
        expectNumbered(volume);
        write(volume, "b.vdb", {"tester", "1.2", ""});
    });
    writer.join();
    expectNumbered(Volume::open(at("b.vdb"))); // what is copied comes from the stream, too
}

TEST_F(VolumeTest, StandsInTheWorldWhereOpenVdbSaysToo) {
    write(numberedVolume(), "a.vdb");
    const auto grid = gridIn("a.vdb", "ior");
    const glm::dvec4 voxel(1, 5, 7, 1);
    const glm::dvec4 ours = turnedFrame().worldFromIndex * voxel;
    const glm::dvec3 theirs = grid.worldFromIndex({1, 5, 7});
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(ours[i], theirs[i], 1e-12); // double, values near 50
    const glm::dvec4 back = turnedFrame().indexFromWorld() * ours;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], voxel[i], 1e-12); // as above, over 0.25
}

TEST_F(VolumeTest, VoxelsMayBeOfAnySizeThatOpenVdbHolds) {
    for (const double size : {kLeastVoxelSize, 1e-3, 1e6, 1e9}) {
        Frame frame;
        frame.voxelSize = size;
        for (int i = 0; i < 3; ++i) frame.worldFromIndex[i][i] = size;
        frame.worldFromIndex[3] = glm::dvec4(3 * size, -size, 0, 1);
        Volume volume(frame);
        volume.put("ior", {glm::ivec3(0), glm::ivec3(1)},
                   {glm::ivec3(2), 1, {1, 2, 3, 4, 5, 6, 7, 8}}, {});
        const Volume back = Volume::open(write(volume, "a.vdb"));
        EXPECT_NEAR(back.frame().voxelSize / size, 1, 1e-15); // a cube root of a cube in double
        // OpenVDB takes the matrix apart into a scale and a translation, which rounds.
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 3; ++j)
                EXPECT_NEAR(back.frame().worldFromIndex[i][j] / size,
                            frame.worldFromIndex[i][j] / size, 1e-15);
    }
    Frame tiny;
    tiny.voxelSize = 0.9 * kLeastVoxelSize;
    for (int i = 0; i < 3; ++i) tiny.worldFromIndex[i][i] = tiny.voxelSize;
    Volume volume(tiny);
    EXPECT_THROW(volume.put("ior", {glm::ivec3(0), glm::ivec3(0)}, {glm::ivec3(1), 1, {1}}, {}),
                 DataError);
}

TEST_F(VolumeTest, TheDomainIsTheBoxOfAllActiveVoxels) {
    VdbGrid a = emptyFloats("a", 1), b = emptyFloats("b", 0);
    a.fill({{0, 0, 0}, {3, 4, 5}}, glm::dvec3(2));
    // Values that are not active count for nothing.
    a.fill({{-90, 0, 0}, {-80, 4, 5}}, glm::dvec3(2), false);
    b.fill({{-20, 2, 2}, {-20, 2, 40}}, glm::dvec3(1));
    const IndexBox wanted{{-20, 0, 0}, {3, 4, 40}};
    EXPECT_EQ(Volume::open(vdb("with.vdb", {a, b})).domain(), wanted);
    EXPECT_EQ(Volume::open(vdb("without.vdb", {a, b}, {}, false)).domain(), wanted);
    // Values outside the active voxels are the tree's all the same.
    const auto dense = Volume::open(at("with.vdb")).dense("a", {{-81, 0, 0}, {0, 0, 0}});
    EXPECT_EQ(dense.values.front(), 2);
    EXPECT_EQ(dense.values[40], 1);
    EXPECT_EQ(dense.values.back(), 2);
}

TEST_F(VolumeTest, TheSameContentGivesTheSameBytes) {
    write(numberedVolume(), "a.vdb");
    write(numberedVolume(), "b.vdb");
    EXPECT_TRUE(bytesOf("a.vdb") == bytesOf("b.vdb"));
    write(numberedVolume(), "c.vdb", {"tester", "1.2", "another command"});
    EXPECT_FALSE(bytesOf("a.vdb").substr(0, 64) == bytesOf("c.vdb").substr(0, 64))
        << "the identifier does not depend on the history";
    write(Volume::open(at("a.vdb")), "d.vdb");
    write(Volume::open(at("a.vdb")), "e.vdb");
    EXPECT_TRUE(bytesOf("d.vdb") == bytesOf("e.vdb"));
}

// Its leaves are compressed by several threads, some thousands at a time.
TEST_F(VolumeTest, ALargeGridIsWrittenAsOpenVdbWritesIt) {
    const IndexBox box{glm::ivec3(0), glm::ivec3(135)}; // 17³ leaves
    Volume volume(turnedFrame());
    volume.put("ior", box, numbered(box, 1), {.background = glm::vec3(1)});
    write(volume, "ours.vdb");
    vdb("theirs.vdb", {gridIn("ours.vdb", "ior")});
    const std::string ours = bytesOf("ours.vdb"), theirs = bytesOf("theirs.vdb");
    // All but what files say of themselves, which stands before the grid.
    const size_t grid = ours.size() - 4096;
    ASSERT_GT(theirs.size(), grid);
    EXPECT_TRUE(ours.substr(ours.size() - grid) == theirs.substr(theirs.size() - grid));
}

TEST_F(VolumeTest, TheHistoryGrowsByALineAStage) {
    write(numberedVolume(), "a.vdb",
          {"first", "1", commandLine({"/usr/bin/first", "/home/me/a b.obj", "--stats=/x/y.json"})});
    write(Volume::open(at("a.vdb")), "b.vdb", {"second", "2", "second a.vdb"});
    const Volume back = Volume::open(at("b.vdb"));
    EXPECT_EQ(back.metadata("eikonal:command"), "first 'a b.obj' --stats=y.json\nsecond a.vdb");
    EXPECT_EQ(back.metadata("eikonal:tool"), "second");
    EXPECT_EQ(back.metadata("eikonal:version"), "2");
    EXPECT_EQ(back.metadata("nothing"), "");
}

TEST_F(VolumeTest, CopiesThroughWhatItDoesNotKnow) {
    VdbGrid counts = block("counts", VdbGrid::Type::int32, glm::dvec3(42), glm::dvec3(-1));
    counts.setCreator("someone");
    counts.setMeta("note", "kept");
    counts.setMeta("weight", 0.125);
    const VdbGrid mask = block("mask", VdbGrid::Type::boolean, glm::dvec3(1), glm::dvec3(0));
    vdb("a.vdb", {floats("ior"), counts, mask}, {{"frame", 24}});
    write(Volume::open(at("a.vdb")), "b.vdb");

    const VdbGrid back = gridIn("b.vdb", "counts");
    EXPECT_EQ(back.type(), "int32");
    EXPECT_EQ(back.valueAt({3, 3, 3}), 42);
    EXPECT_EQ(back.background(), -1);
    EXPECT_TRUE(back.hasTopologyOf(counts));
    EXPECT_EQ(back.creator(), "someone");
    EXPECT_EQ(back.meta("note"), VdbMeta("kept"));
    EXPECT_EQ(back.meta("weight"), VdbMeta(0.125));
    EXPECT_EQ(gridIn("b.vdb", "mask").type(), "bool");
    EXPECT_EQ(metaIn("b.vdb", "frame"), VdbMeta(24));
}

TEST_F(VolumeTest, DoesNotReadWhatItIsNotAskedFor) {
    auto bad = floats("density");
    bad.set({1, 1, 1}, std::numeric_limits<float>::quiet_NaN());
    vdb("a.vdb", {floats("ior"), bad});
    const Volume volume = Volume::open(at("a.vdb"));
    EXPECT_NO_THROW(volume.dense("ior", volume.domain()));
    EXPECT_NO_THROW(write(volume, "b.vdb"));
    EXPECT_TRUE(std::isnan(gridIn("b.vdb", "density").valueAt({1, 1, 1})))
        << "it was not copied as it was";
}

TEST_F(VolumeTest, ListsItsGrids) {
    vdb("a.vdb", {floats("ior"), vectors("absorption", {1, 2, 3})});
    const auto grids = Volume::open(at("a.vdb")).grids();
    ASSERT_EQ(grids.size(), 2u);
    const bool iorFirst = grids[0].name == "ior";
    EXPECT_EQ(grids[iorFirst ? 0 : 1].type, "float");
    EXPECT_EQ(grids[iorFirst ? 1 : 0].type, "vec3s");
    EXPECT_EQ(grids[0].active, (IndexBox{{0, 0, 0}, {7, 7, 7}}));
}

TEST_F(VolumeTest, ReadsGridsUnderOtherNames) {
    vdb("a.vdb", {floats("density", 1.25f), floats("ior", 3)});
    Volume volume = Volume::open(at("a.vdb"), {{"ior", "density"}});
    EXPECT_TRUE(volume.has("ior"));
    EXPECT_EQ(volume.dense("ior", {{0, 0, 0}, {0, 0, 0}}).values.at(0), 1.25f);
    DenseGrid more = volume.dense("ior", volume.domain());
    for (float& value : more.values) value += 1;
    volume.put("ior", volume.domain(), more, {.allActive = true});
    write(volume, "b.vdb");
    const VdbGrid replaced = gridIn("b.vdb", "density");
    EXPECT_EQ(replaced.type(), "float");
    EXPECT_EQ(replaced.valueAt({2, 2, 2}), 2.25);
    const VdbGrid other = gridIn("b.vdb", "ior");
    EXPECT_EQ(other.type(), "float");
    EXPECT_EQ(other.valueAt({2, 2, 2}), 3);
    expectError(ExitStatus::data, {"a.vdb", "no grid 'smoke'", "density", "ior"}, [&] {
        Volume::open(at("a.vdb"), {{"ior", "smoke"}});
    });
}

TEST_F(VolumeTest, PutMarksAsActiveWhatIsAskedFor) {
    const IndexBox box{{0, 0, 0}, {7, 7, 7}};
    DenseGrid values;
    values.size = box.size();
    values.values.assign(512, 0.5f);
    values.values[1] = 0.75f;
    Volume volume{Frame{}};
    volume.put("some", box, values, {.background = glm::vec3(0.5f)});
    volume.put("all", box, values, {.background = glm::vec3(0.5f), .allActive = true});
    write(volume, "a.vdb");
    EXPECT_EQ(gridIn("a.vdb", "some").activeVoxels(), 1u);
    EXPECT_EQ(gridIn("a.vdb", "all").activeVoxels(), 512u);
    EXPECT_EQ(volume.dense("all", box).values, values.values);
    EXPECT_EQ(volume.background("all", glm::vec3(0)).x, 0.5f);
}

TEST_F(VolumeTest, PutKeepsWhatTheReplacedGridSaidOfItself) {
    auto old = floats("ior");
    old.fill({{0, 0, 0}, {1, 1, 1}}, glm::dvec3(1), true); // active, though background
    old.setCreator("someone");
    old.setMeta("note", "kept");
    old.setMeta("file_note", "of the file");
    auto wind = vectors("wind", {1, 2, 3});
    wind.setCovariant();
    auto smoke = floats("smoke");
    smoke.setLevelSet();
    vdb("a.vdb", {old, wind, smoke});
    Volume volume = Volume::open(at("a.vdb"), {{"wind", "wind"}, {"smoke", "smoke"}});
    DenseGrid values = volume.dense("ior", volume.domain());
    values.values.back() = 1; // background, where the old grid was active
    volume.put("ior", volume.domain(), values, {.background = glm::vec3(1), .keepActive = true});
    for (const char* name : {"wind", "smoke"})
        volume.put(name, volume.domain(), volume.dense(name, volume.domain()), {});
    write(volume, "b.vdb");
    const auto back = gridIn("b.vdb", "ior");
    EXPECT_EQ(back.creator(), "someone");
    EXPECT_EQ(back.meta("note"), VdbMeta("kept"));
    EXPECT_THROW(back.meta("file_note"), std::runtime_error);
    EXPECT_EQ(back.activeVoxels(), 512u);
    EXPECT_EQ(back.meta("file_voxel_count"), VdbMeta(std::int64_t{512}));
    EXPECT_TRUE(gridIn("b.vdb", "wind").isCovariant());
    EXPECT_TRUE(gridIn("b.vdb", "smoke").isLevelSet());

    volume.put("ior", volume.domain(), values, {.background = glm::vec3(1)});
    write(volume, "c.vdb");
    EXPECT_EQ(gridIn("c.vdb", "ior").activeVoxels(), 512u - 8 - 1);
}

TEST_F(VolumeTest, WhatIsComputedIsStoredInFloat) {
    auto old = floats("ior", 1.5f), light = vectors("fluence", {1, 1, 1}), other = floats("other");
    for (VdbGrid* grid : {&old, &light, &other}) grid->setHalf();
    vdb("a.vdb", {old, light, other});
    Volume volume = Volume::open(at("a.vdb"));
    EXPECT_TRUE(volume.isStoredInHalf("ior"));
    const IndexBox box = volume.domain();
    DenseGrid fine = numbered(box, 1, 1), bright = numbered(box, 3, 1e6f); // beyond half's 65504
    fine.values[0] = 1 + 1e-6f;
    volume.put("ior", box, fine, {.background = glm::vec3(1), .keepActive = true});
    volume.put("fluence", box, bright, {});
    EXPECT_FALSE(volume.isStoredInHalf("ior"));
    write(volume, "b.vdb");
    const Volume back = Volume::open(at("b.vdb"));
    EXPECT_EQ(back.dense("ior", box).values, fine.values);
    EXPECT_EQ(back.dense("fluence", box).values, bright.values);
    EXPECT_FALSE(gridIn("b.vdb", "ior").isHalf());
    EXPECT_FALSE(gridIn("b.vdb", "fluence").isHalf());
    EXPECT_TRUE(gridIn("b.vdb", "other").isHalf()) << "copied, so as it was";
}

TEST_F(VolumeTest, GridsOfTheContractClaimNoClassButLevelSets) {
    auto fog = floats("opacity", 0.5f, 0);
    fog.setFogVolume();
    vdb("a.vdb", {floats("ior"), fog});
    Volume volume = Volume::open(at("a.vdb"));
    for (const char* name : {"ior", "opacity"})
        volume.put(name, volume.domain(), volume.dense(name, volume.domain()), {});
    volume.putConstant("ior.glass", glm::vec3(1.5f));
    write(volume, "b.vdb");
    for (const char* name : {"ior", "opacity", "ior.glass"})
        EXPECT_EQ(gridIn("b.vdb", name).gridClass(), "unknown") << name;
}

TEST_F(VolumeTest, TwoGridsOfOneNameAreBothCopied) {
    for (const bool stream : {false, true}) {
        auto first = floats("points", 2), second = floats("points", 3), third = floats("points", 4);
        vdb("a.vdb", {first, floats("ior"), second, third});
        std::thread writer;
        if (stream) {
            ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
            writer = std::thread(
                [&] { std::ofstream(at("pipe"), std::ios::binary) << bytesOf("a.vdb"); });
        }
        write(Volume::open(at(stream ? "pipe" : "a.vdb")), "b.vdb");
        if (stream) writer.join();
        EXPECT_EQ(gridIn("b.vdb", "points[0]").valueAt({1, 1, 1}), 2);
        EXPECT_EQ(gridIn("b.vdb", "points[1]").valueAt({1, 1, 1}), 3);
        EXPECT_EQ(gridIn("b.vdb", "points[2]").valueAt({1, 1, 1}), 4);
        EXPECT_EQ(gridIn("b.vdb", "ior").valueAt({1, 1, 1}), 1.5);
    }
}

TEST_F(VolumeTest, WhatNoStageKnowsMayLieAnywhere) {
    auto slow = vectors("vel", {1, 2, 3}), far = floats("divergence"), tapered = floats("camera");
    slow.setVoxelSize(2);
    far.preScale({1, 2, 1});
    tapered.setFrustum();
    far.set({1000, 1000, 1000}, 1);
    vdb("a.vdb", {slow, far, tapered, floats("ior")});
    const Volume volume = Volume::open(at("a.vdb"));
    EXPECT_EQ(volume.domain(), (IndexBox{glm::ivec3(0), glm::ivec3(7)}));
    EXPECT_EQ(volume.frame().voxelSize, 1);
    write(volume, "b.vdb");
    EXPECT_EQ(gridIn("b.vdb", "vel").worldFromIndex({1, 0, 0}).x, 2);
    EXPECT_EQ(gridIn("b.vdb", "divergence").valueAt({1000, 1000, 1000}), 1);
    EXPECT_TRUE(gridIn("b.vdb", "camera").hasTopologyOf(tapered));
}

TEST_F(VolumeTest, TreesSharedByGridsAreCopiedWhole) {
    auto first = floats("first", 2), second = first.sharing("second");
    second.setVoxelSize(3);
    vdb("a.vdb", {first, second, floats("ior")});
    write(Volume::open(at("a.vdb")), "b.vdb");
    EXPECT_TRUE(gridIn("b.vdb", "second").hasTopologyOf(first));
    EXPECT_EQ(gridIn("b.vdb", "second").valueAt({3, 3, 3}), 2);
    EXPECT_EQ(gridIn("b.vdb", "second").worldFromIndex({1, 0, 0}).x, 3);
    const Volume shared = Volume::open(at("a.vdb"), {{"ior", "second"}});
    EXPECT_EQ(shared.dense("ior", {glm::ivec3(0), glm::ivec3(0)}).values.at(0), 2);
    EXPECT_NEAR(shared.frame().voxelSize, 3, 1e-14); // a cube root
}

TEST_F(VolumeTest, DoublesAreReadAsFloatsAndOneNumberIsGrey) {
    vdb("a.vdb", {block("ior", VdbGrid::Type::float64, glm::dvec3(1.25), glm::dvec3(1.125)),
                  floats("scattering", 0.5f, 0)});
    Volume volume = Volume::open(at("a.vdb"));
    const IndexBox box{glm::ivec3(7), glm::ivec3(8, 7, 7)};
    EXPECT_EQ(volume.dense("ior", box).values, (std::vector<float>{1.25f, 1.125f}));
    EXPECT_EQ(volume.background("ior", glm::vec3(0)), glm::vec3(1.125f));
    EXPECT_EQ(volume.dense("scattering", box).values,
              (std::vector<float>{0.5f, 0.5f, 0.5f, 0, 0, 0}));
    EXPECT_EQ(volume.dense("scattering", box).components, 3);
    volume.put("ior", volume.domain(), volume.dense("ior", volume.domain()),
               {.background = glm::vec3(1.125f), .keepActive = true});
    write(volume, "b.vdb");
    EXPECT_EQ(gridIn("b.vdb", "ior").type(), "float");
    EXPECT_EQ(gridIn("b.vdb", "ior").activeVoxels(), 512u);
    EXPECT_EQ(gridIn("b.vdb", "scattering").type(), "float");
}

TEST_F(VolumeTest, PutRefusesWhatNoGridMayHold) {
    const IndexBox box{{4, 5, 6}, {7, 7, 7}};
    Volume volume{Frame{}};
    DenseGrid values = numbered(box, 1);
    values.values[5] = std::numeric_limits<float>::quiet_NaN();
    expectError(ExitStatus::internal, {"'fluence'", "(5, 6, 6)", "NaN"},
                [&] { volume.put("fluence", box, values, {}); });
    values.values[5] = -std::numeric_limits<float>::infinity();
    expectError(ExitStatus::internal, {"infinite"},
                [&] { volume.put("fluence", box, values, {}); });
}

TEST(Bricks, HoldWhatADenseCopyHolds) {
    // A level set of a ball with its band, and a grid whose every voxel differs, each over a box
    // that begins and ends within leaves.
    Volume volume(turnedFrame());
    const IndexBox box{{-13, 3, 5}, {30, 41, 60}};
    DenseGrid distances{box.size(), 1, {}};
    for (int z = 0; z < distances.size.z; ++z)
        for (int y = 0; y < distances.size.y; ++y)
            for (int x = 0; x < distances.size.x; ++x)
                distances.values.push_back(static_cast<float>(
                    0.25 * (glm::length(glm::dvec3(x, y, z) - glm::dvec3(20, 19, 25)) - 15)));
    volume.putLevelSet({"", "sdf"}, box, distances, 3);
    volume.put("ior", kBox, numbered(kBox, 1), {.background = glm::vec3(1), .allActive = true});
    for (const auto& [grid, part] :
         {std::pair("sdf", box), std::pair("sdf", IndexBox{{-2, 9, 8}, {17, 33, 31}}),
          std::pair("ior", kBox)}) {
        const DenseGrid dense = volume.dense(grid, part);
        const BrickGrid bricks = volume.bricks(grid, part);
        ASSERT_EQ(bricks.size, dense.size);
        size_t i = 0;
        for (int z = 0; z < dense.size.z; ++z)
            for (int y = 0; y < dense.size.y; ++y)
                for (int x = 0; x < dense.size.x; ++x, ++i)
                    ASSERT_EQ(bricks.at({x, y, z}), dense.values[i]) << x << " " << y << " " << z;
    }
    // What is far from the boundary takes no memory.
    const BrickGrid bricks = volume.bricks("sdf", box);
    EXPECT_LT(bricks.values.size(), distances.values.size() * 3 / 4);
    DenseGrid bad = numbered(kBox, 1);
    bad.values[5] = -2;
    volume.put("ior", kBox, bad, {.allActive = true});
    expectError(ExitStatus::data, {"ior", "voxel", "-2"}, [&] { volume.bricks("ior", kBox); });
}
