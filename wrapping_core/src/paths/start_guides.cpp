// SPDX-License-Identifier: Apache-2.0
#include "paths/start_guides.h"

#include <algorithm>
#include <cmath>

#include "paths/hole_passages.h"
#include "surfaces/arc_walker.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/segment_clearance.h"

namespace tautline {
namespace {

constexpr int kArcGuides = 6;      ///< points taken from each arc of a previous path
constexpr int kGuidesPerTurn = 8;  ///< of a winding
constexpr double kFar = 1e3;       ///< in sizes of the surface: from there the way down ends on the outside
constexpr double kThrough = 3;     ///< in sizes: from the surface inwards, beyond the middle
constexpr int kHoleSteps = 12;     ///< towards the hole's centre

/** Where the straight line of the string comes from and goes to, in S. */
struct Chord {
    Vec3 A_S, B_S;
};

double calcAzimuth(const Vec3& p_S) {
    return std::atan2(p_S.y(), p_S.x());
}

Vec3 makeCylindrical(double radius, double azimuth, double z) {
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/** Where a ray from far outside towards the z axis of S, at this azimuth and height, meets the surface: no step is
longer than half the height there. From a ray that passes by, the surface point under its start. */
Vec3 findOutermostPoint(const Surface& surface, double azimuth, double z) {
    constexpr int kMaxSteps = 200;
    const double size = surface.getSize(), least = 1e-3 * size;
    double radius = kFar * size;
    for (int i = 0; i < kMaxSteps && radius > 0; ++i) {
        const Vec3 p = makeCylindrical(radius, azimuth, z);
        const double height = surface.calcHeight(p);
        if (!(height > least)) return surface.findSurfacePoint(p).p;
        radius -= height / 2;
    }
    return surface.findSurfacePoint(makeCylindrical(kFar * size, azimuth, z)).p;
}

/** Where the line passes the hole, moved towards the centre until it lies clear of the surface. */
Vec3 findHolePoint(const Surface& surface, const Hole& hole, const Chord& chord) {
    Vec3 point = hole.calcPlaneCrossing(chord.A_S, chord.B_S);
    point -= hole.getAxis().dot(point) * hole.getAxis();
    for (int i = 0; i < kHoleSteps && surface.calcHeight(point) < 0; ++i) point *= 0.8;
    return point;
}

void guide(const Surface& surface, std::monostate, const Chord& chord, std::vector<Vec3>& guides_S) {
    const std::optional<Hole> hole = surface.getHole();
    if (hole && hole->countCrossings(chord.A_S, chord.B_S) != 0)
        guides_S.push_back(findHolePoint(surface, *hole, chord));
}

void guide(const Surface& surface, const PassNear& hint, const Chord&, std::vector<Vec3>& guides_S) {
    guides_S.push_back(surface.findSurfacePoint(hint.point_S).p);
}

/** The surface point under one that lies clear of it beside D: no farther out than it takes, since from far out along
the axis of a long surface the way down would lead far along it. */
Vec3 findPointOnSide(const Surface& surface, const Vec3& D, const Vec3& side) {
    const double size = surface.getSize();
    Vec3 beside = D;
    for (double height = kThrough * size; height < kFar * size; height *= 2) {
        beside = D + (height - side.dot(D)) * side;
        if (surface.calcHeight(beside) > size) break;
    }
    return surface.findSurfacePoint(beside).p;
}

/** Nothing where the line is clear on the side that is asked for; else over the top of that side. */
void guide(const Surface& surface, const PassOnSide& hint, const Chord& chord, std::vector<Vec3>& guides_S) {
    const Vec3 side = hint.direction_S.normalized(), step = chord.B_S - chord.A_S;
    const double length = step.norm();
    const Vec3 e = length > 0 ? Vec3(step / length) : Vec3(Vec3::UnitX());
    const Vec3 D = chord.A_S + surface.findLowestPoint(chord.A_S, e, length) * e;
    if (surface.calcHeight(D) > 0 && side.dot(D) >= 0) return;
    guides_S.push_back(findPointOnSide(surface, D, side));
}

void guide(const Surface& surface, const WindAround& hint, const Chord& chord, std::vector<Vec3>& guides_S) {
    const double from = calcAzimuth(chord.A_S), direct = calcAzimuth(chord.B_S) - from;
    const double turn = direct + 2 * kPi * std::round(hint.turns - direct / (2 * kPi));
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / (2 * kPi) * kGuidesPerTurn)));
    for (int i = 0; i < count; ++i) {
        const double fraction = (i + 0.5) / count;
        const double z = chord.A_S.z() + fraction * (chord.B_S.z() - chord.A_S.z());
        guides_S.push_back(findOutermostPoint(surface, from + fraction * turn, z));
    }
}

/** Points of a ring's tube in the half plane of the hole's axis and a place beside it. */
struct TubePoints {
    Vec3 inner, outer, top, bottom;

    TubePoints(const Surface& surface, const Vec3& axis, const Vec3& beside_S) {
        const double size = surface.getSize(), far = kFar * size;
        const Vec3 aside = makeTangent(beside_S, axis);
        inner = surface.findSurfacePoint(1e-3 * size * aside).p;
        outer = surface.findSurfacePoint(far * aside).p;
        const Vec3 middle = 0.5 * (inner + outer);
        top = surface.findSurfacePoint(middle + far * axis).p;
        bottom = surface.findSurfacePoint(middle - far * axis).p;
    }
};

/** Through the hole each time and around the tube between two passages; once more around it where an end is on the
wrong side of the ring. All in half planes, so that no step from one point to the next cuts through the tube or the
hole. */
void guide(const Surface& surface, const ThreadHole& hint, const Chord& chord, std::vector<Vec3>& guides_S) {
    const int count = std::abs(hint.passages);
    const bool isUpward = hint.passages >= 0;
    const Hole hole = *surface.getHole();  // PathProblem refuses the hint without one
    const Vec3 axis = hole.getAxis();
    const TubePoints atA(surface, axis, chord.A_S), atB(surface, axis, chord.B_S);
    if (count == 0) {
        if (hole.countCrossings(chord.A_S, chord.B_S) != 0) guides_S.push_back(atA.outer);
        return;
    }
    const auto goRound = [&](const TubePoints& tube) {
        const Vec3 &leave = isUpward ? tube.top : tube.bottom, &enter = isUpward ? tube.bottom : tube.top;
        guides_S.insert(guides_S.end(), {leave, tube.outer, enter});
    };
    const Vec3 through = count == 1 ? Vec3(Vec3::Zero()) : atA.inner;
    if ((axis.dot(chord.A_S) > 0) == isUpward) goRound(atA);
    guides_S.push_back(through);
    for (int i = 1; i < count; ++i) {
        goRound(atA);
        guides_S.push_back(through);
    }
    if ((axis.dot(chord.B_S) < 0) == isUpward) goRound(atB);
}

int countAskedPassages(const Surface& surface, const StartHint& hint, const Chord& chord) {
    if (const auto* thread = std::get_if<ThreadHole>(&hint)) return thread->passages;
    const std::optional<Hole> hole = surface.getHole();
    if (std::holds_alternative<std::monostate>(hint) && hole) return hole->countCrossings(chord.A_S, chord.B_S);
    return PassageRule::kAny;
}

/** The next point that the string is sure to pass: a fixed point or a hinted one. */
Vec3 findNextKnown(const PathProblem& problem, const PathPose& pose, int element) {
    for (int e = element + 1; e < problem.getNumElements(); ++e) {
        if (!pose.hasElement(e)) continue;
        const PathElement& next = problem.getElement(e);
        if (next.isPoint()) return pose.X_GE[e].p;
        if (const auto* near = std::get_if<PassNear>(&next.hint)) return pose.X_GE[e] * near->point_S;
    }
    return pose.X_GE.back().p;
}

/** Lifted obstacles that have come between the guides beside them are passed where they were: on the side that is kept,
however far that is. */
void guideOverSunken(const PathProblem& problem, const PathPose& pose, const PathSolution& previous,
                     StartGuides& guides) {
    Vec3 last_G = Vec3::Zero();
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const PathElement& element = problem.getElement(e);
        if (pose.hasElement(e) && !element.isPoint() && guides[e].empty()) {
            const auto next = std::find_if(guides.begin() + e, guides.end(), [](const auto& g) { return !g.empty(); });
            LineClearance clearance = previous.contacts[e].clearance;
            if (next == guides.end() || previous.contacts[e].isSwitchedOff || !clearance.keptN.allFinite()) continue;
            findSegmentClearance(*element.surface, pose.X_GE[e], last_G, next->front(), clearance);
            const bool isSunk = clearance.distance * clearance.scale < kContactTolerance;
            if (isSunk && clearance.keptC.p.allFinite()) guides[e] = {pose.X_GE[e] * clearance.keptC.p};
        }
        if (!guides[e].empty()) last_G = guides[e].back();
    }
}

}  // namespace

StartCourse calcHintedCourse(const PathProblem& problem, const PathPose& pose) {
    const int n = problem.getNumElements();
    StartCourse course{StartGuides(n), PassageRule{std::vector<int>(n, PassageRule::kAny)}};
    Vec3 last_G = Vec3::Zero();
    for (int e = 0; e < n; ++e) {
        if (!pose.hasElement(e)) continue;
        const PathElement& element = problem.getElement(e);
        const Pose& X_GE = pose.X_GE[e];
        std::vector<Vec3>& guides = course.guides[e];
        if (element.isPoint()) {
            guides = {X_GE.p};
        } else {
            const Chord chord{X_GE.shiftBack(last_G), X_GE.shiftBack(findNextKnown(problem, pose, e))};
            std::visit([&](const auto& hint) { guide(*element.surface, hint, chord, guides); }, element.hint);
            for (Vec3& p : guides) p = X_GE * p;
            course.passages.counts[e] = countAskedPassages(*element.surface, element.hint, chord);
        }
        if (!guides.empty()) last_G = guides.back();
    }
    return course;
}

StartCourse calcPreviousCourse(const PathProblem& problem, const PathPose& pose, const PathSolution& previous) {
    StartCourse course;
    course.guides.resize(problem.getNumElements());
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (!pose.hasElement(e)) continue;
        const PathElement& element = problem.getElement(e);
        const ObstacleContact& contact = previous.contacts[e];
        std::vector<Vec3>& points = course.guides[e];
        if (element.isPoint())
            points = {Vec3::Zero()};
        else if (contact.isTouched && contact.start.length > 0)
            sampleGeodesic(*element.surface, contact.start, kRoughlyAlong, kArcGuides, points);
        else if (contact.isTouched)
            points = {contact.start.point.p};
        else if (contact.passage.count != 0)
            points = {contact.passage.through_S};
        for (Vec3& p : points) p = pose.X_GE[e] * p;
        points.erase(std::remove_if(points.begin(), points.end(), [](const Vec3& p) { return !p.allFinite(); }),
                     points.end());
    }
    guideOverSunken(problem, pose, previous, course.guides);
    return course;
}

Vec3 calcOppositeGuide(const PathProblem& problem, const PathPose& pose, const PathSolution& path, int element) {
    const Surface& surface = *problem.getElement(element).surface;
    const Geodesic& arc = path.contacts[element].geodesic;
    const Vec3 middle = 0.5 * (arc.P.x + arc.Q.x), N = (arc.P.N + arc.Q.N).normalized();
    return pose.X_GE[element] * surface.findSurfacePoint(middle - kThrough * surface.getSize() * N).p;
}

}  // namespace tautline
