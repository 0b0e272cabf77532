#pragma once
#include "tautline/banded_solver.h"
#include "tautline/path_error.h"
#include "tautline/path_problem.h"
#include "tautline/path_solution.h"

namespace tautline {

struct PathSolverOptions {
    double pathErrorTolerance = 1e-11;  ///< on max |eps|; what Newton leaves is its square
    int maxIterations = 40;             ///< Newton iterations for one contact set
    bool allowsColdStart = true;        ///< false: report NotConverged where the start given does not lead on
    GeodesicOptions geodesics;

    /** InvalidInput naming the option that is out of its range. */
    void validate() const;
};

/** Newton's method on the path error of one contact set (thesis Sec. 4.6). Where its step does not lower the error, or
does not exist, damped least-squares steps take its place. Holds the workspace; answers do not depend on it. */
class PathNewton {
public:
    explicit PathNewton(const PathSolverOptions& options) : m_options(options) {}

    /** @param path   in: contact set and starts of the arcs; out: arcs, segments, length and error, finite also where
    the iteration fails. @return true if max |eps| <= tolerance */
    bool iterate(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    bool calcNewtonStep();
    bool calcDampedStep(const PathProblem& problem, double damping);
    void shortenBrokenArcs(const PathProblem& problem, const PathPose& pose);
    bool tryStep(const PathProblem& problem, const PathPose& pose, double fraction, PathSolution& path);
    bool tryNewtonStep(const PathProblem& problem, const PathPose& pose, PathSolution& path);
    bool tryDampedSteps(const PathProblem& problem, const PathPose& pose, PathSolution& path);
    double calcStepFraction(const PathProblem& problem) const;
    void applyStep(const PathProblem& problem, double fraction);
    void storeChain(PathSolution& path) const;

    PathSolverOptions m_options;
    Chain m_chain, m_trial;
    PathJacobian m_jacobian;
    BandedSolver m_normal{2 * kPathBandwidth, 2 * kPathBandwidth};  ///< J^T J + damping, only when Newton fails
    std::vector<double> m_eps, m_trialEps, m_step;
};

}  // namespace tautline
