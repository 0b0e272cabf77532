// SPDX-License-Identifier: Apache-2.0
#include "paths/local/path_newton.h"

namespace tautline {
namespace {

constexpr double kLeastFraction =
    0.1;                         ///< of a step within the limits; a longer step means a Jacobian next to singular
constexpr int kMaxHalvings = 6;  ///< of a step that does not lower the error

}  // namespace

/** Thesis Sec. 4.6: shoot, assemble, solve, correct, until the path error vanishes. */
bool PathNewton::iterate(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const bool isFinite = m_stepper.begin(problem, pose, path);
    for (int i = 0; isFinite && path.pathError > m_options.pathErrorTolerance && i < m_options.maxIterations; ++i) {
        ++path.iterations;
        if (!calcStep() || !searchLine(path)) break;
        m_stepper.acceptTrial(path);
    }
    m_stepper.store(path);
    return isFinite && path.pathError <= m_options.pathErrorTolerance;
}

/** m_step = -J^-1 eps (thesis Eqn. 4.57). */
bool PathNewton::calcStep() {
    const std::vector<double>& eps = m_stepper.getError();
    calcPathErrorJacobian(m_stepper.getChain(), m_jacobian);
    m_step.resize(eps.size());
    for (std::size_t i = 0; i < eps.size(); ++i) m_step[i] = -eps[i];
    return m_jacobian.solveInPlace(m_step);
}

/** Halves the step until the error falls. @return false if it does not */
bool PathNewton::searchLine(PathSolution& path) {
    double fraction = m_stepper.calcStepFraction(m_step);
    if (fraction < kLeastFraction) return false;
    for (int halving = 0; halving <= kMaxHalvings; ++halving, fraction /= 2)
        if (m_stepper.tryStep(m_step, fraction, path) &&
            calcNorm(m_stepper.getTrialError()) < calcNorm(m_stepper.getError()))
            return true;
    return false;
}

}  // namespace tautline
