// SPDX-License-Identifier: Apache-2.0
#include "joint_axes.h"

#include <algorithm>
#include <map>

#include "tautline/simbody/conversions.h"

namespace tautline::models {
namespace {

/** No motion: turns about x, y, z, then shifts along x, y, z. */
JointAxes makeRestingAxes() {
    JointAxes resting;
    for (int i = 0; i < 6; ++i) resting.axes[i] = SimTK::Vec3(SimTK::UnitVec3(SimTK::CoordinateAxis(i % 3)));
    return resting;
}

/** Adds a mobility for the next of the joint's coordinates. */
int addMobility(JointAxes& axes) {
    axes.mobilities.push_back(axes.numMobilities);
    return axes.numMobilities++;
}

/** The axes driven one to one by the joint's coordinates, in their order. */
JointAxes drive(std::initializer_list<std::size_t> axes) {
    JointAxes driven = makeRestingAxes();
    for (std::size_t axis : axes) {
        driven.functions[axis] = ScalarFunction::linear(1.0, 0.0);
        driven.arguments[axis] = {addMobility(driven)};
    }
    return driven;
}

/** Body-fixed angles x, y, z, and the origin of M at (a n_x, b n_y, c n_z) with the z axis n of M in F:
n = (sin y, -sin x cos y, cos x cos y). */
JointAxes makeEllipsoidAxes(const Vector3& semiAxes) {
    JointAxes axes = drive({0, 1, 2});
    const auto sine = [](double amplitude) { return ScalarFunction::sine(amplitude, 1.0, 0.0, 0.0); };
    const auto cosine = [](double amplitude) { return ScalarFunction::sine(amplitude, 1.0, kPi / 2, 0.0); };
    axes.functions[3] = sine(semiAxes.x());
    axes.functions[4] = MultivariateFunction::product({sine(-semiAxes.y()), cosine(1.0)});
    axes.functions[5] = MultivariateFunction::product({cosine(semiAxes.z()), cosine(1.0)});
    axes.arguments[3] = {1};
    axes.arguments[4] = {0, 1};
    axes.arguments[5] = {0, 1};
    return axes;
}

/** Whether a coordinate moves an axis. */
bool isDrivenBy(const TransformAxis& axis, const std::string& coordinate) {
    for (std::size_t i = 0; i < axis.coordinates.size(); ++i)
        if (axis.coordinates[i] == coordinate && axis.function.dependsOn(static_cast<int>(i))) return true;
    return false;
}

/** A coordinate that moves no axis becomes no mobility: the equations of motion would be singular. An axis is
constant in the arguments that are such coordinates, so any mobility may stand in for them. */
JointAxes makeCustomAxes(const Joint& joint) {
    JointAxes custom = makeRestingAxes();
    std::map<std::string, int> mobilityOf;
    for (const Coordinate& coordinate : joint.coordinates) {
        const bool moves = std::any_of(joint.axes.begin(), joint.axes.end(),
                                       [&](const TransformAxis& axis) { return isDrivenBy(axis, coordinate.name); });
        if (moves)
            mobilityOf[coordinate.name] = addMobility(custom);
        else
            custom.mobilities.push_back(-1);
    }
    for (std::size_t i = 0; i < 6; ++i) {
        const TransformAxis& axis = joint.axes[i];
        custom.axes[i] = toSimTK(axis.axis).normalize();
        custom.functions[i] = axis.function;
        const bool rests = std::none_of(axis.coordinates.begin(), axis.coordinates.end(),
                                        [&](const std::string& name) { return mobilityOf.count(name) > 0; });
        if (rests) continue;
        for (const std::string& name : axis.coordinates) custom.arguments[i].push_back(mobilityOf[name]);
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
        case JointType::Ellipsoid:
            return makeEllipsoidAxes(joint.semiAxes);
        case JointType::Custom:
            return makeCustomAxes(joint);
    }
    return makeRestingAxes();
}

double calcRestingValue(const MultivariateFunction& function) {
    const std::vector<double> zeros(static_cast<std::size_t>(std::max(function.getNumArguments(), 1)), 0.0);
    return function.calcValue(zeros.data());
}

SimTK::Transform calcFixedTransform(const JointAxes& axes) {
    SimTK::Transform X_FM;
    for (std::size_t i = 0; i < 3; ++i) {
        const SimTK::UnitVec3 axis(axes.axes[i]);
        X_FM.updR() = X_FM.R() * SimTK::Rotation(calcRestingValue(axes.functions[i]), axis);
    }
    for (std::size_t i = 3; i < 6; ++i) X_FM.updP() += calcRestingValue(axes.functions[i]) * axes.axes[i];
    return X_FM;
}

}  // namespace tautline::models
