// Environment maps as the world has them: other primaries, suns, negative edges, layers, parts.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/picture.h"
#include "support/exr_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <cmath>
#include <map>
#include <optional>
#include <sys/stat.h>

using namespace eikonal;
using namespace eikonal::image;

namespace {

/// A part of a file: its name, and channels with the one value they hold.
struct Part {
    std::string name;
    std::vector<std::pair<std::string, float>> channels;
};

class EnvironmentTest : public ExrFilesTest {
protected:
    void write(const std::string& file, const std::vector<Part>& parts,
               const std::optional<Imf::Chromaticities>& chromaticities = std::nullopt) const {
        std::vector<Imf::Header> headers;
        for (const Part& part : parts) {
            headers.emplace_back(kWidth, kHeight);
            headers.back().setName(part.name);
            headers.back().setType(Imf::SCANLINEIMAGE);
            if (chromaticities) Imf::addChromaticities(headers.back(), *chromaticities);
            for (const auto& [name, value] : part.channels)
                headers.back().channels().insert(name, Imf::Channel(Imf::FLOAT));
        }
        Imf::MultiPartOutputFile out(at(file).c_str(), headers.data(),
                                     static_cast<int>(headers.size()));
        for (size_t p = 0; p < parts.size(); ++p) {
            std::map<std::string, std::vector<float>> samples;
            Imf::FrameBuffer planes;
            for (const auto& [name, value] : parts[p].channels) {
                std::vector<float>& plane = samples[name];
                plane.assign(kWidth * kHeight, value);
                planes.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(plane.data()),
                                               sizeof(float), sizeof(float) * kWidth));
            }
            Imf::OutputPart output(out, static_cast<int>(p));
            output.setFrameBuffer(planes);
            output.writePixels(kHeight);
        }
    }
    /// R, G, B of the first pixel.
    std::vector<float> first(const std::string& file, const std::string& layer = "") const {
        const Image map = readEnvironment({at(file), layer}).map;
        EXPECT_EQ(map.channels, (std::vector<std::string>{"R", "G", "B"}));
        return {map.plane(0)[0], map.plane(1)[0], map.plane(2)[0]};
    }
    static constexpr int kWidth = 4, kHeight = 3;
};

Image even(float r, float g, float b) {
    Image image(2, 1);
    image.addChannels({"R", "G", "B"}, std::vector<float>{r, g, b, r, g, b}, 3);
    return image;
}

constexpr std::array<double, 8> kAcesCg = {0.713, 0.293, 0.165,   0.830,
                                           0.128, 0.044, 0.32168, 0.33767};

} // namespace

TEST(Radiance, OtherPrimariesBecomeRec709) {
    Image image = even(0, 1, 0);
    image.chromaticities = kAcesCg;
    EXPECT_EQ(makeRadiance(image, "sky.exr").size(), 1u) << "green is out of gamut";
    // The published matrix from ACEScg to linear Rec. 709 (Bradford): its second column is
    // -0.6218, 1.1410, -0.0103, rounded to four places by OpenColorIO's configuration.
    EXPECT_EQ(image.plane(0)[0], 0);
    EXPECT_NEAR(image.plane(1)[0], 1.1408, 5e-4);
    EXPECT_EQ(image.plane(2)[0], 0);

    Image red = even(1, 0, 0);
    red.chromaticities = kAcesCg;
    makeRadiance(red, "sky.exr");
    EXPECT_NEAR(red.plane(0)[0], 1.7051, 5e-4); // its first column
    Image white = even(0.5f, 0.5f, 0.5f);
    white.chromaticities = kAcesCg;
    EXPECT_TRUE(makeRadiance(white, "sky.exr").empty());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white.plane(c)[0], 0.5, 1e-6); // floats
}

TEST(Radiance, ItsOwnPrimariesStayBitByBit) {
    Image image = even(0.1f, 0.2f, 0.3f);
    image.chromaticities = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
    EXPECT_TRUE(makeRadiance(image, "sky.exr").empty());
    EXPECT_EQ(image.pixels, even(0.1f, 0.2f, 0.3f).pixels);
}

TEST(Radiance, WhatIsNoneIsClampedAndToldOrRefused) {
    Image image = numbered(4, 3, {"R", "G", "B"});
    image.plane(2)[4 + 1] = -2;
    image.plane(1)[0] = -0.5f;
    image.plane(0)[7] = INFINITY;
    image.plane(0)[8] = -INFINITY;
    const std::vector<std::string> warnings = makeRadiance(image, "sky.exr");
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[0],
              "sky.exr: 1 infinite samples are taken as 65504 (channel 'R', pixel (3, 1))");
    EXPECT_EQ(
        warnings[1],
        "sky.exr: 3 negative samples are taken as 0 (down to -inf, channel 'R', pixel (0, 2))");
    EXPECT_EQ(image.plane(0)[7], 65504.f);
    EXPECT_EQ(image.plane(0)[8], 0.f);
    EXPECT_EQ(image.plane(1)[0], 0.f);
    EXPECT_EQ(image.plane(2)[5], 0.f);
    EXPECT_EQ(image.plane(2)[6], 200 + 1 + 2.f / 64) << "what is radiance stays";

    image.plane(2)[4 + 1] = NAN;
    expectError(ExitStatus::data, {"sky.exr", "nan", "'B'", "(1, 1)"},
                [&] { makeRadiance(image, "sky.exr"); });
    Image flat = even(1, 1, 1);
    flat.chromaticities = {0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3};
    expectError(ExitStatus::data, {"chromaticities"}, [&] { makeRadiance(flat, "sky.exr"); });
    flat.chromaticities = std::array<double, 8>{};
    expectError(ExitStatus::data, {"chromaticities"}, [&] { makeRadiance(flat, "sky.exr"); });
}

TEST_F(EnvironmentTest, ChromaticitiesComeFromTheFile) {
    write("aces.exr", {{"sky", {{"R", 1}, {"G", 0}, {"B", 0}}}},
          Imf::Chromaticities({0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f},
                              {0.32168f, 0.33767f}));
    EXPECT_NEAR(first("aces.exr")[0], 1.7051, 5e-4); // as above
}

TEST_F(EnvironmentTest, TheOnlyLayerIsTaken) {
    write("one.exr", {{"beauty",
                       {{"ViewLayer.Combined.R", 1},
                        {"ViewLayer.Combined.G", 2},
                        {"ViewLayer.Combined.B", 3},
                        {"ViewLayer.Combined.A", 1},
                        {"ViewLayer.Depth.Z", 9}}}});
    EXPECT_EQ(first("one.exr"), (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(first("one.exr", "ViewLayer.Combined"), (std::vector<float>{1, 2, 3}));
    expectError(ExitStatus::data, {"one.exr", "'Depth'", "ViewLayer.Combined"},
                [&] { first("one.exr", "Depth"); });
}

TEST_F(EnvironmentTest, OfSeveralOneMustBeNamed) {
    const Part layers{
        "all",
        {{"sky.R", 1}, {"sky.G", 2}, {"sky.B", 3}, {"sun.R", 4}, {"sun.G", 5}, {"sun.B", 6}}};
    write("two.exr", {layers});
    expectError(ExitStatus::data, {"two.exr", "several layers", "FILE:LAYER", "sky, sun"},
                [&] { first("two.exr"); });
    EXPECT_EQ(first("two.exr", "sun"), (std::vector<float>{4, 5, 6}));
    // One without a layer is the picture, whatever is beside it.
    Part more = layers;
    for (const char* name : {"R", "G", "B"}) more.channels.emplace_back(name, 7.f);
    write("more.exr", {more});
    EXPECT_EQ(first("more.exr"), (std::vector<float>{7, 7, 7}));
    EXPECT_EQ(first("more.exr", "sky"), (std::vector<float>{1, 2, 3}));
}

TEST_F(EnvironmentTest, OfSeveralPartsTheFirstWithColoursIsTaken) {
    write("parts.exr", {{"depth", {{"Z", 9}}},
                        {"left", {{"R", 1}, {"G", 2}, {"B", 3}}},
                        {"right", {{"R", 4}, {"G", 5}, {"B", 6}}}});
    EXPECT_EQ(first("parts.exr"), (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(first("parts.exr", "right"), (std::vector<float>{4, 5, 6}));
    expectError(ExitStatus::data, {"parts.exr", "'depth'", "left, right"},
                [&] { first("parts.exr", "depth"); });
}

TEST_F(EnvironmentTest, NamesAreTakenApartWhereNoFileHasThem) {
    EXPECT_EQ(parsePictureName("a.exr").layer, "");
    EXPECT_EQ(parsePictureName("a.exr:sky.day").path, "a.exr");
    EXPECT_EQ(parsePictureName("a.exr:sky.day").layer, "sky.day");
    EXPECT_EQ(parsePictureName("a.exr:").path, "a.exr:");
    exr("b:sky", numbered(2, 2, {"R", "G", "B"}));
    EXPECT_EQ(parsePictureName(at("b:sky")).path, at("b:sky"));
    putBytes("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x20\x10\x80\x82");
    expectError(ExitStatus::data, {"a.hdr", "layer"}, [&] { first("a.hdr", "sky"); });
}

TEST_F(EnvironmentTest, StreamsAreReadAsFilesAre) {
    exr("a.exr", numbered(5, 4, {"R", "G", "B"}));
    const Image image = numbered(5, 4, {"R", "G", "B"});
    {
        AtomicFile png(at("a.png"));
        writePicture(image, png, {});
        png.commit();
    }
    for (const char* name : {"a.exr", "a.png"}) {
        const std::string pipe = at(std::string("pipe-") + name);
        ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
        std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << bytesOf(name); });
        const Image map = readEnvironment({pipe, ""}).map;
        writer.join();
        EXPECT_EQ(map.pixels, readEnvironment({at(name), ""}).map.pixels) << name;
    }
    ASSERT_EQ(::mkfifo(at("bad").c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(at("bad")) << "no picture"; });
    expectError(ExitStatus::data, {at("bad")}, [&] { first("bad"); });
    writer.join();
}
