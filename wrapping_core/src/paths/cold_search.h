// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/contact_search.h"
#include "paths/elastic_string.h"

namespace tautline {

/** Finds a path anew: lays a string along guides, lets it fall taut, and searches from there. Holds the string. */
class ColdSearch {
public:
    /** @param search   leads on from the string; must outlive this */
    ColdSearch(const PathSolverOptions& options, ContactSearch& search)
        : m_tolerance(options.pathErrorTolerance), m_search(search) {}

    /** Along a previous path, whose side and passages the new one keeps.
    @param path   in: entries are used where the string says nothing; out: the best path met. @return true if it is a
    verified minimum */
    bool findPathAlong(const PathProblem& problem, const PathPose& pose, const PathSolution& previous,
                       PathSolution& path);

    /** As the hints of the problem say; where they lead to no minimum, past point hints, on other sides, past rings
    that have no hint but would be threaded by the straight line, and without any hint. Says in the path whether it
    follows the hints. */
    bool findPathFromHints(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    bool findPathOfScene(const PathProblem& problem, const PathPose& pose, PathSolution& path);
    bool findHintedPath(const PathProblem& problem, const PathPose& pose, PathSolution& path);
    bool findPath(const PathProblem& problem, const PathPose& pose, const StartCourse& course, PathSolution& path);
    bool tightenString(const PathProblem& problem, const PathPose& pose, double fineness, double tolerance,
                       int maxSweeps, const PassageRule& rule, PathSolution& path);
    bool isMinimumBesideRings(const PathProblem& problem, const PathPose& pose, PassageRule rule,
                              const PathSolution& path) const;
    bool pushOffConjugatePoint(const PathProblem& problem, const PathPose& pose, double push, const PathSolution& path);
    bool tryCourse(const PathProblem& problem, const PathPose& pose, const StartCourse& course, PathSolution& path);
    bool findPathWithoutPoints(const PathProblem& problem, const PathPose& pose, StartCourse course,
                               PathSolution& path);
    bool findPathWithoutHints(const PathProblem& problem, const PathPose& pose, PathSolution& path);
    bool findOtherSides(const PathProblem& problem, const PathPose& pose, StartCourse& course, PathSolution& path);

    double m_tolerance;  ///< on max |eps|
    ContactSearch& m_search;
    ElasticString m_string;
    PathSolution m_spare;   ///< the answer where no ring can be threaded as the straight line does; empty: none met
    PathSolution m_stuck;   ///< to go back to where a moved scene does not help
    PathSolution m_before;  ///< to go back to where another try fails
};

}  // namespace tautline
