// SPDX-License-Identifier: Apache-2.0
#include "parallel_work.h"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "tautline/error.h"

namespace tautline::python {
namespace {

/** Between two looks for Ctrl-C. */
constexpr auto kPatience = std::chrono::milliseconds(50);

/** Items, and who works on them. */
struct Shared {
    std::atomic<int> next{0};
    std::atomic<bool> isStopped{false};
    std::mutex mutex;
    std::condition_variable ended;
    int numWorking = 0;
    std::exception_ptr error;
};

/** Of the work of this thread; null outside of runParallel(). */
thread_local const std::atomic<bool>* isThreadStopped = nullptr;

void workThrough(Shared& shared, int worker, int count, int itemsPerBlock, const std::function<void(int, int)>& work) {
    isThreadStopped = &shared.isStopped;
    try {
        while (!shared.isStopped) {
            const int first = shared.next.fetch_add(itemsPerBlock);
            if (first >= count) break;
            for (int i = first; i < std::min(first + itemsPerBlock, count) && !shared.isStopped; ++i) work(worker, i);
        }
    } catch (...) {
        const std::lock_guard<std::mutex> lock(shared.mutex);
        if (!shared.error) shared.error = std::current_exception();
        shared.isStopped = true;
    }
    const std::lock_guard<std::mutex> lock(shared.mutex);
    --shared.numWorking;
    shared.ended.notify_all();
}

/** Waits for all workers, and tells them to stop on Ctrl-C. @return whether it was pressed */
bool waitForAll(Shared& shared) {
    bool isInterrupted = false;
    std::unique_lock<std::mutex> lock(shared.mutex);
    while (!shared.ended.wait_for(lock, kPatience, [&] { return shared.numWorking == 0; })) {
        lock.unlock();
        if (!isInterrupted) {
            const pybind11::gil_scoped_acquire python;
            isInterrupted = PyErr_CheckSignals() != 0;
            if (isInterrupted) PyErr_Clear();  // raised again once all have stopped
        }
        if (isInterrupted) shared.isStopped = true;
        lock.lock();
    }
    return isInterrupted;
}

}  // namespace

void throwIfStopped() {
    if (isThreadStopped && *isThreadStopped) throw std::runtime_error("stopped");
}

int countWorkers(int count, int numThreads, int itemsPerBlock) {
    require(numThreads >= 0, "threads must not be negative, but is ", numThreads);
    const int wanted = numThreads > 0 ? numThreads : static_cast<int>(std::thread::hardware_concurrency());
    return std::max(1, std::min(wanted, (count + itemsPerBlock - 1) / itemsPerBlock));
}

void runParallel(int count, int numThreads, const std::function<void(int, int)>& work, int itemsPerBlock) {
    Shared shared;
    const int numWorkers = countWorkers(count, numThreads, itemsPerBlock);
    bool isInterrupted = false;
    {
        const pybind11::gil_scoped_release released;
        shared.numWorking = numWorkers;
        std::vector<std::thread> threads;
        for (int worker = 0; worker < numWorkers; ++worker)
            threads.emplace_back([&, worker] { workThrough(shared, worker, count, itemsPerBlock, work); });
        isInterrupted = waitForAll(shared);
        for (std::thread& thread : threads) thread.join();
    }
    if (isInterrupted) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw pybind11::error_already_set();
    }
    if (shared.error) std::rethrow_exception(shared.error);
}

}  // namespace tautline::python
