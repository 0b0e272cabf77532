// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_stability.h"

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

constexpr double kNeutral = 1e-9;  ///< relative second variation below which a path is neither stable nor unstable

double calcRelative(double a, double b) {
    return (a + b) / (std::abs(a) + std::abs(b));
}

}  // namespace

/** Second variation of the length over sideways displacements b of the contact points along their binormals:

    sum over lines of (b_Q^2 + b_P^2 - 2 b_Q b_P B_Q.B_P)/l  +  sum over arcs of the index form of the Jacobi fields,

a symmetric tridiagonal form in (b_P, b_Q) of all contacts in order, positive definite at a strict minimum. Its
pivots, in terms of the displacement y and slope y' of the sideways field that stays taut from the fixed point
behind: on an arc y_Q = a y_P + r y_P', y_Q' = a' y_P + r' y_P'; on a line slopes sigma = y'/y obey
sigma_P = 1/l - (B_Q.B_P/l)^2/(sigma_Q + 1/l). After the first pivot that is not positive the others mean nothing. */
PathStability calcPathStability(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    PathStability stability;
    double sigmaQ = 0;  // slope at the end of the last arc
    Vec3 BQ = Vec3::Zero();
    for (std::size_t j = 0; j + 1 < path.segments.size(); ++j) {
        const StraightSegment &in = path.segments[j], &out = path.segments[j + 1];
        const int e = in.toElement;
        if (problem.getElement(e).isPoint()) continue;
        const Geodesic& arc = path.contacts[e].geodesic;
        const Pose& X_GS = pose.X_GE[e];
        // From a fixed point y : y' = l : 1; from an arc, the pivot.
        double y = in.length, slope = 1;
        if (!problem.getElement(in.fromElement).isPoint()) {
            const double twist = BQ.dot(X_GS.rotate(arc.P.B));
            y = 1, slope = 1 / in.length - twist * twist / (in.length * in.length * (sigmaQ + 1 / in.length));
        }
        const double yQ = arc.a * y + arc.r * slope, slopeQ = arc.aDot * y + arc.rDot * slope;
        // A path over a sphere between opposite points can turn freely: neutral, and a minimum like its neighbours.
        const bool isLast = problem.getElement(out.toElement).isPoint();
        const double atArc = calcRelative(arc.a * y, arc.r * slope);
        const double atLine = calcRelative(slopeQ * out.length, yQ) + (isLast ? kNeutral : 0);
        const bool isBeyondConjugatePoint = arc.hasConjugatePoint && path.contacts[e].start.length > 0;
        const double margin = isBeyondConjugatePoint ? -1 : atArc > 0 ? std::min(atArc, atLine) : atArc;
        if (!(margin >= stability.margin) || stability.element < 0) stability = {margin, e};
        if (!stability.isStable()) return stability;
        sigmaQ = slopeQ / yQ;
        BQ = X_GS.rotate(arc.Q.B);
    }
    return stability;
}

}  // namespace tautline
