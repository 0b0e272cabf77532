// SPDX-License-Identifier: Apache-2.0
#include "paths/arc_changes.h"

#include <algorithm>
#include <cmath>

#include "surfaces/arc_walker.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/segment_clearance.h"
#include "tautline/paths/tolerances.h"
#include "tautline/surfaces/geodesic_events.h"

namespace tautline {
namespace {

constexpr double kMostHalf = 2;  ///< half of a new arc where the surface hardly curves, in sizes

/** From the top of a circle to where the line from a point touches it, as an angle at its center: positive towards the
point. The chord's half angle where the point lies in the circle.
@param along, above   of the point, from the top [m]
@param depth          of the line to be bent, below the top [m] */
double calcTangentAngle(double radius, double along, double above, double depth) {
    const double distance = std::hypot(along, radius + above);
    if (!(distance > radius)) return std::sqrt(2 * std::max(0.0, depth) / radius);
    return std::atan2(along, radius + above) - std::acos(radius / distance);
}

/** The start of an arc for Newton's method: that of the string from A to B, both in S, over the osculating circle at
the place where the clearance was measured. Of length zero where the line just touches. */
GeodesicStart calcTouchingArc(const Surface& surface, const Vec3& A_S, const Vec3& B_S,
                              const LineClearance& clearance) {
    const DarbouxFrame frame = surface.calcFrame(clearance.C, B_S - A_S);
    const double radius = 1 / std::max(std::abs(frame.kappaN), 1e-3 * clearance.scale);
    const double most = std::min(radius, kMostHalf * surface.getSize());
    const auto calcHalf = [&](const Vec3& end_S, double sign) {
        const Vec3 from = end_S - clearance.C.p;
        const double angle = calcTangentAngle(radius, sign * frame.t.dot(from), frame.N.dot(from), -clearance.distance);
        return std::clamp(radius * angle, 0.0, most);
    };
    const double before = calcHalf(A_S, -1), after = calcHalf(B_S, 1);
    GeodesicStart arc;
    arc.point = surface.calcDisplacedPoint(clearance.C, -before * frame.t);
    arc.tangent = surface.calcFrame(arc.point, frame.t).t;
    arc.length = before + after;
    return arc;
}

/** The section of a surface by the plane through a segment and a direction N out of it, over where the segment is below
the surface: points of it in order, and first and last the segment's ends. */
std::vector<Vec3> calcSection(const Surface& surface, const Vec3& A_S, const Vec3& B_S, const Vec3& N_S) {
    constexpr int kSamples = 96, kMaxMarches = 100;
    const double atSurface = 1e-6 * surface.getSize();
    std::vector<Vec3> section{A_S};
    for (int i = 1; i < kSamples; ++i) {
        Vec3 p = A_S + i * (B_S - A_S) / kSamples;
        double height = surface.calcHeight(p);
        if (height > 0) continue;
        // Outwards by the depth, which is no more than the way to the surface.
        for (int k = 0; k < kMaxMarches && height < -atSurface; ++k) {
            p -= height * N_S;
            height = surface.calcHeight(p);
        }
        if (height >= -atSurface) section.push_back(p);
    }
    section.push_back(B_S);
    return section;
}

/** Indices of the hull of a plane polyline on the side of N, first and last included. */
std::vector<int> findHull(const std::vector<Vec3>& points, const Vec3& along, const Vec3& N_S) {
    std::vector<int> hull;
    for (int k = 0; k < static_cast<int>(points.size()); ++k) {
        const auto isBelow = [&] {
            const Vec3& a = points[hull[hull.size() - 2]];
            const Vec3 toLast = points[hull.back()] - a, toNext = points[k] - a;
            return along.dot(toLast) * N_S.dot(toNext) >= N_S.dot(toLast) * along.dot(toNext);
        };
        while (hull.size() >= 2 && isBelow()) hull.pop_back();
        hull.push_back(k);
    }
    return hull;
}

/** An arc over each run of neighbors that are on the hull of the section. */
std::vector<GeodesicStart> calcArcsOfHull(const Surface& surface, const Vec3& A_S, const Vec3& B_S, const Vec3& N_S) {
    const Vec3 along = (B_S - A_S).normalized();
    const std::vector<Vec3> section = calcSection(surface, A_S, B_S, N_S);
    const std::vector<int> hull = findHull(section, along, N_S);
    std::vector<GeodesicStart> arcs;
    for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
        const Vec3& p = section[hull[i]];
        if (i > 1 && hull[i] == hull[i - 1] + 1) {
            arcs.back().length += (p - section[hull[i - 1]]).norm();
            continue;
        }
        GeodesicStart arc;
        arc.point = surface.findSurfacePoint(p);
        arc.tangent = surface.calcFrame(arc.point, section[hull[i] + 1] - section[hull[i] - 1]).t;
        arcs.push_back(arc);
    }
    return arcs;
}

/** An arc as a row of trihedra at equal distances, between the ends of the segments beside it; in S. */
struct SampledArc {
    std::vector<DarbouxFrame> frames;
    std::vector<SurfacePoint> points;
    double spacing = 0;  ///< [m]
    Vec3 A_S, B_S;       ///< where the segments come from and go to

    int getLast() const { return static_cast<int>(frames.size()) - 1; }
};

SampledArc sampleArc(const Surface& surface, const ContactArc& arc, const Vec3& A_S, const Vec3& B_S) {
    constexpr int kLeast = 48, kMost = 1000;
    constexpr double kPerRadian = 24;
    const Geodesic& geodesic = arc.geodesic;
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
        const Geodesic& piece = walker.next();
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
    int deepest = 0;
    const auto isHollow = [&](int i) { return arc.frames[i].kappaN > 0; };
    while (deepest < last && !isHollow(deepest)) ++deepest;
    if (!isHollow(deepest))  // between two samples: at the larger of them
        for (int i = 0; i <= last; ++i)
            if (arc.frames[i].kappaN > arc.frames[deepest].kappaN) deepest = i;
    Bridge bridge{deepest - 1, deepest + 1};
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
    if (!(arc.start.length > 0) || !arc.geodesic.converged) return false;
    const double tolerance = kVerificationRounding / surface.getSize();
    return calcLargestNormalCurvature(surface, arc.start, arc.geodesic) > tolerance;
}

/** Whether the segment passes clear of the surface. */
bool isClear(const Surface& surface, const Vec3& A_S, const Vec3& B_S) {
    const double length = (B_S - A_S).norm();
    if (!(length > 0)) return true;
    const Vec3 e_S = (B_S - A_S) / length;
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
    const Vec3 e_S = X_GS.rotateBack(line.e);
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

GeodesicStart calcTouchingArcs(const Surface& surface, const Vec3& A_S, const Vec3& B_S, const LineClearance& clearance,
                               std::vector<GeodesicStart>& further) {
    further.clear();
    if (surface.isConvex() || !(surface.calcFrame(clearance.C, B_S - A_S).kappaN > 0))
        return calcTouchingArc(surface, A_S, B_S, clearance);
    const std::vector<GeodesicStart> arcs = calcArcsOfHull(surface, A_S, B_S, clearance.N);
    if (arcs.empty()) return calcTouchingArc(surface, A_S, B_S, clearance);
    further.assign(arcs.begin() + 1, arcs.end());
    return arcs.front();
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
    const Vec3 A_S = X_GS.shiftBack(line.A), B_S = X_GS.shiftBack(line.B);
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
