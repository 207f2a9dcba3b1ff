// What goes into a buffer or texture comes out of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/program.h"
#include "gpu/resources.h"
#include "support/device.h"

#include <gtest/gtest.h>
#include <numeric>

using namespace eikonal::gpu;

namespace {

std::vector<float> numbers(size_t count) {
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), 0.5f);
    return values;
}

} // namespace

TEST(GpuBuffer, RoundTrips) {
    const auto values = numbers(1000);
    Buffer buffer(eikonal::device(), 4000, values.data());
    std::vector<float> back(1000);
    buffer.download(back.data(), 4000);
    EXPECT_EQ(back, values);

    const float other[2] = {-1, -2};
    buffer.upload(other, 8, 40);
    buffer.download(back.data(), 16, 36); // items 9 to 12
    EXPECT_EQ(back[0], 9.5f);
    EXPECT_EQ(back[1], -1);
    EXPECT_EQ(back[2], -2);
    EXPECT_EQ(back[3], 12.5f);

    buffer.clear();
    buffer.download(back.data(), 4000);
    EXPECT_EQ(back, std::vector<float>(1000, 0));
    eikonal::device().check("the test");
}

TEST(GpuBuffer, MovesAndMayBeEmpty) {
    const auto values = numbers(4);
    Buffer a(eikonal::device(), 16, values.data());
    Buffer b = std::move(a);
    Buffer c;
    c = std::move(b);
    EXPECT_EQ(c.bytes(), 16);
    std::vector<float> back(4);
    c.download(back.data(), 16);
    EXPECT_EQ(back, values);
    const Buffer none(eikonal::device(), 0);
    EXPECT_EQ(none.bytes(), 0);
    eikonal::device().check("the test");
}

TEST(GpuTexture, RoundTripsInEveryFormat) {
    const glm::ivec3 size(7, 5, 3); // rows of 7 bytes: alignment must not matter
    for (const TexelFormat format : {TexelFormat::r32f, TexelFormat::rg32f, TexelFormat::rgba32f}) {
        const auto values = numbers(static_cast<size_t>(7 * 5 * 3 * componentsOf(format)));
        Texture texture(eikonal::device(), size, format, Filter::nearest);
        texture.upload(values.data());
        std::vector<float> back(values.size());
        texture.download(back.data(), texture.bytes());
        EXPECT_EQ(back, values);
    }
    std::vector<std::uint8_t> bytes(7 * 5 * 3), bytesBack(bytes.size());
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
    Texture texture(eikonal::device(), size, TexelFormat::r8ui, Filter::nearest);
    EXPECT_EQ(texture.bytes(), 7 * 5 * 3);
    texture.upload(bytes.data());
    texture.download(bytesBack.data(), texture.bytes());
    EXPECT_EQ(bytesBack, bytes);
    texture.clear();
    texture.download(bytesBack.data(), texture.bytes());
    EXPECT_EQ(bytesBack, std::vector<std::uint8_t>(bytes.size(), 0));
    std::vector<std::uint32_t> words(7 * 5 * 3, 0xdeadbeef), wordsBack(words.size());
    Texture integers(eikonal::device(), size, TexelFormat::r32ui, Filter::nearest);
    integers.upload(words.data());
    integers.download(wordsBack.data(), integers.bytes());
    EXPECT_EQ(wordsBack, words);
    eikonal::device().check("the test");
}

TEST(GpuTexture, TakesSlicesAndFlatPictures) {
    const auto values = numbers(7 * 5 * 3);
    Texture texture(eikonal::device(), {7, 5, 3}, TexelFormat::r32f, Filter::linear);
    texture.clear();
    texture.uploadSlices(1, 2, values.data());
    std::vector<float> back(7 * 5 * 3);
    texture.download(back.data(), texture.bytes());
    EXPECT_EQ(back[34], 0);
    EXPECT_EQ(back[35], 0.5f);
    EXPECT_EQ(back[104], 69.5f);
    Texture flat(eikonal::device(), {15, 7, 0}, TexelFormat::r32f, Filter::linear);
    EXPECT_EQ(flat.bytes(), 15 * 7 * 4);
    flat.upload(values.data());
    flat.download(back.data(), flat.bytes());
    EXPECT_EQ(back, values);
    eikonal::device().check("the test");
}
