// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

namespace tautline {

/** So many poses of a row are solved one after another, the first of them by itself and the others continued from the
one before; then a new block begins. Long enough that the first one's search costs little, short enough that a motion of
some hundred frames keeps all threads busy. */
inline constexpr int kPosesPerBlock = 64;

/** Who shares a piece of work. */
struct Threads {
    int count = 0;  ///< 0: as many as the machine has
    /** If given, asked by the calling thread twenty times a second while the others work; true ends the work. */
    std::function<bool()> isInterrupted;
};

/** How many workers runBlocks() has: no more than there are blocks, and one at least.
@throws InvalidInput if a count is negative, or a block has no item */
int countWorkers(int numItems, int itemsPerBlock, const Threads& threads);

/** Calls work(worker, item) for all items from 0 on. Each block of items belongs to one worker, in order, with none of
another block in between; workers take the next block when they are done with one. So what comes out depends on the
number of threads only if work depends on more than its block.

If work throws, items beyond the one concerned are left out, and those before it still done: it is always the first of
all errors that is thrown here. Plain threads do it: blocks are few, alike, and do not spawn others, so that there is
nothing for a scheduler of tasks to gain.
@param work   with the worker's number, below countWorkers(), for its workspace
@return false if it was interrupted */
bool runBlocks(int numItems, int itemsPerBlock, const Threads& threads,
               const std::function<void(int worker, int item)>& work);

}  // namespace tautline
