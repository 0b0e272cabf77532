// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include "tautline/models/model_description.h"

namespace tautline::models {

/** The motion of any joint written as that of a custom joint, from the frame F on the parent to the frame M on the
child: R_FM = R(a0,f0) R(a1,f1) R(a2,f2), each axis carried along by those before it, and p_FM = f3 a3 + f4 a4 + f5 a5
in F. */
struct JointAxes {
    /** Unit vectors. */
    std::array<SimTK::Vec3, 6> axes;
    std::array<MultivariateFunction, 6> functions;
    /** The functions' arguments, as indices into the mobilities; none: the function's value at 0 holds always. */
    std::array<std::vector<int>, 6> arguments;
    /** For each of the joint's coordinates the mobility that it is; -1 if it moves nothing. */
    std::vector<int> mobilities;
    int numMobilities = 0;
};

JointAxes makeJointAxes(const Joint& joint);

/** The value of a function all of whose arguments rest at 0. */
double calcRestingValue(const MultivariateFunction& function);

/** X_FM of a joint without coordinates. */
SimTK::Transform calcFixedTransform(const JointAxes& axes);

}  // namespace tautline::models
