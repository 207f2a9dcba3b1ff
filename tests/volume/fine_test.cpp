// Grids of fine voxels, a whole number of which lies along an edge of the scene's.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "support/vdb_files.h"

#include <map>
#include <tuple>

namespace eikonal::volume {
namespace {

using glm::dvec3;
using glm::ivec3;

class FineGrids : public VolumeTest {};

/// A scene of voxels of 0.25 whose domain begins at (−3, 2, 5).
Volume sceneAt(const ivec3& low) {
    Frame frame;
    frame.voxelSize = 0.25;
    frame.worldFromIndex = glm::dmat4(0.25);
    frame.worldFromIndex[3] = glm::dvec4(1, 2, 3, 1);
    Volume volume(frame);
    const IndexBox box{low, low + 3};
    PutOptions options;
    options.allActive = true;
    volume.put("ior", box, numbered(box, 1), options);
    return volume;
}

TEST_F(FineGrids, ComeBackAsTheyWereAndLieInTheirVoxels) {
    const ivec3 low(-3, 2, 5);
    for (const int detail : {1, 2, 3, 8}) {
        Volume volume = sceneAt(low);
        FineGrid light;
        light.detail = detail;
        light.voxels = {ivec3(0), ivec3(4 * detail - 1), ivec3(detail, 0, 2 * detail)};
        light.values = {{1, 2, 3}, {0, 0, 0}, {0.5f, 0.25f, 7}};
        volume.putFine("irradiance", volume.domain(), light);
        EXPECT_EQ(volume.domain().min, low); // it does not count to the domain
        const std::string path = write(volume, "fine.vdb");
        const Volume again = Volume::open(path);
        EXPECT_EQ(again.domain().min, low);
        EXPECT_EQ(again.domain().size(), ivec3(4));
        const FineGrid found = again.fine("irradiance", again.domain());
        EXPECT_EQ(found.detail, detail);
        std::map<std::tuple<int, int, int>, glm::vec3> values;
        for (size_t i = 0; i < found.voxels.size(); ++i)
            values[{found.voxels[i].x, found.voxels[i].y, found.voxels[i].z}] = found.values[i];
        ASSERT_EQ(values.size(), 3u);
        for (size_t i = 0; i < 3; ++i) {
            const ivec3 at = light.voxels[i];
            EXPECT_EQ((values[{at.x, at.y, at.z}]), light.values[i]);
        }
        // The first fine voxel begins where the domain does.
        const VdbGrid grid = gridIn("fine.vdb", "irradiance");
        const dvec3 middle = grid.worldFromIndex(dvec3(low * detail));
        const dvec3 corner = dvec3(1, 2, 3) + 0.25 * (dvec3(low) - 0.5);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(middle[axis], corner[axis] + 0.125 / detail, 1e-12);
    }
}

TEST_F(FineGrids, NoGridIsNone) {
    const Volume volume = sceneAt(ivec3(0));
    EXPECT_TRUE(volume.fine("irradiance", volume.domain()).empty());
}

TEST_F(FineGrids, OneThatDoesNotSubdivideTheVoxelsIsRefused) {
    const auto refused = [&](const std::function<void(VdbGrid&)>& change, const char* word) {
        VdbGrid light = vectors("irradiance", dvec3(1));
        change(light);
        const Volume volume = Volume::open(vdb("bad.vdb", {floats("ior"), light}));
        try {
            volume.fine("irradiance", volume.domain());
            FAIL() << "expected a refusal for " << word;
        } catch (const DataError& error) {
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    refused([](VdbGrid& light) { light.setVoxelSize(0.4); }, "does not subdivide");
    refused([](VdbGrid& light) { light.translate({0.3, 0, 0}); }, "does not subdivide");
    refused([](VdbGrid& light) { light.setVoxelSize(2); }, "does not subdivide");
    refused([](VdbGrid& light) { light.set({1, 1, 1}, dvec3(NAN)); }, "is NaN");
}

TEST_F(FineGrids, AreNotWhereASceneLiesIfAnythingElseTells) {
    VdbGrid light = vectors("irradiance", dvec3(1));
    light.setVoxelSize(0.5);
    light.translate(dvec3(-0.25));
    const Volume volume = Volume::open(vdb("order.vdb", {light, vectors("scattering", dvec3(1))}));
    EXPECT_EQ(volume.frame().voxelSize, 1);
    EXPECT_EQ(volume.fine("irradiance", volume.domain()).detail, 2);
}

} // namespace
} // namespace eikonal::volume
