// SPDX-License-Identifier: Apache-2.0
#include "cable_path_pool.h"

#include <utility>

#include "cable_states.h"

namespace tautline {
namespace {

constexpr std::size_t kMostSpares = 4;  ///< an integrator has no more States than that in use

}  // namespace

CablePathPool::CablePathPool() = default;
CablePathPool::~CablePathPool() = default;

/** The one that came last, which is the likeliest to be in the processor's cache. */
std::shared_ptr<CablePath> CablePathPool::take() {
    std::unique_ptr<CablePath> path;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (!m_spares.empty()) {
            path = std::move(m_spares.back());
            m_spares.pop_back();
        }
    }
    if (!path) path = std::make_unique<CablePath>();
    return {path.release(),
            [pool = shared_from_this()](CablePath* left) { pool->takeBack(std::unique_ptr<CablePath>(left)); }};
}

void CablePathPool::takeBack(std::unique_ptr<CablePath> path) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_spares.size() < kMostSpares) m_spares.push_back(std::move(path));
}

}  // namespace tautline
