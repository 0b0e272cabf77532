// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/equations/path_error.h"
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/path_solver_options.h"

namespace tautline {

/** Steps of the natural corrections xi on one contact set: what Newton's method and the minimizer have in common.
Holds the chain where the iteration stands and the one that a step tries. */
class PathStepper {
public:
    explicit PathStepper(const PathSolverOptions& options) : m_options(options) {}

    /** Shoots the arcs from the starts in `path`, whose error history begins anew. Both arguments before it must
    outlive the iteration. @return false where an arc cannot be shot: all arcs are then points, drawable and no more */
    bool begin(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    const Chain& getChain() const { return m_chain; }
    const std::vector<double>& getError() const { return m_eps; }
    const Chain& getTrial() const { return m_trial; }
    const std::vector<double>& getTrialError() const { return m_trialEps; }

    /** Size of the surface of a contact [m]. */
    double getSize(std::size_t contact) const {
        return m_problem->getElement(m_chain.contacts[contact].element).surface->getSize();
    }

    /** Largest fraction of a step (xi of all contacts in order), up to 1, that keeps every geodesic within the limits
    that its linearization deserves. */
    double calcStepFraction(const std::vector<double>& step) const;

    /** Shoots the trial chain at a fraction of a step. @return false if an arc could not be shot */
    bool tryStep(const std::vector<double>& step, double fraction, PathSolution& path);

    /** Goes to the trial chain and notes its error. */
    void acceptTrial(PathSolution& path);

    /** Arcs, segments, length and error into `path`. */
    void store(PathSolution& path) const;

private:
    void shortenBrokenArcs();

    PathSolverOptions m_options;
    const PathProblem* m_problem = nullptr;
    const PathPose* m_pose = nullptr;
    Chain m_chain, m_trial;
    std::vector<double> m_eps, m_trialEps;
};

/** Euclidean norm of a path error. */
double calcNorm(const std::vector<double>& v);

}  // namespace tautline
