// A folder of its own for each test, and how errors are expected.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

namespace eikonal {

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

    void putBytes(const std::string& name, const std::string& bytes) const {
        std::filesystem::create_directories(std::filesystem::path(at(name)).parent_path());
        std::ofstream(at(name), std::ios::binary) << bytes;
    }

    std::filesystem::path folder;
};

/// Expects an Error of that status whose message holds every one of the words. It is one line but
/// where it quotes a compiler's log.
inline void expectError(ExitStatus status, const std::vector<std::string>& words,
                        const std::function<void()>& act, bool oneLine = true) {
    try {
        act();
        ADD_FAILURE() << "no error, expected status " << static_cast<int>(status);
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), status) << error.what();
        const std::string message = error.what();
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos)
                << "'" << word << "' is not in: " << message;
        EXPECT_TRUE(!oneLine || message.find('\n') == std::string::npos)
            << "more than one line: " << message;
    }
}

} // namespace eikonal
