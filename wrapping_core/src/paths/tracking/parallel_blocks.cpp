// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/parallel_blocks.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "tautline/error.h"

namespace tautline {
namespace {

/** Between two looks for an interruption. */
constexpr auto kPatience = std::chrono::milliseconds(50);

/** The items of one call of runBlocks(), and how far they are. */
class BlockQueue {
public:
    BlockQueue(int numItems, int itemsPerBlock, const std::function<void(int, int)>& work)
        : m_work(work), m_itemsPerBlock(itemsPerBlock), m_end(numItems) {}

    /** Takes blocks until none is left. Throws nothing. */
    void workThrough(int worker) {
        for (;;) {
            const int first = takeBlock();
            if (first >= m_end) return;
            const long last = std::min<long>(static_cast<long>(first) + m_itemsPerBlock, m_end);
            for (int item = first; item < last && item < m_end; ++item)
                if (!workOn(worker, item)) break;
        }
    }

    void stop() { m_end = 0; }

    void rethrow() const {
        if (m_error) std::rethrow_exception(m_error);
    }

private:
    /** @return its first item; once all are taken, the end */
    int takeBlock() {
        const std::lock_guard<std::mutex> lock(m_mutex);
        const int first = m_next, end = m_end;
        m_next = end - first <= m_itemsPerBlock ? std::max(first, end) : first + m_itemsPerBlock;
        return first;
    }

    bool workOn(int worker, int item) {
        try {
            m_work(worker, item);
            return true;
        } catch (...) {
            const std::lock_guard<std::mutex> lock(m_mutex);
            if (item < m_end) m_end = item, m_error = std::current_exception();
            return false;
        }
    }

    const std::function<void(int, int)>& m_work;
    const int m_itemsPerBlock;
    std::atomic<int> m_end;  ///< items from here on are not worked on
    std::mutex m_mutex;
    int m_next = 0;
    std::exception_ptr m_error;  ///< of item m_end, unless all went well
};

/** Joined whatever happens, be it that the system has no more threads. */
struct JoinedThreads {
    JoinedThreads() = default;
    JoinedThreads(const JoinedThreads&) = delete;
    JoinedThreads& operator=(const JoinedThreads&) = delete;
    ~JoinedThreads() {
        for (std::thread& thread : threads) thread.join();
    }
    std::vector<std::thread> threads;
};

/** Threads that work through a queue, until they are done or this goes out of scope. */
class Workers {
public:
    Workers(BlockQueue& queue, int firstWorker, int end) : m_numWorking(end - firstWorker) {
        for (int worker = firstWorker; worker < end; ++worker)
            m_joined.threads.emplace_back([this, &queue, worker] {
                queue.workThrough(worker);
                const std::lock_guard<std::mutex> lock(m_mutex);
                --m_numWorking;
                m_ended.notify_all();
            });
    }

    /** @return whether all have ended in this time */
    bool waitFor(std::chrono::milliseconds time) {
        std::unique_lock<std::mutex> lock(m_mutex);
        return m_ended.wait_for(lock, time, [this] { return m_numWorking == 0; });
    }

private:
    std::mutex m_mutex;
    std::condition_variable m_ended;
    int m_numWorking;
    JoinedThreads m_joined;  ///< last, since they use the others
};

/** @return whether the work was interrupted */
bool watch(Workers& workers, const std::function<bool()>& isInterrupted, BlockQueue& queue) {
    bool isStopped = false;
    while (!workers.waitFor(kPatience)) {
        if (isStopped || !isInterrupted()) continue;
        isStopped = true;
        queue.stop();
    }
    return isStopped;
}

}  // namespace

int countWorkers(int numItems, int itemsPerBlock, const Threads& threads) {
    require(threads.count >= 0, "threads must not be negative, but is ", threads.count);
    require(numItems >= 0, "the number of items must not be negative, but is ", numItems);
    require(itemsPerBlock > 0, "a block must have an item, but has ", itemsPerBlock);
    const int wanted = threads.count > 0 ? threads.count : static_cast<int>(std::thread::hardware_concurrency());
    const int numBlocks = numItems / itemsPerBlock + (numItems % itemsPerBlock != 0);
    return std::max(1, std::min(wanted, numBlocks));
}

bool runBlocks(int numItems, int itemsPerBlock, const Threads& threads, const std::function<void(int, int)>& work) {
    const int numWorkers = countWorkers(numItems, itemsPerBlock, threads);
    BlockQueue queue(numItems, itemsPerBlock, work);
    bool isStopped = false;
    if (threads.isInterrupted) {
        Workers workers(queue, 0, numWorkers);
        isStopped = watch(workers, threads.isInterrupted, queue);
    } else {
        const Workers others(queue, 1, numWorkers);
        queue.workThrough(0);
    }
    if (!isStopped) queue.rethrow();
    return !isStopped;
}

}  // namespace tautline
