#include "tautline/paths/single_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tautline/geodesics/geodesic_events.h"

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
        if (here < before && here <= after && here < lowest + spacing) {
            double a = (i - 1) * spacing, b = (i + 1) * spacing;
            for (int k = 0; k < kRefinements; ++k) {
                const double left = a + (b - a) / 3, right = b - (b - a) / 3;
                const bool isLeftLower = height(left) < height(right);
                (isLeftLower ? b : a) = isLeftLower ? right : left;
            }
            lowest = std::min(lowest, height(0.5 * (a + b)));
        }
        before = here, here = after;
    }
    return lowest / size;
}

}  // namespace

double calcSingleContactWitness(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                                int element) {
    constexpr double kTiny = std::numeric_limits<double>::min();  // as calcContactWitness()
    const Surface& surface = *problem.getElement(element).surface;
    const ObstacleContact& contact = path.contacts[element];
    if (!contact.isTouched || surface.isConvex()) return 1;
    double witness = -calcLargestNormalCurvature(surface, contact.start, contact.geodesic) * surface.getSize();
    for (const StraightSegment& line : path.segments)
        if (line.fromElement == element || line.toElement == element)
            witness = std::min(witness, calcReturnHeight(surface, pose.X_GE[element], line));
    if (!std::isfinite(witness)) return 1;
    return witness == 0 ? kTiny : witness;
}

}  // namespace tautline
