// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** A problem in a pose: the scene that one solve looks at. Both must outlive it. */
struct PosedProblem {
    const PathProblem& problem;
    const PathPose& pose;

    int size() const { return problem.getNumElements(); }
    bool isPoint(int e) const { return problem.getElement(e).isPoint(); }
    /** Whether an obstacle lies between the fixed points beside it. @param in, out   the segments before and after */
    bool isBetweenPoints(const PathSolution& path, int in, int out) const {
        return isPoint(path.segments[in].fromElement) && isPoint(path.segments[out].toElement);
    }
    bool isObstacle(int e) const { return !isPoint(e) && pose.hasElement(e); }
    const Surface& getSurface(int e) const { return *problem.getElement(e).surface; }
    const Pose& getPose(int e) const { return pose.X_GE[e]; }
    const StartHint& getHint(int e) const { return problem.getElement(e).hint; }

    /** Height of a fixed point above the surface of an obstacle [m]. */
    double calcHeight(int point, int obstacle) const {
        return getSurface(obstacle).calcHeight(getPose(obstacle).shiftBack(getPose(point).p));
    }

    /** Calls visit(e) for every obstacle that takes part, in path order. */
    template <class Visitor>
    void forEachObstacle(Visitor visit) const {
        for (int e = 0; e < size(); ++e)
            if (isObstacle(e)) visit(e);
    }

    /** Calls visit(e, in, out) for every obstacle that takes part, with the indices in path.segments of the straight
    segments before and after it: the same one while it is lifted; segments between its arcs lie between them. */
    template <class Visitor>
    void forEachObstacleOnSegments(const PathSolution& path, Visitor visit) const {
        int in = 0;
        const int last = static_cast<int>(path.segments.size()) - 1;
        forEachObstacle([&](int e) {
            while (in < last && path.segments[in].toElement < e) ++in;
            visit(e, in, in + path.contacts[e].getNumArcs());
        });
    }

    /** Calls visit(point, obstacle) with either end of its span for every obstacle that takes part: the fixed points
    before and after it. */
    template <class Visitor>
    void forEachSpanEnd(Visitor visit) const {
        int first = 0;
        for (int e = 0; e < size(); ++e) {
            if (!isPoint(e) || !pose.hasElement(e)) continue;
            for (int obstacle = first + 1; obstacle < e; ++obstacle) {
                if (!isObstacle(obstacle)) continue;
                visit(first, obstacle);
                visit(e, obstacle);
            }
            first = e;
        }
    }
};

}  // namespace tautline
