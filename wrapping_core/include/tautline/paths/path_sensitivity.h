// SPDX-License-Identifier: Apache-2.0
#pragma once
/** How a solved path answers to a motion of its elements: by the implicit function theorem on eps = 0, in one
O(n) solve per motion. */
#include <memory>

#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline {

/** Rates of a path under one motion of its elements (velocities, or any other variation of the poses); one entry per
element in each list, zero where it is not touched. Of an obstacle with several arcs P is where the first one begins and
Q where the last one ends. */
struct PathVariation {
    double lengthRate = 0;                ///< dL/dt [m/s]
    std::vector<Vector4> xiRate;          ///< of the first arc's natural corrections (s, beta, theta, l), in m/s but
                                          ///< the third, in rad/s
    std::vector<Vector3> PRate, QRate;    ///< velocities of the contact points in ground [m/s]
    std::vector<SpatialForce> forceRate;  ///< of the unit force [1/s] and its moment about the moving origin [m/s]
};

/** Computes variations of a path whose path error vanishes; reuses its memory.

The first derivative of the length with respect to the poses needs no solve: it is minus the unit forces
(calcUnitForces): dL = -sum (F . dp + M . dphi) over the elements, dphi a rotation vector in ground. The second
derivatives are the rates of these forces: along a motion, d(dL)/dt = -sum (dF/dt . dp + dM/dt . dphi). They hold
while the contact set stays as it is: dL is continuous when contact changes, its derivative jumps. */
class PathSensitivity {
public:
    PathSensitivity();
    PathSensitivity(PathSensitivity&&) noexcept;
    PathSensitivity& operator=(PathSensitivity&&) noexcept;
    ~PathSensitivity();

    /** Takes the path. All arguments must describe one solve and outlive the calls below.
    @param path   status Solved, or any path with small path error: the results are those of eps = const
    @throws InvalidInput if the path is empty or another problem's */
    void setPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path);

    /** @param V_GE   velocities of the elements, one per element, in ground
    @return false if the Jacobian is singular there (a path on the verge of instability); rates are then zero
    @throws InvalidInput unless a path was set and there is one velocity per element */
    bool calcVariation(const std::vector<SpatialVelocity>& V_GE, PathVariation& variation);

    /** Moves the starts of the arcs ahead, so that the error of a continued solve begins at second order in the step
    instead of first.
    @param V_GE   velocities of the elements at the pose of setPath()
    @param dt     time to the pose of the next solve [s], of either sign
    @param path   in: the path of setPath(); out: the start of the next solve
    @return false, and nothing changed, where calcVariation() fails */
    bool predictStarts(const std::vector<SpatialVelocity>& V_GE, double dt, PathSolution& path);

private:
    struct Workspace;

    std::unique_ptr<Workspace> m_workspace;
};

}  // namespace tautline
