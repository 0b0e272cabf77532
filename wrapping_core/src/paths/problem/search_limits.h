// SPDX-License-Identifier: Apache-2.0
#pragma once
/** What the search for a path may cost. None of these decides what an answer is (tautline/paths/tolerances.h): they
bound the work of a solve that comes to no answer, and were set from what solves that come to one need. */

namespace tautline {

/** Contact sets of one local solve: each obstacle touched, lifted and touched again, and some more for small n. */
inline int calcMaxContactChanges(int numElements) {
    return 3 * numElements + 10;
}

/** Splits and joins of arcs while one contact set is solved: a sheet of many hollows opens one after the other. */
inline constexpr int kMaxArcChanges = 24;

/** Reversed tangents and saddles that one local solve mends; a start that needs more is in another basin. */
inline constexpr int kMaxRepairs = 4;

/** Of the contact points of a saddle along its direction of negative curvature, in sizes: out of the region where the
length is flat, within the one where arcs are still alike. */
inline constexpr double kSaddleMove = 0.1;

/** How finely an elastic band is relaxed: spacing of its nodes relative to the default, the largest move of a node in a
sweep, in spacings, that counts as rest, and the sweeps after which it counts as that too. */
struct BandLevel {
    double fineness, tolerance;
    int maxSweeps;
};

/** Of 4000 random scenes that need a band 98 % are solved from the first, 1.6 % from the second, the rest from the
third level. */
inline constexpr BandLevel kBandLevels[] = {{1.0, 2e-3, 400}, {0.5, 2e-4, 1500}, {0.25, 2e-5, 3000}};

/** For bands that slide off slowly. */
inline constexpr BandLevel kPatientBand = {0.5, 1e-6, 6000};

/** Of a band that lies beyond a conjugate point, sideways in sizes of the surface; each move is twice the one before.
 */
inline constexpr double kFirstBandMove = 0.1;
inline constexpr int kMaxBandMoves = 6;

/** Iterations of the minimizer while contacts are inserted from the straight line: beyond that a band is cheaper. */
inline constexpr int kMaxInsertionDescents = 12;

/** Path error below which Newton's method goes on where the minimizer has used up its iterations. */
inline constexpr double kNearlyStationary = 1e-2;

/** Geodesics shot per element after which no further search begins: scenes that are solved need half as many. */
inline constexpr int kMaxShotsPerElement = 20000;

/** Iterations of each method for a path that is tracked to a pose, or over a part of the way there: what needs more is
halved.
Of 11,000 parts that Newton's method led over 99 % needed at most 10. */
inline constexpr int kMaxPartIterations = 15;

/** Geodesics shot per touched obstacle after which a path that is followed counts as lost. Of 1600 paths that were
followed to their end half needed 25, and none 1000. */
inline constexpr int kMaxFollowShots = 1000;

}  // namespace tautline
