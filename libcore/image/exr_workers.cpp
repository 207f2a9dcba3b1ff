// The threads that OpenEXR's tasks run on: as many as there are to be had, the caller's if none.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr_workers.h"

#include <OpenEXR/IlmThreadPool.h>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace eikonal::image {

using IlmThread::Task;
using IlmThread::TaskGroup;

namespace {

void perform(Task* task) {
    TaskGroup* const group = task->group();
    try {
        task->execute();
    } catch (...) {
        // Its block of lines stays unwritten, which the writer finds.
    }
    delete task;
    if (group != nullptr) group->finishOneTask();
}

} // namespace

/// OpenEXR's own provider loses its threads where starting one of several fails, and a caller whose
/// task fails on its own thread then waits for good.
class ExrWorkers::Threads : public IlmThread::ThreadPoolProvider {
public:
    explicit Threads(int wanted) {
        try {
            mThreads.reserve(static_cast<size_t>(wanted));
            for (int i = 0; i < wanted; ++i) mThreads.emplace_back([this] { work(); });
        } catch (const std::exception&) {
            // Those that started will do.
        }
    }
    ~Threads() override { finish(); }

    int numThreads() const override { return static_cast<int>(mThreads.size()); }
    void setNumThreads(int) override {}

    void addTask(Task* task) override {
        if (mThreads.empty()) return perform(task);
        try {
            const std::lock_guard lock(mMutex);
            mTasks.push_back(task);
        } catch (const std::exception&) {
            return perform(task);
        }
        mWake.notify_one();
    }

    void finish() override {
        {
            const std::lock_guard lock(mMutex);
            mStops = true;
        }
        mWake.notify_all();
        for (std::thread& thread : mThreads) thread.join();
        mThreads.clear();
    }

private:
    void work() {
        std::unique_lock lock(mMutex);
        for (;;) {
            mWake.wait(lock, [this] { return mStops || mNext < mTasks.size(); });
            if (mNext == mTasks.size()) return;
            Task* const task = mTasks[mNext++];
            lock.unlock();
            perform(task);
            lock.lock();
        }
    }

    std::mutex mMutex;
    std::condition_variable mWake;
    std::vector<Task*> mTasks; // in the order of arrival
    size_t mNext = 0;          // the first that nobody has taken
    bool mStops = false;
    std::vector<std::thread> mThreads; // last, since they use the others
};

// The pool owns its provider until another takes its place.
ExrWorkers::ExrWorkers(int threads) : mThreads(new Threads(threads > 1 ? threads : 0)) {
    IlmThread::ThreadPool::globalThreadPool().setThreadProvider(mThreads);
}

ExrWorkers::~ExrWorkers() {
    mThreads->finish();
}

int ExrWorkers::count() const {
    return mThreads->numThreads();
}

} // namespace eikonal::image
