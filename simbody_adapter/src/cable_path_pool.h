// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace tautline {

struct CablePath;

/** The paths of one cable that no State holds any more, for their room and for what they say: an integrator that looks
for an event copies its State for each pose that it tries, drops it, and comes back to the poses between which the event
was found. Used by many threads at once. */
class CablePathPool : public std::enable_shared_from_this<CablePathPool> {
public:
    CablePathPool();
    ~CablePathPool();
    CablePathPool(const CablePathPool&) = delete;

    /** A path to be overwritten, which comes back when its last holder lets go, even after the cable is gone. */
    std::shared_ptr<CablePath> take();

    /** One that was continued from the start of this number, for which isWanted(path) holds; null: there is none. */
    template <class Predicate>
    std::shared_ptr<CablePath> find(std::uint64_t startSerial, Predicate isWanted) {
        // Where no event is looked for, without the lock.
        if (m_lastStartSerial.load(std::memory_order_relaxed) != startSerial) return nullptr;
        const std::lock_guard<std::mutex> lock(m_mutex);
        for (auto spare = m_spares.begin(); spare != m_spares.end(); ++spare)
            if (isWanted(**spare)) return share(removeSpare(spare));
        return nullptr;
    }

private:
    using Spares = std::vector<std::unique_ptr<CablePath>>;

    std::unique_ptr<CablePath> removeSpare(Spares::iterator spare);
    std::shared_ptr<CablePath> share(std::unique_ptr<CablePath> path);
    void takeBack(std::unique_ptr<CablePath> path);

    std::mutex m_mutex;
    Spares m_spares;                                  ///< oldest first
    std::atomic<std::uint64_t> m_lastStartSerial{0};  ///< of the spare that came last
};

}  // namespace tautline
