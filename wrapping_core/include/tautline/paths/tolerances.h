// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The numbers that decide what an answer is. (What a search may cost is bounded elsewhere, and decides nothing.) In
sizes of the surface concerned, if nothing else is said. The tolerance of the path error and that of geodesics are a
user's to choose: PathSolverOptions. */

namespace tautline {

// Contact.

/** d_tol of thesis Sec. 6.2, normalized by max(|kappa_n|, 1/size): the one constant for switching contact,
verifying and flagging it. Tiny, since a penetration h at touchdown makes the rate jump with h. */
inline constexpr double kContactTolerance = -1e-10;

/** Arcs shorter than this are of negative length: a thousand times the rounding of a length. */
inline constexpr double kShortestArc = -1e-12;

/** The same between events, where the event finder watches an arc that shrinks: as much as it may overshoot. */
inline constexpr double kShortestTrackedArc = -1e-6;

/** Fixed points that lie less above or below a surface are lifted off to this height: the straight segment there would
have no length, and no direction. The length changes by that height at most. */
inline constexpr double kEndOnSurface = 1e-7;

/** Of a witness that was found below zero, and of a margin of stability, when the path is solved once more. */
inline constexpr double kWitnessRounding = 1e-12, kMarginRounding = 1e-8;

/** Path error of a path whose contacts are judged: what is left of it turns a long segment off a thin obstacle by more
than the tolerance of contact. [1] */
inline constexpr double kSettledError = 1e-14;

/** Path error below which a path may be called one: looser than any tolerance in use. [1] */
inline constexpr double kVanishingError = 1e-8;

// Minima.

/** Of curvatures (over 1/size) and heights on a minimum: what differences of solved places leave. */
inline constexpr double kVerificationRounding = 1e-9;

/** Second variation, relative to the sum of its terms, below which a path is neither stable nor unstable. [1] */
inline constexpr double kNeutralVariation = 1e-9;

/** Where a string slips off that follows a path from pose to pose: below zero, where a way leads down from the saddle
that is no longer lost in rounding. On the verge it would slip by next to nothing, again and again. What the path is too
long by until then is of second order. [1] */
inline constexpr double kSlipMargin = -1e-6;

/** Relative change of length by which a string that has slipped differs from one that went on, and by which a shorter
path is shorter: rounding. [1] */
inline constexpr double kContinuousLength = 1e-9, kLengthRounding = 1e-12;

/** By which, of itself, a height may fall below the distance of the same place. [1] */
inline constexpr double kSamePlace = 1e-9;

// Routes.

/** By which a side may be missed in rounding, and within which a point lies on the axis and on no side. */
inline constexpr double kOnTheEdge = 1e-9, kOnTheAxis = 1e-9;

/** Of the angle by which a path turns about an axis. [rad] */
inline constexpr double kTurnRounding = 1e-9;

/** Height below which the arc on one obstacle shows that another overlaps it: deeper than two contacts that only touch.
 */
inline constexpr double kOverlap = -1e-6;

// Numbers.

/** Distance from ground's origin over the span of the path: beyond it the solver works in a frame near the path, since
three digits of a coordinate are lost. [1] */
inline constexpr double kFarFromOrigin = 1e3;

}  // namespace tautline
