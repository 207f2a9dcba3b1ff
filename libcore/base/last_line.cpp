// The last line of a run that a library ends: by a signal, an exception nobody can catch, or
// exit(). SPDX-License-Identifier: GPL-3.0-or-later
#include "base/last_line.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/standard_error.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace eikonal {

namespace {

// Process-wide, since handlers can reach nothing else.
const char* toolName = "eikonal";
std::atomic<int> orderly{-1}; // the status of a run that has ended

constexpr const char* kNoMemory = "not enough memory on the host";
constexpr const char* kNoThread = "the system allows no more threads";

/// The standard library's, or TBB's, where the system refuses a thread.
bool wantsThread(const std::exception& error) {
    const auto* const system = dynamic_cast<const std::system_error*>(&error);
    return (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) ||
           std::strstr(error.what(), "pthread_create") != nullptr;
}

/// Only what a signal handler may do: no allocation, no lock.
[[noreturn]] void end(ExitStatus status, std::string_view reason) {
    removeTemporaries();
    std::array<char, 512> line;
    size_t length = 0;
    for (const std::string_view part : {std::string_view(toolName), std::string_view(": error: "),
                                        reason.substr(0, 400), std::string_view("\n")}) {
        const size_t fits = std::min(part.size(), line.size() - length);
        std::memcpy(line.data() + length, part.data(), fits);
        length += fits;
    }
    std::replace(line.data(), line.data() + length - 1, '\n', ' ');
    tell({line.data(), length});
    ::_exit(static_cast<int>(status));
}

/// Whether the system refuses memory now, as it did just before where a library took no for a yes.
bool memoryIsShort() {
    const size_t kProbe = size_t{64} << 20; // what an allocator asks for to serve a new thread
    void* const probe =
        ::mmap(nullptr, kProbe, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (probe == MAP_FAILED) return true;
    ::munmap(probe, kProbe);
    return false;
}

[[noreturn]] void endByLibrary(std::string_view reason) {
    if (memoryIsShort()) end(ExitStatus::memory, kNoMemory);
    end(ExitStatus::internal, reason);
}

/// What fails once the outputs are there changes nothing.
void passOver() {
    if (orderly >= 0) ::_exit(orderly);
}

[[noreturn]] void onTerminate() {
    passOver();
    try {
        if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
        endByLibrary("a library ended the run");
    } catch (const std::bad_alloc&) {
        end(ExitStatus::memory, kNoMemory);
    } catch (const std::exception& error) {
        if (wantsThread(error)) end(ExitStatus::memory, kNoThread);
        endByLibrary(error.what());
    } catch (...) {
        endByLibrary("a library threw what is no exception");
    }
}

void onFatalSignal(int signal) {
    passOver();
    switch (signal) {
    case SIGABRT:
        endByLibrary("a library ended the run (SIGABRT)");
    case SIGBUS:
        endByLibrary("a library crashed (SIGBUS)");
    case SIGFPE:
        endByLibrary("a library crashed (SIGFPE)");
    case SIGILL:
        endByLibrary("a library crashed (SIGILL)");
    default:
        endByLibrary("a library crashed (SIGSEGV)");
    }
}

/// Handlers that are there already (a sanitizer's) stay.
void handle(int signal) {
    struct sigaction old {};
    if (::sigaction(signal, nullptr, &old) != 0 || old.sa_handler != SIG_DFL) return;
    struct sigaction action {};
    action.sa_handler = onFatalSignal;
    action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
}

} // namespace

void endExceptionsInOneLine(const char* tool) {
    toolName = tool;
    std::set_terminate(onTerminate);
}

void endInOneLine(const char* tool) {
    endExceptionsInOneLine(tool);
    // A stack that overflowed holds no handler: it gets one of its own.
    static std::array<char, 1 << 16> stack;
    stack_t place{};
    place.ss_sp = stack.data();
    place.ss_size = stack.size();
    ::sigaltstack(&place, nullptr);
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) handle(signal);
    std::atexit([] {
        if (orderly < 0) endByLibrary("a library ended the run (exit)");
    });
}

Error meaningOf(const std::exception& error) {
    if (const auto* const known = dynamic_cast<const Error*>(&error)) return *known;
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return MemoryError(kNoMemory);
    if (wantsThread(error)) return MemoryError(kNoThread);
    return InternalError(error.what());
}

void endOrderly(int status) {
    orderly = status;
}

} // namespace eikonal
