// Which EXR files are taken, how their windows are read, and what is refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr.h"
#include "image/picture.h"
#include "support/exr_files.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <cstring>
#include <limits>
#include <random>
#include <sys/resource.h>

using namespace eikonal;
using namespace eikonal::image;

namespace {

class ExrInputTest : public ExrFilesTest {
protected:
    Environment environment(const std::string& name, const std::string& layer = "") const {
        return readEnvironment({at(name), layer});
    }

    /// A file of half-float channels whose samples are 1, 2, 3... in the data window's order.
    void halfFile(const std::string& name, Imf::Header header,
                  const std::vector<std::string>& channels) const {
        const Imath::Box2i window = header.dataWindow();
        const size_t width = static_cast<size_t>(window.size().x + 1);
        std::vector<half> samples(width * static_cast<size_t>(window.size().y + 1));
        for (size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<float>(i + 1);
        Imf::FrameBuffer planes;
        for (const std::string& channel : channels) {
            header.channels().insert(channel, Imf::Channel(Imf::HALF));
            planes.insert(channel, Imf::Slice::Make(Imf::HALF, samples.data(), window, sizeof(half),
                                                    sizeof(half) * width));
        }
        if (header.hasTileDescription()) {
            Imf::TiledOutputFile file(at(name).c_str(), header);
            file.setFrameBuffer(planes);
            file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
        } else {
            Imf::OutputFile file(at(name).c_str(), header);
            file.setFrameBuffer(planes);
            file.writePixels(window.size().y + 1);
        }
    }
};

/// The most memory this process ever held at once [KiB].
long peakKibibytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

const std::vector<std::string> kRgb = {"R", "G", "B"};

} // namespace

TEST_F(ExrInputTest, TheDataWindowIsPlacedInTheDisplayWindow) {
    // Display (0,0)-(3,2); data (-1,1)-(2,4): one column and two rows of it lie outside.
    halfFile("a.exr", Imf::Header(Imath::Box2i({0, 0}, {3, 2}), Imath::Box2i({-1, 1}, {2, 4})),
             kRgb);
    const Image image = readExr(at("a.exr"));
    ASSERT_EQ(image.width, 4);
    ASSERT_EQ(image.height, 3);
    const std::vector<float> expected = {0, 0, 0, 0, 2, 3, 4, 0, 6, 7, 8, 0};
    for (const std::string& channel : kRgb)
        EXPECT_EQ(interleaved(image, {channel}), expected) << channel;
}

TEST_F(ExrInputTest, WindowsThatDoNotMeetGiveBlack) {
    halfFile("a.exr", Imf::Header(Imath::Box2i({0, 0}, {1, 1}), Imath::Box2i({5, 7}, {6, 8})),
             kRgb);
    EXPECT_EQ(interleaved(readExr(at("a.exr")), {"G"}), std::vector<float>(4, 0.f));
}

TEST_F(ExrInputTest, AnEnvironmentMapIsItsDataWindow) {
    Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), Imath::Box2i({2, 3}, {3, 3}));
    Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
    halfFile("a.exr", header, kRgb);
    const Image image = environment("a.exr").map;
    EXPECT_EQ(image.envmap, Envmap::latLong);
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 1);
    EXPECT_EQ(interleaved(image, {"B"}), (std::vector<float>{1, 2}));

    Imf::Header cube(1, 6);
    Imf::addEnvmap(cube, Imf::ENVMAP_CUBE);
    halfFile("cube.exr", cube, kRgb);
    expectError(ExitStatus::data, {"cube.exr", "cube map", "lat-long"},
                [&] { environment("cube.exr"); });
}

TEST_F(ExrInputTest, TiledFilesAndFilesFromBottomToTopReadAlike) {
    Imf::Header tiled(50, 40);
    tiled.setTileDescription(Imf::TileDescription(16, 16));
    halfFile("tiled.exr", tiled, kRgb);
    Imf::Header upwards(50, 40);
    upwards.lineOrder() = Imf::DECREASING_Y;
    upwards.compression() = Imf::PIZ_COMPRESSION;
    halfFile("scan.exr", upwards, kRgb);
    const Image a = readExr(at("tiled.exr")), b = readExr(at("scan.exr"));
    EXPECT_EQ(a.pixels, b.pixels);
    EXPECT_EQ(a.pixels[50 * 40 - 1], 2000.f); // exact: halves hold even integers up to 4096
}

TEST_F(ExrInputTest, LuminanceAloneIsSpreadOverAnEnvironment) {
    halfFile("y.exr", Imf::Header(2, 1), {"Y"});
    EXPECT_EQ(readExr(at("y.exr")).channels, std::vector<std::string>{"Y"});
    EXPECT_EQ(interleaved(environment("y.exr").map, kRgb), (std::vector<float>{1, 1, 1, 2, 2, 2}));
}

TEST_F(ExrInputTest, WhatIsNoPictureIsRefusedByName) {
    expectError(ExitStatus::missing, {"none.exr", "No such file"},
                [&] { readExr(at("none.exr")); });
    expectError(ExitStatus::missing, {"directory"}, [&] { readExr(folder.string()); });
    putBytes("garbage.exr", std::string(5000, 'x'));
    expectError(ExitStatus::data, {"garbage.exr", "no OpenEXR"},
                [&] { readExr(at("garbage.exr")); });
    putBytes("empty.exr", "");
    expectError(ExitStatus::data, {"empty.exr"}, [&] { readExr(at("empty.exr")); });
    exr("depth.exr", numbered(3, 3, {"Z", "steps", "R", "G"}));
    expectError(ExitStatus::data, {"depth.exr", "R, G and B", "Z", "steps"},
                [&] { readExr(at("depth.exr")); });
    exr("chroma.exr", numbered(3, 3, {"Y", "RY", "BY"}));
    expectError(ExitStatus::data, {"chroma"}, [&] { readExr(at("chroma.exr")); });
}

TEST_F(ExrInputTest, AHeaderOfAbsurdSizeTakesNoMemory) {
    // The two y limits of both windows, patched into a small file: 100 000 rows that aren't there.
    exr("a.exr", numbered(1024, 4, kRgb));
    std::string bytes = bytesOf("a.exr");
    for (const char* name : {"dataWindow", "displayWindow"}) {
        // name, 0, "box2i", 0, size (4), x0 y0 x1 y1
        const size_t at = bytes.find(name) + std::string(name).size() + 1 + 6 + 4 + 12;
        const int rows = 99999;
        std::memcpy(bytes.data() + at, &rows, sizeof rows);
    }
    // Long enough for the table of their places, which OpenEXR reads on opening.
    putBytes("tall.exr", bytes + std::string(100'000, '\1'));
    const long before = peakKibibytes();
    expectError(ExitStatus::data, {"tall.exr"}, [&] { readExr(at("tall.exr")); });
    // The picture would take 1200 MiB; 100 MiB leave room for the table of lines.
    EXPECT_LT(peakKibibytes() - before, 100 * 1024);
}

TEST_F(ExrInputTest, AnAttributeOfAbsurdSizeTakesNoMemory) {
    ImageAttributes attributes;
    attributes.strings = {{"comments", "hello"}};
    exr("a.exr", numbered(8, 4, kRgb), attributes);
    std::string bytes = bytesOf("a.exr");
    // name, 0, "string", 0, size (4)
    const size_t at = bytes.find("comments") + 9 + 7;
    const long before = peakKibibytes();
    for (const int size : {1 << 30, 1'000'000, -1}) {
        std::memcpy(bytes.data() + at, &size, sizeof size);
        putBytes("big.exr", bytes);
        expectError(ExitStatus::data, {"big.exr", "'comments'", std::to_string(size)},
                    [&] { readExr(this->at("big.exr")); });
    }
    EXPECT_LT(peakKibibytes() - before, 100 * 1024); // of the gibibyte claimed
}

TEST_F(ExrInputTest, AnAttributeOfAnotherTypesSizeIsRefused) {
    // OpenEXR reads on where the type ends, not where the claim does: what follows would be read as
    // names, types and sizes.
    exr("a.exr", numbered(8, 4, kRgb));
    const std::string whole = bytesOf("a.exr");
    for (const std::string type : {"compression", "chlist", "box2i"}) {
        std::string bytes = whole;
        const size_t size = bytes.rfind(type + '\0') + type.size() + 1; // its name may be the same
        ++bytes[size];
        bytes.insert(size + 4 + static_cast<unsigned char>(whole[size]), 1, '\0');
        putBytes("b.exr", bytes);
        expectError(ExitStatus::data, {"b.exr", type}, [&] { readExr(at("b.exr")); });
    }
}

TEST_F(ExrInputTest, DamagedFilesAreDataErrorsOrStillPictures) {
    exr("a.exr", numbered(40, 40, {"R", "G", "B", "A"}));
    const std::string whole = bytesOf("a.exr");
    // Truncated anywhere: the last block is always missing, so never a picture.
    for (size_t length = 0; length < whole.size(); length += whole.size() / 40 + 1) {
        putBytes("cut.exr", whole.substr(0, length));
        expectError(ExitStatus::data, {"cut.exr"}, [&] { readExr(at("cut.exr")); });
    }
    // Bytes changed at random: a value may change unnoticed, but nothing else may be thrown.
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        std::string bytes = whole;
        for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
        putBytes("hurt.exr", bytes);
        try {
            readExr(at("hurt.exr"));
        } catch (const Error& error) {
            EXPECT_TRUE(error.status() == ExitStatus::data || error.status() == ExitStatus::memory)
                << "round " << round << ": " << error.what();
        }
    }
}

TEST(ImageSize, IsCheckedBeforeMemoryIsTaken) {
    EXPECT_NO_THROW(checkSize(1, 1, 4, "a.exr"));
    EXPECT_THROW(checkSize(0, 5, 4, "a.exr"), DataError);
    EXPECT_THROW(checkSize(5, (1 << 17) + 1, 4, "a.exr"), DataError);
    // 2^34 pixels of 1000 floats are 64 TiB, more than any machine this runs on.
    EXPECT_THROW(checkSize(1 << 17, 1 << 17, 1000, "a.exr"), MemoryError);
}
