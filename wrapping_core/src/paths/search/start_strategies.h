// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/local/local_solver.h"
#include "paths/search/elastic_band.h"

namespace tautline {

/** The search for a path: starts, one after the other, from each of which the local solver (local_solver.h) leads on,
until one has led to a minimum that runs as was asked.

| strategy      | applies                            | begins from                                             | costs |
|---------------|------------------------------------|---------------------------------------------------------|-------|
| Continued     | a path is given                    | its contacts                                            | us    |
| AlongPrevious | that failed                        | an elastic band laid along it                           | ms    |
| Inserted      | always                             | straight lines through the fixed points; obstacles are  | us    |
|               |                                    | touched as they are met, on the sides asked for; if     |       |
|               |                                    | that fails, on the sides on which they are met          |       |
| Band          | always                             | an elastic band laid along the route asked for          | ms    |
| Released      | hints were given, but the band     | as before, without the hints                            | ms    |
|               | slipped off the route they ask for |                                                         |       |

A path that could not be continued to a minimum, nor found anew, is sought again after 1, 2, 4, 8 ... steps alone.

The band is a coarse discretization of the string with one-sided contact, so that it can bend where arcs cannot: it
finds the contacts and the basin of the minimum, or shows why there is none (StringFault). Where it comes to rest on the
route asked for, but is not a smooth path, that is the answer: another route would be another string.

Of several paths met the best is returned (Rank). Holds the workspace; answers do not depend on it. */
class PathSearch {
public:
    explicit PathSearch(const PathSolverOptions& options) : m_options(options), m_local(options) {}

    LocalSolver& updLocalSolver() { return m_local; }

    /** @param path   in: the start, contacts of all elements present; out: the best path met
    @param isContinued   whether it was given
    @return true if it is a verified minimum */
    bool findPath(const PosedProblem& scene, bool isContinued, PathSolution& path);

private:
    /** How good a path is, ascending. */
    enum class Rank {
        None,              ///< none met yet
        Lost,              ///< its path error does not vanish
        NotStationary,     ///< the same, but it was begun along a band: near where the string is
        Stationary,        ///< it does, but the path is not a minimum
        MinimumElsewhere,  ///< a minimum on another route than was asked
        AskedButBroken,    ///< where the string comes to rest on the route asked for, which no smooth path can say
        Minimum,           ///< a minimum on the route asked for
    };

    struct Strategy {
        StartStrategy kind;
        bool (PathSearch::*applies)() const;
        void (PathSearch::*attempt)(PathSolution& path);
    };
    static const Strategy kStrategies[];

    bool canContinue() const { return m_isContinued; }
    bool canLayAlongPrevious() const;
    bool canSearch() const;
    bool canRelease() const;
    void continuePrevious(PathSolution& path);
    void layAlongPrevious(PathSolution& path);
    void insertContacts(PathSolution& path);
    void layAlongAskedRoute(PathSolution& path);
    void release(PathSolution& path);

    void solveInserted(const Route& route, PathSolution& path);
    void solveAlongBand(const Route& route, bool keepsSides, PathSolution& path);
    void solveRoundWalls(const Route& route, bool keepsSides, PathSolution& path);
    Rank tightenBand(const BandLevel& level, const Route& route, bool keepsSides, PathSolution& path);
    Rank freeBand(Rank rank, const Route& route, bool keepsSides, PathSolution& path);
    void acceptFault(PathSolution& path);
    void yieldInGrooves(PathSolution& path);
    void keepContactsOfBand(PathSolution& path);
    Rank judge(const PathVerification& broken, const PassageRule& threading, bool keepsSides,
               const PathSolution& path) const;
    void offer(Rank rank, const PathSolution& path);
    RouteDeviation findThreadingDeviation(const PathSolution& path) const;
    bool hasHints() const;

    PathSolverOptions m_options;
    LocalSolver m_local;
    ElasticBand m_band;

    const PosedProblem* m_scene = nullptr;
    bool m_isContinued = false;
    bool m_isLoose = false;                  ///< continued, it is a minimum, but has left a ring
    int m_failedSteps = 0;                   ///< of the path that is continued (SolveReport)
    std::vector<PassedObstacle> m_previous;  ///< of the path that is continued
    Route m_asked;                           ///< laid out when first needed
    PathSolution m_best;                     ///< of the paths offered
    Rank m_bestRank = Rank::None;            ///< its
    PathSolution m_atRest;                   ///< the best path met along the band that was laid last
    Rank m_atRestRank = Rank::None;          ///< its
    PathVerification m_broken;               ///< of the last local solve
};

}  // namespace tautline
