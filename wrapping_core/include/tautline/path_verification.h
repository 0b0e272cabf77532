#pragma once
#include <string>

#include "tautline/path_problem.h"
#include "tautline/path_solution.h"

namespace tautline {

/** Why a path with vanishing path error is not a local minimum: the first condition that fails, and where. */
struct PathVerification {
    enum class Condition {
        None,             ///< all hold
        ReversedTangent,  ///< e . t <= 0 at an end of an arc: a cusp
        NegativeLength,   ///< an arc shorter than -1e-12 of the surface's size
        PullsOutward,     ///< kappa_n > 0 somewhere on an arc: a string would lift there
        ConjugatePoint,   ///< the arc is longer than a shortest curve can be
        Unstable,         ///< the second variation of the length is not positive: a saddle or a longest path
        Penetration,      ///< a straight segment passes below a surface
        OutsideDomain,    ///< an arc leaves the domain of its surface
    };
    Condition condition = Condition::None;
    int element = -1;  ///< the obstacle concerned

    bool isMinimum() const { return condition == Condition::None; }
};

/** Checks the conditions of a local minimum on a solved path, contact set included. */
PathVerification verifyPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

/** A sentence for people, with the obstacle's name. */
std::string describe(const PathVerification& verification, const PathProblem& problem);

/** Why a path has the status that it has, in a sentence for people that names the elements concerned.
@param path   as solve() left it at this pose */
std::string explainStatus(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

/** Signed distance between the straight segment A B (ground) and a surface (thesis Cha. 6), on the side of
`clearance.keptN` if that is set, else on the side that the segment suggests. Where the critical point D is
not between the ends, the height of the nearer end counts.
@param clearance   in: that of the last accepted state, or nothing; out: today's */
void findSegmentClearance(const Surface& surface, const Pose& X_GS, const Vec3& A_G, const Vec3& B_G,
                          LineClearance& clearance);

}  // namespace tautline
