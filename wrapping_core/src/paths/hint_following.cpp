// SPDX-License-Identifier: Apache-2.0
#include "paths/hint_following.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "paths/obstacle_walk.h"
#include "surfaces/arc_walker.h"

namespace tautline {
namespace {

/** Where a path passes an obstacle, in S: from the end of the segment before it to that of the one after. */
std::vector<Vec3> calcPassingPoints(const Surface& surface, const Pose& X_GS, const ObstacleContact& contact,
                                    const StraightSegment& in, const StraightSegment& out) {
    constexpr double kLeast = 16, kMost = 2000, kPerSize = 4;  // points of an arc
    std::vector<Vec3> points;
    if (contact.isTouched) {
        const double count = kLeast + kPerSize * std::abs(contact.start.length) / surface.getSize();
        sampleGeodesic(surface, contact.start, kRoughlyAlong, static_cast<int>(std::min(count, kMost)), points);
    }
    points.insert(points.begin(), X_GS.shiftBack(in.A));
    points.push_back(X_GS.shiftBack(out.B));
    return points;
}

/** About the z axis, positive from x to y [rad]. */
double calcTurning(const std::vector<Vec3>& points) {
    double turning = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec3 &a = points[i], &b = points[i + 1];
        turning += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    }
    return turning;
}

bool isOnSide(const PassOnSide& hint, const ObstacleContact& contact, const std::vector<Vec3>& points) {
    const Vec3& there = contact.isTouched ? points[points.size() / 2] : contact.clearance.C.p;
    return !(hint.direction_S.dot(there) < 0);
}

/** The angle nearest to the hint's would be off by half a turn at most; the path's neighbours may stand elsewhere than
those that the hint was laid between. */
bool turnsAsOften(const WindAround& hint, const std::vector<Vec3>& points) {
    return std::abs(calcTurning(points) - 2 * kPi * hint.turns) < 1.2 * kPi;
}

}  // namespace

bool turnsAsHinted(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    bool isAsHinted = true;
    visitObstaclesOnSegments(problem, pose, path, [&](int e, int in, int out) {
        const PathElement& element = problem.getElement(e);
        const ObstacleContact& contact = path.contacts[e];
        const auto* side = std::get_if<PassOnSide>(&element.hint);
        const auto* winding = std::get_if<WindAround>(&element.hint);
        if (contact.isSwitchedOff || !(side || winding)) return;
        const std::vector<Vec3> points =
            calcPassingPoints(*element.surface, pose.X_GE[e], contact, path.segments[in], path.segments[out]);
        if (side && !isOnSide(*side, contact, points)) isAsHinted = false;
        if (winding && !turnsAsOften(*winding, points)) isAsHinted = false;
    });
    return isAsHinted;
}

}  // namespace tautline
