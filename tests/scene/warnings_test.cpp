// What a scene's files hold that can't be, or that will not be traced as people may expect.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "scene/effects.h"
#include "support/vdb_files.h"

using namespace eikonal;
using namespace eikonal::volume;

namespace {

constexpr int kEdge = 24;
const IndexBox kBox{glm::ivec3(0), glm::ivec3(kEdge - 1)};

/// A ball's signed distance [voxel], cut to its band.
double ballAt(const glm::ivec3& voxel, double band) {
    return std::clamp(glm::length(glm::dvec3(voxel) - 11.7) - 8.0, -band, band);
}

class SceneWarnings : public VolumeTest {
protected:
    /// Writes a level set of `valueAt` and an index, on voxels of `h` units.
    std::string levelSet(double background, double h,
                         const std::function<double(const glm::ivec3&)>& valueAt) const {
        VdbGrid sdf = emptyFloats("sdf", static_cast<float>(background));
        for (int z = 0; z < kEdge; ++z)
            for (int y = 0; y < kEdge; ++y)
                for (int x = 0; x < kEdge; ++x) sdf.set({x, y, z}, valueAt({x, y, z}));
        VdbGrid ior = emptyFloats("ior", 1);
        ior.fill(kBox, glm::dvec3(1.5));
        sdf.setVoxelSize(h);
        ior.setVoxelSize(h);
        return vdb("a.vdb", {sdf, ior});
    }
    static scene::Scene read(const std::string& path) {
        const Volume volume = Volume::open(path);
        return scene::read(scene::Files(volume), {});
    }
    static std::string warned(const std::string& path) {
        return join(scene::warningsOf(read(path)), "\n");
    }
    /// An index of 1 and of 1 + contrast.
    std::string weak(float contrast, bool half) const {
        VdbGrid ior = floats("ior", 1 + contrast);
        ior.fill({glm::ivec3(0), glm::ivec3(3)}, glm::dvec3(1));
        if (half) ior.setHalf();
        return vdb("a.vdb", {ior});
    }
};

} // namespace

TEST_F(SceneWarnings, AGoodLevelSetIsTakenWithoutAWord) {
    for (const double h : {1.0, 0.05})
        for (const double band : {3.0, 2.0, 8.0})
            EXPECT_EQ(warned(levelSet(band * h, h,
                                      [&](const glm::ivec3& p) { return h * ballAt(p, band); })),
                      "")
                << band;
}

TEST_F(SceneWarnings, ALevelSetThatLostItsSignIsRefused) {
    for (const double h : {1.0, 0.05})
        for (const double band : {3.0, 2.0}) {
            const auto lost = [&](const glm::ivec3& p) {
                const double d = ballAt(p, band);
                return h * (d <= -band ? band : d);
            };
            expectError(ExitStatus::data, {"a.vdb", "'sdf'", "voxel (", "a sign is lost"},
                        [&] { read(levelSet(band * h, h, lost)); });
            const auto one = [&](const glm::ivec3& p) {
                return h * (p == glm::ivec3(11, 12, 13) ? band : ballAt(p, band));
            };
            expectError(ExitStatus::data, {"a.vdb", "'sdf'", "voxel (11, 12, 12)"},
                        [&] { read(levelSet(band * h, h, one)); });
        }
}

TEST_F(SceneWarnings, ALevelSetInsideOutIsRefused) {
    const auto inverted = [](const glm::ivec3& p) { return -ballAt(p, 3); };
    expectError(ExitStatus::data, {"'sdf'", "inside out"},
                [&] { read(levelSet(-3, 1, inverted)); });
}

TEST_F(SceneWarnings, DistancesInVoxelsAreTold) {
    const std::string path = levelSet(3, 0.05, [](const glm::ivec3& p) { return ballAt(p, 3); });
    EXPECT_NE(warned(path).find("seems to be in voxels"), std::string::npos) << warned(path);
}

TEST_F(SceneWarnings, ANarrowBandIsTold) {
    const std::string path = levelSet(1.5, 1, [](const glm::ivec3& p) { return ballAt(p, 1.5); });
    EXPECT_NE(warned(path).find("known to 1.5 voxels"), std::string::npos) << warned(path);
}

TEST_F(SceneWarnings, AnIndexThatItsNumbersCantHoldIsTold) {
    // Above 1 floats are 2^-23 apart, halves 2^-10; they round by half of it.
    EXPECT_NE(warned(weak(2e-6f, false)).find("32-bit floats"), std::string::npos);
    EXPECT_EQ(warned(weak(1e-5f, false)), "");
    EXPECT_NE(warned(weak(0.02f, true)).find("16 bits"), std::string::npos);
    EXPECT_EQ(warned(weak(0.25f, true)).find("16 bits"), std::string::npos);
    EXPECT_EQ(warned(weak(0, true)), "");
}

TEST_F(SceneWarnings, WhereNothingAppliesALineSaysWhatWasFound) {
    const auto idle = [&](const std::string& path, const GridNames& names = {}) {
        const Volume volume = Volume::open(path, names);
        const scene::Files files(volume);
        const auto effects = scene::effectsOf(scene::read(files, {}), {});
        return join(scene::idleWarnings(files, effects), "\n");
    };
    const std::string density = vdb("density.vdb", {floats("density", 3, 0)});
    EXPECT_NE(idle(density).find("(found: density)"), std::string::npos);
    EXPECT_NE(idle(density).find("--grid-ior NAME"), std::string::npos);
    EXPECT_EQ(idle(density, {{"scattering", "density"}}), "");
    VdbGrid ior = floats("ior");
    ior.set({4, 4, 4}, 1.25);
    EXPECT_EQ(idle(vdb("ior.vdb", {ior, floats("density")})), "");
    VdbGrid surface = emptyFloats("surface", 3);
    for (int x = 0; x < 8; ++x) surface.set({x, 0, 0}, x - 3.5);
    surface.setLevelSet();
    const std::string path = vdb("surface.vdb", {surface});
    EXPECT_NE(idle(path).find("--grid-sdf NAME"), std::string::npos);
    EXPECT_NE(idle(path, {{"sdf", "surface"}}).find("(found: surface)"), std::string::npos)
        << "a boundary between equal indices";
}
