// SPDX-License-Identifier: Apache-2.0
#include "parallel_work.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <stdexcept>

namespace tautline::python {
namespace {

/** Of the work of this thread; null outside of runParallel(). */
thread_local const std::atomic<bool>* isThreadStopped = nullptr;

/** Whether Ctrl-C was pressed; it is raised again once all have stopped. */
bool findControlC() {
    const pybind11::gil_scoped_acquire python;
    const bool isPressed = PyErr_CheckSignals() != 0;
    if (isPressed) PyErr_Clear();
    return isPressed;
}

void run(int numThreads, std::atomic<bool>& isStopped, const std::function<bool(const Threads&)>& work) {
    bool isDone = false;
    {
        const pybind11::gil_scoped_release released;
        isDone = work({numThreads, [&isStopped] {
                           if (findControlC()) isStopped = true;
                           return isStopped.load();
                       }});
    }
    if (isDone) return;
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw pybind11::error_already_set();
}

}  // namespace

void throwIfStopped() {
    if (isThreadStopped && *isThreadStopped) throw std::runtime_error("stopped");
}

void runInterruptibly(int numThreads, const std::function<bool(const Threads&)>& work) {
    std::atomic<bool> isStopped{false};
    run(numThreads, isStopped, work);
}

void runParallel(int count, int numThreads, const std::function<void(int, int)>& work) {
    std::atomic<bool> isStopped{false};
    run(numThreads, isStopped, [&](const Threads& threads) {
        return runBlocks(count, kItemsPerBlock, threads, [&](int worker, int i) {
            isThreadStopped = &isStopped;
            work(worker, i);
        });
    });
}

}  // namespace tautline::python
