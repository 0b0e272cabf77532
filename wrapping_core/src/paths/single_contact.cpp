#include "tautline/paths/single_contact.h"

#include <algorithm>

#include "surfaces/refine_lowest.h"
#include "tautline/geodesics/geodesic_events.h"
#include "tautline/paths/contact_switch.h"

namespace tautline {
namespace {

/** Height in sizes at which a segment comes near the surface again after it has left it: the lowest of the local
minima between its ends, 1 if there is none. Towards its tangent end the height falls to 0, which is no minimum. */
double calcReturnHeight(const Surface& surface, const Pose& X_GS, const StraightSegment& line) {
    constexpr int kLeastSamples = 16, kMostSamples = 200, kRefinements = 40;
    const double size = surface.getSize();
    const Vec3 A_S = X_GS.shiftBack(line.A), e_S = X_GS.R.transpose() * line.e;
    Vec3 N;
    const auto height = [&](double s) { return surface.calcHeight(A_S + s * e_S, N); };
    const int count = std::clamp(static_cast<int>(4 * line.length / size), kLeastSamples, kMostSamples);
    const double spacing = line.length / count;
    double lowest = size, before = height(0), here = height(spacing);
    for (int i = 1; i < count; ++i) {
        const double after = height((i + 1) * spacing);
        if (here < before && here <= after && here < lowest + spacing)
            lowest = std::min(lowest, height(refineLowest(height, (i - 1) * spacing, (i + 1) * spacing, kRefinements)));
        before = here, here = after;
    }
    return lowest / size;
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
