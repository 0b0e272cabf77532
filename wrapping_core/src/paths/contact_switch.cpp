// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/contact_switch.h"

#include <algorithm>
#include <cmath>

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
void touchAtClearance(const Surface& surface, const Vec3& A_S, const Vec3& B_S, ObstacleContact& contact) {
    const LineClearance& clearance = contact.clearance;
    const DarbouxFrame frame = surface.calcFrame(clearance.C, B_S - A_S);
    const double radius = 1 / std::max(std::abs(frame.kappaN), 1e-3 * clearance.scale);
    const double most = std::min(radius, kMostHalf * surface.getSize());
    const auto calcHalf = [&](const Vec3& end_S, double sign) {
        const Vec3 from = end_S - clearance.C.p;
        const double angle = calcTangentAngle(radius, sign * frame.t.dot(from), frame.N.dot(from), -clearance.distance);
        return std::clamp(radius * angle, 0.0, most);
    };
    const double before = calcHalf(A_S, -1), after = calcHalf(B_S, 1);
    contact.isTouched = true;
    contact.start.point = surface.calcDisplacedPoint(clearance.C, -before * frame.t);
    contact.start.tangent = surface.calcFrame(contact.start.point, frame.t).t;
    contact.start.length = before + after;
}

}  // namespace

void switchContact(const PathProblem& problem, const PathPose& pose, int element, PathSolution& path) {
    ObstacleContact& contact = path.contacts[element];
    if (contact.isTouched) return liftContact(contact);
    const StraightSegment& line = path.segments[contact.segment];
    const Pose& X_GS = pose.X_GE[element];
    touchAtClearance(*problem.getElement(element).surface, X_GS.shiftBack(line.A), X_GS.shiftBack(line.B), contact);
}

void liftContact(ObstacleContact& contact) {
    contact.isTouched = false;
    contact.clearance = LineClearance();
    contact.clearance.keptC = contact.start.point;
    contact.clearance.keptN = contact.geodesic.P.N;
}

bool hasSwallowedEnd(const PathSolution& path) {
    return std::any_of(path.contacts.begin(), path.contacts.end(),
                       [](const ObstacleContact& contact) { return contact.isTouched && contact.isSwitchedOff; });
}

bool haveSameContacts(const PathSolution& a, const PathSolution& b) {
    if (a.contacts.size() != b.contacts.size()) return false;
    for (std::size_t e = 0; e < a.contacts.size(); ++e)
        if (a.contacts[e].isTouched != b.contacts[e].isTouched) return false;
    return true;
}

}  // namespace tautline
