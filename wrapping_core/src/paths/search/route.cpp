// SPDX-License-Identifier: Apache-2.0
#include "paths/search/route.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "paths/contacts/arc_course.h"
#include "surfaces/arc_walker.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/segment_clearance.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

constexpr int kArcWaypoints = 6;      ///< points taken from each arc of a previous path
constexpr int kWaypointsPerTurn = 8;  ///< of a winding
constexpr double kFar = 1e3;          ///< in sizes of the surface: from there the way down ends on the outside
constexpr double kClear = 3;          ///< in sizes: how far beside a body the search for its surface begins
constexpr double kOnRay = 1e-3;       ///< in sizes: height at which a ray has come down on the surface
constexpr int kHoleSteps = 12;        ///< towards the hole's center

/** Where the straight line of the string comes from and goes to, in S. */
struct Chord {
    Vector3 A_S, B_S;
};

double calcAzimuth(const Vector3& p_S) {
    return std::atan2(p_S.y(), p_S.x());
}

Vector3 makeCylindrical(double radius, double azimuth, double z) {
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/** A point just outside a convex body that has the z axis inside, at this azimuth and height: Newton's method on the
height along the ray from the axis, which from outside never goes too far. None where the axis is not inside. */
std::optional<Vector3> findPointOverAxis(const Surface& surface, double azimuth, double z) {
    constexpr int kMaxSteps = 30;
    const double size = surface.getSize();
    const Vector3 outward = makeCylindrical(1, azimuth, 0), onAxis(0, 0, z);
    if (!surface.isConvex() || !(surface.calcHeight(onAxis) < 0)) return {};
    double radius = 2 * size;
    while (radius < kFar * size && !(surface.calcHeight(onAxis + radius * outward) > 0)) radius *= 2;
    for (int i = 0; i < kMaxSteps; ++i) {
        Vector3 N;
        const Vector3 p = onAxis + radius * outward;
        const double height = surface.calcHeightAndNormal(p, N);
        if (!(height > kOnRay * size)) return p;
        radius -= height / N.dot(outward);
        if (!(radius > 0)) break;
    }
    return {};
}

/** Where a ray from far outside towards the z axis of S, at this azimuth and height, meets the surface: no step is
longer than half the height there. From a ray that passes by, the surface point under its start. */
Vector3 findOutermostPoint(const Surface& surface, double azimuth, double z) {
    constexpr int kMaxSteps = 200;
    if (const auto p = findPointOverAxis(surface, azimuth, z)) return surface.findSurfacePoint(*p).p;
    const double size = surface.getSize();
    const Vector3 outward = makeCylindrical(1, azimuth, 0);
    double radius = kFar * size;
    for (int i = 0; i < kMaxSteps && radius > 0; ++i) {
        const Vector3 p = radius * outward + Vector3(0, 0, z);
        const double height = surface.calcHeight(p);
        if (!(height > kOnRay * size)) return surface.findSurfacePoint(p).p;
        radius -= height / 2;
    }
    return surface.findSurfacePoint(makeCylindrical(kFar * size, azimuth, z)).p;
}

/** Where the line passes the hole, moved towards the center until it lies clear of the surface. */
Vector3 findHolePoint(const Surface& surface, const Hole& hole, const Chord& chord) {
    Vector3 point = hole.calcPlaneCrossing(chord.A_S, chord.B_S);
    point -= hole.getAxis().dot(point) * hole.getAxis();
    for (int i = 0; i < kHoleSteps && surface.calcHeight(point) < 0; ++i) point *= 0.8;
    return point;
}

void guide(const PathElement& element, std::monostate, const Chord& chord, std::vector<Vector3>& waypoints_S) {
    const std::optional<Hole> hole = element.surface->getHole();
    if (hole && hole->countCrossings(chord.A_S, chord.B_S) != 0)
        waypoints_S.push_back(findHolePoint(*element.surface, *hole, chord));
}

/** The surface point under one that lies clear of it beside D: no farther out than it takes, since from far out along
the axis of a long surface the way down would lead far along it. */
Vector3 findPointOnSide(const Surface& surface, const Vector3& D, const Vector3& side) {
    const double size = surface.getSize();
    Vector3 beside = D;
    for (double height = kClear * size; height < kFar * size; height *= 2) {
        beside = D + (height - side.dot(D)) * side;
        if (surface.calcHeight(beside) > size) break;
    }
    return surface.findSurfacePoint(beside).p;
}

/** Where the chord comes nearest to the surface, or dips deepest below it. */
Vector3 findLowestPoint(const Surface& surface, const Chord& chord) {
    const Vector3 step = chord.B_S - chord.A_S;
    const double length = step.norm();
    const Vector3 e = length > 0 ? Vector3(step / length) : Vector3(Vector3::UnitX());
    return chord.A_S + surface.findLowestPoint(chord.A_S, e, length) * e;
}

/** Of a tangent to a circle of radius R about the z axis, from a point outside. */
struct CircleTangent {
    double angle;   ///< between the point and the tangent point, as seen from the axis
    double length;  ///< across the axis

    CircleTangent(double radius, const Vector3& p_S) {
        const double rho = p_S.head<2>().norm();
        angle = std::acos(std::min(1.0, radius / rho));
        length = std::sqrt(std::max(0.0, rho * rho - radius * radius));
    }
};

/** Turns about the z axis by this angle from the chord's begin to its end, as a string about a circular cylinder does:
tangent lines and a helix, which is straight where the cylinder is unrolled. */
void layTurn(const Surface& surface, const Chord& chord, double turn, std::vector<Vector3>& waypoints_S) {
    const double middle = calcAzimuth(chord.A_S) + turn / 2;
    const double radius = findOutermostPoint(surface, middle, 0.5 * (chord.A_S.z() + chord.B_S.z())).head<2>().norm();
    const CircleTangent atA(radius, chord.A_S), atB(radius, chord.B_S);
    const double touching = std::max(0.0, std::abs(turn) - atA.angle - atB.angle);
    const double unrolled = atA.length + radius * touching + atB.length;
    const int count = std::max(1, static_cast<int>(std::ceil(touching / (2 * kPi) * kWaypointsPerTurn)));
    for (int i = 0; i < count; ++i) {
        const double along = (i + 0.5) / count * touching;
        const double azimuth = calcAzimuth(chord.A_S) + std::copysign(atA.angle + along, turn);
        const double fraction = unrolled > 0 ? (atA.length + radius * along) / unrolled : 0.5;
        waypoints_S.push_back(
            findOutermostPoint(surface, azimuth, chord.A_S.z() + fraction * (chord.B_S.z() - chord.A_S.z())));
    }
}

/** The turn about the axis of an endless body that brings the middle of the arc to the side asked for: of the two by
less than a full turn the one that does; the shorter where both do; where none does, the one that comes nearer. */
double calcTurnToSide(const Surface& surface, const Chord& chord, const Vector3& side_S) {
    const double from = calcAzimuth(chord.A_S), direct = calcAzimuth(chord.B_S) - from;
    const double forward = direct - 2 * kPi * std::floor(direct / (2 * kPi));
    const double side = calcAzimuth(side_S), middle = from + forward / 2;
    // A string meets a circle of radius R at acos(R/rho) from where it comes: that shifts the middle of its arc.
    const double z = 0.5 * (chord.A_S.z() + chord.B_S.z());
    const double radius = findOutermostPoint(surface, side, z).head<2>().norm();
    const double shift = (CircleTangent(radius, chord.A_S).angle - CircleTangent(radius, chord.B_S).angle) / 2;
    const double onForward = std::cos(middle + shift - side), onBackward = -std::cos(middle - shift - side);
    const bool isForward = (onForward >= 0) == (onBackward >= 0)
                               ? (onForward >= 0 ? forward <= kPi : std::cos(middle - side) >= 0)
                               : onForward >= 0;
    return isForward ? forward : forward - 2 * kPi;
}

/** Whether the straight line is clear of an obstacle on the side that is asked for. @param D   its lowest point */
bool isClearOnSide(const PathElement& element, const Vector3& D) {
    return element.surface->calcHeight(D) > 0 && element.side_S.dot(D) >= -kOnTheEdge * element.surface->getSize();
}

/** Nothing where the line is clear on the side that is asked for. */
void guideToSide(const PathElement& element, const Vector3& point_S, const Chord& chord,
                 std::vector<Vector3>& waypoints_S) {
    const Surface& surface = *element.surface;
    const Vector3 D = findLowestPoint(surface, chord);
    if (element.isEndless) {
        if (!element.side_S.allFinite() || isClearOnSide(element, D)) return;
        layTurn(surface, chord, calcTurnToSide(surface, chord, element.side_S), waypoints_S);
    } else if (point_S.allFinite()) {
        waypoints_S.push_back(point_S);
    } else if (!isClearOnSide(element, D)) {
        waypoints_S.push_back(findPointOnSide(surface, D, element.side_S));
    }
}

void guide(const PathElement& element, const PassOnSide&, const Chord& chord, std::vector<Vector3>& waypoints_S) {
    guideToSide(element, Vector3::Constant(kNaN), chord, waypoints_S);
}

void guide(const PathElement& element, const WindAround& hint, const Chord& chord, std::vector<Vector3>& waypoints_S) {
    const double direct = calcAzimuth(chord.B_S) - calcAzimuth(chord.A_S);
    const double turn = direct + 2 * kPi * std::round(hint.turns - direct / (2 * kPi));
    layTurn(*element.surface, chord, turn, waypoints_S);
}

/** Points of a ring's tube in the half plane of the hole's axis and a place beside it. */
struct TubePoints {
    Vector3 inner, outer, top, bottom;

    TubePoints(const Surface& surface, const Vector3& axis, const Vector3& beside_S) {
        const double size = surface.getSize(), far = kFar * size;
        const Vector3 aside = makeTangent(beside_S, axis);
        inner = surface.findSurfacePoint(1e-3 * size * aside).p;
        outer = surface.findSurfacePoint(far * aside).p;
        const Vector3 middle = 0.5 * (inner + outer);
        top = surface.findSurfacePoint(middle + far * axis).p;
        bottom = surface.findSurfacePoint(middle - far * axis).p;
    }
};

/** Through the hole each time and around the tube between two passages; once more around it where an end is on the
wrong side of the ring. All in half planes, so that no step from one point to the next cuts through the tube or the
hole. */
void guide(const PathElement& element, const ThreadHole& hint, const Chord& chord, std::vector<Vector3>& waypoints_S) {
    const Surface& surface = *element.surface;
    const int count = std::abs(hint.passages);
    const bool isUpward = hint.passages >= 0;
    const Hole hole = *surface.getHole();  // PathProblem refuses the hint without one
    const Vector3 axis = hole.getAxis();
    const TubePoints atA(surface, axis, chord.A_S), atB(surface, axis, chord.B_S);
    if (count == 0) {
        if (hole.countCrossings(chord.A_S, chord.B_S) != 0) waypoints_S.push_back(atA.outer);
        return;
    }
    const auto goRound = [&](const TubePoints& tube) {
        const Vector3 &leave = isUpward ? tube.top : tube.bottom, &enter = isUpward ? tube.bottom : tube.top;
        waypoints_S.insert(waypoints_S.end(), {leave, tube.outer, enter});
    };
    const Vector3 through = count == 1 ? Vector3(Vector3::Zero()) : atA.inner;
    if ((axis.dot(chord.A_S) > 0) == isUpward) goRound(atA);
    waypoints_S.push_back(through);
    for (int i = 1; i < count; ++i) {
        goRound(atA);
        waypoints_S.push_back(through);
    }
    if ((axis.dot(chord.B_S) < 0) == isUpward) goRound(atB);
}

/** Through a hole from the side where the chord begins to the one where it ends; 0 if that is the same. */
int chooseWay(const Hole& hole, const Chord& chord) {
    const bool isAboveA = hole.getAxis().dot(chord.A_S) > 0, isAboveB = hole.getAxis().dot(chord.B_S) > 0;
    return isAboveA == isAboveB ? 0 : (isAboveA ? -1 : 1);
}

void guide(const PathElement& element, const PassNear& hint, const Chord& chord, std::vector<Vector3>& waypoints_S) {
    const int way = element.isAskedThroughHole ? chooseWay(*element.surface->getHole(), chord) : 0;
    if (way != 0) guide(element, ThreadHole{way}, chord, waypoints_S);
    if (waypoints_S.size() > 1) return;
    waypoints_S.clear();
    guideToSide(element, element.surface->findSurfacePoint(hint.point_S).p, chord, waypoints_S);
}

int countAskedPassages(const PathElement& element, const Chord& chord) {
    if (const auto* thread = std::get_if<ThreadHole>(&element.hint)) return thread->passages;
    const std::optional<Hole> hole = element.surface->getHole();
    if (element.isAskedThroughHole && chooseWay(*hole, chord) != 0) return chooseWay(*hole, chord);
    if (std::holds_alternative<std::monostate>(element.hint) && hole) return hole->countCrossings(chord.A_S, chord.B_S);
    return PassageRule::kAny;
}

/** The next point that the string is sure to pass: a fixed point or a hinted one. */
Vector3 findNextKnown(const PosedProblem& scene, int element) {
    for (int e = element + 1; e < scene.size(); ++e) {
        if (!scene.pose.hasElement(e)) continue;
        if (scene.isPoint(e)) return scene.getPose(e).p;
        if (const auto* near = std::get_if<PassNear>(&scene.getHint(e))) return scene.getPose(e) * near->point_S;
    }
    return scene.getPose(scene.size() - 1).p;
}

/** @param points_S   on all arcs in turn; of arcs without length their start */
void layAlongArcs(const Surface& surface, const PassedObstacle& obstacle, std::vector<Vector3>& points_S) {
    std::vector<Vector3> along;
    const auto layAlong = [&](const GeodesicStart& arc) {
        along = {arc.point.p};
        if (arc.length > 0) sampleGeodesic(surface, arc, kRoughlyAlong, kArcWaypoints, along);
        points_S.insert(points_S.end(), along.begin(), along.end());
    };
    layAlong(obstacle.arc);
    for (const GeodesicStart& arc : obstacle.furtherArcs) layAlong(arc);
}

/** Lifted obstacles that have come between the waypoints beside them are passed where they were: on the side that is
kept, however far that is. */
void guideOverSunken(const PosedProblem& scene, const std::vector<PassedObstacle>& previous, Waypoints& waypoints) {
    Vector3 last_G = Vector3::Zero();
    for (int e = 0; e < scene.size(); ++e) {
        if (scene.isObstacle(e) && waypoints[e].empty()) {
            const auto next = std::find_if(waypoints.begin() + e, waypoints.end(),
                                           [](const auto& points) { return !points.empty(); });
            LineClearance clearance;
            clearance.keptC = previous[e].keptC;
            clearance.keptN = previous[e].keptN;
            if (next == waypoints.end() || previous[e].isSwitchedOff || !clearance.keptN.allFinite()) continue;
            findSegmentClearance(scene.getSurface(e), scene.getPose(e), last_G, next->front(), clearance);
            const bool isSunk = clearance.distance * clearance.scale < kContactTolerance;
            if (isSunk && clearance.keptC.p.allFinite()) waypoints[e] = {scene.getPose(e) * clearance.keptC.p};
        }
        if (!waypoints[e].empty()) last_G = waypoints[e].back();
    }
}

}  // namespace

void calcAskedRoute(const PosedProblem& scene, Route& route) {
    route.waypoints.resize(scene.size());
    for (std::vector<Vector3>& points : route.waypoints) points.clear();
    route.threading.counts.assign(scene.size(), PassageRule::kAny);
    Vector3 last_G = Vector3::Zero();
    for (int e = 0; e < scene.size(); ++e) {
        if (!scene.pose.hasElement(e)) continue;
        const PathElement& element = scene.problem.getElement(e);
        const Pose& X_GE = scene.getPose(e);
        std::vector<Vector3>& points = route.waypoints[e];
        if (element.isPoint()) {
            points.push_back(X_GE.p);
        } else {
            const Chord chord{X_GE.shiftBack(last_G), X_GE.shiftBack(findNextKnown(scene, e))};
            std::visit([&](const auto& hint) { guide(element, hint, chord, points); }, element.hint);
            for (Vector3& p : points) p = X_GE * p;
            route.threading.counts[e] = countAskedPassages(element, chord);
        }
        if (!points.empty()) last_G = points.back();
    }
}

int calcAskedPassages(const PathElement& element, const Vector3& A_S, const Vector3& B_S) {
    return countAskedPassages(element, {A_S, B_S});
}

double calcAskedTurn(const PathElement& element, const Vector3& A_S, const Vector3& B_S) {
    const Chord chord{A_S, B_S};
    const bool isDirect =
        !element.side_S.allFinite() || isClearOnSide(element, findLowestPoint(*element.surface, chord));
    return isDirect ? calcShortTurning(A_S, B_S) : calcTurnToSide(*element.surface, chord, element.side_S);
}

void rememberPath(const PathSolution& path, std::vector<PassedObstacle>& previous) {
    previous.resize(path.contacts.size());
    for (std::size_t e = 0; e < previous.size(); ++e) {
        const ObstacleContact& contact = path.contacts[e];
        PassedObstacle& passed = previous[e];
        passed.isTouched = contact.isTouched, passed.isSwitchedOff = contact.isSwitchedOff;
        passed.arc = contact.start;
        passed.furtherArcs.clear();
        for (const ContactArc& arc : contact.furtherArcs) passed.furtherArcs.push_back(arc.start);
        passed.passage = contact.passage;
        passed.keptC = contact.clearance.keptC, passed.keptN = contact.clearance.keptN;
    }
}

Route calcPreviousRoute(const PosedProblem& scene, const std::vector<PassedObstacle>& previous) {
    Route route;
    route.waypoints.resize(scene.size());
    for (int e = 0; e < scene.size(); ++e) {
        if (!scene.pose.hasElement(e)) continue;
        const PassedObstacle& obstacle = previous[e];
        std::vector<Vector3>& points = route.waypoints[e];
        if (scene.isPoint(e))
            points = {Vector3::Zero()};
        else if (obstacle.isTouched)
            layAlongArcs(scene.getSurface(e), obstacle, points);
        else if (obstacle.passage.count != 0)
            points = {obstacle.passage.through_S};
        for (Vector3& p : points) p = scene.getPose(e) * p;
        points.erase(std::remove_if(points.begin(), points.end(), [](const Vector3& p) { return !p.allFinite(); }),
                     points.end());
    }
    guideOverSunken(scene, previous, route.waypoints);
    return route;
}

bool rethread(const PosedProblem& scene, const std::vector<PassedObstacle>& previous, Route& route) {
    bool isChanged = false;
    scene.forEachObstacle([&](int e) {
        const HolePassage& before = previous[e].passage;
        if (!scene.problem.getElement(e).hasHole || !before.isKnown()) return;
        if (!scene.isPoint(before.from) || !scene.isPoint(before.to)) return;
        const Pose& X_GE = scene.getPose(e);
        const Chord chord{X_GE.shiftBack(scene.getPose(before.from).p), X_GE.shiftBack(scene.getPose(before.to).p)};
        const Hole hole = *scene.getSurface(e).getHole();
        const int count =
            before.count - hole.countCrossings(before.A_S, chord.A_S) - hole.countCrossings(chord.B_S, before.B_S);
        route.waypoints[e].clear();
        guide(scene.problem.getElement(e), ThreadHole{count}, chord, route.waypoints[e]);
        for (Vector3& p : route.waypoints[e]) p = X_GE * p;
        isChanged = true;
    });
    return isChanged;
}

Route calcReleasedRoute(const PosedProblem& scene) {
    Route route{Waypoints(scene.size()), PassageRule{std::vector<int>(scene.size(), PassageRule::kAny)}};
    for (int e = 0; e < scene.size(); ++e)
        if (scene.isPoint(e) && scene.pose.hasElement(e)) route.waypoints[e] = {scene.getPose(e).p};
    return route;
}

GeodesicStart calcArcAlong(const Surface& surface, const Pose& X_GS, const Vector3& before,
                           const std::vector<Vector3>& points, const Vector3& after) {
    const Vector3 in = points.front() - before, out = after - points.back();
    // Half of each edge beside the points belongs to the turning that the first and the last of them see.
    const Vector3 along = points.size() > 1 ? Vector3(points[1] - points[0]) : out;
    GeodesicStart arc;
    arc.point = surface.findSurfacePoint(X_GS.shiftBack(points.front()));
    const DarbouxFrame frame =
        surface.calcFrame(arc.point, X_GS.rotateBack(Vector3(in.normalized() + along.normalized())));
    arc.tangent = frame.t;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) arc.length += (points[k + 1] - points[k]).norm();
    if (points.size() == 1 && std::abs(frame.kappaN) > 0) {
        const double turn = std::acos(std::clamp(in.normalized().dot(out.normalized()), -1.0, 1.0));
        arc.length = std::min(turn / std::abs(frame.kappaN), 0.5 * (in.norm() + out.norm()));
        arc.point = surface.calcDisplacedPoint(arc.point, -0.5 * arc.length * frame.t);
    }
    return arc;
}

}  // namespace tautline
