// SPDX-License-Identifier: Apache-2.0
#include "paths/equations/second_variation.h"

#include <algorithm>
#include <cmath>

#include "paths/equations/geodesic_variations.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

double calcRelative(double a, double b) {
    return (a + b) / (std::abs(a) + std::abs(b));
}

/** The taut sideways field at one contact: y at P and Q. */
struct FieldAtContact {
    double yP = 0, yQ = 0;
    double toPrevious = 0;  ///< displacement of the previous contact's Q over that of this P; 0 behind a fixed point
};

/** Elimination from contact to contact. */
class PivotRecursion {
public:
    /** Enters the arc to which the segment `in` leads. */
    void enterArc(const PosedProblem& scene, const PathSolution& path, const StraightSegment& in) {
        const int e = in.toElement;
        const ShotGeodesic& arc = path.getArcAfter(in).geodesic;
        // From a fixed point y : y' = l : 1; from an arc, the pivot.
        y = in.length;
        double slope = 1;
        toPrevious = 0;
        if (!scene.isPoint(in.fromElement)) {
            const double twist = BQ.dot(scene.getPose(e).rotate(arc.P.B)), pivot = sigmaQ + 1 / in.length;
            y = 1;
            slope = 1 / in.length - twist * twist / (in.length * in.length * pivot);
            toPrevious = twist / (in.length * pivot);
        }
        atArc = calcRelative(arc.a * y, arc.r * slope);
        yQ = arc.a * y + arc.r * slope;
        slopeQ = arc.aDot * y + arc.rDot * slope;
    }
    void leaveArc(const Vector3& binormal_G) {
        sigmaQ = slopeQ / yQ;
        BQ = binormal_G;
    }

    double y = 0, yQ = 0, slopeQ = 0;
    double atArc = 1;       ///< pivot at P, relative to its terms
    double toPrevious = 0;  ///< displacement of the previous Q over that of this P

private:
    double sigmaQ = 0;  ///< slope at the end of the last arc
    Vector3 BQ = Vector3::Zero();
};

/** The field that stays taut behind the failing contact, taken back to the fixed point where it began, and no farther
on: it has the sign of the pivot. @param failsAtArc   at P already, so that Q stays where it is */
void traceBack(const PathSolution& path, const std::vector<FieldAtContact>& fields, std::size_t segment,
               bool failsAtArc, SidewaysField& direction) {
    direction.assign(path.segments.size(), Vector2::Zero());
    double bQ = failsAtArc ? 0 : 1, bP = failsAtArc ? 1 : fields[segment].yP / fields[segment].yQ;
    for (std::size_t j = segment;; --j) {
        direction[j] = Vector2(bP, bQ);
        if (j == 0 || !(std::abs(fields[j].toPrevious) > 0)) break;
        bQ = fields[j].toPrevious * bP;
        bP = bQ * fields[j - 1].yP / fields[j - 1].yQ;
    }
    double largest = 0;
    for (const Vector2& b : direction) largest = std::max(largest, b.cwiseAbs().maxCoeff());
    for (Vector2& b : direction) b /= largest;
}

}  // namespace

/** Second variation of the length over sideways displacements b of the contact points along their binormals:

    sum over lines of (b_Q^2 + b_P^2 - 2 b_Q b_P B_Q.B_P)/l  +  sum over arcs of the index form of the Jacobi fields,

a symmetric tridiagonal form in (b_P, b_Q) of all contacts in order, positive definite at a strict minimum. Its
pivots, in terms of the displacement y and slope y' of the sideways field that stays taut from the fixed point
behind: on an arc y_Q = a y_P + r y_P', y_Q' = a' y_P + r' y_P'; on a line slopes sigma = y'/y obey
sigma_P = 1/l - (B_Q.B_P/l)^2/(sigma_Q + 1/l). After the first pivot that is not positive the others mean nothing. */
PathStability calcSecondVariation(const PosedProblem& scene, const PathSolution& path, SidewaysField* direction) {
    PathStability stability;
    PivotRecursion pivots;
    std::vector<FieldAtContact> fields;
    if (direction) fields.resize(path.segments.size());
    for (std::size_t j = 0; j + 1 < path.segments.size(); ++j) {
        const StraightSegment &in = path.segments[j], &out = path.segments[j + 1];
        const int e = in.toElement;
        if (scene.isPoint(e)) continue;
        const ContactArc& contact = path.getArcAfter(in);
        const ShotGeodesic& arc = contact.geodesic;
        pivots.enterArc(scene, path, in);
        if (direction) fields[j] = {pivots.y, pivots.yQ, pivots.toPrevious};
        // A path over a sphere between opposite points can turn freely: neutral, and a minimum like its neighbours.
        const double neutral = scene.isPoint(out.toElement) ? kNeutralVariation : 0;
        const double atLine = calcRelative(pivots.slopeQ * out.length, pivots.yQ) + neutral;
        const bool isBeyondConjugatePoint = arc.hasConjugatePoint && contact.start.length > 0;
        const double margin = isBeyondConjugatePoint ? -1
                              : pivots.atArc > 0     ? std::min(pivots.atArc, atLine)
                                                     : pivots.atArc;
        if (!(margin >= stability.margin) || stability.element < 0) stability = {margin, e};
        if (!stability.isStable()) {
            if (direction) traceBack(path, fields, j, !(pivots.atArc > 0), *direction);
            return stability;
        }
        pivots.leaveArc(scene.getPose(e).rotate(arc.Q.B));
    }
    return stability;
}

PathStability calcPathStability(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    return calcSecondVariation({problem, pose}, path);
}

bool moveAlongNegativeCurvature(const PosedProblem& scene, double amount, PathSolution& path) {
    constexpr double kMaxTurn = 0.6;  // of a start [rad], as in a step of Newton's method
    SidewaysField direction;
    const PathStability stability = calcSecondVariation(scene, path, &direction);
    if (stability.isStable()) return false;
    for (std::size_t j = 0; j < direction.size(); ++j) {
        if (direction[j].isZero()) continue;
        const StraightSegment& in = path.segments[j];
        ContactArc& contact = path.contacts[in.toElement].updArc(in.toArc);
        const Surface& surface = scene.getSurface(in.toElement);
        const ShotGeodesic& arc = contact.geodesic;
        const Vector2 b = amount * surface.getSize() * direction[j];
        const double turn = (b[1] - arc.a * b[0]) / arc.r;
        const double theta = std::isfinite(turn) ? std::clamp(turn, -kMaxTurn, kMaxTurn) : 0;
        contact.start = calcCorrectedStart(surface, contact.start, arc.P, Vector4(0, b[0], theta, 0));
    }
    return true;
}

}  // namespace tautline
