// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_explanation.h"

#include <algorithm>
#include <sstream>

#include "surfaces/arc_walker.h"
#include "tautline/paths/tolerances.h"

namespace tautline {

using Condition = PathVerification::Condition;

namespace {

std::string quoteName(const PathProblem& problem, int element) {
    return "'" + problem.getElement(element).name + "'";
}

}  // namespace

std::string describe(const PathVerification& verification, const PathProblem& problem) {
    if (verification.element < 0)
        return verification.isMinimum() ? "a local minimum" : "the path error does not vanish";
    const std::string name = quoteName(problem, verification.element);
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
        case Condition::NotStationary:
            return "the path error does not vanish";
        case Condition::None:
            break;
    }
    return "a local minimum";
}

namespace {

/** The fixed point that is inside an obstacle, by name. */
std::string describeEndInside(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint() || !pose.hasElement(e) || !path.contacts[e].isSwitchedOff) continue;
        const Surface& surface = *problem.getElement(e).surface;
        int before = e, after = e;
        while (!problem.getElement(before).isPoint() || !pose.hasElement(before)) --before;
        while (!problem.getElement(after).isPoint() || !pose.hasElement(after)) ++after;
        const auto calcHeight = [&](int point) {
            return surface.calcHeight(pose.X_GE[e].shiftBack(pose.X_GE[point].p));
        };
        const bool isBefore = calcHeight(before) <= calcHeight(after);
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
        if (problem.getElement(e).isPoint()) continue;
        for (int i = 0; i < contact.getNumArcs(); ++i) {
            const ShotGeodesic& arc = contact.getArc(i).geodesic;
            if (std::max(arc.P.kappaN, arc.Q.kappaN) * problem.getElement(e).surface->getSize() > -kVanishing) return e;
        }
    }
    return -1;
}

/** The obstacle whose arc begins or ends outside its surface's domain, or -1. */
int findOutsideDomain(const PathProblem& problem, const PathSolution& path) {
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const ObstacleContact& contact = path.contacts[e];
        if (problem.getElement(e).isPoint()) continue;
        const Surface& surface = *problem.getElement(e).surface;
        for (int i = 0; i < contact.getNumArcs(); ++i) {
            const ContactArc& arc = contact.getArc(i);
            if (!surface.isInDomain(arc.start.point) || !surface.isInDomain(arc.geodesic.endPoint)) return e;
        }
    }
    return -1;
}

/** The segment that is so short that the rounding of its ends turns it by as much as the path error, or null. */
const StraightSegment* findRoundedSegment(const PathSolution& path) {
    constexpr double kRounding = 1e-15;  // of coordinates that have gone through two poses
    for (const StraightSegment& line : path.segments)
        if (line.length * path.pathError <= kRounding * (line.A.norm() + line.B.norm())) return &line;
    return nullptr;
}

/** Whether a segment that passes below a sheet, at this place, comes out beside it: from there the string slides off.
Past an edge the height jumps, by far more than the way there. */
bool passesEdge(const Surface& surface, const Pose& X_GS, const StraightSegment& line, const Vector3& place_G) {
    constexpr int kSamples = 200;  // from the place to an end
    constexpr double kJump = 3;    // in steps
    const auto comesOutBeside = [&](const Vector3& end_G) {
        const Vector3 step = (end_G - place_G) / kSamples;
        double last = 0;
        for (int i = 0; i <= kSamples; ++i) {
            const Vector3 p_S = X_GS.shiftBack(place_G + i * step);
            const double height = surface.calcHeight(p_S);
            if (height > 0)
                return height - last > kJump * step.norm() || !surface.isInDomain(surface.findSurfacePoint(p_S));
            last = height;
        }
        return false;
    };
    return comesOutBeside(line.A) || comesOutBeside(line.B);
}

/** Two obstacles of which the arc on one passes below the surface of the other: they overlap where the path passes. */
StringFault findOverlap(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    constexpr int kSamples = 9;  // of an arc
    std::vector<Vector3> arc_S, one_S;
    const auto sampleArcs = [&](int e) {
        arc_S.clear();
        for (int i = 0; i < path.contacts[e].getNumArcs(); ++i) {
            sampleGeodesic(*problem.getElement(e).surface, path.contacts[e].getArc(i).start, kAlongArc, kSamples,
                           one_S);
            arc_S.insert(arc_S.end(), one_S.begin(), one_S.end());
        }
    };
    const auto isBelow = [&](int e, int other) {
        const Surface& surface = *problem.getElement(other).surface;
        return std::any_of(arc_S.begin(), arc_S.end(), [&](const Vector3& p_S) {
            const Vector3 p_G = pose.X_GE[e] * p_S;
            return surface.calcHeight(pose.X_GE[other].shiftBack(p_G)) < kOverlap * surface.getSize();
        });
    };
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint() || !path.contacts[e].isTouched) continue;
        sampleArcs(e);
        for (int other = 0; other < problem.getNumElements(); ++other)
            if (other != e && !problem.getElement(other).isPoint() && path.contacts[other].isTouched &&
                isBelow(e, other))
                return {StringFault::Kind::Groove, e, other};
    }
    return {};
}

std::string describe(const StringFault& fault, const PathProblem& problem) {
    if (fault.kind == StringFault::Kind::Groove)
        return "the string lies in the groove between " + quoteName(problem, fault.element) + " and " +
               quoteName(problem, fault.other) + ", where no smooth path is";
    if (fault.kind == StringFault::Kind::Sliding && fault.element < 0)
        return "the string still slides, far from where it would come to rest";
    if (fault.kind == StringFault::Kind::Sliding)
        return "the string still slides over " + quoteName(problem, fault.element) + ", next to a neutral course";
    return "the string would meet " + quoteName(problem, fault.other) + " before " + quoteName(problem, fault.element) +
           ", against the order of the path";
}

/** Why the string that was laid anew came to no better path, ": " before it; empty if that is not known. */
std::string describeCause(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    StringFault fault = path.fault;
    const bool isVague = fault.kind == StringFault::Kind::Sliding && fault.element < 0;
    if (fault.kind == StringFault::Kind::None || isVague) {
        const StringFault overlap = findOverlap(problem, pose, path);
        if (overlap.kind != StringFault::Kind::None) fault = overlap;
    }
    if (fault.kind != StringFault::Kind::None) return ": " + describe(fault, problem);
    if (path.status != PathStatus::NotConverged) return "";
    const int outside = findOutsideDomain(problem, path);
    if (outside >= 0) return ": the arc on " + quoteName(problem, outside) + " leaves the domain of its surface";
    const int vanishing = findVanishingPressure(problem, path);
    if (vanishing < 0) return "";
    return ": the pressure vanishes at an end of the arc on " + quoteName(problem, vanishing);
}

std::string explainNotConverged(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    if (!pose.isFinite()) return "a pose is not finite";
    if (!problem.hasUsableSizes()) return "the square of an obstacle's size is 0 or infinite in double precision";
    std::ostringstream text;
    text << "the path error stays at " << path.pathError;
    if (const StraightSegment* line = findRoundedSegment(path))
        text << ": a segment of " << line->length << " m is too short for the rounding of its ends";
    else
        text << describeCause(problem, pose, path);
    return text.str();
}

std::string describe(const RouteDeviation& deviation, const PathProblem& problem) {
    const std::string name = quoteName(problem, deviation.element);
    switch (deviation.kind) {
        case RouteDeviation::Kind::Side:
            return "not on the side of " + name + " that is asked for";
        case RouteDeviation::Kind::Near:
            return "not on the side of " + name + " where the point of its hint is";
        case RouteDeviation::Kind::Winding:
            return "not with the turns about " + name + " that are asked for";
        case RouteDeviation::Kind::Threading:
            return "not through the hole of " + name + " as is asked for";
        case RouteDeviation::Kind::Continued:
            return "continued round " + name + " as a search from this pose alone would not begin";
        case RouteDeviation::Kind::None:
            break;
    }
    return "as is asked for";
}

/** Empty if it goes through all holes as it did. */
std::string explainLeftHole(const PathProblem& problem, const PathSolution& path) {
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (path.contacts[e].hasLeftHole) return "the path has left the hole of " + quoteName(problem, e);
    return "";
}

std::string explainSolved(const PathProblem& problem, const PathSolution& path) {
    const std::string minimum = "a local minimum";
    if (path.deviation.kind == RouteDeviation::Kind::None) return minimum;
    return minimum + ", but " + describe(path.deviation, problem);
}

/** Of a path whose error vanishes: the condition that does not hold. */
std::string explainNotMinimum(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                              double shortestArc) {
    if (const std::string left = explainLeftHole(problem, path); !left.empty()) return left;
    const PathVerification verification = verifyPath(problem, pose, path, shortestArc);
    if (verification.isMinimum()) return describe(verification, problem);
    const Vector3& place = verification.place_G;
    std::ostringstream text;
    text << describe(verification, problem) << " at (" << place.x() << ", " << place.y() << ", " << place.z() << ")";
    const bool isSunk = verification.condition == Condition::Penetration && verification.segment >= 0;
    if (isSunk && passesEdge(*problem.getElement(verification.element).surface, pose.X_GE[verification.element],
                             path.segments[verification.segment], place))
        text << " and leaves the domain of the surface beside it";
    else
        text << describeCause(problem, pose, path);
    return text.str();
}

}  // namespace

std::string explainStatus(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                          double shortestArc) {
    switch (path.status) {
        case PathStatus::Solved:
            return explainSolved(problem, path);
        case PathStatus::EndInside:
            return describeEndInside(problem, pose, path);
        case PathStatus::NotConverged:
            return explainNotConverged(problem, pose, path);
        case PathStatus::NotMinimum:
        case PathStatus::LeftDomain:
            break;
    }
    return explainNotMinimum(problem, pose, path, shortestArc);
}

}  // namespace tautline
