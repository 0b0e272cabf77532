#pragma once
#include "tautline/contact_search.h"
#include "tautline/elastic_string.h"
#include "tautline/path_passages.h"
#include "tautline/path_problem.h"
#include "tautline/path_solution.h"

namespace tautline {

/** Finds shortest paths. Holds the workspace of a solve: one per thread; the answer never depends on what
it solved before. No allocation once it has solved a path of the same size. */
class PathSolver {
public:
    explicit PathSolver(const PathSolverOptions& options = {});
    const PathSolverOptions& getOptions() const { return m_options; }

    /** Solves for path and contact set. An empty `path` is a cold start from the problem's hints; otherwise
    it is continued from, and found anew along it where that fails. A fixed point that lies on a surface (to 1e-7 of
    its size) is treated as lying 1e-7 sizes above it, where a straight segment still has a direction; that changes
    the length by about 1e-10 sizes.
    @param pose   one pose per element; InvalidInput if their number differs. Never throws for finite poses
    @param path   in: start; out: the answer, finite and drawable whatever its status */
    void solve(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    /** Solves with the contact set of `path` as it is, so that the equations stay smooth past lift-off
    (arcs of negative length) and touchdown (clearances below zero) while an integrator locates the event.
    `path` must come from an earlier solve. Its status tells only whether the path error vanishes. */
    void solveKeepingContacts(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    const PathPose& calcLiftedPose(const PathProblem& problem, const PathPose& pose);
    bool tightenString(const PathProblem& problem, const PathPose& pose, double fineness, double tolerance,
                       int maxSweeps, PassageRule rule, PathSolution& path);
    bool pushOffConjugatePoint(const PathProblem& problem, const PathPose& pose, double push, const PathSolution& path);
    bool findPath(const PathProblem& problem, const PathPose& pose, PassageRule rule, PathSolution& path);
    bool findColdPath(const PathProblem& problem, const PathPose& pose, const StartGuides& guides, PassageRule rule,
                      PathSolution& path);
    bool findColdPathWithoutPoints(const PathProblem& problem, const PathPose& pose, StartGuides guides,
                                   PathSolution& path);
    bool findOtherSides(const PathProblem& problem, const PathPose& pose, StartGuides& guides, PathSolution& path);
    void switchOffEnclosing(const PathProblem& problem, const PathPose& pose, PathSolution& path) const;
    void finish(const PathProblem& problem, const PathPose& pose, bool isFound, PathSolution& path) const;

    PathSolverOptions m_options;
    ElasticString m_string;
    ContactSearch m_search;
    std::vector<double> m_startLengths;  ///< of the arcs by element, while contacts are kept
    PathSolution m_previous;
    PathPose m_liftedPose;
};

/** One-off: a cold start from the problem's hints. */
PathSolution solvePath(const PathProblem& problem, const PathPose& pose, const PathSolverOptions& options = {});

}  // namespace tautline
