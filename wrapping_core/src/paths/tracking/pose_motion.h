// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tautline/paths/path_problem.h"

namespace tautline {

/** How the elements of a path get from one pose to another.

Two poses do not tell how often an element turned in between. Each one goes on at the velocity that it had, and at the
same time along the screw that leads from where that would end to where it is: with V^ the twist at the start in the
element's own frame,

    X(s) = X_0 exp(s V^ dt) exp(s log(exp(-V^ dt) X_0^-1 X_1)),   0 <= s <= 1.

Of the turns by theta + 2 pi k this is the one nearest to what the velocity foretells, and a body that turns about an
axis at rest keeps to its circle at any speed (Murray, Li and Sastry, A Mathematical Introduction to Robotic
Manipulation, 1994, ch. 2). Without velocities it is the shortest screw. */
class PoseMotion {
public:
    /** @param V_GE   velocities at `from` in ground, at the elements' origins; empty: not known
    @param duration   from one to the other [s], of either sign */
    void set(const PathPose& from, const std::vector<SpatialVelocity>& V_GE, double duration, const PathPose& to);

    /** An upper bound for the turn of two elements against each other over the whole way [rad]. */
    double calcTurnBound(int a, int b) const;

    /** @param share    of the way
    @param[out] pose    the elements that take part are those of the pose where it ends */
    void calcPose(double share, PathPose& pose) const;

private:
    struct ElementMotion {
        Pose X_G0;
        SpatialVelocity foretold, rest;  ///< displacements, in the element's frame [rad, m]
    };
    std::vector<ElementMotion> m_elements;
    const PathPose* m_to = nullptr;  ///< must outlive the use
};

/** exp of a displacement by w [rad] and v [m]: the screw that they begin. */
Pose calcScrew(const SpatialVelocity& displacement);

/** The shortest displacement whose screw a pose is. */
SpatialVelocity calcScrewDisplacement(const Pose& X);

}  // namespace tautline
