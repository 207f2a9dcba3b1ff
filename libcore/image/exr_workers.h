// The threads that OpenEXR's tasks run on: as many as there are to be had, the caller's if none.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace eikonal::image {

/// Lends OpenEXR's process-wide pool up to that many threads for as long as it lives; one at a
/// time. A thread that the system refuses is done without, and a task that fails for want of memory
/// counts as done, so that nobody waits for it: whoever writes looks at what was written.
class ExrWorkers {
public:
    explicit ExrWorkers(int threads);
    ~ExrWorkers();
    ExrWorkers(const ExrWorkers&) = delete;
    ExrWorkers& operator=(const ExrWorkers&) = delete;

    /// Threads beside the caller's; 0: the caller's thread does the work.
    int count() const;

private:
    class Threads;
    Threads* mThreads;
};

} // namespace eikonal::image
