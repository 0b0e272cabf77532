// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "tautline/paths/path_solver.h"

namespace tautline {

/** Switches contacts whose witness is below zero, one at a time, solving after each, until none is left; if that comes
to no end, lets the solver find a contact set from here. A path that is then a saddle is left for the shorter one to
which a string slips from it. For events: the path that they leave is the one next to where they stopped, not the one
that a search from elsewhere would find. */
class ContactSettler {
public:
    /** @param path   in: solved with its contacts kept, or, of status NotConverged, the path from which that failed,
    with what is switched off at this pose; out: solved anew, or as it was where that fails
    @return the obstacle that the string has slipped on: no stable path was left near it; -1: none */
    int settle(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    void refine(const PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path);
    bool switchContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path);

    std::optional<PathSolver> m_refiner;  ///< made when first needed
};

}  // namespace tautline
