// What the system grants a run: threads and address space, asked for before the work needs them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/resources.h"

#include "base/error.h"
#include "base/text.h"

#include <malloc.h>
#include <mutex>
#include <sys/mman.h>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <vector>

namespace eikonal {

int startableThreads(int wanted) {
    std::mutex gate;
    std::vector<std::thread> threads;
    {
        // All must live at once: what is limited is how many do.
        const std::lock_guard closed(gate);
        threads.reserve(static_cast<size_t>(wanted));
        try {
            for (int i = 0; i < wanted; ++i)
                threads.emplace_back([&gate] { const std::lock_guard pass(gate); });
        } catch (const std::system_error&) {
            // As many as there are.
        }
    }
    for (std::thread& thread : threads) thread.join();
    return static_cast<int>(threads.size());
}

void saveAddressSpace() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        ::mallopt(M_ARENA_MAX, 1);
}

void requireMemory(const std::string& who, std::size_t bytes) {
    void* const probe = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                               MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (probe == MAP_FAILED)
        throw MemoryError(who + " needs " + bytesText(static_cast<double>(bytes)) +
                          ", which the system refuses (ulimit -v?)");
    ::munmap(probe, bytes);
}

} // namespace eikonal
