// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Walks over the obstacles of a path in their order. */
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** Calls visit(e) for every obstacle that takes part. */
template <class Visitor>
void visitObstacles(const PathProblem& problem, const PathPose& pose, Visitor visit) {
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (!problem.getElement(e).isPoint() && pose.hasElement(e)) visit(e);
}

/** Calls visit(e, in, out) for every obstacle that takes part, with the indices in path.segments of the straight
segments before and after it: the same one while it is lifted. */
template <class Visitor>
void visitObstaclesOnSegments(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                              Visitor visit) {
    int in = 0;
    const int last = static_cast<int>(path.segments.size()) - 1;
    visitObstacles(problem, pose, [&](int e) {
        while (in < last && path.segments[in].toElement < e) ++in;
        visit(e, in, path.contacts[e].isTouched ? in + 1 : in);
    });
}

}  // namespace tautline
