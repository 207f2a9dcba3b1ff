// Pictures for the eye: known sRGB values, repetition, and the module on demand.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/picture.h"

#include "image/srgb.h"
#include "support/exr_files.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <unistd.h>

using namespace eikonal;
using namespace eikonal::image;

namespace {

class PictureTest : public ExrFilesTest {
protected:
    void write(const std::string& name, const Image& image, const ToneMap& toneMap = {}) const {
        AtomicFile out(at(name));
        writePicture(image, out, toneMap);
        out.commit();
    }
};

/// Sets EIKONAL_MODULES for as long as it lives.
class ModulesFolder {
public:
    explicit ModulesFolder(const std::string& folder) {
        ::setenv("EIKONAL_MODULES", folder.c_str(), 1);
    }
    ~ModulesFolder() { ::unsetenv("EIKONAL_MODULES"); }
    ModulesFolder(const ModulesFolder&) = delete;
    ModulesFolder& operator=(const ModulesFolder&) = delete;
};

/// One row of grey pixels; alpha, where given, is the same everywhere.
Image greys(const std::vector<float>& values, float alpha = 1) {
    Image image(static_cast<int>(values.size()), 1);
    for (const char* name : {"R", "G", "B"}) image.addChannels({name}, values, 1);
    image.addChannels({"A"}, std::vector<float>(values.size(), alpha), 1);
    return image;
}

std::vector<int> firstOfEach(const std::vector<std::uint8_t>& bytes, size_t stride) {
    std::vector<int> firsts;
    for (size_t i = 0; i < bytes.size(); i += stride) firsts.push_back(bytes[i]);
    return firsts;
}

/// What the running program is linked with, as the loader sees it.
std::string linkedLibraries() {
    const std::string command =
        "ldd '" + std::filesystem::read_symlink("/proc/self/exe").string() + "'";
    std::string text;
    FILE* const pipe = ::popen(command.c_str(), "r");
    std::array<char, 4096> part{};
    while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
    ::pclose(pipe);
    return text;
}

} // namespace

TEST(Srgb, CurveIsTheStandards) {
    // 188 and 118 are the published bytes of linear 0.5 and 0.18; 0.0031308 is where the pieces
    // meet, to the digits the standard gives (1e-6 there).
    EXPECT_EQ(std::floor(255 * srgbFromLinear(0.5) + 0.5), 188);
    EXPECT_EQ(std::floor(255 * srgbFromLinear(0.18) + 0.5), 118);
    EXPECT_NEAR(srgbFromLinear(0.0031308), srgbFromLinear(0.00313081), 1e-6);
    for (int i = 0; i <= 255; ++i)
        // 1e-7: the standard's rounded constants leave a step of 3e-8 where the pieces meet.
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(i / 255.0)), i / 255.0, 1e-7);
}

TEST(ToneMapping, ClipsByDefaultAfterExposure) {
    EXPECT_EQ(toneMapped(0.25, {}), 0.25);
    EXPECT_EQ(toneMapped(7, {}), 1);
    EXPECT_EQ(toneMapped(-1, {}), 0);
    EXPECT_EQ(toneMapped(0.125, {.exposure = 2}), 0.5); // exact: powers of two
    EXPECT_EQ(firstOfEach(displayBytes(greys({0, 0.5, 1, 9, -3}), {}), 3),
              (std::vector<int>{0, 188, 255, 255, 0}));
}

TEST(ToneMapping, FilmicRisesFromBlackToWhite) {
    const ToneMap filmic{.curve = ToneCurve::filmic};
    EXPECT_EQ(toneMapped(0, filmic), 0);
    // The published formula at 1: 2.54 / 3.16, to double rounding.
    EXPECT_NEAR(toneMapped(1, filmic), 2.54 / 3.16, 1e-15);
    EXPECT_EQ(toneMapped(1e6, filmic), 1);
    for (double x = 0; x < 6; x += 0.01)
        EXPECT_LT(toneMapped(x, filmic), toneMapped(x + 0.01, filmic));
}

TEST(ToneMapping, AlphaIsDividedOutOnlyWhereItIsWritten) {
    const Image half = greys({0.25f}, 0.5f); // premultiplied: the surface has 0.5
    EXPECT_EQ(displayBytes(half, {.alpha = true}), (std::vector<std::uint8_t>{188, 188, 188, 128}));
    EXPECT_EQ(displayBytes(half, {}), (std::vector<std::uint8_t>{137, 137, 137}));
    EXPECT_EQ(displayBytes(greys({0.25f}, 0), {.alpha = true}), (std::vector<std::uint8_t>(4, 0)));
}

TEST(DisplayPicture, IsToldByItsSuffix) {
    for (const char* name : {"a.png", "b/A.PNG", "a.b.jpg", "a.jpeg", "a.tga"})
        EXPECT_TRUE(isDisplayPicture(name)) << name;
    for (const char* name : {"a.exr", "png", "a.png/b", "-", "", "a.tif", "a.png.exr"})
        EXPECT_FALSE(isDisplayPicture(name)) << name;
}

TEST_F(PictureTest, PngHoldsSrgbAndComesBackLinear) {
    write("a.png", greys({0, 0.5, 1, 2, 0.18f}));
    EXPECT_EQ(bytesOf("a.png").substr(1, 3), "PNG");
    const Image back = readPicture(at("a.png"));
    ASSERT_EQ(back.channels, (std::vector<std::string>{"R", "G", "B"}));
    ASSERT_EQ(back.width, 5);
    const std::vector<int> bytes = {0, 188, 255, 255, 118};
    for (size_t i = 0; i < bytes.size(); ++i)
        // 1e-6: float rounding of the decoded byte.
        EXPECT_NEAR(back.plane(0)[i], linearFromSrgb(bytes[i] / 255.0), 1e-6) << i;
}

TEST_F(PictureTest, RowsAndChannelsKeepTheirPlace) {
    Image image(2, 2);
    image.addChannels({"R", "G", "B"}, std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, 3);
    // JPEG is left out: it blurs colours over such neighbours.
    for (const char* name : {"a.png", "a.tga"}) {
        write(name, image);
        // Exact: 0 and 1 are fixed points of every step.
        EXPECT_EQ(interleaved(readPicture(at(name)), {"R", "G", "B"}),
                  interleaved(image, {"R", "G", "B"}))
            << name;
    }
}

TEST_F(PictureTest, AlphaIsPremultipliedAgainOnTheWayIn) {
    write("a.png", greys({0.25f}, 0.5f), {.alpha = true});
    const Image back = readPicture(at("a.png"));
    ASSERT_EQ(back.channels.size(), 4u);
    // 0.004: half a step of 8 bits in alpha and, by the curve's slope, in colour.
    EXPECT_NEAR(back.plane(0)[0], 0.25, 0.004);
    EXPECT_NEAR(back.plane(3)[0], 0.5, 0.004);
}

TEST_F(PictureTest, JpegIsWrittenWithoutAlpha) {
    write("a.jpg", greys(std::vector<float>(64, 0.5f)), {.alpha = true});
    const Image back = readEnvironment({at("a.jpg"), ""}).map;
    ASSERT_EQ(back.channels.size(), 3u);
    // 0.01: one step of 8 bits, which is what JPEG may be off for an even grey.
    EXPECT_NEAR(back.plane(1)[10], 0.5, 0.01);
}

TEST_F(PictureTest, AnEnvironmentIsTwiceAsWideAsHigh) {
    const auto warningsOf = [&](int width, int height) {
        const std::vector<float> pixels(static_cast<size_t>(width * height), 0.5f);
        Image image(width, height);
        for (const char* name : {"R", "G", "B"}) image.addChannels({name}, pixels, 1);
        write("a.png", image);
        EXPECT_TRUE(readPlate({at("a.png"), ""}).warnings.empty());
        return readEnvironment({at("a.png"), ""}).warnings;
    };
    EXPECT_TRUE(warningsOf(64, 32).empty());
    EXPECT_TRUE(warningsOf(65, 33).empty()); // by edges
    const auto warnings = warningsOf(64, 48);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("64 x 48"), std::string::npos);
}

TEST_F(PictureTest, RadianceHdrIsLinear) {
    // One pixel of (0.5, 0.25, 2): mantissas over 256 times 2^(exponent - 128).
    putBytes("a.hdr",
             std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n") + "\x20\x10\x80\x82");
    // 1 %: the format's 8-bit mantissa, half a step added or not, as readers differ.
    const Image back = readEnvironment({at("a.hdr"), ""}).map;
    EXPECT_NEAR(back.plane(0)[0], 0.5, 0.02);
    EXPECT_NEAR(back.plane(1)[0], 0.25, 0.02);
    EXPECT_NEAR(back.plane(2)[0], 2, 0.02);
}

TEST_F(PictureTest, RepeatsByteForByteAcrossSeconds) {
    const Image image = numbered(50, 40, {"R", "G", "B", "A"});
    for (const char* suffix : {".png", ".jpg", ".tga"}) write(std::string("a") + suffix, image);
    // Dates in files count whole seconds.
    ::usleep(1'100'000);
    for (const char* suffix : {".png", ".jpg", ".tga"}) {
        write(std::string("b") + suffix, image);
        EXPECT_TRUE(bytesOf(std::string("a") + suffix) == bytesOf(std::string("b") + suffix))
            << suffix;
    }
    EXPECT_EQ(bytesOf("a.png").find("tIME"), std::string::npos);
    EXPECT_EQ(bytesOf("a.png").find("Date"), std::string::npos);
}

TEST_F(PictureTest, ExrIsReadWithoutTheModuleWhateverItsName) {
    exr("a.dat", numbered(3, 2, {"R", "G", "B"}));
    const ModulesFolder none(folder.string());
    EXPECT_EQ(readPicture(at("a.dat")).channels.size(), 3u);
}

TEST_F(PictureTest, FailuresHaveTheirStatusAndLeaveNoFile) {
    Image image = greys({0, 1});
    expectError(ExitStatus::usage, {"a.gif", ".png"}, [&] { write("a.gif", image); });
    image.plane(3)[1] = std::nanf("");
    expectError(ExitStatus::internal, {"a.png", "'A'", "(1, 0)"}, [&] { write("a.png", image); });
    expectError(ExitStatus::internal, {"'R'"}, [&] { write("a.png", numbered(2, 2, {"Z"})); });
    EXPECT_TRUE(std::filesystem::is_empty(folder));

    std::filesystem::create_symlink("/dev/full", at("full.png"));
    expectError(ExitStatus::io, {"full.png", "No space left"}, [&] {
        write("full.png", greys({0, 1}));
    });
    expectError(ExitStatus::missing, {"none.png"}, [&] { readPicture(at("none.png")); });
    putBytes("garbage.png", std::string(3000, 'x'));
    expectError(ExitStatus::data, {"garbage.png"}, [&] { readPicture(at("garbage.png")); });
    write("cut.png", numbered(90, 90, {"R", "G", "B"}));
    putBytes("cut.png", bytesOf("cut.png").substr(0, 200));
    ::testing::internal::CaptureStderr();
    expectError(ExitStatus::data, {"cut.png"}, [&] { readPicture(at("cut.png")); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "main alone reports errors";
}

TEST_F(PictureTest, AMissingModuleIsNamedWithTheLoadersReason) {
    std::filesystem::create_directory(at("empty"));
    const ModulesFolder none(at("empty"));
    const std::vector<std::string> words = {"empty/libeikonal_oiio.so", "cannot open",
                                            "EIKONAL_MODULES"};
    expectError(ExitStatus::missing, words, [] { requirePictureModule(); });
    expectError(ExitStatus::missing, words, [&] { write("a.png", greys({1})); });
    putBytes("a.hdr", "#?RADIANCE\n");
    expectError(ExitStatus::missing, words, [&] { readPicture(at("a.hdr")); });
    putBytes("empty/libeikonal_oiio.so", "no library");
    expectError(ExitStatus::missing, {"libeikonal_oiio.so"}, [] { requirePictureModule(); });
}

TEST_F(PictureTest, NoProgramIsLinkedWithOpenImageIO) {
    const std::string libraries = linkedLibraries();
    ASSERT_NE(libraries.find("libOpenEXR"), std::string::npos) << libraries;
    EXPECT_EQ(libraries.find("OpenImageIO"), std::string::npos) << libraries;
    EXPECT_NO_THROW(requirePictureModule()) << "found beside the program";
}
