#include "tautline/path_verification.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "nearer_clearance.h"
#include "tautline/contact_switch.h"
#include "tautline/geodesic_events.h"

namespace tautline {
namespace {

using Condition = PathVerification::Condition;

constexpr GeodesicOptions kWalking{1e-6, 200};  ///< for looking along an arc whose ends are known exactly
constexpr double kNeutral = 1e-9;  ///< relative second variation below which a path is neither stable nor unstable

/** True if the arc presses on its surface all along: kappa_n <= 0 at closely spaced points. */
bool pressesEverywhere(const Surface& surface, const ObstacleContact& contact) {
    const double tolerance = 1e-9 / surface.getSize();
    if (contact.geodesic.P.kappaN > tolerance || contact.geodesic.Q.kappaN > tolerance) return false;
    if (surface.isConvex() || !(contact.start.length > 0)) return true;
    const int pieces = 2 + static_cast<int>(std::min(500.0, 5 * contact.start.length / surface.getSize()));
    GeodesicStart from = contact.start;
    from.length /= pieces;
    Geodesic piece;
    for (int i = 1; i < pieces; ++i) {
        surface.shootGeodesic(from, kWalking, piece);
        if (piece.Q.kappaN > tolerance) return false;
        from.point = piece.endPoint, from.tangent = piece.Q.t;
    }
    return true;
}

/** True if a straight segment that leaves the surface at one end dips below it elsewhere. */
bool meetsOwnSurface(const Surface& surface, const Pose& X_GS, const StraightSegment& line) {
    if (surface.isConvex() || !(line.length > 0)) return false;
    const Vec3 A_S = X_GS.shiftBack(line.A), e_S = X_GS.R.transpose() * line.e;
    // Near the tangent end the height is rounding of a square: judge beyond a margin only.
    Vec3 N;
    const double s = surface.findLowestPoint(A_S, e_S, line.length);
    return surface.calcHeight(A_S + s * e_S, N) < -1e-9 * surface.getSize();
}

/** The ends tell it for most arcs; along the arc it is asked only of surfaces that have an edge. */
bool isInDomain(const Surface& surface, const ObstacleContact& contact) {
    const double margin =
        std::min(surface.calcDomainMargin(contact.start.point), surface.calcDomainMargin(contact.geodesic.endPoint));
    if (!(margin >= 0) || !surface.isInDomain(contact.start.point) || !surface.isInDomain(contact.geodesic.endPoint))
        return false;
    return margin == kInfinity || !findDomainExit(surface, contact.start, kWalking);
}

Condition verifyContact(const Surface& surface, const Pose& X_GS, const ObstacleContact& contact,
                        const StraightSegment& in, const StraightSegment& out) {
    const Geodesic& arc = contact.geodesic;
    if (!isInDomain(surface, contact)) return Condition::OutsideDomain;
    if (!(in.e.dot(X_GS.R * arc.P.t) > 0) || !(out.e.dot(X_GS.R * arc.Q.t) > 0)) return Condition::ReversedTangent;
    if (contact.start.length < -1e-12 * surface.getSize()) return Condition::NegativeLength;
    if (arc.hasConjugatePoint && contact.start.length > 0) return Condition::ConjugatePoint;
    if (!pressesEverywhere(surface, contact)) return Condition::PullsOutward;
    if (meetsOwnSurface(surface, X_GS, in) || meetsOwnSurface(surface, X_GS, out)) return Condition::Penetration;
    return Condition::None;
}

/** Second variation of the length over sideways displacements b of the contact points along their binormals:

    sum over lines of (b_Q^2 + b_P^2 - 2 b_Q b_P B_Q.B_P)/l  +  sum over arcs of the index form of the Jacobi fields,

a symmetric tridiagonal form in (b_P, b_Q) of all contacts in order, positive definite at a strict minimum. Its
pivots, in terms of the displacement y and slope y' of the sideways field that stays taut from the fixed point
behind: on an arc y_Q = a y_P + r y_P', y_Q' = a' y_P + r' y_P'; on a line slopes sigma = y'/y obey
sigma_P = 1/l - (B_Q.B_P/l)^2/(sigma_Q + 1/l). @return the first contact at which a pivot is not positive, or -1 */
int findUnstableContact(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    double sigmaQ = 0;  // slope at the end of the last arc
    Vec3 BQ = Vec3::Zero();
    for (std::size_t j = 0; j + 1 < path.segments.size(); ++j) {
        const StraightSegment &in = path.segments[j], &out = path.segments[j + 1];
        const int e = in.toElement;
        if (problem.getElement(e).isPoint()) continue;
        const Geodesic& arc = path.contacts[e].geodesic;
        const Mat3& R = pose.X_GE[e].R;
        // From a fixed point y : y' = l : 1; from an arc, the pivot.
        double y = in.length, slope = 1;
        if (!problem.getElement(in.fromElement).isPoint()) {
            const double twist = BQ.dot(R * arc.P.B);
            y = 1, slope = 1 / in.length - twist * twist / (in.length * in.length * (sigmaQ + 1 / in.length));
        }
        const double yQ = arc.a * y + arc.r * slope, slopeQ = arc.aDot * y + arc.rDot * slope;
        const double bend = slopeQ * out.length;
        // A path over a sphere between opposite points can turn freely: neutral, and a minimum like its neighbours.
        const bool isLast = problem.getElement(out.toElement).isPoint();
        const double margin = isLast ? -kNeutral * (std::abs(bend) + std::abs(yQ)) : 0;
        if (!(yQ > 0) || !(bend + yQ > margin)) return e;
        sigmaQ = slopeQ / yQ;
        BQ = R * arc.Q.B;
    }
    return -1;
}

/** The clearance of a line of which nothing is known yet: Newton from the segment's lowest point. */
void findFreshClearance(const Surface& surface, const Vec3& A_S, const Vec3& e_S, double length,
                        LineClearance& clearance) {
    constexpr int kApproaches = 4;
    Vec3 D = A_S + surface.findLowestPoint(A_S, e_S, length) * e_S, N;
    const bool isOutside = surface.calcHeight(D, N) > 0;
    clearance.C = surface.findSurfacePoint(D);
    // From foot to foot: the lowest point of a line is far from the nearest one where a surface is thin.
    for (int i = 0; i < kApproaches && isOutside; ++i) {
        D = A_S + std::clamp(e_S.dot(clearance.C.p - A_S), 0.0, length) * e_S;
        clearance.C = surface.findSurfacePoint(D);
    }
    clearance.N = surface.calcFrame(clearance.C, e_S).N;
    surface.findLineClearance(A_S, e_S, clearance);
    if (isOutside && !(clearance.distance > 0)) clearance.found = false;  // the far side of the surface
}

/** The height of one point of the line as its clearance. */
void takeHeight(const Surface& surface, const Vec3& A_S, const Vec3& e_S, double s, LineClearance& clearance) {
    const Vec3 D = A_S + s * e_S;
    clearance.C = surface.findSurfacePoint(D);
    clearance.distance = surface.calcHeight(D, clearance.N);
    clearance.scale = 1 / surface.getSize();
    clearance.lineCoordinate = s;
}

}  // namespace

namespace {

/** Where on its arc a touched obstacle breaks a condition, in S. */
Vec3 findPlaceOnArc(const Surface& surface, const ObstacleContact& contact, Condition condition, bool isAtEnd) {
    const auto orStart = [&](const std::optional<GeodesicPlace>& place) {
        return place ? place->point.p : contact.geodesic.P.x;
    };
    if (condition == Condition::OutsideDomain) return orStart(findDomainExit(surface, contact.start, kWalking));
    if (condition == Condition::ConjugatePoint) return orStart(findConjugatePoint(surface, contact.start, kWalking));
    if (condition == Condition::PullsOutward) {
        const std::vector<GeodesicPlace> changes = findPressureChanges(surface, contact.start, kWalking);
        if (!changes.empty()) return changes.front().point.p;
    }
    return isAtEnd ? contact.geodesic.Q.x : contact.geodesic.P.x;
}

/** Where a touched obstacle breaks a condition, in ground. */
Vec3 findPlace(const Surface& surface, const Pose& X_GS, const ObstacleContact& contact, Condition condition,
               const StraightSegment& in, const StraightSegment& out) {
    if (condition == Condition::Penetration) {
        const StraightSegment& line = meetsOwnSurface(surface, X_GS, in) ? in : out;
        return line.A +
               surface.findLowestPoint(X_GS.shiftBack(line.A), X_GS.R.transpose() * line.e, line.length) * line.e;
    }
    const bool isAtEnd = condition == Condition::ReversedTangent && in.e.dot(X_GS.R * contact.geodesic.P.t) > 0;
    return X_GS * findPlaceOnArc(surface, contact, condition, isAtEnd);
}

}  // namespace

PathVerification verifyPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    int segmentIn = 0;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const PathElement& element = problem.getElement(e);
        if (element.isPoint() || !pose.hasElement(e)) continue;
        const ObstacleContact& contact = path.contacts[e];
        if (contact.isTouched) {
            while (path.segments[segmentIn].toElement != e) ++segmentIn;
            const StraightSegment &in = path.segments[segmentIn], &out = path.segments[segmentIn + 1];
            const Condition condition = verifyContact(*element.surface, pose.X_GE[e], contact, in, out);
            if (condition != Condition::None)
                return {condition, e, findPlace(*element.surface, pose.X_GE[e], contact, condition, in, out)};
        } else if (!contact.isSwitchedOff && contact.clearance.distance * contact.clearance.scale < kContactTolerance) {
            return {Condition::Penetration, e, pose.X_GE[e] * contact.clearance.C.p};
        }
    }
    const int unstable = findUnstableContact(problem, pose, path);
    if (unstable >= 0)
        return {Condition::Unstable, unstable, pose.X_GE[unstable] * path.contacts[unstable].geodesic.P.x};
    return {};
}

std::string describe(const PathVerification& verification, const PathProblem& problem) {
    if (verification.isMinimum()) return "a local minimum";
    const std::string name = "'" + problem.getElement(verification.element).name + "'";
    switch (verification.condition) {
        case Condition::ReversedTangent:
            return "the path turns back at " + name;
        case Condition::NegativeLength:
            return "the arc on " + name + " has negative length";
        case Condition::PullsOutward:
            return "the arc on " + name + " would lift inside";
        case Condition::ConjugatePoint:
            return "the arc on " + name + " goes beyond its conjugate point";
        case Condition::Penetration:
            return "a straight segment passes below the surface of " + name;
        case Condition::OutsideDomain:
            return "the arc on " + name + " leaves the domain of its surface";
        case Condition::Unstable:
            return "the path can be shortened sideways at " + name;
        case Condition::None:
            break;
    }
    return "a local minimum";
}

namespace {

std::string quoteName(const PathProblem& problem, int element) {
    return "'" + problem.getElement(element).name + "'";
}

/** The fixed point that is inside an obstacle, by name. */
std::string describeEndInside(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    Vec3 N_S;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint() || !pose.hasElement(e) || !path.contacts[e].isSwitchedOff) continue;
        const Surface& surface = *problem.getElement(e).surface;
        int before = e, after = e;
        while (!problem.getElement(before).isPoint() || !pose.hasElement(before)) --before;
        while (!problem.getElement(after).isPoint() || !pose.hasElement(after)) ++after;
        const bool isBefore = surface.calcHeight(pose.X_GE[e].shiftBack(pose.X_GE[before].p), N_S) < 0;
        return "the point " + quoteName(problem, isBefore ? before : after) + " is inside " + quoteName(problem, e) +
               ", which is switched off";
    }
    return "a point is inside an obstacle";
}

/** The obstacle at an end of whose arc the surface hardly curves away from the path, or -1: there the string lifts,
and a single contact does not follow it. */
int findVanishingPressure(const PathProblem& problem, const PathSolution& path) {
    constexpr double kVanishing = 0.05;  // of 1/size
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const ObstacleContact& contact = path.contacts[e];
        if (problem.getElement(e).isPoint() || !contact.isTouched) continue;
        const double kappaN = std::max(contact.geodesic.P.kappaN, contact.geodesic.Q.kappaN);
        if (kappaN * problem.getElement(e).surface->getSize() > -kVanishing) return e;
    }
    return -1;
}

std::string describe(const StringFault& fault, const PathProblem& problem) {
    if (fault.kind == StringFault::Kind::Groove)
        return "the string lies in the groove between " + quoteName(problem, fault.element) + " and " +
               quoteName(problem, fault.other) + ", where no smooth path is";
    return "the string touches " + quoteName(problem, fault.element) + " in two places";
}

}  // namespace

std::string explainStatus(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    if (path.status == PathStatus::EndInside) return describeEndInside(problem, pose, path);
    if (path.status == PathStatus::Solved) return "a local minimum";
    std::string text;
    if (path.status == PathStatus::NotConverged) {
        std::ostringstream error;
        error << "the path error stays at " << path.pathError;
        text = error.str();
    } else {
        const PathVerification verification = verifyPath(problem, pose, path);
        std::ostringstream place;
        place << " at (" << verification.place_G.x() << ", " << verification.place_G.y() << ", "
              << verification.place_G.z() << ")";
        text = describe(verification, problem) + place.str();
    }
    const int vanishing = findVanishingPressure(problem, path);
    if (path.fault.kind != StringFault::Kind::None)
        text += ": " + describe(path.fault, problem);
    else if (path.status == PathStatus::NotConverged && vanishing >= 0)
        text += ": the pressure vanishes at an end of the arc on " + quoteName(problem, vanishing);
    return text;
}

void findSegmentClearance(const Surface& surface, const Pose& X_GS, const Vec3& A_G, const Vec3& B_G,
                          LineClearance& clearance) {
    const Vec3 A_S = X_GS.shiftBack(A_G), B_S = X_GS.shiftBack(B_G);
    const double length = (B_S - A_S).norm();
    const Vec3 e_S = length > 0 ? Vec3((B_S - A_S) / length) : Vec3(Vec3::UnitX());
    LineClearance kept = clearance;
    kept.found = false;
    kept.C = clearance.keptC, kept.N = clearance.keptN;
    if (kept.N.allFinite() && kept.C.p.allFinite()) surface.findLineClearance(A_S, e_S, kept);
    if (!kept.found) findFreshClearance(surface, A_S, e_S, length, kept);
    // Eqn. 6.3 puts D on the infinite line: past an end, the height of that end is what counts.
    if (!kept.found)
        takeHeight(surface, A_S, e_S, surface.findLowestPoint(A_S, e_S, length), kept);
    else if (!(kept.lineCoordinate >= 0 && kept.lineCoordinate <= length))
        takeHeight(surface, A_S, e_S, kept.lineCoordinate < 0 ? 0 : length, kept);
    const bool isClear = kept.distance > 0 || !kept.keptN.allFinite();
    if (isClear) kept.keptC = kept.C, kept.keptN = kept.N;
    clearance = kept;
}

void takeNearerClearance(const Surface& surface, const Pose& X_GS, const Vec3& A_G, const Vec3& B_G,
                         LineClearance& clearance) {
    if (!(clearance.distance > 0) || surface.isConvex()) return;
    const Vec3 A_S = X_GS.shiftBack(A_G), B_S = X_GS.shiftBack(B_G);
    const double length = (B_S - A_S).norm();
    if (!(length > 0)) return;
    const Vec3 e_S = (B_S - A_S) / length;
    // A few heights along the segment tell whether there is one.
    constexpr int kSamples = 16;
    bool isNearer = false;
    Vec3 N;
    for (int i = 0; i <= kSamples && !isNearer; ++i)
        isNearer = surface.calcHeight(A_S + (length * i / kSamples) * e_S, N) < (1 - 1e-9) * clearance.distance;
    if (!isNearer) return;
    LineClearance nearer = clearance;
    nearer.found = false;
    findFreshClearance(surface, A_S, e_S, length, nearer);
    const bool isOnSegment = nearer.lineCoordinate >= 0 && nearer.lineCoordinate <= length;
    if (!nearer.found || !isOnSegment || !(nearer.distance < clearance.distance)) return;
    if (nearer.distance > 0) nearer.keptC = nearer.C, nearer.keptN = nearer.N;
    clearance = nearer;
}

}  // namespace tautline
