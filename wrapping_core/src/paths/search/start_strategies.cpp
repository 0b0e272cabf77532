// SPDX-License-Identifier: Apache-2.0
#include "paths/search/start_strategies.h"

#include <algorithm>
#include <cmath>

#include "paths/problem/search_limits.h"
#include "paths/search/route_check.h"
#include "tautline/paths/path_verification.h"
#include "tautline/paths/segment_clearance.h"

namespace tautline {
namespace {

using Condition = PathVerification::Condition;

/** Takes all obstacles out of contact, and watches them on no side. */
void clearContacts(PathSolution& path) {
    for (ObstacleContact& contact : path.contacts) {
        contact.isTouched = false;
        contact.furtherArcs.clear();
        contact.yields = false;
        contact.clearance = LineClearance();
    }
}

/** Whether a ring is to be threaded by going round its tube: no single arc is laid along that. */
bool hasLoops(const PosedProblem& scene, const Route& route) {
    bool hasLoops = false;
    scene.forEachObstacle([&](int e) {
        const bool isThreaded =
            std::holds_alternative<ThreadHole>(scene.getHint(e)) || scene.problem.getElement(e).isAskedThroughHole;
        hasLoops = hasLoops || (isThreaded && route.waypoints[e].size() > 1);
    });
    return hasLoops;
}

/** Whether sides are all that is asked for: any path on them will do. */
bool hasSidesAlone(const PosedProblem& scene) {
    bool hasOthers = false;
    scene.forEachObstacle([&](int e) {
        const StartHint& hint = scene.getHint(e);
        const bool isFree = std::holds_alternative<std::monostate>(hint) && !scene.getSurface(e).getHole();
        hasOthers = hasOthers || !(isFree || std::holds_alternative<PassOnSide>(hint));
    });
    return scene.problem.hasHints() && !hasOthers;
}

/** Whether a string rests where it shows a fault, so that no finer one would show another. */
bool isAtRest(const StringFault& fault) {
    using Kind = StringFault::Kind;
    return fault.kind == Kind::Groove || fault.kind == Kind::OutOfOrder;
}

/** Whether two obstacles meet near a place: steps to and fro between their surfaces come to where they do. */
bool meet(const PosedProblem& scene, int e, int other, const Vector3& place_G) {
    constexpr int kSteps = 8;
    constexpr double kApart = 0.1;  // in sizes
    if (!scene.isObstacle(other)) return false;
    Vector3 p_G = place_G;
    const auto goToSurface = [&](int element) {
        const Pose& X_GS = scene.getPose(element);
        const Vector3 from_G = p_G;
        p_G = X_GS * scene.getSurface(element).findSurfacePoint(X_GS.shiftBack(from_G)).p;
        return (p_G - from_G).norm();
    };
    double apart = kInfinity;
    for (int i = 0; i < kSteps; ++i) {
        goToSurface(other);
        apart = goToSurface(e);
    }
    return apart < kApart * scene.getSurface(e).getSize();
}

/** Whether the string may have slipped off the groove between an obstacle and a neighbor, which a coarse band misses.
 */
bool mayHaveLeftGroove(const PosedProblem& scene, const Route& route, const PathSolution& path) {
    const int e = findSideDeviation(scene, path).element;
    if (e < 0 || route.waypoints[e].empty()) return false;
    const Vector3& place_G = route.waypoints[e][route.waypoints[e].size() / 2];
    return meet(scene, e, e - 1, place_G) || meet(scene, e, e + 1, place_G);
}

/** The first element from one on that has waypoints: the insertion at the latest. */
int findNextWaypoint(const Route& route, int element) {
    while (route.waypoints[element].empty()) ++element;
    return element;
}

/** Watches a lifted obstacle on the side of a place near its surface. */
void watchFrom(const Surface& surface, const Vector3& place_S, LineClearance& clearance) {
    clearance.keptC = surface.findSurfacePoint(place_S);
    clearance.keptN = surface.calcFrame(clearance.keptC, Vector3::UnitX()).N;
}

/** Whether a new search is due, of a path that failed to be a minimum this many times in a row: after 1, 2, 4, 8 ...
steps, so that what cannot be found costs little in the end, and is found soon where it can be. */
bool isSearchDue(int failedSteps) {
    return (failedSteps & (failedSteps - 1)) == 0;
}

}  // namespace

const PathSearch::Strategy PathSearch::kStrategies[] = {
    {StartStrategy::Continued, &PathSearch::canContinue, &PathSearch::continuePrevious},
    {StartStrategy::AlongPrevious, &PathSearch::canLayAlongPrevious, &PathSearch::layAlongPrevious},
    {StartStrategy::Inserted, &PathSearch::canSearch, &PathSearch::insertContacts},
    {StartStrategy::Band, &PathSearch::canSearch, &PathSearch::layAlongAskedRoute},
    {StartStrategy::Released, &PathSearch::canRelease, &PathSearch::release},
};

bool PathSearch::findPath(const PosedProblem& scene, bool isContinued, PathSolution& path) {
    m_scene = &scene;
    m_isContinued = isContinued || !m_options.allowsColdStart;
    m_failedSteps = isContinued ? path.report.failedSteps : 0;
    m_isLoose = false;
    m_bestRank = Rank::None;
    m_asked.waypoints.clear();
    if (m_isContinued && m_options.allowsColdStart) rememberPath(path, m_previous);
    for (const Strategy& strategy : kStrategies) {
        if (!(this->*strategy.applies)()) continue;
        path.report.strategy = strategy.kind;
        path.wasCold = strategy.kind != StartStrategy::Continued;
        (this->*strategy.attempt)(path);
        if (m_bestRank == Rank::Minimum) break;
    }
    if (m_bestRank != Rank::Minimum) goBack(m_best, path);
    if (path.wasCold) path.deviation = findThreadingDeviation(path);
    const bool isMinimum = m_bestRank == Rank::Minimum || m_bestRank == Rank::MinimumElsewhere;
    path.report.failedSteps = isMinimum ? 0 : m_failedSteps + 1;
    if (isMinimum && m_failedSteps > 0)
        for (ObstacleContact& contact : path.contacts) contact.yields = false;
    m_scene = nullptr;
    return isMinimum;
}

bool PathSearch::canLayAlongPrevious() const {
    return m_isContinued && canSearch();
}

bool PathSearch::canSearch() const {
    return m_options.allowsColdStart && isSearchDue(m_failedSteps);
}

bool PathSearch::canRelease() const {
    return canSearch() && m_bestRank < Rank::MinimumElsewhere && hasHints();
}

/** Whether the asked route is one of several: it has hints, or rings that are to be passed as the straight line does.
 */
bool PathSearch::hasHints() const {
    const std::vector<int>& counts = m_asked.threading.counts;
    return m_scene->problem.hasHints() ||
           std::any_of(counts.begin(), counts.end(), [](int count) { return count != PassageRule::kAny; });
}

PathSearch::Rank PathSearch::judge(const PathVerification& broken, const PassageRule& threading, bool keepsSides,
                                   const PathSolution& path) const {
    // Where e = -t the path error vanishes, but the length is not stationary.
    if (broken.condition == Condition::NotStationary || broken.condition == Condition::ReversedTangent)
        return Rank::Lost;
    if (!broken.isMinimum()) return Rank::Stationary;
    if (!hasRightPassages(*m_scene, threading, path)) return Rank::MinimumElsewhere;
    if (m_isLoose && !hasRightPassages(*m_scene, PassageRule(), path)) return Rank::MinimumElsewhere;
    const bool isOnSide = !keepsSides || findSideDeviation(*m_scene, path).kind == RouteDeviation::Kind::None;
    return isOnSide ? Rank::Minimum : Rank::MinimumElsewhere;
}

/** The first ring that a path laid anew does not go through as was asked, or as the straight line does. */
RouteDeviation PathSearch::findThreadingDeviation(const PathSolution& path) const {
    RouteDeviation deviation;
    m_scene->forEachObstacleOnSegments(path, [&](int e, int in, int out) {
        if (m_asked.waypoints.empty() || m_asked.threading.counts[e] == PassageRule::kAny) return;
        if (deviation.kind != RouteDeviation::Kind::None || path.contacts[e].isSwitchedOff) return;
        if (calcHolePassage(*m_scene, path, e, in, out).count != m_asked.threading.counts[e])
            deviation = {RouteDeviation::Kind::Threading, e};
    });
    return deviation;
}

/** The first of equals stays. A minimum is where the search ends: `path` itself is the answer then. */
void PathSearch::offer(Rank rank, const PathSolution& path) {
    if (rank <= m_bestRank) return;
    m_bestRank = rank;
    if (rank != Rank::Minimum) m_best = path;
}

/** Keeps the course of the path that was given, whatever the hints say. Where an obstacle has yielded to another, that
path goes on as it is, saddle or not; and a minimum with all obstacles is tried for beside it. */
void PathSearch::continuePrevious(PathSolution& path) {
    const bool hasYielded =
        m_failedSteps > 0 && std::any_of(path.contacts.begin(), path.contacts.end(),
                                         [](const ObstacleContact& contact) { return contact.yields; });
    offer(judge(m_local.solve(*m_scene, path, {!hasYielded}), PassageRule(), hasYielded, path), path);
    m_isLoose = m_bestRank == Rank::MinimumElsewhere;
    if (!hasYielded || m_bestRank == Rank::Minimum || !isSearchDue(m_failedSteps)) return;
    for (ObstacleContact& contact : path.contacts) contact.yields = false;
    const PathVerification broken = m_local.solve(*m_scene, path, {true, kMaxInsertionDescents});
    offer(judge(broken, PassageRule(), true, path), path);
}

void PathSearch::layAlongPrevious(PathSolution& path) {
    m_band.beginSearch();
    Route route = calcPreviousRoute(*m_scene, m_previous);
    solveAlongBand(route, false, path);
    if (m_bestRank != Rank::Minimum && m_scene->problem.hasHoles() && rethread(*m_scene, m_previous, route))
        solveAlongBand(route, false, path);
}

void PathSearch::insertContacts(PathSolution& path) {
    calcAskedRoute(*m_scene, m_asked);
    solveInserted(m_asked, path);
    if (m_bestRank == Rank::Minimum || !hasSidesAlone(*m_scene)) return;
    Route straight = calcReleasedRoute(*m_scene);
    straight.threading = m_asked.threading;
    solveInserted(straight, path);
}

void PathSearch::layAlongAskedRoute(PathSolution& path) {
    m_band.beginSearch();
    solveAlongBand(m_asked, true, path);
    if (m_bestRank != Rank::Minimum) acceptFault(path);
}

void PathSearch::release(PathSolution& path) {
    const Route released = calcReleasedRoute(*m_scene);
    const StringFault fault = m_best.fault;
    m_band.beginSearch();
    solveAlongBand(released, true, path);
    // Where nothing is known against the hinted string, what keeps the free one from a minimum is the reason.
    if (fault.kind == StringFault::Kind::None) m_best.fault = path.fault;
}

/** A turn about a body is laid as an arc. Of other obstacles it is said on which side they are watched, and therefore
touched: where the point of a hint is, or as the straight line between the waypoints beside them suggests. */
void PathSearch::solveInserted(const Route& route, PathSolution& path) {
    const PosedProblem& scene = *m_scene;
    if (hasLoops(scene, route)) return;
    clearContacts(path);
    path.fault = {};
    int last = 0;
    for (int e = 1; e < scene.size(); ++e) {
        const std::vector<Vector3>& points = route.waypoints[e];
        ObstacleContact& contact = path.contacts[e];
        if (scene.isObstacle(e) && !contact.isSwitchedOff) {
            const Surface& surface = scene.getSurface(e);
            const Pose& X_GS = scene.getPose(e);
            const int next = findNextWaypoint(route, e + 1);
            const Vector3 &before = route.waypoints[last].back(), &after = route.waypoints[next].front();
            if (points.size() > 1) {
                contact.isTouched = true;
                contact.start = calcArcAlong(surface, X_GS, before, points, after);
            } else if (points.size() == 1) {
                watchFrom(surface, X_GS.shiftBack(points.front()), contact.clearance);
            } else if (!scene.isPoint(last) || !scene.isPoint(next)) {
                findSegmentClearance(surface, X_GS, before, after, contact.clearance);
                watchFrom(surface, contact.clearance.C.p, contact.clearance);
            }
        }
        if (!points.empty()) last = e;
    }
    m_broken = m_local.solve(scene, path, {true, kMaxInsertionDescents});
    offer(judge(m_broken, route.threading, true, path), path);
}

/** Ever finer bands, until the local solver leads on from one. One that has slipped off the route asked for is laid
anew: where a string rests in a groove, nodes that are too far apart may miss it. One that rests on the route, but is
not smooth, may show more when it is finer; but one that passes through a wall is not made finer, but laid round it. */
void PathSearch::solveAlongBand(const Route& route, bool keepsSides, PathSolution& path) {
    path.fault = {};
    m_atRestRank = Rank::None;
    bool hasSlipped = true;
    int level = 0;
    for (const BandLevel& band : kBandLevels) {
        path.report.bandLevel = ++level;
        if (hasSlipped) m_band.lay(*m_scene, route.waypoints);
        const Rank rank = freeBand(tightenBand(band, route, keepsSides, path), route, keepsSides, path);
        if (m_bestRank == Rank::Minimum) return;
        const bool rests = isAtRest(m_band.findFault(m_scene->problem));
        if (!rests && m_band.passesThroughWalls(m_scene->problem)) return solveRoundWalls(route, keepsSides, path);
        hasSlipped = rank == Rank::MinimumElsewhere && !rests;
        if (hasSlipped && !mayHaveLeftGroove(*m_scene, route, path)) return;
    }
    if (hasSlipped) return;
    // A band in which nothing is wrong may still slide, slower than was asked for.
    const StringFault::Kind fault = m_band.findFault(m_scene->problem).kind;
    if (fault == StringFault::Kind::Sliding) m_band.disturb();
    const bool mayMove = fault == StringFault::Kind::None || fault == StringFault::Kind::Sliding;
    if (mayMove && tightenBand(kPatientBand, route, keepsSides, path) == Rank::Minimum) return;
    path.fault = m_band.findFault(m_scene->problem);
}

/** Where a band has passed through walls, which its nodes are too far apart to meet: laid round them, and watched. */
void PathSearch::solveRoundWalls(const Route& route, bool keepsSides, PathSolution& path) {
    m_band.layRoundWalls(*m_scene, route.waypoints);
    path.report.bandLevel = 0;
    for (const BandLevel& band : kBandLevels) {
        ++path.report.bandLevel;
        freeBand(tightenBand(band, route, keepsSides, path), route, keepsSides, path);
        if (m_bestRank == Rank::Minimum) return;
    }
    path.fault = m_band.findFault(m_scene->problem);
    // A band that walls hold back only seems to be at rest: its string goes on sliding where no node may follow.
    if (path.fault.kind == StringFault::Kind::None) path.fault = {StringFault::Kind::Sliding, -1, -1};
}

/** @return what the path is that the relaxed band leads on to */
PathSearch::Rank PathSearch::tightenBand(const BandLevel& level, const Route& route, bool keepsSides,
                                         PathSolution& path) {
    const PosedProblem& scene = *m_scene;
    m_broken = {Condition::NotStationary, -1};
    m_band.relax(scene.problem, level);
    if (path.shots > kMaxShotsPerElement * scene.size()) return Rank::None;
    clearContacts(path);
    m_band.extractContacts(scene, path.contacts);
    m_broken = m_local.solve(scene, path);
    const Rank rank = std::max(Rank::NotStationary, judge(m_broken, route.threading, keepsSides, path));
    offer(rank, path);
    const bool isOnRoute = rank != Rank::MinimumElsewhere && hasRightPassages(scene, route.threading, path);
    if (rank >= m_atRestRank && isOnRoute) {
        m_atRestRank = rank;
        m_atRest = path;
    }
    return rank;
}

/** An arc beyond its conjugate point is shortest among geodesics nearby, but not among curves: only the band, which can
bend inside the arc, leads on from there. Laid symmetrically it stays, so that it is moved sideways, farther each time.
@param rank   of the path that the band led on to before
@return that of the last one it leads on to */
PathSearch::Rank PathSearch::freeBand(Rank rank, const Route& route, bool keepsSides, PathSolution& path) {
    double move = kFirstBandMove;
    for (int i = 0; i < kMaxBandMoves && m_broken.condition == Condition::ConjugatePoint; ++i, move *= 2) {
        const int e = m_broken.element;
        const Vector3 sideways_G = m_scene->getPose(e).rotate(path.contacts[e].getArc(m_broken.arc).geodesic.P.B);
        m_band.move(e, move * m_scene->getSurface(e).getSize() * sideways_G);
        rank = tightenBand(kPatientBand, route, keepsSides, path);
    }
    return rank;
}

/** A string that rests on the route asked for, but is not one smooth path: the path next to it is the answer, or goes
on to be, so that its length varies smoothly. */
void PathSearch::acceptFault(PathSolution& path) {
    const StringFault fault = path.fault;
    m_best.fault = fault;
    const bool goesOn = m_isContinued && m_failedSteps > 0 && m_bestRank == Rank::Stationary;
    if (!isAtRest(fault) || goesOn) return;
    if (m_atRestRank < Rank::Stationary && fault.other >= 0) yieldInGrooves(path);
    if (m_atRestRank == Rank::None) keepContactsOfBand(path);
    // A string that would have to cross itself is no answer, unless a path shows where it is.
    if (fault.kind == StringFault::Kind::OutOfOrder && m_atRestRank < Rank::Stationary) return;
    goBack(m_atRest, path);
    path.fault = fault;
    offer(Rank::AskedButBroken, path);
}

/** Where two bodies overlap under the string it lies in the groove between them, with a kink that no smooth path has.
The path that lies on one of them and passes through the other is smooth, of a length that varies smoothly, and its
forces balance: of the two ways to choose the longer is nearer to the string, which has to keep clear of both. */
void PathSearch::yieldInGrooves(PathSolution& path) {
    const std::vector<StringFault> grooves = m_band.findGrooves(m_scene->problem);
    for (const bool yieldsSecond : {true, false}) {
        clearContacts(path);
        m_band.extractContacts(*m_scene, path.contacts);
        for (const StringFault& groove : grooves) {
            const int first = yieldsSecond ? groove.element : groove.other;
            const int second = yieldsSecond ? groove.other : groove.element;
            if (path.contacts[first].yields) continue;
            path.contacts[second].isTouched = false;
            path.contacts[second].furtherArcs.clear();
            path.contacts[second].yields = true;
        }
        const Rank rank = judge(m_local.solve(*m_scene, path, {false}), PassageRule(), true, path);
        if (rank != Rank::Stationary) continue;
        if (m_atRestRank == Rank::Stationary && !(path.length > m_atRest.length)) continue;
        m_atRestRank = rank;
        m_atRest = path;
    }
}

/** The contacts that the band shows, as they are: a path that can be drawn where the string is. */
void PathSearch::keepContactsOfBand(PathSolution& path) {
    clearContacts(path);
    m_band.extractContacts(*m_scene, path.contacts);
    const bool isStationary = m_local.findStationaryPath(*m_scene, path);
    updateClearances(*m_scene, path);
    m_atRestRank = isStationary ? Rank::Stationary : Rank::NotStationary;
    m_atRest = path;
}

}  // namespace tautline
