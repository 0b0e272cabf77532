// SPDX-License-Identifier: Apache-2.0
#include "paths/tracking/contact_settling.h"

#include <algorithm>
#include <cmath>

#include "paths/equations/second_variation.h"
#include "paths/problem/posed_problem.h"
#include "paths/problem/search_limits.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/contact_witness.h"
#include "tautline/paths/path_stability.h"
#include "tautline/paths/path_verification.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

constexpr int kRefinements = 3;  ///< of Newton's method

bool holds(const PathStability& stability) {
    return stability.margin > kSlipMargin + kMarginRounding;
}

/** @return the obstacle with the lowest witness below zero, to rounding; -1 if there is none */
int findLowestWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    int worst = -1;
    double lowest = kWitnessRounding;
    PosedProblem{problem, pose}.forEachObstacle([&](int e) {
        const double witness = calcContactWitness(problem, pose, path, e);
        if (witness < lowest) lowest = witness, worst = e;
    });
    return worst;
}

int findFirstTouched(const PathSolution& path) {
    for (std::size_t e = 0; e < path.contacts.size(); ++e)
        if (path.contacts[e].isTouched) return static_cast<int>(e);
    return -1;
}

bool isMinimum(const PathSolution& path) {
    return path.status == PathStatus::Solved || path.status == PathStatus::EndInside;
}

/** Lets the solver go on from a path that is no minimum. @return true if it has come to one that is no longer */
bool goOn(PathSolver& solver, const PathProblem& problem, const PathPose& pose, const PathSolution& from,
          PathSolution& path) {
    PathSolution next = from;
    solver.solve(problem, pose, next);
    if (!isMinimum(next) || !(next.length <= (1 + kLengthRounding) * path.length)) return false;
    path = next;
    return true;
}

/** The solver goes downhill from a saddle by itself; where it does not come to a shorter path, it begins beside the
saddle, on either side. @return the obstacle at which the path was a saddle, if it is now a minimum; else -1 */
int leaveSaddle(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const PathStability stability = calcPathStability(problem, pose, path);
    if (holds(stability)) return -1;
    for (const double amount : {0.0, kSaddleMove, -kSaddleMove}) {
        PathSolution moved = path;
        if (amount != 0) moveAlongNegativeCurvature({problem, pose}, amount, moved);
        if (goOn(solver, problem, pose, moved, path)) return stability.element;
    }
    return -1;
}

/** A contact just made may break other conditions of a minimum. */
void leaveFalseContact(PathSolver& solver, const PathProblem& problem, const PathPose& pose, const PathSolution& before,
                       PathSolution& path) {
    const PathVerification verification = verifyPath(problem, pose, path);
    if (verification.isMinimum() || verification.condition == PathVerification::Condition::Unstable) return;
    const int e = verification.element;
    if (path.contacts[e].isTouched && !before.contacts[e].isTouched)
        goOn(solver, problem, pose, PathSolution(path), path);
}

/** Lets the solver find a contact set. @return true if it has come to a path */
bool solveAnew(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    PathSolution next = path;
    solver.solve(problem, pose, next);
    if (next.status == PathStatus::NotConverged) return false;
    path = next;
    return true;
}

/** Whether a string that was where it could not stay, or that has jumped, has slipped: it has not if it had only been
watched on a side where it does not pass. */
bool hasSlipped(const PathProblem& problem, const PathPose& pose, const PathSolution& before,
                const PathSolution& after) {
    if (!(std::abs(after.length / before.length - 1) < kContinuousLength)) return true;
    return before.status != PathStatus::NotConverged && !holds(calcPathStability(problem, pose, before));
}

}  // namespace

/** A path's contacts are judged to rounding, as far as its geodesics are shot so well: what is left of the path error
turns a long segment off a thin obstacle by more than the tolerance of contact. */
void ContactSettler::refine(const PathSolver& solver, const PathProblem& problem, const PathPose& pose,
                            PathSolution& path) {
    if (!m_refiner) {
        PathSolverOptions options = solver.getOptions();
        options.pathErrorTolerance = std::min(options.pathErrorTolerance, kSettledError);
        options.maxIterations = std::min(options.maxIterations, kRefinements);
        m_refiner.emplace(options);
    }
    PathSolution refined = path;
    m_refiner->solveKeepingContacts(problem, pose, refined);
    if (!(refined.pathError < path.pathError)) return;
    refined.status = path.status;
    path = refined;
}

/** @return true if no witness is left below zero */
bool ContactSettler::switchContacts(PathSolver& solver, const PathProblem& problem, const PathPose& pose,
                                    PathSolution& path) {
    const int maxSwitches = 2 * problem.getNumElements();
    for (int i = 0; i < maxSwitches; ++i) {
        const int worst = findLowestWitness(problem, pose, path);
        if (worst < 0) return true;
        switchContact(problem, pose, worst, path);
        solver.solveKeepingContacts(problem, pose, path);
        if (path.status == PathStatus::NotConverged) return false;
        refine(solver, problem, pose, path);
    }
    return false;
}

int ContactSettler::settle(PathSolver& solver, const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const PathSolution before = path;
    if (path.status != PathStatus::NotConverged) refine(solver, problem, pose, path);
    const bool hasWitnesses = path.status != PathStatus::NotConverged || hasSwallowedEnd(path);
    int slippedAt = -1;
    if (hasWitnesses && switchContacts(solver, problem, pose, path)) {
        leaveFalseContact(solver, problem, pose, before, path);
        slippedAt = leaveSaddle(solver, problem, pose, path);
    } else {
        path = before;
        if (solveAnew(solver, problem, pose, path)) slippedAt = findFirstTouched(before);
    }
    if (path.status != PathStatus::NotConverged) refine(solver, problem, pose, path);
    return hasSlipped(problem, pose, before, path) ? slippedAt : -1;
}

}  // namespace tautline
