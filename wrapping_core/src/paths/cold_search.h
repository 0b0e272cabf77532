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

    /** As the hints of the problem say; where they lead to no minimum, past point hints and on other sides. */
    bool findPathFromHints(const PathProblem& problem, const PathPose& pose, PathSolution& path);

private:
    bool findPath(const PathProblem& problem, const PathPose& pose, const StartGuides& guides, PassageRule rule,
                  PathSolution& path);
    bool tightenString(const PathProblem& problem, const PathPose& pose, double fineness, double tolerance,
                       int maxSweeps, PassageRule rule, PathSolution& path);
    bool pushOffConjugatePoint(const PathProblem& problem, const PathPose& pose, double push, const PathSolution& path);
    bool findPathWithoutPoints(const PathProblem& problem, const PathPose& pose, StartGuides guides,
                               PathSolution& path);
    bool findOtherSides(const PathProblem& problem, const PathPose& pose, StartGuides& guides, PathSolution& path);

    double m_tolerance;  ///< on max |eps|
    ContactSearch& m_search;
    ElasticString m_string;
    PathSolution m_before;  ///< to go back to where another try fails
};

}  // namespace tautline
