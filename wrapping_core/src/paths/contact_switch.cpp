// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/contact_switch.h"

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

constexpr double kMostHalf = 2;  ///< half of a new arc where the surface hardly curves, in sizes

}  // namespace

void switchContact(const PathProblem& problem, const PathPose& pose, int element, PathSolution& path) {
    ObstacleContact& contact = path.contacts[element];
    if (contact.isTouched) return liftContact(contact);
    const Vec3 e_S = pose.X_GE[element].R.transpose() * path.segments[contact.segment].e;
    touchAtClearance(*problem.getElement(element).surface, e_S, contact);
}

void touchAtClearance(const Surface& surface, const Vec3& e_S, ObstacleContact& contact) {
    const LineClearance& clearance = contact.clearance;
    const DarbouxFrame frame = surface.calcFrame(clearance.C, e_S);
    // The chord that the line cuts from the osculating circle stands for the arc.
    const double curvature = std::max(std::abs(frame.kappaN), 1e-3 * clearance.scale);
    const double half = std::min(
        {std::sqrt(2 * std::max(0.0, -clearance.distance) / curvature), 1 / curvature, kMostHalf * surface.getSize()});
    contact.isTouched = true;
    contact.start.point = surface.calcDisplacedPoint(clearance.C, -half * frame.t);
    contact.start.tangent = surface.calcFrame(contact.start.point, frame.t).t;
    contact.start.length = 2 * half;
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
