// SPDX-License-Identifier: Apache-2.0
#include "cable_path_pool.h"

#include <utility>

#include "cable_states.h"

namespace tautline {
namespace {

/** So many of the latest are kept as they are: of the poses that a search for an event has tried, those that its window
lies between are among them mostly. */
constexpr std::size_t kKept = 4;

}  // namespace

CablePathPool::CablePathPool() = default;
CablePathPool::~CablePathPool() = default;

std::shared_ptr<CablePath> CablePathPool::take() {
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (m_spares.size() > kKept) return share(removeSpare(m_spares.begin()));
    }
    return share(std::make_unique<CablePath>());
}

std::unique_ptr<CablePath> CablePathPool::removeSpare(Spares::iterator spare) {
    std::unique_ptr<CablePath> removed = std::move(*spare);
    m_spares.erase(spare);
    return removed;
}

std::shared_ptr<CablePath> CablePathPool::share(std::unique_ptr<CablePath> path) {
    return {path.release(),
            [pool = shared_from_this()](CablePath* left) { pool->takeBack(std::unique_ptr<CablePath>(left)); }};
}

void CablePathPool::takeBack(std::unique_ptr<CablePath> path) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_spares.size() > kKept + 1) m_spares.erase(m_spares.begin());
    m_lastStartSerial.store(path->startSerial, std::memory_order_relaxed);
    m_spares.push_back(std::move(path));
}

}  // namespace tautline
