// SPDX-License-Identifier: Apache-2.0
#include "paths/contacts/arc_changes.h"

#include <algorithm>
#include <cmath>

#include "paths/contacts/touching_arcs.h"
#include "surfaces/arc_walker.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/segment_clearance.h"
#include "tautline/paths/tolerances.h"
#include "tautline/surfaces/geodesic_events.h"

namespace tautline {
namespace {

/** An arc as a row of trihedra at equal distances, between the ends of the segments beside it; in S. */
struct SampledArc {
    std::vector<DarbouxFrame> frames;
    std::vector<SurfacePoint> points;
    double spacing = 0;  ///< [m]
    Vector3 A_S, B_S;    ///< where the segments come from and go to

    int getLast() const { return static_cast<int>(frames.size()) - 1; }
};

SampledArc sampleArc(const Surface& surface, const ContactArc& arc, const Vector3& A_S, const Vector3& B_S) {
    constexpr int kLeast = 48, kMost = 1000;
    constexpr double kPerRadian = 24;
    const ShotGeodesic& geodesic = arc.geodesic;
    const double curvature =
        std::max({std::abs(geodesic.P.kappaN), std::abs(geodesic.Q.kappaN), 1 / surface.getSize()});
    const int pieces =
        std::clamp(static_cast<int>(std::min(1.0 * kMost, kPerRadian * curvature * geodesic.length)), kLeast, kMost);
    SampledArc sampled;
    sampled.A_S = A_S, sampled.B_S = B_S;
    sampled.spacing = geodesic.length / pieces;
    sampled.frames = {geodesic.P};
    sampled.points = {arc.start.point};
    ArcWalker walker(surface, arc.start, kAlongArc, pieces);
    for (int i = 0; i < pieces; ++i) {
        const ShotGeodesic& piece = walker.next();
        sampled.frames.push_back(piece.Q);
        sampled.points.push_back(piece.endPoint);
    }
    return sampled;
}

/** A bridge over the first hollow of an arc: from sample `left`, -1 if the path does not come down before it, to sample
`right`, one beyond the last if it does not come down after it. */
struct Bridge {
    int left, right;
};

/** The hull of the arc over its hollow: both ends are moved out until the line between them leaves the surface and
comes to it without rising above the tangent planes there. */
Bridge findBridge(const SampledArc& arc) {
    const int last = arc.getLast();
    const auto isHollow = [&](int i) { return arc.frames[i].kappaN > 0; };
    int first = 0;
    while (first < last && !isHollow(first)) ++first;
    if (!isHollow(first))  // between two samples: at the larger of them
        for (int i = 0; i <= last; ++i)
            if (arc.frames[i].kappaN > arc.frames[first].kappaN) first = i;
    Bridge bridge{first - 1, first + 1};
    while (bridge.right <= last && isHollow(bridge.right)) ++bridge.right;
    const auto getPlace = [&](int i) { return i < 0 ? arc.A_S : i > last ? arc.B_S : arc.frames[i].x; };
    const auto isAbove = [&](int from, int to) {
        return from >= 0 && from <= last && arc.frames[from].N.dot(getPlace(to) - getPlace(from)) > 0;
    };
    for (bool isMoved = true; isMoved;) {
        isMoved = false;
        for (; isAbove(bridge.left, bridge.right); --bridge.left) isMoved = true;
        for (; isAbove(bridge.right, bridge.left); ++bridge.right) isMoved = true;
    }
    return bridge;
}

bool hasHollow(const Surface& surface, const ContactArc& arc) {
    return arc.start.length > 0 && arc.geodesic.converged && !pressesEverywhere(surface, arc);
}

/** Whether the segment passes clear of the surface. */
bool isClear(const Surface& surface, const Vector3& A_S, const Vector3& B_S) {
    const double length = (B_S - A_S).norm();
    if (!(length > 0)) return true;
    const Vector3 e_S = (B_S - A_S) / length;
    return surface.calcHeight(A_S + surface.findLowestPoint(A_S, e_S, length) * e_S) >= 0;
}

/** @param in, out   the segments beside it
@return false, and nothing is changed, where an arc that is hollow all along is not bridged by the line over it: the
string would lie on an edge of the surface */
bool splitArc(const PosedProblem& scene, int e, int i, const StraightSegment& in, const StraightSegment& out,
              ObstacleContact& contact) {
    const Pose& X_GS = scene.getPose(e);
    const SampledArc sampled =
        sampleArc(scene.getSurface(e), contact.getArc(i), X_GS.shiftBack(in.A), X_GS.shiftBack(out.B));
    const Bridge bridge = findBridge(sampled);
    const int last = sampled.getLast();
    if (bridge.left < 0 && bridge.right > last) {
        if (!isClear(scene.getSurface(e), sampled.A_S, sampled.B_S)) return false;
        liftArc(i, contact);
        return true;
    }
    ContactArc& arc = contact.updArc(i);
    const ContactArc whole = arc;
    const auto layFrom = [&](int from, ContactArc& to) {
        to.start = {sampled.points[from], sampled.frames[from].t, (last - from) * sampled.spacing};
        to.shot = ArcShot();
    };
    if (bridge.left < 0) {
        layFrom(bridge.right, arc);
        return true;
    }
    arc.start.length = bridge.left * sampled.spacing;
    if (bridge.right > last) return true;
    contact.furtherArcs.insert(contact.furtherArcs.begin() + i, whole);
    layFrom(bridge.right, contact.updArc(i + 1));
    return true;
}

/** Arc i and the next one as one, over the segment between them. */
void join(int i, double between, ObstacleContact& contact) {
    contact.updArc(i).start.length += between + contact.getArc(i + 1).start.length;
    contact.furtherArcs.erase(contact.furtherArcs.begin() + i);
}

/** Whether a segment between two arcs of one obstacle runs back, as those of arcs that overlap do. */
bool isReversed(const Pose& X_GS, const ContactArc& from, const ContactArc& to, const StraightSegment& line) {
    const Vector3 e_S = X_GS.rotateBack(line.e);
    return !(e_S.dot(from.geodesic.Q.t) > 0) || !(e_S.dot(to.geodesic.P.t) > 0);
}

/** Whether an arc that went on over the segment to the next one would press all along. */
bool isClosed(const Surface& surface, const ObstacleContact& contact, int i, double between) {
    constexpr double kNarrow = 0.3;  // in sizes: over more the arc and its continuation part
    if (between > kNarrow * surface.getSize()) return false;
    ContactArc whole = contact.getArc(i);
    whole.start.length += between + contact.getArc(i + 1).start.length;
    surface.shootGeodesic(whole.start, kAlongArc, whole.geodesic);
    return whole.geodesic.converged && !hasHollow(surface, whole);
}

/** @param at   which of the arcs it becomes */
void insertArc(const GeodesicStart& start, int at, ObstacleContact& contact) {
    ContactArc arc;
    arc.start = start;
    if (at == 0) std::swap(arc, static_cast<ContactArc&>(contact));
    contact.furtherArcs.insert(contact.furtherArcs.begin() + std::max(0, at - 1), arc);
}

}  // namespace

bool pressesEverywhere(const Surface& surface, const ContactArc& arc) {
    const double tolerance = kVerificationRounding / surface.getSize();
    if (arc.geodesic.P.kappaN > tolerance || arc.geodesic.Q.kappaN > tolerance) return false;
    if (surface.isConvex() || !(arc.start.length > 0)) return true;
    return !(calcLargestNormalCurvature(surface, arc.start, arc.geodesic) > tolerance);
}

bool splitArcs(const PosedProblem& scene, PathSolution& path) {
    bool isSplit = false;
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int) {
        const Surface& surface = scene.getSurface(e);
        ObstacleContact& contact = path.contacts[e];
        if (surface.isConvex()) return;
        for (int i = 0; i < contact.getNumArcs(); ++i) {
            if (!hasHollow(surface, contact.getArc(i))) continue;
            if (!splitArc(scene, e, i, path.segments[in + i], path.segments[in + i + 1], contact)) continue;
            isSplit = true;
            return;  // segments after this one are no longer those of the arcs
        }
    });
    return isSplit;
}

bool joinArcs(const PosedProblem& scene, PathSolution& path) {
    bool isJoined = false;
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int) {
        ObstacleContact& contact = path.contacts[e];
        // From the last pair on, so that the segments before keep their places.
        for (int i = contact.getNumArcs() - 2; i >= 0; --i) {
            const StraightSegment& line = path.segments[in + i + 1];
            const bool runsBack = isReversed(scene.getPose(e), contact.getArc(i), contact.getArc(i + 1), line);
            if (!runsBack && !isClosed(scene.getSurface(e), contact, i, line.length)) continue;
            join(i, runsBack ? -line.length : line.length, contact);
            isJoined = true;
        }
    });
    return isJoined;
}

bool joinNearestArcs(const PosedProblem& scene, PathSolution& path) {
    int element = -1, arc = -1;
    double nearest = kInfinity;
    scene.forEachObstacleOnSegments(path, [&](int e, int in, int) {
        for (int i = 0; i + 1 < path.contacts[e].getNumArcs(); ++i) {
            const double length = path.segments[in + i + 1].length / scene.getSurface(e).getSize();
            if (length < nearest) nearest = length, element = e, arc = i;
        }
    });
    if (element < 0) return false;
    join(arc, nearest * scene.getSurface(element).getSize(), path.contacts[element]);
    return true;
}

void touchAgain(const PosedProblem& scene, int element, int segment, PathSolution& path) {
    const StraightSegment& line = path.segments[segment];
    const Surface& surface = scene.getSurface(element);
    const Pose& X_GS = scene.getPose(element);
    ObstacleContact& contact = path.contacts[element];
    const Vector3 A_S = X_GS.shiftBack(line.A), B_S = X_GS.shiftBack(line.B);
    LineClearance clearance;
    findSegmentClearance(surface, X_GS, line.A, line.B, clearance);
    int at = line.fromElement == element ? line.fromArc + 1 : line.toArc;
    std::vector<GeodesicStart> further;
    insertArc(calcTouchingArcs(surface, A_S, B_S, clearance, further), at++, contact);
    for (const GeodesicStart& start : further) insertArc(start, at++, contact);
}

void liftArc(int arc, ObstacleContact& contact) {
    if (contact.furtherArcs.empty()) return liftContact(contact);
    if (arc == 0) static_cast<ContactArc&>(contact) = contact.furtherArcs.front();
    contact.furtherArcs.erase(contact.furtherArcs.begin() + std::max(0, arc - 1));
}

}  // namespace tautline
