// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/single_contact.h"

#include <algorithm>

#include "surfaces/closest_approach.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/surfaces/geodesic_events.h"

namespace tautline {
namespace {

/** Height in sizes at which a segment comes near the surface again after it has left it: the lowest of the local
minima between its ends, 1 if there is none. Towards its tangent end the height falls to 0, which is no minimum. */
double calcReturnHeight(const Surface& surface, const Pose& X_GS, const StraightSegment& line) {
    const double size = surface.getSize();
    const Vec3 A_S = X_GS.shiftBack(line.A), e_S = X_GS.rotateBack(line.e);
    const auto place = findClosestApproach(surface, A_S, e_S, line.length, size);
    return place ? place->height / size : 1;
}

}  // namespace

double calcSingleContactWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                                int element) {
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
