#pragma once
#include "tautline/length_minimizer.h"
#include "tautline/path_newton.h"

namespace tautline {

/** Finds the path over one contact set, and the contact set that a path keeps. Holds the workspace; answers do not
depend on it. Paths may be stationary only: whether they are minima is for verifyPath() to say. */
class ContactSearch {
public:
    explicit ContactSearch(const PathSolverOptions& options) : m_newton(options), m_minimizer(options) {}

    /** Newton on one contact set, then lift what has negative length and touch what is penetrated, one at a time, until
    neither is left.
    @param path   in: contact set and starts; out: the contacts are those that it was solved with, also where the search
    comes to no end. @return true if converged so */
    bool search(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    /** The contact set as it is: Newton's method from the starts in `path`, fast where they are near; where it leads to
    no path, the minimizer from the same starts. @return true if the path error vanishes */
    bool findStationaryPath(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    /** Goes downhill to a path that is no saddle: from where Newton's method began, as a string would fall; if that too
    ends on a saddle, from there, pushed sideways at the contact that holds it. */
    void leaveSaddle(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    bool findPathOfContacts(const PathProblem& problem, const PathPose& pose, PathSolution& path);
    void restoreStarts(PathSolution& path) const;

    PathNewton m_newton;
    LengthMinimizer m_minimizer;
    std::vector<GeodesicStart> m_starts;  ///< of the last contact set, by element
    PathSolution m_cusp;
};

/** Clearances of all lifted obstacles on the segments that pass them. */
void updateClearances(const PathProblem& problem, const PathPose& pose, PathSolution& path);

/** Looks for places where lifted obstacles are nearer to their segments than where they were watched so far. */
void watchNearestPlaces(const PathProblem& problem, const PathPose& pose, PathSolution& path);

/** Takes an earlier path again; what was spent since stays counted. */
void goBack(const PathSolution& earlier, PathSolution& path);

}  // namespace tautline
