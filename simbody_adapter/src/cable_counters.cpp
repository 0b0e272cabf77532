// SPDX-License-Identifier: Apache-2.0
#include "cable_counters.h"

#include <cmath>

namespace tautline {

void CableCounters::countSolve(const PathSolution& path, std::chrono::nanoseconds elapsed) {
    ++m_solves;
    if (path.wasCold) ++m_coldSolves;
    if (path.status == PathStatus::NotConverged) ++m_failures;
    // Of a straight path there is nothing more to count, and to add nothing takes its time.
    if (path.iterations > 0) m_iterations += path.iterations;
    if (path.shots > 0) m_shots += path.shots;
    if (elapsed.count() > 0) m_nanoseconds += elapsed.count();
}

void CableCounters::countStep(bool isDegraded, double pathError) {
    ++m_steps;
    if (isDegraded) ++m_degradedSteps;
    // An error that is no number stays: it must not be lost.
    double largest = m_largestPathError;
    while (!(pathError <= largest) && !std::isnan(largest))
        if (m_largestPathError.compare_exchange_weak(largest, pathError)) break;
}

void CableCounters::countEvent(PathEvent::Kind kind) {
    switch (kind) {
        case PathEvent::Kind::Touched:
        case PathEvent::Kind::Lifted:
        case PathEvent::Kind::Split:
        case PathEvent::Kind::Joined:
        case PathEvent::Kind::ArcMade:
        case PathEvent::Kind::ArcLost:
        case PathEvent::Kind::SwitchedOff:
        case PathEvent::Kind::SwitchedOn:
            ++m_contactEvents;
            return;
        case PathEvent::Kind::Slipped:
            ++m_slips;
            return;
        case PathEvent::Kind::LeftHole:
            ++m_holesLeft;
            return;
    }
}

CableStatistics CableCounters::getStatistics() const {
    CableStatistics result;
    result.numSolves = m_solves;
    result.numColdSolves = m_coldSolves;
    result.numFailures = m_failures;
    result.numIterations = m_iterations;
    result.numShots = m_shots;
    result.numContactEvents = m_contactEvents;
    result.numSteps = m_steps;
    result.numDegradedSteps = m_degradedSteps;
    result.largestPathError = m_largestPathError;
    result.numSlips = m_slips;
    result.numHolesLeft = m_holesLeft;
    result.seconds = 1e-9 * static_cast<double>(m_nanoseconds);
    return result;
}

void CableCounters::reset() {
    for (std::atomic<long>* counter : {&m_solves, &m_coldSolves, &m_failures, &m_iterations, &m_shots, &m_nanoseconds,
                                       &m_steps, &m_degradedSteps, &m_contactEvents, &m_slips, &m_holesLeft})
        *counter = 0;
    m_largestPathError = 0;
}

}  // namespace tautline
