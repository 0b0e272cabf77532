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
    const Vector3 A_S = X_GS.shiftBack(line.A), e_S = X_GS.rotateBack(line.e);
    const auto place = findClosestApproach(surface, A_S, e_S, line.length, size);
    return place ? place->height / size : 1;
}

/** The least of -kappaN along an arc, above what counts as pressure all along (kVerificationRounding). Where it is
least at the end of a bridge, the width of that tells more: to rounding of the path error the end lies on either side of
where the pressure vanishes. */
double calcPressure(const Surface& surface, const ObstacleContact& contact, int i) {
    const ContactArc& arc = contact.getArc(i);
    const double largest = calcLargestNormalCurvature(surface, arc.start, arc.geodesic);
    const bool isAfterBridge = i > 0, isBeforeBridge = i + 1 < contact.getNumArcs();
    if ((isAfterBridge && largest <= arc.geodesic.P.kappaN) || (isBeforeBridge && largest <= arc.geodesic.Q.kappaN))
        return kInfinity;
    return 2 * kVerificationRounding / surface.getSize() - largest;
}

}  // namespace

SurfaceReturn findSurfaceReturn(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                                int element) {
    SurfaceReturn lowest;
    const Surface& surface = *problem.getElement(element).surface;
    if (surface.isConvex()) return lowest;
    for (std::size_t j = 0; j < path.segments.size(); ++j) {
        const StraightSegment& line = path.segments[j];
        if (line.fromElement != element && line.toElement != element) continue;
        const double height = calcReturnHeight(surface, pose.X_GE[element], line);
        if (height < lowest.height) lowest = {static_cast<int>(j), height};
    }
    return lowest;
}

double calcContactWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path, int element) {
    const ObstacleContact& contact = path.contacts[element];
    // An end inside leaves no path over the obstacle: it must be off, and then nothing is watched.
    if (contact.isSwitchedOff) return contact.isTouched ? -1 : 1;
    // A string that has left a ring has gone through it since the path that this one was continued from.
    if (contact.hasLeftHole) return -1;
    if (!contact.isTouched)
        return makeWitness(contact.clearance.distance * contact.clearance.scale - kContactTolerance);
    const double shortest = contact.getArc(findShortestArc(contact)).start.length;
    const double height = findSurfaceReturn(problem, pose, path, element).height;
    return makeWitness(std::min(shortest / problem.getElement(element).surface->getSize(), height));
}

double calcSplitWitness(const PathProblem& problem, const PathSolution& start, const PathSolution& path, int element) {
    const Surface& surface = *problem.getElement(element).surface;
    const ObstacleContact& contact = path.contacts[element];
    if (!contact.isTouched || surface.isConvex()) return 1;
    double pressure = 1, width = 1;
    for (int i = 0; i < contact.getNumArcs(); ++i)
        pressure = std::min(pressure, calcPressure(surface, contact, i) * surface.getSize());
    for (const StraightSegment& line : path.segments)
        if (line.fromElement == element && line.toElement == element)
            width = std::min(width, line.length / surface.getSize());
    const int before = start.isEmpty() ? 0 : start.contacts[element].getNumArcs(), now = contact.getNumArcs();
    if (before == 0 || now == before) return makeWitness(std::min(pressure, width * width));
    return makeWitness(-std::abs(now > before ? width * width : pressure));
}

}  // namespace tautline
