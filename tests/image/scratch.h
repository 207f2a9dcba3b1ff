// A folder of its own for each test of the image room, and what its tests share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "base/error.h"
#include "image/exr.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <string>

namespace eikonal::image {

class ScratchTest : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "eikonal-XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string at(const std::string& name) const { return (folder / name).string(); }

    std::string bytesOf(const std::string& name) const {
        std::ifstream in(at(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    void put(const std::string& name, const std::string& bytes) const {
        std::ofstream(at(name), std::ios::binary) << bytes;
    }

    /// Writes and commits an EXR of that name in the folder.
    void exr(const std::string& name, const Image& image, const ImageAttributes& attributes = {},
             int threads = 1) const {
        AtomicFile out(at(name));
        writeExr(image, attributes, out, threads);
        out.commit();
    }

    std::filesystem::path folder;
};

/// Expects an Error of that status whose message holds every one of the words.
inline void expectError(ExitStatus status, const std::vector<std::string>& words,
                        const std::function<void()>& act) {
    try {
        act();
        ADD_FAILURE() << "no error, expected status " << static_cast<int>(status);
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), status) << error.what();
        const std::string message = error.what();
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos)
                << "'" << word << "' is not in: " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
    }
}

/// An image whose every sample tells its channel and pixel: 100 k + y + x / 64, exact in float.
inline Image numbered(int width, int height, const std::vector<std::string>& names) {
    Image image(width, height);
    std::vector<float> samples;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (size_t k = 0; k < names.size(); ++k)
                samples.push_back(100 * static_cast<float>(k) + static_cast<float>(y) +
                                  static_cast<float>(x) / 64);
    image.addChannels(names, samples, names.size());
    return image;
}

} // namespace eikonal::image
