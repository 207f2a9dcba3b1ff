// The ground and the lights that fall on it, as files' metadata tell of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "scene/ground.h"
#include "support/ground_stage.h"

#include <gtest/gtest.h>

using namespace eikonal;
using glm::dvec3;

namespace {

/// A stage whose metadata are these.
volume::Volume saying(const std::string& ground, const std::string& lights = "") {
    volume::Volume volume = GroundStage{}.make(lights);
    volume.setMetadata(volume::kGroundKey, ground);
    return volume;
}

std::optional<scene::Ground> read(std::vector<volume::Volume> volumes) {
    const scene::Files files(std::move(volumes));
    return scene::readGround(files, scene::read(files, {}));
}

std::optional<scene::Ground> read(volume::Volume a) {
    std::vector<volume::Volume> volumes;
    volumes.push_back(std::move(a));
    return read(std::move(volumes));
}

std::optional<scene::Ground> read(volume::Volume a, volume::Volume b) {
    std::vector<volume::Volume> volumes;
    volumes.push_back(std::move(a));
    volumes.push_back(std::move(b));
    return read(std::move(volumes));
}

} // namespace

TEST(SceneGround, IsReadAsItWasWritten) {
    GroundStage stage;
    stage.ground = {7.1, {0.1, 0.7, 1.0 / 3}, 0.3};
    const auto ground = read(stage.make());
    ASSERT_TRUE(ground);
    EXPECT_EQ(ground->plane, stage.ground); // text that reads back as the same numbers
    EXPECT_EQ(ground->region, 0);
    EXPECT_TRUE(ground->lights.lights.empty());
}

TEST(SceneGround, IsNoneWhereNoMetadataTellOfIt) {
    EXPECT_FALSE(read(TestVolume(glm::ivec3(8)).constant("ior", 1).take()));
}

TEST(SceneGround, OfAnotherFormIsRefused) {
    for (const char* text : {"0", "0 1,1,1", "0 1 0", "0 1,1,1 0 0", "0 1,1,2 0", "0 1,-1,0 0",
                             "0 1,1,1 -1", "nan 1,1,1 0", "1e13 1,1,1 0", "a b c", "0  1,1,1 0"}) {
        EXPECT_THROW(read(saying(text)), DataError) << text;
    }
    EXPECT_TRUE(read(saying("0 1,1,1 0")));
}

TEST(SceneGround, OfFilesIsOneAndHasTheLightsOfAll) {
    const auto both = read(saying("0 1,1,1 0", "point:0,1,0:3\nsky=upward:1,2,3"),
                           saying("0 1,1,1 0", "2=upward:0.5,0,0\ndirectional:0,-1,0"));
    ASSERT_TRUE(both);
    ASSERT_EQ(both->lights.lights.size(), 2u);
    EXPECT_EQ(both->lights.lights[0].rgb, dvec3(3));
    EXPECT_EQ(both->lights.upward, dvec3(1.5, 2, 3));
    EXPECT_THROW(read(saying("0 1,1,1 0"), saying("0 1,1,1 2")), DataError);
}

TEST(SceneGround, LightsOfAnotherFormAreRefused) {
    for (const char* text : {"sun", "point:1,2", "environment:sky.exr", "upward:1,2",
                             "point:0,1,0\n", "sky=upward:1,2,x"})
        EXPECT_THROW(read(saying("0 1,1,1 0", text)), DataError) << text;
}

TEST(SceneGround, ALightIsRecordedAsItWasGiven) {
    const std::string spec = "key=spot:1,2,3:0,0,-4:30:5:6";
    EXPECT_EQ(scene::recordOf(scene::parseLight(spec), dvec3(0)), spec);
    scene::Light sky = scene::parseLight("sky=environment:sky.exr");
    EXPECT_EQ(scene::recordOf(sky, {0.25, 1e-7, 3}), "sky=upward:0.25,1e-07,3");
}
