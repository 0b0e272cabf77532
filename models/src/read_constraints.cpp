// SPDX-License-Identifier: Apache-2.0
#include "read_constraints.h"

#include <map>

#include "read_functions.h"

namespace tautline::models {
namespace {

ModelConstraint readCoupler(Element& element, const FrameTable&) {
    CoordinateCoupler coupler;
    coupler.name = element.getName();
    coupler.line = element.findLine();
    const Element independent = element.require("independent_coordinate_names");
    const Element dependent = element.require("dependent_coordinate_name");
    coupler.dependentCoordinate = resolveCoordinate(dependent).name;
    for (const std::string& name : independent.getWords()) {
        coupler.independentCoordinates.push_back(resolveCoordinate(independent, name).name);
        if (coupler.independentCoordinates.back() == coupler.dependentCoordinate)
            dependent.fail(element.describe() + " couples '" + coupler.dependentCoordinate + "' to itself");
    }
    if (coupler.independentCoordinates.empty()) independent.fail(element.describe() + " has no independent coordinate");
    coupler.function =
        requireWrappedFunction(element.require("coupled_coordinates_function"), coupler.independentCoordinates.size());
    coupler.scaleFactor = element.getNumberOr("scale_factor", 1.0);
    return coupler;
}

/** The frame that a socket, or an element of the old layout, names. */
BodyFrame resolveFrame(Element& element, const std::string& socketName, const std::string& oldTag,
                       const FrameTable& frames) {
    Element socket = element.findSocket(socketName);
    if (!socket) socket = element.find(oldTag);
    if (!socket) element.fail(element.describe() + " has no socket_" + socketName);
    return frames.resolve(socket, "/constraintset/" + element.getName());
}

/** Bodies 1 and 2 of a constraint with a point on each. */
template <class Constraint>
void readPoints(Element& element, const FrameTable& frames, Constraint& constraint) {
    constraint.name = element.getName();
    constraint.line = element.findLine();
    const BodyFrame frame1 = resolveFrame(element, "body_1", "body_1", frames);
    const BodyFrame frame2 = resolveFrame(element, "body_2", "body_2", frames);
    constraint.body1 = frame1.body;
    constraint.body2 = frame2.body;
    constraint.location1 = frame1.X_BF * element.getVec3Or("location_body_1", Vector3::Zero());
    constraint.location2 = frame2.X_BF * element.getVec3Or("location_body_2", Vector3::Zero());
}

void requireTwoBodies(const Element& element, const std::string& body1, const std::string& body2) {
    if (body1 == body2) element.fail(element.describe() + " holds body '" + body1 + "' to itself");
}

ModelConstraint readPointConstraint(Element& element, const FrameTable& frames) {
    PointConstraint constraint;
    readPoints(element, frames, constraint);
    requireTwoBodies(element, constraint.body1, constraint.body2);
    return constraint;
}

ModelConstraint readConstantDistance(Element& element, const FrameTable& frames) {
    ConstantDistanceConstraint constraint;
    readPoints(element, frames, constraint);
    requireTwoBodies(element, constraint.body1, constraint.body2);
    constraint.distance = element.requirePositive("constant_distance");
    return constraint;
}

ModelConstraint readWeld(Element& element, const FrameTable& frames) {
    WeldConstraint constraint;
    constraint.name = element.getName();
    constraint.line = element.findLine();
    const BodyFrame frame1 = resolveFrame(element, "frame1", "body_1", frames);
    const BodyFrame frame2 = resolveFrame(element, "frame2", "body_2", frames);
    constraint.body1 = frame1.body;
    constraint.body2 = frame2.body;
    // The old layout has the frames' poses beside the names of the bodies.
    constraint.X_B1F = frame1.X_BF * makePose(element.getVec3Or("location_body_1", Vector3::Zero()),
                                              element.getVec3Or("orientation_body_1", Vector3::Zero()));
    constraint.X_B2F = frame2.X_BF * makePose(element.getVec3Or("location_body_2", Vector3::Zero()),
                                              element.getVec3Or("orientation_body_2", Vector3::Zero()));
    element.acceptTag("frames");
    requireTwoBodies(element, constraint.body1, constraint.body2);
    return constraint;
}

ModelConstraint readPointOnLine(Element& element, const FrameTable& frames) {
    PointOnLineConstraint constraint;
    constraint.name = element.getName();
    constraint.line = element.findLine();
    const BodyFrame line = resolveFrame(element, "line_body", "line_body", frames);
    const BodyFrame follower = resolveFrame(element, "follower_body", "follower_body", frames);
    constraint.lineBody = line.body;
    constraint.followerBody = follower.body;
    constraint.pointOnLine = line.X_BF * element.getVec3Or("point_on_line", Vector3::Zero());
    constraint.direction = line.X_BF.R * element.getVec3Or("line_direction_vec", Vector3::Zero());
    if (constraint.direction.isZero(0)) element.fail("the line of " + element.describe() + " has no direction");
    constraint.follower = follower.X_BF * element.getVec3Or("point_on_follower", Vector3::Zero());
    requireTwoBodies(element, constraint.lineBody, constraint.followerBody);
    return constraint;
}

bool isEnforced(Element& element) {
    const Element enforced = element.find("isEnforced");
    const Element disabled = element.find("isDisabled");
    return (!enforced || enforced.getBool()) && !(disabled && disabled.getBool());
}

using ConstraintReader = ModelConstraint (*)(Element&, const FrameTable&);

const std::map<std::string, ConstraintReader>& getConstraintReaders() {
    static const std::map<std::string, ConstraintReader> kReaders{{"CoordinateCouplerConstraint", readCoupler},
                                                                  {"PointConstraint", readPointConstraint},
                                                                  {"WeldConstraint", readWeld},
                                                                  {"PointOnLineConstraint", readPointOnLine},
                                                                  {"ConstantDistanceConstraint", readConstantDistance}};
    return kReaders;
}

void readConstraint(Element element, const FrameTable& frames) {
    const bool enforced = isEnforced(element);
    const auto reader = getConstraintReaders().find(element.getTag());
    if (!enforced) return element.skipThis("ConstraintSet", "not enforced");
    if (reader == getConstraintReaders().end()) return element.refuse("constraint", Effect::Motion);
    const ModelConstraint constraint = reader->second(element, frames);
    element.refuseUnknown();
    element.updReading().model.constraints.push_back(constraint);
}

}  // namespace

const Coordinate& resolveCoordinate(const Element& socket, const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    const Coordinate* coordinate = findCoordinate(socket.updReading().model, name);
    if (!coordinate) socket.fail("there is no coordinate '" + path + "', the " + socket.describeField());
    return *coordinate;
}

const Coordinate& resolveCoordinate(const Element& socket) {
    return resolveCoordinate(socket, socket.getText());
}

void readConstraints(Element& model, const FrameTable& frames) {
    Element set = model.find("ConstraintSet");
    if (!set) return;
    for (const Element& constraint : set.getSetMembers()) readConstraint(constraint, frames);
}

}  // namespace tautline::models
