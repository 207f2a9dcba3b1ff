// Runs the hard cases: with a seed that is told, and every failure says how to see it again.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <string>

namespace {

/// What a failed case is run again with.
class Rerun : public testing::EmptyTestEventListener {
public:
    explicit Rerun(std::string program) : mProgram(std::move(program)) {}

    void OnTestEnd(const testing::TestInfo& test) override {
        if (!test.result()->Failed()) return;
        std::cout << "    rerun: RC_PARAMS='" << std::getenv("RC_PARAMS") << "' " << mProgram
                  << " --gtest_filter='" << test.test_suite_name() << "." << test.name() << "'\n";
    }

private:
    std::string mProgram;
};

} // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    // Every example of a property is a picture or a simulation: ten of them, and none to shrink a
    // failure by, which would take minutes.
    const std::string params = "seed=" + std::to_string(std::random_device{}()) +
                               " max_success=10 max_discard_ratio=20 noshrink=1";
    ::setenv("RC_PARAMS", params.c_str(), 0);
    std::cout << "RC_PARAMS='" << std::getenv("RC_PARAMS") << "'\n";
    testing::UnitTest::GetInstance()->listeners().Append(new Rerun(argv[0]));
    return RUN_ALL_TESTS();
}
