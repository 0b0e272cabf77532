// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/contact_switch.h"

#include <algorithm>

#include "paths/contacts/arc_changes.h"
#include "paths/contacts/touching_arcs.h"
#include "tautline/paths/contact_witness.h"

namespace tautline {
namespace {

/** Of a touched obstacle: makes an arc more or one less, whichever is more due. */
void switchArc(const PosedProblem& scene, int element, PathSolution& path) {
    ObstacleContact& contact = path.contacts[element];
    if (contact.isSwitchedOff || contact.hasLeftHole) return liftContact(contact);
    const int shortest = findShortestArc(contact);
    const double length = contact.getArc(shortest).start.length / scene.getSurface(element).getSize();
    const SurfaceReturn lowest = findSurfaceReturn(scene.problem, scene.pose, path, element);
    if (lowest.height < length)
        touchAgain(scene, element, lowest.segment, path);
    else
        liftArc(shortest, contact);
}

}  // namespace

int findShortestArc(const ObstacleContact& contact) {
    int shortest = 0;
    for (int i = 1; i < contact.getNumArcs(); ++i)
        if (contact.getArc(i).start.length < contact.getArc(shortest).start.length) shortest = i;
    return shortest;
}

void switchContact(const PathProblem& problem, const PathPose& pose, int element, PathSolution& path) {
    ObstacleContact& contact = path.contacts[element];
    if (contact.isTouched) return switchArc({problem, pose}, element, path);
    const StraightSegment& line = path.segments[contact.segment];
    const Pose& X_GS = pose.X_GE[element];
    std::vector<GeodesicStart> further;
    contact.start = calcTouchingArcs(*problem.getElement(element).surface, X_GS.shiftBack(line.A),
                                     X_GS.shiftBack(line.B), contact.clearance, further);
    contact.isTouched = true;
    contact.furtherArcs.clear();
    for (const GeodesicStart& start : further) contact.furtherArcs.emplace_back().start = start;
}

void liftContact(ObstacleContact& contact) {
    contact.isTouched = false;
    contact.furtherArcs.clear();
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
        if (a.contacts[e].getNumArcs() != b.contacts[e].getNumArcs()) return false;
    return true;
}

}  // namespace tautline
