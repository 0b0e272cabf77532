// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_verification.h"

#include <algorithm>
#include <cmath>

#include "paths/contacts/arc_changes.h"
#include "surfaces/arc_walker.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/path_stability.h"
#include "tautline/paths/tolerances.h"
#include "tautline/surfaces/geodesic_events.h"

namespace tautline {
namespace {

using Condition = PathVerification::Condition;

/** True if a straight segment that leaves the surface at one end dips below it elsewhere. */
bool meetsOwnSurface(const Surface& surface, const Pose& X_GS, const StraightSegment& line) {
    if (surface.isConvex() || !(line.length > 0)) return false;
    const Vector3 A_S = X_GS.shiftBack(line.A), e_S = X_GS.rotateBack(line.e);
    // Near the tangent end the height is rounding of a square: judge beyond a margin only.
    const double s = surface.findLowestPoint(A_S, e_S, line.length);
    return surface.calcHeight(A_S + s * e_S) < -kVerificationRounding * surface.getSize();
}

/** The ends tell it for most arcs; along the arc it is asked only of surfaces that have an edge. */
bool isInDomain(const Surface& surface, const ContactArc& contact) {
    const double margin =
        std::min(surface.calcDomainMargin(contact.start.point), surface.calcDomainMargin(contact.geodesic.endPoint));
    if (!(margin >= 0)) return false;
    return margin == kInfinity || !findDomainExit(surface, contact.start, kAlongArc);
}

Condition findBrokenCondition(const Surface& surface, const Pose& X_GS, const ContactArc& contact,
                              const StraightSegment& in, const StraightSegment& out, double shortestArc) {
    const ShotGeodesic& arc = contact.geodesic;
    if (!isInDomain(surface, contact)) return Condition::OutsideDomain;
    if (!(in.e.dot(X_GS.rotate(arc.P.t)) > 0) || !(out.e.dot(X_GS.rotate(arc.Q.t)) > 0))
        return Condition::ReversedTangent;
    if (contact.start.length < shortestArc * surface.getSize()) return Condition::NegativeLength;
    if (arc.hasConjugatePoint && contact.start.length > 0) return Condition::ConjugatePoint;
    if (!pressesEverywhere(surface, contact)) return Condition::PullsOutward;
    if (meetsOwnSurface(surface, X_GS, in) || meetsOwnSurface(surface, X_GS, out)) return Condition::Penetration;
    return Condition::None;
}

/** Where on its arc a touched obstacle breaks a condition, in S. */
Vector3 findPlaceOnArc(const Surface& surface, const ContactArc& contact, Condition condition, bool isAtEnd) {
    const auto orStart = [&](const std::optional<GeodesicPlace>& place) {
        return place ? place->point.p : contact.geodesic.P.x;
    };
    if (condition == Condition::OutsideDomain) return orStart(findDomainExit(surface, contact.start, kAlongArc));
    if (condition == Condition::ConjugatePoint) return orStart(findConjugatePoint(surface, contact.start, kAlongArc));
    if (condition == Condition::PullsOutward) {
        const std::vector<GeodesicPlace> changes = findPressureChanges(surface, contact.start, kAlongArc);
        if (!changes.empty()) return changes.front().point.p;
    }
    return isAtEnd ? contact.geodesic.Q.x : contact.geodesic.P.x;
}

/** Where a touched obstacle breaks a condition, in ground. */
Vector3 findPlace(const Surface& surface, const Pose& X_GS, const ContactArc& contact, Condition condition,
                  const StraightSegment& in, const StraightSegment& out) {
    if (condition == Condition::Penetration) {
        const StraightSegment& line = meetsOwnSurface(surface, X_GS, in) ? in : out;
        return line.A + surface.findLowestPoint(X_GS.shiftBack(line.A), X_GS.rotateBack(line.e), line.length) * line.e;
    }
    const bool isAtEnd = condition == Condition::ReversedTangent && in.e.dot(X_GS.rotate(contact.geodesic.P.t)) > 0;
    return X_GS * findPlaceOnArc(surface, contact, condition, isAtEnd);
}

/** @param i    of the arcs of element e
@param segmentIn   that comes to it */
PathVerification verifyArc(const Surface& surface, const Pose& X_GS, const PathSolution& path, int e, int i,
                           int segmentIn, double shortestArc) {
    const ContactArc& arc = path.contacts[e].getArc(i);
    const StraightSegment &in = path.segments[segmentIn], &out = path.segments[segmentIn + 1];
    const Condition condition = findBrokenCondition(surface, X_GS, arc, in, out, shortestArc);
    if (condition == Condition::None) return {};
    const int segment = meetsOwnSurface(surface, X_GS, in) ? segmentIn : segmentIn + 1;
    return {condition, e, findPlace(surface, X_GS, arc, condition, in, out), i,
            condition == Condition::Penetration ? segment : -1};
}

}  // namespace

PathVerification verifyPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                            double shortestArc) {
    int segmentIn = 0;
    const int lastSegment = static_cast<int>(path.segments.size()) - 1;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const PathElement& element = problem.getElement(e);
        if (element.isPoint() || !pose.hasElement(e)) continue;
        const ObstacleContact& contact = path.contacts[e];
        while (segmentIn < lastSegment && path.segments[segmentIn].toElement < e) ++segmentIn;
        for (int i = 0; i < contact.getNumArcs(); ++i) {
            const PathVerification broken =
                verifyArc(*element.surface, pose.X_GE[e], path, e, i, segmentIn + i, shortestArc);
            if (!broken.isMinimum()) return broken;
        }
        if (!contact.isTouched && !contact.isSwitchedOff &&
            !(contact.clearance.distance * contact.clearance.scale >= kContactTolerance)) {
            if (lastSegment < 0) return {Condition::Penetration, e};  // a pose that is not finite leaves no path
            const StraightSegment& line = path.segments[segmentIn];
            const double s = std::clamp(contact.clearance.lineCoordinate, 0.0, line.length);
            return {Condition::Penetration, e, line.A + s * line.e, 0, segmentIn};
        }
    }
    const PathStability stability = calcPathStability(problem, pose, path);
    if (!stability.isStable())
        return {Condition::Unstable, stability.element,
                pose.X_GE[stability.element] * path.contacts[stability.element].geodesic.P.x};
    return {};
}

}  // namespace tautline
