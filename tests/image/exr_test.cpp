// What a written EXR holds, that it repeats, and how writing fails.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr.h"
#include "support/exr_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <csignal>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace eikonal;
using namespace eikonal::image;

namespace {

using ExrTest = ExrFilesTest;

const std::vector<std::string> kRenderChannels = {"R",
                                                  "G",
                                                  "B",
                                                  "A",
                                                  "AR",
                                                  "AG",
                                                  "AB",
                                                  "exit_position.X",
                                                  "exit_position.Y",
                                                  "exit_position.Z",
                                                  "transmittance.R",
                                                  "optical_path_length.V",
                                                  "steps.V",
                                                  "Z",
                                                  "error.V"};

ImageAttributes attributesOf() {
    ImageAttributes attributes;
    attributes.strings = {{"eikonal:tool", "render"},
                          {"eikonal:command", "mesh2vol a.obj -o a.vdb\nrender a.vdb -o a.exr"},
                          {"comments", "a glass"}};
    attributes.hasCamera = true;
    attributes.worldToCamera = glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3));
    attributes.worldToNDC = glm::scale(glm::dmat4(1), glm::dvec3(4, 5, 6));
    attributes.worldToNDC[2][3] = 7; // the perspective row: row 3, column 2 of column-vector form
    return attributes;
}

} // namespace

TEST_F(ExrTest, EveryChannelComesBackAsItWas) {
    // 70 rows are more than four blocks of ZIP's 16 lines, with a rest.
    const Image image = numbered(37, 70, kRenderChannels);
    exr("a.exr", image);
    const Image back = readExr(at("a.exr"));
    ASSERT_EQ(back.width, 37);
    ASSERT_EQ(back.height, 70);
    ASSERT_EQ(back.channels.size(), kRenderChannels.size());
    EXPECT_EQ(back.envmap, Envmap::none);
    // Exact: 32-bit floats go through lossless compression.
    EXPECT_EQ(interleaved(back, kRenderChannels), interleaved(image, kRenderChannels));
}

TEST_F(ExrTest, RowZeroIsOnTop) {
    exr("a.exr", numbered(2, 3, {"R", "G", "B"}));
    Imf::InputFile file(at("a.exr").c_str());
    float line[2] = {};
    Imf::FrameBuffer planes;
    planes.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(line), sizeof(float), 0));
    file.setFrameBuffer(planes);
    file.readPixels(2); // y grows downwards in EXR
    EXPECT_EQ(line[1], 2 + 1.f / 64);
}

TEST_F(ExrTest, HeaderTellsCameraColourAndHistory) {
    exr("a.exr", numbered(4, 4, kRenderChannels), attributesOf());
    Imf::InputFile file(at("a.exr").c_str());
    const Imf::Header& header = file.header();
    EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(header.channels()["steps.V"].type, Imf::FLOAT);

    ASSERT_TRUE(Imf::hasChromaticities(header));
    const Imf::Chromaticities& primaries = Imf::chromaticities(header);
    EXPECT_EQ(primaries.red, Imath::V2f(0.64f, 0.33f));
    EXPECT_EQ(primaries.green, Imath::V2f(0.30f, 0.60f));
    EXPECT_EQ(primaries.blue, Imath::V2f(0.15f, 0.06f));
    EXPECT_EQ(primaries.white, Imath::V2f(0.3127f, 0.3290f));

    // By use rather than by element: Imath's own product is what readers of the file will do.
    // Exact, since the numbers are small integers.
    EXPECT_EQ(Imath::V3f(10, 20, 30) * Imf::worldToCamera(header), Imath::V3f(11, 22, 33));
    EXPECT_EQ(Imath::V4f(1, 1, 1, 1) * Imf::worldToNDC(header), Imath::V4f(4, 5, 6, 8));

    const ImageAttributes attributes = attributesOf();
    for (const auto& [name, text] : attributes.strings) {
        const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
        ASSERT_NE(attribute, nullptr) << name;
        EXPECT_EQ(attribute->value(), text);
    }
}

TEST_F(ExrTest, HeaderHasNoDateNorCameraUnlessThereIsOne) {
    exr("a.exr", numbered(4, 4, {"R", "G", "B"}));
    Imf::InputFile file(at("a.exr").c_str());
    EXPECT_FALSE(Imf::hasCapDate(file.header()));
    EXPECT_FALSE(Imf::hasWorldToCamera(file.header()));
    EXPECT_FALSE(Imf::hasWorldToNDC(file.header()));
}

TEST_F(ExrTest, RepeatsByteForByteOnAnyNumberOfThreads) {
    const Image image = numbered(200, 300, kRenderChannels);
    exr("a.exr", image, attributesOf(), 1);
    const std::string once = bytesOf("a.exr");
    ASSERT_FALSE(once.empty());
    for (const int threads : {1, 2, 7, 0}) {
        exr("b.exr", image, attributesOf(), threads);
        EXPECT_TRUE(bytesOf("b.exr") == once) << threads << " threads";
    }
}

TEST_F(ExrTest, FifoGetsTheSameBytesAsAFile) {
    const Image image = numbered(64, 64, kRenderChannels);
    exr("a.exr", image);
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = bytesOf("pipe"); });
    exr("pipe", image);
    reader.join();
    EXPECT_TRUE(received == bytesOf("a.exr"));
}

TEST_F(ExrTest, NanAndInfinityAreFaultsOfOursWithTheirPlace) {
    Image image = numbered(5, 4, {"R", "G", "B", "exit_position.X"});
    image.plane(3)[2 * 5 + 3] = std::numeric_limits<float>::quiet_NaN();
    expectError(ExitStatus::internal, {"a.exr", "'exit_position.X'", "nan", "(3, 2)"},
                [&] { exr("a.exr", image); });
    image.plane(3)[2 * 5 + 3] = 0;
    image.plane(1)[19] = -std::numeric_limits<float>::infinity();
    expectError(ExitStatus::internal, {"'G'", "inf", "(4, 3)"}, [&] { exr("a.exr", image); });
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << "a refused picture left a file";
}

TEST_F(ExrTest, AnImageThatContradictsItselfIsRefused) {
    Image image = numbered(5, 4, {"R", "G", "B"});
    image.channels[2] = "R";
    expectError(ExitStatus::internal, {"twice"}, [&] { exr("a.exr", image); });
    image.channels[2] = "B";
    image.pixels.pop_back();
    expectError(ExitStatus::internal, {"59", "60"}, [&] { exr("a.exr", image); });
    expectError(ExitStatus::internal, {"twice"}, [] {
        Image twice = numbered(2, 2, {"Z"});
        twice.addChannels({"Z"}, std::vector<float>(4), 1);
    });
    expectError(ExitStatus::internal, {"'depth'", "Z"},
                [] { interleaved(numbered(2, 2, {"Z"}), {"depth"}); });
}

TEST_F(ExrTest, AFullDiskIsAnIoErrorWithThePath) {
    // Through a link, as /dev/full has no suffix; small enough to stay in the stream's buffer, and
    // large enough not to.
    std::filesystem::create_symlink("/dev/full", at("full.exr"));
    for (const int size : {4, 400})
        expectError(ExitStatus::io, {"full.exr", "No space left"},
                    [&] { exr("full.exr", numbered(size, size, kRenderChannels)); });
}

TEST_F(ExrTest, ALimitOnTheFileSizeIsAnIoErrorThatLeavesNothing) {
    // A regular file that can't grow, which is the seeking path's full disk. The child keeps the
    // limit and the ignored signal to itself.
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        int status = 0;
        try {
            exr("a.exr", numbered(300, 300, kRenderChannels));
        } catch (const Error& error) {
            status = static_cast<int>(error.status());
        }
        ::_exit(status);
    }
    int ended = 0;
    ::waitpid(child, &ended, 0);
    ASSERT_TRUE(WIFEXITED(ended));
    EXPECT_EQ(WEXITSTATUS(ended), static_cast<int>(ExitStatus::io));
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}
