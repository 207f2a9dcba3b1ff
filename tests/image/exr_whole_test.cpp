// A picture is written whole or not at all, also where memory or threads are short.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr_workers.h"
#include "support/exr_files.h"

#include <atomic>
#include <dlfcn.h>
#include <sys/stat.h>

namespace {

// Which block's compression fails, from 1 on; 0: none.
std::atomic<int> failing{0}, compressed{0};

} // namespace

// The program's own stands before zlib's, as the loader resolves names: Z_MEM_ERROR where told.
extern "C" int compress2(unsigned char* out, unsigned long* outSize, const unsigned char* in,
                         unsigned long inSize, int level) {
    using Compress = decltype(compress2);
    static auto* const real = reinterpret_cast<Compress*>(::dlsym(RTLD_NEXT, "compress2"));
    return ++compressed == failing ? -4 : real(out, outSize, in, inSize, level);
}

using namespace eikonal;
using namespace eikonal::image;

namespace {

class ExrWholeTest : public ExrFilesTest {
protected:
    void TearDown() override {
        failing = 0;
        ExrFilesTest::TearDown();
    }
};

constexpr int kBlocks = 7; // of 16 lines

} // namespace

TEST_F(ExrWholeTest, ABlockThatCannotBeCompressedIsNoPicture) {
    const Image image = numbered(50, 16 * kBlocks - 3, {"R", "G", "B", "A"});
    for (const int threads : {1, 3})
        for (int block = 0; block <= kBlocks; ++block) {
            SCOPED_TRACE("block " + std::to_string(block));
            failing = block;
            compressed = 0;
            if (block == 0)
                EXPECT_NO_THROW(exr("out.exr", image, {}, threads));
            else
                expectError(ExitStatus::io, {"out.exr", "not written whole"},
                            [&] { exr("out.exr", image, {}, threads); });
            ASSERT_GE(compressed, std::max(block, 1)) << "zlib's compress2() was not replaced";
            EXPECT_EQ(std::filesystem::exists(at("out.exr")), block == 0);
            std::filesystem::remove(at("out.exr"));
        }
}

TEST_F(ExrWholeTest, SoIsOneThatGoesIntoAPipe) {
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
    std::string got;
    std::thread reader([&] { got = bytesOf("pipe"); });
    failing = 2;
    compressed = 0;
    expectError(ExitStatus::io, {"not written whole"}, [&] {
        exr("pipe", numbered(50, 100, {"R", "G", "B"}));
    });
    reader.join();
    EXPECT_TRUE(got.empty()) << got.size()
                             << " bytes: a reader must not take a part for the picture";
}

TEST_F(ExrWholeTest, AnyNumberOfThreadsWritesTheSameBytes) {
    const Image image = numbered(70, 90, {"R", "G", "B", "A", "error.V"});
    exr("one.exr", image, {}, 1);
    for (const int threads : {2, 5, 64}) {
        exr("more.exr", image, {}, threads);
        EXPECT_TRUE(bytesOf("one.exr") == bytesOf("more.exr")) << threads;
    }
    EXPECT_EQ(ExrWorkers(1).count(), 0) << "one thread is the caller's";
}
