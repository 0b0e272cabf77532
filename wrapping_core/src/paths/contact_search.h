// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/hole_passages.h"
#include "paths/length_minimizer.h"
#include "paths/path_newton.h"

namespace tautline {

/** Finds from a start near by the path over one contact set, the contact set that a path keeps, and the minimum. Holds
the workspace; answers do not depend on it. */
class ContactSearch {
public:
    explicit ContactSearch(const PathSolverOptions& options) : m_newton(options), m_minimizer(options) {}

    /** Searches for the contact set, mending cusps and leaving saddles, until verifyPath() finds no fault.
    @param path   in: contact set and starts; out: the best path met. @return true if it is a minimum that goes through
    the holes as it should */
    bool findMinimum(const PathProblem& problem, const PathPose& pose, const PassageRule& rule, PathSolution& path);

    /** Newton on one contact set, then lift what has negative length and touch what is penetrated, one at a time, until
    neither is left. The path may be stationary only.
    @param path   in: contact set and starts; out: the contacts are those that it was solved with, also where the search
    comes to no end. @return true if converged so */
    bool search(const PathProblem& problem, const PathPose& pose, PathSolution& path);

    /** The contact set as it is: Newton's method from the starts in `path`, fast where they are near; where it leads to
    no path, the minimizer from the same starts. @return true if the path error vanishes */
    bool findStationaryPath(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    /** Goes downhill to a path that is no saddle: from where Newton's method began, as a string would fall; if that too
    ends on a saddle, from there, pushed sideways at the contact that holds it. */
    void leaveSaddle(const PathProblem& problem, const PathPose& pose, PathSolution& path);
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
