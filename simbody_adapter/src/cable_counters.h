// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <chrono>

#include "tautline/paths/path_tracker.h"
#include "tautline/simbody/cable.h"

namespace tautline {

/** What a cable has done since it was built or reset: counted by all threads that realize States. */
class CableCounters {
public:
    void countSolve(const PathSolution& path, std::chrono::nanoseconds elapsed);
    /** @param pathError   of the path at the step's end */
    void countStep(bool isDegraded, double pathError);
    void countEvent(PathEvent::Kind kind);

    CableStatistics getStatistics() const;
    void reset();

private:
    std::atomic<long> m_solves{0}, m_coldSolves{0}, m_failures{0}, m_iterations{0}, m_shots{0}, m_nanoseconds{0};
    std::atomic<long> m_steps{0}, m_degradedSteps{0};
    std::atomic<long> m_contactEvents{0}, m_slips{0}, m_holesLeft{0};
    std::atomic<double> m_largestPathError{0};
};

}  // namespace tautline
