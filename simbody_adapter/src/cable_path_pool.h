// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <mutex>
#include <vector>

namespace tautline {

struct CablePath;

/** The paths of one cable that no State holds any more, for their room: an integrator that looks for an event copies
its State for each pose that it tries, and drops it. Used by many threads at once. */
class CablePathPool : public std::enable_shared_from_this<CablePathPool> {
public:
    CablePathPool();
    ~CablePathPool();
    CablePathPool(const CablePathPool&) = delete;

    /** A path to be overwritten, which comes back when its last holder lets go, even after the cable is gone. */
    std::shared_ptr<CablePath> take();

private:
    void takeBack(std::unique_ptr<CablePath> path);

    std::mutex m_mutex;
    std::vector<std::unique_ptr<CablePath>> m_spares;
};

}  // namespace tautline
