// Inputs of every kind, and what the system grants.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/input_file.h"
#include "base/last_line.h"
#include "base/resources.h"
#include "support/scratch.h"

#include <csignal>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

using namespace eikonal;

namespace {

class InputTest : public ScratchTest {};

/// The status and the words of a process that ends in its own way.
std::pair<int, std::string> ended(const std::function<void()>& act) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDERR_FILENO);
        endInOneLine("tool");
        act();
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string said;
    char block[512];
    for (ssize_t got = 0; (got = ::read(ends[0], block, sizeof block)) > 0;)
        said.append(block, static_cast<size_t>(got));
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), said};
}

} // namespace

TEST_F(InputTest, AStreamIsKeptAndSeeks) {
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
    const std::string bytes(200'000, 'x'); // more than a pipe holds
    std::thread writer([&] { std::ofstream(at("pipe")) << bytes; });
    const SeekableInput input(at("pipe"));
    writer.join();
    EXPECT_NE(input.path(), at("pipe"));
    for (int round = 0; round < 2; ++round) EXPECT_TRUE(readWhole(input.path()) == bytes);
    putBytes("file", "abc");
    EXPECT_EQ(SeekableInput(at("file")).path(), at("file"));
    EXPECT_EQ(SeekableInput(at("none")).path(), at("none"));
}

TEST(Resources, ThreadsAndMemoryAreAskedFor) {
    EXPECT_EQ(startableThreads(0), 0);
    EXPECT_EQ(startableThreads(5), 5);
    EXPECT_NO_THROW(requireMemory("the test", 1 << 20));
    expectError(ExitStatus::memory, {"the test", "bytes", "ulimit -v"},
                [] { requireMemory("the test", std::size_t{1} << 62); });
}

TEST(LastLine, IsSaidWhateverALibraryDoes) {
    using Case = std::pair<const char*, std::function<void()>>;
    const std::error_code again = std::make_error_code(std::errc::resource_unavailable_try_again);
    const Case kMemory[] = {
        {"memory", [] { std::thread([] { throw std::bad_alloc(); }).join(); }},
        {"threads", [&] { std::thread([&] { throw std::system_error(again); }).join(); }},
        {"threads", [] { std::thread([] { throw std::runtime_error("pthread_create"); }).join(); }},
    };
    for (const auto& [word, act] : kMemory) {
        const auto [status, said] = ended(act);
        EXPECT_EQ(status, 71) << said;
        EXPECT_NE(said.find(word), std::string::npos) << said;
    }
    const Case kFaults[] = {
        {"two lines", [] { std::thread([] { throw std::runtime_error("two\nlines"); }).join(); }},
        {"no exception", [] { std::thread([] { throw 1; }).join(); }},
        {"SIGSEGV", [] { ::raise(SIGSEGV); }},
        {"SIGABRT", [] { std::abort(); }},
        {"SIGBUS", [] { ::raise(SIGBUS); }},
        {"exit", [] { std::exit(0); }},
    };
    for (const auto& [word, act] : kFaults) {
        const auto [status, said] = ended(act);
        EXPECT_EQ(status, 70) << word << ": " << said;
        EXPECT_EQ(said.rfind("tool: error: ", 0), 0u) << said;
        EXPECT_NE(said.find(word), std::string::npos) << said;
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    }
    // What fails behind the end changes nothing.
    EXPECT_EQ(ended([] {
                  endOrderly(0);
                  std::abort();
              }),
              std::make_pair(0, std::string()));
}

TEST(LastLine, ExceptionsMeanWhatTheyAre) {
    EXPECT_EQ(meaningOf(DataError("x")).status(), ExitStatus::data);
    EXPECT_EQ(meaningOf(std::bad_alloc()).status(), ExitStatus::memory);
    EXPECT_EQ(meaningOf(std::runtime_error("x")).status(), ExitStatus::internal);
    EXPECT_EQ(meaningOf(std::runtime_error("pthread_create has failed")).status(),
              ExitStatus::memory);
}
