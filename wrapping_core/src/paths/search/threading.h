// SPDX-License-Identifier: Apache-2.0
#pragma once
/** How often a path goes through the holes of its obstacles: whether that is right, and what is kept of it. */
#include <limits>
#include <vector>

#include "paths/problem/posed_problem.h"

namespace tautline {

/** Counts the passages through the hole of element e of a portion of a path, arcs between its segments included.
@param first, last   indices of its segments, both included */
HolePassage calcHolePassage(const PosedProblem& scene, const PathSolution& path, int e, std::size_t first,
                            std::size_t last);

/** True if a string cannot have come from `before` to `after` without the ring going through it: the two, closed
by the straight ways of their ends, are linked with the ring. False where nothing is known of `before`. */
bool hasLeftHole(const Hole& hole, const HolePassage& before, const HolePassage& after);

/** How often a path has to go through each hole, along +z of S less against it. */
struct PassageRule {
    static constexpr int kAny = std::numeric_limits<int>::min();
    std::vector<int> counts;  ///< by element; empty: as the path that this one was continued from
};

bool hasRightPassages(const PosedProblem& scene, const PassageRule& rule, const PathSolution& path);

/** Notes the passages through holes, and which were lost since the path that this one was continued from. Those of a
path that did not converge, or has left the hole, are no course to keep: the ones before them stay. */
void updatePassages(const PosedProblem& scene, bool isConverged, PathSolution& path);

/** Whether the path has left a ring that it was threaded through: no string came there on its way. */
bool hasLeftAnyHole(const PathSolution& path);

/** Where no search led through a hole again: later solves no longer look for the way, but still say that it was left.
 */
void giveUpLostHoles(PathSolution& path);

}  // namespace tautline
