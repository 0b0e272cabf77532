// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/contact_witness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surfaces/closest_approach.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/tolerances.h"
#include "tautline/surfaces/geodesic_events.h"

namespace tautline {
namespace {

double makeWitness(double value) {
    constexpr double kTiny = std::numeric_limits<double>::min();
    if (!std::isfinite(value)) return 1;
    return value == 0 ? kTiny : value;
}

/** Height in sizes at which a segment comes near the surface again after it has left it: the lowest of the local
minima between its ends, 1 if there is none. Towards its tangent end the height falls to 0, which is not a minimum. */
double calcReturnHeight(const Surface& surface, const Pose& X_GS, const StraightSegment& line) {
    const double size = surface.getSize();
    const Vec3 A_S = X_GS.shiftBack(line.A), e_S = X_GS.rotateBack(line.e);
    const auto place = findClosestApproach(surface, A_S, e_S, line.length, size);
    return place ? place->height / size : 1;
}

}  // namespace

double calcContactWitness(const PathProblem& problem, const PathSolution& path, int element) {
    const ObstacleContact& contact = path.contacts[element];
    // An end inside leaves no path over the obstacle: it must be off, and then nothing is watched.
    if (contact.isSwitchedOff) return contact.isTouched ? -1 : 1;
    // A string that has left a ring has gone through it since the path that this one was continued from.
    if (contact.hasLeftHole) return -1;
    if (contact.isTouched) return makeWitness(contact.start.length / problem.getElement(element).surface->getSize());
    return makeWitness(contact.clearance.distance * contact.clearance.scale - kContactTolerance);
}

double calcSplitWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path, int element) {
    const Surface& surface = *problem.getElement(element).surface;
    const ObstacleContact& contact = path.contacts[element];
    if (!contact.isTouched || surface.isConvex()) return 1;
    double witness = -calcLargestNormalCurvature(surface, contact.start, contact.geodesic) * surface.getSize();
    for (const StraightSegment& line : path.segments)
        if (line.fromElement == element || line.toElement == element)
            witness = std::min(witness, calcReturnHeight(surface, pose.X_GE[element], line));
    return makeWitness(witness);
}

}  // namespace tautline
