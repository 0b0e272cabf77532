// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/point_path.h"

namespace tautline {

void layPointPath(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    path.contacts.resize(problem.getNumElements());
    path.length = path.pathError = 0;
    path.errorHistory.clear();
    path.report = {};
    path.report.strategy = StartStrategy::Inserted;  // from the straight line, whatever was given
    std::size_t numSegments = 0;
    int last = 0;
    for (int e = 1; e < problem.getNumElements(); ++e) {
        if (!pose.hasElement(e)) continue;
        if (numSegments == path.segments.size()) path.segments.emplace_back();
        StraightSegment& line = path.segments[numSegments++];
        line.fromElement = last, line.toElement = e;
        line.A = pose.X_GE[last].p, line.B = pose.X_GE[e].p;
        const Vector3 AB = line.B - line.A;
        line.length = AB.norm();
        line.e =
            line.length > 0 ? Vector3(AB / line.length) : Vector3(Vector3::UnitX());  // any serves if there is no way
        path.length += line.length;
        last = e;
    }
    path.segments.resize(numSegments);
    path.status = PathStatus::Solved;
}

}  // namespace tautline
