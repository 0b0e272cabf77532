// SPDX-License-Identifier: Apache-2.0
#include "multibody_plan.h"

#include <algorithm>
#include <map>
#include <set>

#include "tautline/models/model_error.h"

namespace tautline::models {
namespace {

/** Sine of the angle below which two axes count as parallel; the mobilizer refuses them, too. */
constexpr double kLeastAxisAngle = 1e-5;

[[noreturn]] void fail(const ModelDescription& model, int line, const std::string& what) {
    throw ModelError(model.fileName, line, what);
}

/** Joints without motion need no proper axes: they become welds. */
void checkAxes(const ModelDescription& model, const PlannedJoint& planned) {
    if (planned.axes.numMobilities == 0) return;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < (i < 3 ? 3u : 6u); ++j) {
            const SimTK::Vec3 product = planned.axes.axes[i] % planned.axes.axes[j];
            if (product.norm() < kLeastAxisAngle) {
                fail(model, planned.joint->axes[j].line,
                     "axes " + std::to_string(i % 3 + 1) + " and " + std::to_string(j % 3 + 1) +
                         (i < 3 ? " of rotation" : " of translation") + " of joint '" + planned.joint->name +
                         "' are parallel");
            }
        }
    }
}

PlannedJoint planJoint(const ModelDescription& model, const Joint& joint, bool reversed) {
    const std::string& name = reversed ? joint.parentBody : joint.childBody;
    const Body* body = findBody(model, name);
    if (!body) fail(model, joint.line, "joint '" + joint.name + "' hangs the ground on a body");
    PlannedJoint planned{&joint, body, reversed, makeJointAxes(joint)};
    checkAxes(model, planned);
    return planned;
}

/** Takes all joints that touch the tree by one end; true if there was one. */
bool growTree(const ModelDescription& model, std::set<const Joint*>& left, std::set<std::string>& reached,
              std::vector<PlannedJoint>& plan) {
    const std::size_t before = plan.size();
    for (const Joint& joint : model.joints) {
        if (!left.count(&joint)) continue;
        const bool fromParent = reached.count(joint.parentBody) > 0;
        const bool fromChild = reached.count(joint.childBody) > 0;
        if (fromParent && fromChild)
            fail(model, joint.line, "joint '" + joint.name + "' closes a loop of bodies, which cannot be built");
        if (!fromParent && !fromChild) continue;
        plan.push_back(planJoint(model, joint, fromChild));
        reached.insert(plan.back().outboardBody->name);
        left.erase(&joint);
    }
    return plan.size() > before;
}

void checkThatAllBodiesHang(const ModelDescription& model, const std::set<std::string>& reached) {
    for (const Body& body : model.bodies)
        if (!reached.count(body.name))
            fail(model, body.line, "no joints lead from the ground to body '" + body.name + "'");
}

/** A mobilizer that carries nothing with mass has no acceleration. */
void checkMasses(const ModelDescription& model, const std::vector<PlannedJoint>& plan) {
    std::map<std::string, double> carried;
    for (auto planned = plan.rbegin(); planned != plan.rend(); ++planned) {
        const Joint& joint = *planned->joint;
        const double mass = carried[planned->outboardBody->name] + planned->outboardBody->mass;
        carried[planned->reversed ? joint.childBody : joint.parentBody] += mass;
        if (mass == 0.0 && planned->axes.numMobilities > 0) {
            fail(model, planned->outboardBody->line,
                 "body '" + planned->outboardBody->name + "' moves by joint '" + joint.name +
                     "', but neither it nor what hangs on it has mass");
        }
    }
}

void requireCoordinate(const ModelDescription& model, int line, const std::string& name) {
    if (!findCoordinate(model, name)) fail(model, line, "there is no coordinate '" + name + "'");
}

void requireBody(const ModelDescription& model, int line, const std::string& name) {
    if (name != kGroundName && !findBody(model, name)) fail(model, line, "there is no body '" + name + "'");
}

/** The reader has checked this; a description may also be made by hand. */
struct ConstraintCheck {
    const ModelDescription& model;

    void operator()(const CoordinateCoupler& coupler) const {
        for (const std::string& name : coupler.independentCoordinates) requireCoordinate(model, coupler.line, name);
        requireCoordinate(model, coupler.line, coupler.dependentCoordinate);
    }
    void operator()(const PointOnLineConstraint& constraint) const {
        requireBody(model, constraint.line, constraint.lineBody);
        requireBody(model, constraint.line, constraint.followerBody);
    }
    template <class Constraint>
    void operator()(const Constraint& constraint) const {
        requireBody(model, constraint.line, constraint.body1);
        requireBody(model, constraint.line, constraint.body2);
    }
};

}  // namespace

std::vector<PlannedJoint> planMultibody(const ModelDescription& model) {
    std::set<const Joint*> left;
    for (const Joint& joint : model.joints) left.insert(&joint);
    std::set<std::string> reached{kGroundName};
    std::vector<PlannedJoint> plan;
    while (growTree(model, left, reached, plan)) {
    }
    checkThatAllBodiesHang(model, reached);
    checkMasses(model, plan);
    for (const ModelConstraint& constraint : model.constraints) std::visit(ConstraintCheck{model}, constraint);
    return plan;
}

}  // namespace tautline::models
