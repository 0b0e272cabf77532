// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

#include "tautline/paths/parallel_blocks.h"

namespace tautline::python {

/** So many items in a row go to a worker: neighbors have much in common. */
inline constexpr int kItemsPerBlock = 16;

/** Calls work(threads) with Python's lock released; what it throws is thrown here. It hands `threads` on, so that
Ctrl-C ends it, and says whether it was done; if not, KeyboardInterrupt is thrown. */
void runInterruptibly(int numThreads, const std::function<bool(const Threads& threads)>& work);

/** Calls work(worker, i) for every i below `count`, as runBlocks() and interruptibly.
@param numThreads   0: as many as the machine has
@param work   may take Python's lock */
void runParallel(int count, int numThreads, const std::function<void(int worker, int i)>& work);

/** Throws where Ctrl-C shall end the work of this thread: for calls of Python functions in the midst of an item. */
void throwIfStopped();

}  // namespace tautline::python
