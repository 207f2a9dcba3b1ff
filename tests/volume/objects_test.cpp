// Level sets, the objects they bound, and grids of an object's own.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/vdb_files.h"
#include "volume/contract.h"

using namespace eikonal;
using namespace eikonal::volume;

namespace {

const IndexBox kBox{{-20, -18, -16}, {19, 21, 23}};

/// Distances [unit] to a ball of 11 voxels of half a unit about voxel 0, where not cut exact.
DenseGrid ball() {
    DenseGrid grid;
    grid.size = kBox.size();
    for (int z = kBox.min.z; z <= kBox.max.z; ++z)
        for (int y = kBox.min.y; y <= kBox.max.y; ++y)
            for (int x = kBox.min.x; x <= kBox.max.x; ++x)
                grid.values.push_back(
                    0.5f * (static_cast<float>(std::sqrt(x * x + y * y + z * z)) - 11.0f));
    return grid;
}

Frame halfUnits() {
    Frame frame;
    frame.voxelSize = 0.5;
    for (int i = 0; i < 3; ++i) frame.worldFromIndex[i][i] = 0.5;
    return frame;
}

std::vector<std::string> namesOf(const Volume& volume) {
    std::vector<std::string> names;
    for (const ObjectFacts& object : volume.objects()) names.push_back(object.name);
    return names;
}

} // namespace
TEST_F(VolumeTest, ALevelSetIsCutToItsBandAndKeepsItsSign) {
    const DenseGrid values = ball();
    Volume volume(halfUnits());
    volume.putLevelSet({"glass", "sdf", 3, 2}, kBox, values, 4);
    const Volume back = Volume::open(write(volume, "a.vdb"));
    const DenseGrid found = back.dense("sdf", kBox);
    for (size_t i = 0; i < values.values.size(); ++i) // 4 voxels are 2 units
        ASSERT_EQ(found.values[i], glm::clamp(values.values[i], -2.0f, 2.0f)) << i;
    EXPECT_EQ(back.background("sdf", glm::vec3(0)).x, 2);
    const VdbGrid grid = gridIn("a.vdb", "sdf");
    EXPECT_EQ(grid.type(), "float");
    EXPECT_TRUE(grid.isLevelSet());
    std::uint64_t active = 0;
    for (const float value : values.values) active += std::abs(value) < 2;
    EXPECT_EQ(grid.activeVoxels(), active);
    EXPECT_FALSE(grid.isActive({0, 0, 0}));
    EXPECT_EQ(grid.valueAt({0, 0, 0}), -2);
    // Other programs read it as a level set: what OpenVDB calls its inside is the ball.
    EXPECT_TRUE(grid.isInside({0, 0, 0}));
}

TEST_F(VolumeTest, ObjectsComeBackThoseThatWinFirst) {
    const DenseGrid values = ball();
    Volume volume(halfUnits());
    volume.putLevelSet({"glass", "sdf.glass", 0, 0}, kBox, values, 4);
    volume.putLevelSet({"water", "sdf.water", 0, 1}, kBox, values, 4);
    volume.putLevelSet({"bubble", "sdf.bubble", 5, 2}, kBox, values, 4);
    volume.putLevelSet({"haze", "sdf.haze", -1, 3}, kBox, values, 4);
    const Volume back = Volume::open(write(volume, "a.vdb"));
    EXPECT_EQ(namesOf(back), (std::vector<std::string>{"bubble", "water", "glass", "haze"}));
    const ObjectFacts bubble = back.objects().front();
    EXPECT_EQ(bubble.sdf, "sdf.bubble");
    EXPECT_EQ(bubble.priority, 5);
    EXPECT_EQ(bubble.order, 2);
    EXPECT_TRUE(namesOf(Volume::open(vdb("b.vdb", {floats("ior")}))).empty());
}

TEST_F(VolumeTest, ABoundaryComesBackAsItWas) {
    Volume volume(halfUnits());
    ObjectFacts ring{"ring", "sdf.ring", 0, 0, 0.25f, Metal{{0.2f, 0.4f, 1.3f}, {3, 2, 1}}};
    volume.putLevelSet(ring, kBox, ball(), 4);
    volume.putLevelSet({"glass", "sdf.glass", 0, 1}, kBox, ball(), 4);
    const Volume back = Volume::open(write(volume, "a.vdb"));
    const std::vector<ObjectFacts> objects = back.objects();
    EXPECT_EQ(objects[0].roughness, 0);
    EXPECT_FALSE(objects[0].metal);
    EXPECT_EQ(objects[1].roughness, 0.25f);
    ASSERT_TRUE(objects[1].metal);
    EXPECT_EQ(objects[1].metal->index, glm::vec3(0.2f, 0.4f, 1.3f));
    EXPECT_EQ(objects[1].metal->extinction, glm::vec3(3, 2, 1));
    // What it is no more does not stay.
    ring.metal.reset();
    ring.roughness = 0;
    volume.putLevelSet(ring, kBox, ball(), 4);
    EXPECT_FALSE(volume.objects()[1].metal);
    EXPECT_EQ(volume.objects()[1].roughness, 0);
}

TEST_F(VolumeTest, ABoundaryThatCantBeIsRefused) {
    const auto refused = [&](const char* key, const VdbMeta& value, const char* word) {
        auto grid = floats("sdf.a");
        grid.setMeta(key, value);
        expectError(ExitStatus::data, {"'sdf.a'", key, word},
                    [&] { Volume::open(vdb("a.vdb", {grid})).objects(); });
    };
    refused("eikonal:roughness", 1.5f, "expected 0 to 1");
    refused("eikonal:roughness", std::nanf(""), "expected 0 to 1");
    refused("eikonal:roughness", std::string("smooth"), "expected a float");
    refused("eikonal:metal_index", 1.5f, "expected a vec3s");
}

TEST_F(VolumeTest, ALevelSetWithoutMetadataIsAnObjectByItsName) {
    const Volume plain = Volume::open(vdb("plain.vdb", {floats("sdf"), floats("ior")}));
    EXPECT_EQ(namesOf(plain), std::vector<std::string>{""});
    const Volume several =
        Volume::open(vdb("several.vdb", {floats("sdf.b"), floats("sdf.c"), floats("sdf.a")}));
    EXPECT_EQ(namesOf(several), (std::vector<std::string>{"c", "b", "a"})); // by order, last wins
    EXPECT_EQ(several.objects().back().order, 0);
    const Volume mapped =
        Volume::open(vdb("mapped.vdb", {floats("surface"), floats("sdf")}), {{"sdf", "surface"}});
    ASSERT_EQ(mapped.objects().size(), 1u); // what has the name in the file is another thing
    EXPECT_EQ(mapped.objects()[0].sdf, "sdf");
}

TEST_F(VolumeTest, LevelSetsThatSayWhatCantBeAreRefused) {
    expectError(ExitStatus::data, {"a.vdb", "'sdf.medium'", "expected another name"},
                [&] { Volume::open(vdb("a.vdb", {floats("sdf.medium")})).objects(); });
    auto other = floats("sdf.b");
    other.setMeta("eikonal:object", "a");
    expectError(ExitStatus::data, {"'sdf.b'", "bounds 'a'", "one level set an object"}, [&] {
        Volume::open(vdb("a.vdb", {floats("sdf.a"), other})).objects();
    });
    auto uneven = floats("sdf.half");
    uneven.setMeta("eikonal:priority", 0.5f);
    expectError(ExitStatus::data, {"'sdf.half'", "eikonal:priority", "float 0.5", "int32"},
                [&] { Volume::open(vdb("a.vdb", {uneven})).objects(); });
    auto number = floats("sdf");
    number.setMeta("eikonal:object", 1);
    expectError(ExitStatus::data, {"eikonal:object", "expected a string"},
                [&] { Volume::open(vdb("a.vdb", {number})).objects(); });
    expectError(ExitStatus::data, {"'sdf.v'", "vec3s", "expected float"}, [&] {
        Volume::open(vdb("a.vdb", {vectors("sdf.v", {1, 2, 3})})).objects();
    });
}

TEST_F(VolumeTest, AConstantGridHasNoActiveVoxelAndComesBack) {
    Volume volume(halfUnits());
    volume.putLevelSet({"glass", "sdf", 0, 0}, kBox, ball(), 4);
    volume.putConstant("ior.glass", glm::vec3(1.5f));
    volume.putConstant("absorption.glass", glm::vec3(1, 2, 3));
    const Volume back = Volume::open(write(volume, "a.vdb"));
    EXPECT_EQ(back.constant("ior.glass"), glm::vec3(1.5f));
    EXPECT_EQ(back.constant("absorption.glass"), glm::vec3(1, 2, 3));
    EXPECT_EQ(back.background("absorption.glass", glm::vec3(0)), glm::vec3(1, 2, 3));
    EXPECT_EQ(back.constant("sdf"), std::nullopt);
    EXPECT_EQ(back.dense("ior.glass", {{0, 0, 0}, {1, 0, 0}}).values,
              (std::vector<float>{1.5f, 1.5f}));
    EXPECT_EQ(gridIn("a.vdb", "ior.glass").activeVoxels(), 0u);
    EXPECT_EQ(back.domain(), volume.domain()); // it is as large as what varies
    expectError(ExitStatus::data, {"no grid 'ior.air'"}, [&] { back.constant("ior.air"); });
    expectError(ExitStatus::internal, {"'smoke'"},
                [&] { volume.putConstant("smoke", glm::vec3(1)); });
}

TEST_F(VolumeTest, AnObjectsOwnGridHasTheRuleOfTheGrid) {
    for (const char* name : {"ior.glass", "ior.medium", "ior.a.b"})
        EXPECT_EQ(ruleFor(name), ruleFor("ior")) << name;
    EXPECT_EQ(ruleFor("sdf.ior"), ruleFor("sdf"));
    for (const char* name : {"fluence.glass", "iorglass", "glass.ior", ".ior"})
        EXPECT_EQ(ruleFor(name), nullptr) << name;
    EXPECT_EQ(ownGrid("albedo", "cup"), "albedo.cup");
    const std::string path =
        vdb("a.vdb", {floats("ior.glass", 1.5f, -1), vectors("anisotropy.glass", {0, 0, 0}),
                      floats("ior.air", -2), floats("ior.ice", 1, 0)});
    const Volume volume = Volume::open(path);
    expectError(ExitStatus::data, {"'ior.glass'", "background is -1"},
                [&] { volume.background("ior.glass", glm::vec3(1)); });
    expectError(ExitStatus::data, {"'anisotropy.glass'", "vec3s", "expected float"},
                [&] { volume.has("anisotropy.glass"); });
    expectError(ExitStatus::data, {"'ior.air'", "voxel (0, 0, 0) is -2, expected > 0"},
                [&] { volume.dense("ior.air", volume.domain()); });
    const Volume dark = Volume::open(vdb("b.vdb", {floats("ior"), emptyFloats("ior.dark", -3)}));
    expectError(ExitStatus::data, {"'ior.dark'", "is -3, expected > 0"},
                [&] { dark.constant("ior.dark"); });
}
