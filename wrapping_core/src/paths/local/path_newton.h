// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/local/path_stepper.h"

namespace tautline {

/** Newton's method on the path error of one contact set (thesis Sec. 4.6): fast from near, and it leads to any
stationary path. It gives up where its step does not lower the error, or is so long that its linearization says nothing.
Holds the workspace; answers do not depend on it. */
class PathNewton {
public:
    explicit PathNewton(const PathSolverOptions& options) : m_options(options), m_stepper(options) {}

    /** @param path   in: contact set and starts of the arcs; out: arcs, segments, length and error, finite also where
    the iteration fails. @return true if max |eps| <= tolerance */
    bool iterate(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    bool calcStep();
    bool searchLine(PathSolution& path);

    PathSolverOptions m_options;
    PathStepper m_stepper;
    PathJacobian m_jacobian;
    std::vector<double> m_step;
};

}  // namespace tautline
