#include "paths/hint_following.h"

#include <cmath>
#include <vector>

#include "geodesics/arc_walker.h"
#include "paths/obstacle_walk.h"

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

bool follows(std::monostate, const ObstacleContact&, const std::vector<Vec3>&) {
    return true;
}
bool follows(const PassNear&, const ObstacleContact&, const std::vector<Vec3>&) {
    return true;  // how near is not said
}
bool follows(const ThreadHole&, const ObstacleContact&, const std::vector<Vec3>&) {
    return true;
}

bool follows(const PassOnSide& hint, const ObstacleContact& contact, const std::vector<Vec3>& points) {
    const Vec3& there = contact.isTouched ? points[points.size() / 2] : contact.clearance.C.p;
    return !(hint.direction_S.dot(there) < 0);
}

/** The angle nearest to the hint's would be off by half a turn at most; the path's neighbours may stand elsewhere than
those that the hint was laid between. */
bool follows(const WindAround& hint, const ObstacleContact&, const std::vector<Vec3>& points) {
    return std::abs(calcTurning(points) - 2 * kPi * hint.turns) < 1.5 * kPi;
}

}  // namespace

bool turnsAsHinted(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    bool isAsHinted = true;
    visitObstaclesOnSegments(problem, pose, path, [&](int e, int in, int out) {
        const PathElement& element = problem.getElement(e);
        const ObstacleContact& contact = path.contacts[e];
        if (contact.isSwitchedOff || std::holds_alternative<std::monostate>(element.hint)) return;
        const std::vector<Vec3> points =
            calcPassingPoints(*element.surface, pose.X_GE[e], contact, path.segments[in], path.segments[out]);
        isAsHinted =
            isAsHinted && std::visit([&](const auto& hint) { return follows(hint, contact, points); }, element.hint);
    });
    return isAsHinted;
}

}  // namespace tautline
