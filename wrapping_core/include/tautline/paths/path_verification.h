// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/paths/tolerances.h"

namespace tautline {

/** Why a path with vanishing path error is not a local minimum: the first condition that fails, and where. */
struct PathVerification {
    enum class Condition {
        None,             ///< all hold
        NotStationary,    ///< the path error does not vanish: never found by verifyPath(), which is not asked then
        ReversedTangent,  ///< e . t <= 0 at an end of an arc: a cusp
        NegativeLength,   ///< an arc shorter than kShortestArc
        PullsOutward,     ///< kappa_n > 0 somewhere on an arc: a string would lift there
        ConjugatePoint,   ///< the arc is longer than a shortest curve can be
        Unstable,         ///< the second variation of the length is not positive: a saddle or a longest path
        Penetration,      ///< a straight segment passes below a surface
        OutsideDomain,    ///< an arc leaves the domain of its surface
    };
    Condition condition = Condition::None;
    int element = -1;                           ///< the obstacle concerned
    Vector3 place_G = Vector3::Constant(kNaN);  ///< where on the path, in ground [m]
    int arc = 0;                                ///< which of its arcs
    int segment = -1;                           ///< of a penetration: index of the straight segment

    bool isMinimum() const { return condition == Condition::None; }
};

/** Checks the conditions of a local minimum on a solved path, contact set included.
@param shortestArc   in sizes of the surface; below it an arc is of negative length */
PathVerification verifyPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                            double shortestArc = kShortestArc);

}  // namespace tautline
