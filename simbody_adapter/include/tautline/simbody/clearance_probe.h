// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/simbody/cable.h"

namespace tautline {

/** Signed distance between an obstacle and the straight segment of the path that passes it (thesis Cha. 6), for
tables and plots: smooth through touchdown and lift-off. While the obstacle is touched, the segment is that of the
path which would be there without this obstacle, so that the distance is negative.

One per obstacle and sequence of poses: it remembers the path without the obstacle and continues from it. Asked again in
an unchanged pose it solves nothing. */
class ClearanceProbe {
public:
    ClearanceProbe(const Cable& cable, CableElementIndex obstacle) : m_cable(cable), m_obstacle(obstacle) {}

    /** Needs Stage::Position. @return `found` is false where the obstacle is touched and there is no path without
    it, or one that does not pass it */
    LineClearance calcClearance(const SimTK::State& state);

private:
    bool isKnown(const PathPose& pose, const GeodesicStart& arc) const;
    LineClearance calcDepth(const PathSolution& path);
    bool solveWithout(const PathPose& without, const PathSolution& path);

    Cable m_cable;
    CableElementIndex m_obstacle;
    PathSolution m_loose;   ///< the last path without the obstacle; empty: none yet
    PathPose m_pose;        ///< where the obstacle was last found touched; empty: nowhere yet
    GeodesicStart m_arc;    ///< of the contact there
    LineClearance m_depth;  ///< and the answer
};

}  // namespace tautline
