// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

namespace tautline::python {

/** So many items in a row go to a worker, unless said otherwise: neighbors have much in common. */
inline constexpr int kItemsPerBlock = 16;

/** Calls work(worker, i) for every i below `count`, on several threads, with Python's lock released. What work throws
ends all workers and is thrown here, as is KeyboardInterrupt after Ctrl-C.
@param numThreads   0: as many as the machine has
@param work   called with the worker's number and i; may take Python's lock
@param itemsPerBlock   from the first item on, so many go to one worker, in the order of i and with none between them */
void runParallel(int count, int numThreads, const std::function<void(int worker, int i)>& work,
                 int itemsPerBlock = kItemsPerBlock);

/** How many workers runParallel() will have. */
int countWorkers(int count, int numThreads, int itemsPerBlock = kItemsPerBlock);

/** Throws where the work of this thread shall end: for calls of Python functions in the midst of an item. */
void throwIfStopped();

}  // namespace tautline::python
