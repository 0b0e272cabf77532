// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paths/local/length_minimizer.h"
#include "paths/local/path_newton.h"
#include "paths/problem/posed_problem.h"
#include "tautline/paths/path_verification.h"

namespace tautline {

/** From a start nearby to the local minimum that it leads to: an active-set method whose one loop is a state machine.
Each turn solves the path error of the contact set (findStationaryPath()), asks for the first condition of a minimum
that is broken, and acts on it:

| condition       | action                                                    | after                                |
|-----------------|-----------------------------------------------------------|--------------------------------------|
| None            | done: a minimum                                           |                                      |
| NotStationary   | given up                                                  |                                      |
| NegativeLength  | the arc is lifted                                         | thesis Sec. 6.3                      |
| Penetration     | the deepest obstacle of each straight segment is touched, | thesis Sec. 6.2, 7.6                 |
|                 | or once more where a segment meets the surface it left    | arc_changes.h                        |
| ReversedTangent | the arc is turned round to where e = t                    | Eqn. 4.3: eps vanishes at e = -t too |
| Unstable        | along the direction of negative curvature, then downhill  | More and Sorensen 1979               |
| others          | given up: only a band that bends inside an arc leads on   | elastic_band.h                       |

To solve the path error of a contact set includes how many arcs an obstacle has: they split over hollows and join again
(arc_changes.h), which leaves the length three times continuously differentiable.

Holds the workspace; answers do not depend on it. */
class LocalSolver {
public:
    explicit LocalSolver(const PathSolverOptions& options) : m_newton(options), m_minimizer(options) {}

    /** How much a solve may do. */
    struct Effort {
        bool leavesSaddles = true;     ///< false: a saddle is given up, and stays where it is
        int maxDescents = kUnlimited;  ///< iterations of the minimizer, in all: a start that needs more is a poor one
        static constexpr int kUnlimited = 1 << 30;
    };

    /** @param path   in: contact set and starts of the arcs; out: the path of the last turn
    @return the condition that stopped it; None for a minimum */
    PathVerification solve(const PosedProblem& scene, PathSolution& path, const Effort& effort);
    PathVerification solve(const PosedProblem& scene, PathSolution& path) { return solve(scene, path, Effort()); }

    /** The contact set as it is: Newton's method from the starts in `path`, fast where they are near; where it leads to
    no path, the minimizer from the same starts. @return true if the path error vanishes */
    bool findStationaryPath(const PosedProblem& scene, PathSolution& path);

private:
    PathVerification findBrokenCondition(const PosedProblem& scene, PathSolution& path);
    bool act(const PosedProblem& scene, const PathVerification& broken, int& numRepairs, PathSolution& path);
    bool solveContacts(const PosedProblem& scene, PathSolution& path);
    bool solveArcs(const PosedProblem& scene, PathSolution& path);
    bool findForwardPath(const PosedProblem& scene, PathSolution& path);
    void touchDeepest(const PosedProblem& scene, PathSolution& path);
    void leaveSaddle(const PosedProblem& scene, PathSolution& path);
    void rememberStarts(const PathSolution& path);
    void restoreStarts(PathSolution& path) const;
    bool minimize(const PosedProblem& scene, PathSolution& path);

    PathNewton m_newton;
    LengthMinimizer m_minimizer;
    std::vector<GeodesicStart> m_starts;  ///< of the last contact set, arc by arc
    int m_numDescents = 0;                ///< iterations that the minimizer may still do
    std::vector<int> m_deepest;           ///< by segment: the obstacle that it penetrates most, or -1
    PathSolution m_reversed;
};

/** Clearances of all lifted obstacles on the segments that pass them. */
void updateClearances(const PosedProblem& scene, PathSolution& path);

/** Looks for places where lifted obstacles are nearer to their segments than where they were watched so far. */
void watchNearestPlaces(const PosedProblem& scene, PathSolution& path);

/** Takes an earlier path again; what was spent since stays counted. */
void goBack(const PathSolution& earlier, PathSolution& path);

}  // namespace tautline
