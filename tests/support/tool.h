// The tools as users run them: a command's status and what it said.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>

namespace eikonal {

struct Ran {
    int status = 0;
    std::string said; ///< standard error
};

/// Runs a command line of the tools in a folder.
inline Ran run(const std::string& command, const std::filesystem::path& folder) {
    const std::string line = "cd '" + folder.string() +
                             "' && PATH='" EIKONAL_BIN_DIR "':$PATH && " + command +
                             " >stdout.txt 2>stderr.txt";
    const int result = std::system(line.c_str());
    Ran ran;
    ran.status = WIFEXITED(result) ? WEXITSTATUS(result) : 128;
    std::ifstream in(folder / "stderr.txt");
    ran.said.assign(std::istreambuf_iterator<char>(in), {});
    return ran;
}

/// A command that fails with that status, in one line of error that holds the words, and leaves no
/// output.
inline void refused(int status, const std::vector<std::string>& words, const std::string& command,
                    const std::filesystem::path& folder) {
    SCOPED_TRACE(command);
    const Ran ran = run(command, folder);
    EXPECT_EQ(ran.status, status) << ran.said;
    for (const std::string& word : words)
        EXPECT_NE(ran.said.find(word), std::string::npos) << "no '" << word << "' in: " << ran.said;
    size_t errors = 0;
    for (size_t at = ran.said.find(": error: "); at != std::string::npos;
         at = ran.said.find(": error: ", at + 1))
        ++errors;
    EXPECT_EQ(errors, 1u) << ran.said;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(name.rfind("out", 0) != 0 && name.rfind(".out", 0) != 0) << "left " << name;
    }
}

} // namespace eikonal
