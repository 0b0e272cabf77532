// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "joint_axes.h"

namespace tautline::models {

/** A joint in the order of building, with the body that it adds to the tree. */
struct PlannedJoint {
    const Joint* joint = nullptr;
    const Body* outboardBody = nullptr;
    /** The tree reaches the joint from its child: the mobilizer is built the other way round. */
    bool reversed = false;
    JointAxes axes;
};

/** Orders the joints from the ground outwards and checks that a multibody system can be built.
@throws ModelError with the file, the line and the name of what cannot. */
std::vector<PlannedJoint> planMultibody(const ModelDescription& model);

}  // namespace tautline::models
