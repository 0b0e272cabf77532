// SPDX-License-Identifier: Apache-2.0
#pragma once
/** A chain is the path's fixed points and arcs ("contacts": an obstacle has as many as it has arcs) in order, with a
straight segment between each and the next. All vectors in ground. */
#include <vector>

#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** An arc of a chain. */
struct ChainContact {
    int element = -1;
    int arc = 0;            ///< which of the element's
    int segmentIn = -1;     ///< the segment that ends at P; the next one, segmentIn + 1, begins at Q
    GeodesicStart start;    ///< in S
    ShotGeodesic geodesic;  ///< in S
    DarbouxFrame P, Q;      ///< in ground
};

/** A straight segment of a chain; contact indices are -1 where it ends at a fixed point. */
struct ChainSegment {
    StraightSegment line;
    int fromContact = -1, toContact = -1;
};

struct Chain {
    std::vector<ChainContact> contacts;
    std::vector<ChainSegment> segments;

    /** Sets contacts and segments from the touched, active elements; starts come from `contacts`. Geodesics, frames and
    lines are left for shootChain(). */
    void build(const PathProblem& problem, const PathPose& pose, const std::vector<ObstacleContact>& elementContacts);
};

/** Shoots all geodesics of the chain (step 1 of thesis Sec. 4.6) and lays the straight segments.
@return false if a geodesic did not come to its end or a number is not finite */
bool shootChain(const PathProblem& problem, const PathPose& pose, const ShootingOptions& options, Chain& chain);

/** As shootChain(), but takes the geodesics that are known: shot on the same surface, as accurately, from where the arc
starts now.
@param elementContacts   by element, those that the chain was built from
@param numShots          how many had to be shot */
bool shootUnknownArcs(const PathProblem& problem, const PathPose& pose, const ShootingOptions& options,
                      const std::vector<ObstacleContact>& elementContacts, Chain& chain, int& numShots);

/** Length of segments and arcs [m]. */
double calcLength(const Chain& chain);

}  // namespace tautline
