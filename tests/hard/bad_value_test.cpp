// Hard cases of numbers that are none: refused on the way in, caught on the way out.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr.h"
#include "image/picture.h"
#include "support/tool.h"
#include "support/vdb_files.h"

#include <limits>

using namespace eikonal;
using volume::VolumeTest;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

const std::string kLightsim = "lightsim in.vdb -o out.vdb --photons 100 --light directional:0,-1,0";
const std::string kRender =
    "render in.vdb -o out.exr --eye 4,4,40 --target 4,4,4 --ortho 8 --size 4x4";
const std::string kSmooth = "volsmooth in.vdb -o out.vdb";

class HardValue : public VolumeTest {
protected:
    /// A file that calls for every effect, with one bad voxel (or component of it) in one grid.
    void spoil(const std::string& grid, float value) const {
        std::vector<volume::VdbGrid> grids;
        for (const char* name : {"ior", "opacity", "anisotropy"}) {
            const bool opaque = std::string(name) == "opacity";
            auto made = floats(name, opaque ? 0.0f : 0.5f, opaque ? 0.0f : 0.5f);
            if (opaque) made.set({7, 7, 7}, 1);
            if (grid == name) made.set({1, 2, 3}, value);
            grids.push_back(made);
        }
        for (const char* name :
             {"absorption", "scattering", "emission", "fluence", "light_direction", "albedo"}) {
            auto made = vectors(name, glm::dvec3(0.5));
            if (grid == name) made.set({1, 2, 3}, {0.5, 0.5, value});
            grids.push_back(made);
        }
        vdb("in.vdb", grids);
    }

    void expectNamed(const std::string& command, const std::string& grid) const {
        refused(65, {"in.vdb", "'" + grid + "'", "voxel (1, 2, 3)"}, command, folder);
    }
};

} // namespace

TEST_F(HardValue, ABadNumberInAVolumeIsRefusedByGridAndVoxel) {
    struct Case {
        const char* grid;
        std::vector<float> values;
        bool lit; // lightsim reads it, too
    };
    const Case cases[] = {{"ior", {kNan, kInfinity, 0, -1.5f}, true},
                          {"absorption", {kNan, -kInfinity, -1e-30f}, true},
                          {"scattering", {kNan, kInfinity, -1}, true},
                          {"anisotropy", {kNan, 1, -1, 1.5f}, true},
                          {"opacity", {kNan, 1.0001f, -1}, true},
                          {"emission", {kNan, kInfinity, -1}, false},
                          {"fluence", {kNan, kInfinity}, false},
                          {"light_direction", {kNan, kInfinity}, false},
                          {"albedo", {kNan, 1.1f, -0.1f}, false}};
    for (const Case& c : cases)
        for (const float value : c.values) {
            spoil(c.grid, value);
            expectNamed(kRender, c.grid);
            if (c.lit) expectNamed(kLightsim, c.grid);
            const bool smoothed = std::string(c.grid) == "ior" || std::string(c.grid) == "opacity";
            if (smoothed) expectNamed(kSmooth, c.grid);
        }
}

TEST_F(HardValue, ABackgroundThatIsNoIndexIsRefused) {
    for (const float background : {kNan, kInfinity, 0.0f, -1.0f}) {
        vdb("in.vdb", {floats("ior", 1.5f, background), vectors("scattering", {1, 1, 1})});
        refused(65, {"in.vdb", "'ior'", "background"}, kRender, folder);
        refused(65, {"in.vdb", "'ior'", "background"}, kLightsim, folder);
    }
}

TEST_F(HardValue, AGoodFileOfTheSameKindIsNotRefused) {
    spoil("none", 0);
    for (const std::string& command : {kRender, kLightsim, kSmooth}) {
        const Ran ran = run(command, folder);
        EXPECT_EQ(ran.status, 0) << ran.said;
    }
}

TEST_F(HardValue, LightBeyondFloatIsAFaultOfTheOutput) {
    // 3e38 W/m² is a float; ten times that, a lamp's voxel, or the sum of two is not.
    spoil("none", 0);
    for (const char* light : {"directional:0,-1,0:1e39", "point:4,4,4:3e38"})
        refused(70, {"fluence", "is infinite"},
                std::string("lightsim in.vdb -o out.vdb --photons 1000 --light ") + light, folder);
    refused(70, {"fluence", "is infinite"},
            "lightsim in.vdb -o out.vdb --photons 1000 --light directional:0,-1,0:3e38 "
            "--light directional:0,-1,0:3e38",
            folder);
}

TEST_F(HardValue, RadianceBeyondFloatIsAFaultOfTheOutput) {
    vdb("in.vdb", {vectors("emission", glm::dvec3(3e38f))});
    refused(70, {"out.exr", "'R'", "pixel (0, 0)"}, kRender, folder);
    refused(70, {"out.png"},
            "render in.vdb -o out.png --eye 4,4,40 --target 4,4,4 --ortho 8 --size 4x4", folder);
    // A sky of 1e38 seen from within an index of 4: L grows by n².
    vdb("in.vdb", {floats("ior", 4, 1)});
    refused(70, {"out.exr", "'R'"},
            "render in.vdb -o out.exr --eye 4,4,4 --target 4,4,5 --ortho 1 --size 2x2 "
            "--background 1e38",
            folder);
}

TEST_F(HardValue, NoWriterTakesANaN) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        image::Image picture(3, 2);
        std::vector<float> samples(18, 0.5f);
        samples[3 * 4 + 1] = bad; // G of pixel (1, 1)
        picture.addChannels({"R", "G", "B"}, samples, 3);
        expectError(ExitStatus::internal, {"out.exr", "'G'", "pixel (1, 1)"}, [&] {
            AtomicFile out(at("out.exr"));
            image::writeExr(picture, {}, out);
            out.commit();
        });
        for (const char* name : {"out.png", "out.jpg", "out.tga"})
            expectError(ExitStatus::internal, {name}, [&] {
                AtomicFile out(at(name));
                image::writePicture(picture, out, {});
                out.commit();
            });
        volume::Volume volume{volume::Frame{}};
        volume::DenseGrid grid = volume::numbered({{0, 0, 0}, {3, 3, 3}}, 3);
        grid.values[3 * (2 * 16 + 1 * 4 + 3) + 2] = bad;
        expectError(ExitStatus::internal, {"'fluence'", "voxel (3, 1, 2)"}, [&] {
            volume.put("fluence", {{0, 0, 0}, {3, 3, 3}}, grid, {});
        });
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            ADD_FAILURE() << "left " << entry.path();
    }
}
