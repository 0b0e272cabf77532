// SPDX-License-Identifier: Apache-2.0
#include "joint_axes.h"

#include "tautline/simbody/conversions.h"

namespace tautline::models {
namespace {

/** No motion: turns about x, y, z, then shifts along x, y, z. */
JointAxes makeRestingAxes() {
    JointAxes resting;
    for (int i = 0; i < 6; ++i) resting.axes[i] = SimTK::Vec3(SimTK::UnitVec3(SimTK::CoordinateAxis(i % 3)));
    resting.coordinates.fill(-1);
    return resting;
}

/** The axes driven one to one by the joint's coordinates, in their order. */
JointAxes drive(std::initializer_list<std::size_t> axes) {
    JointAxes driven = makeRestingAxes();
    int coordinate = 0;
    for (std::size_t axis : axes) {
        driven.functions[axis] = ScalarFunction::linear(1.0, 0.0);
        driven.coordinates[axis] = coordinate++;
    }
    return driven;
}

int findIndex(const Joint& joint, const std::string& coordinate) {
    for (std::size_t i = 0; i < joint.coordinates.size(); ++i)
        if (joint.coordinates[i].name == coordinate) return static_cast<int>(i);
    return -1;
}

JointAxes makeCustomAxes(const Joint& joint) {
    JointAxes custom;
    for (std::size_t i = 0; i < 6; ++i) {
        custom.axes[i] = toSimTK(joint.axes[i].axis).normalize();
        custom.functions[i] = joint.axes[i].function;
        custom.coordinates[i] = findIndex(joint, joint.axes[i].coordinate);
    }
    return custom;
}

}  // namespace

JointAxes makeJointAxes(const Joint& joint) {
    switch (joint.type) {
        case JointType::Weld:
            return drive({});
        case JointType::Pin:
            return drive({2});
        case JointType::Slider:
            return drive({3});
        case JointType::Universal:
            return drive({0, 1});
        case JointType::Ball:
        case JointType::Gimbal:
            return drive({0, 1, 2});
        case JointType::Planar:
            return drive({2, 3, 4});
        case JointType::Free:
            return drive({0, 1, 2, 3, 4, 5});
        case JointType::Custom:
            return makeCustomAxes(joint);
    }
    return makeRestingAxes();
}

SimTK::Transform calcFixedTransform(const JointAxes& axes) {
    SimTK::Transform X_FM;
    for (std::size_t i = 0; i < 3; ++i) {
        const SimTK::UnitVec3 axis(axes.axes[i]);
        X_FM.updR() = X_FM.R() * SimTK::Rotation(axes.functions[i].calcValue(0.0), axis);
    }
    for (std::size_t i = 3; i < 6; ++i) X_FM.updP() += axes.functions[i].calcValue(0.0) * axes.axes[i];
    return X_FM;
}

}  // namespace tautline::models
