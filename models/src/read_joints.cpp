// SPDX-License-Identifier: Apache-2.0
#include "read_joints.h"

#include <map>

#include "read_functions.h"

namespace tautline::models {
namespace {

struct JointKind {
    JointType type;
    /** -1: any number. */
    int coordinates;
};

const std::map<std::string, JointKind>& getJointKinds() {
    static const std::map<std::string, JointKind> kKinds{
        {"WeldJoint", {JointType::Weld, 0}},     {"PinJoint", {JointType::Pin, 1}},
        {"SliderJoint", {JointType::Slider, 1}}, {"UniversalJoint", {JointType::Universal, 2}},
        {"BallJoint", {JointType::Ball, 3}},     {"GimbalJoint", {JointType::Gimbal, 3}},
        {"PlanarJoint", {JointType::Planar, 3}}, {"FreeJoint", {JointType::Free, 6}},
        {"CustomJoint", {JointType::Custom, -1}}};
    return kKinds;
}

std::string makeJointPath(const Element& joint) {
    return "/jointset/" + joint.getRequiredName();
}

void readPrescribedMotion(Element& element, Coordinate& coordinate) {
    const bool enforced = element.getBoolOr("prescribed", false);
    const Element wrapper = element.find("prescribed_function");
    const bool hasFunction = wrapper && !wrapper.getChildren().empty();
    if (enforced && !hasFunction) element.fail(element.describe() + " is prescribed but has no prescribed_function");
    if (enforced)
        coordinate.prescribedMotion = requireWrappedFunction(wrapper);
    else if (hasFunction)
        wrapper.skipThis("Coordinate", "the motion is not enforced");
}

Coordinate readCoordinate(Element element) {
    if (element.getTag() != "Coordinate") element.fail("unknown element " + element.describe());
    Coordinate coordinate;
    coordinate.name = element.getRequiredName();
    coordinate.line = element.findLine();
    coordinate.defaultValue = element.getNumberOr("default_value", 0.0);
    coordinate.defaultSpeed = element.getNumberOr("default_speed_value", 0.0);
    if (const Element range = element.find("range")) {
        const std::vector<double> ends = range.getNumbers(2);
        if (ends[0] > ends[1]) range.fail("empty range of " + element.describe());
        coordinate.range = {ends[0], ends[1]};
    }
    coordinate.clamped = element.getBoolOr("clamped", false);
    coordinate.locked = element.getBoolOr("locked", false);
    readPrescribedMotion(element, coordinate);
    element.skip({"motion_type", "is_free_to_satisfy_constraints"}, "says nothing about the motion");
    element.refuseUnknown();
    return coordinate;
}

/** Whether the coordinate is one of the joint's. */
bool hasCoordinate(const Joint& joint, const std::string& name) {
    for (const Coordinate& coordinate : joint.coordinates)
        if (coordinate.name == name) return true;
    return false;
}

void readCoordinates(Element& element, Joint& joint) {
    std::vector<Element> members;
    if (Element set = element.find("CoordinateSet")) members = set.getSetMembers();
    if (const Element list = element.find("coordinates")) members = list.getChildren();
    for (const Element& member : members) {
        const Coordinate coordinate = readCoordinate(member);
        if (hasCoordinate(joint, coordinate.name) || findCoordinate(element.updReading().model, coordinate.name))
            member.fail("a second coordinate '" + coordinate.name + "'");
        joint.coordinates.push_back(coordinate);
    }
}

/** The function stands in the axis itself, or inside <function>, or is left out. */
ScalarFunction readAxisFunction(Element& element, bool driven) {
    std::vector<Element> functions;
    for (const Element& child : element.getChildren()) {
        const std::string tag = child.getTag();
        if (tag == "coordinates" || tag == "axis") continue;
        functions.push_back(child);
    }
    if (functions.size() > 1) functions[1].fail("a second function in " + element.describe());
    std::optional<ScalarFunction> function;
    if (!functions.empty())
        function = functions[0].getTag() == "function" ? readWrappedFunction(functions[0]) : readFunction(functions[0]);
    return function.value_or(driven ? ScalarFunction::linear(1.0, 0.0) : ScalarFunction());
}

TransformAxis readTransformAxis(Element element, const Joint& joint) {
    TransformAxis axis;
    axis.line = element.findLine();
    if (const Element coordinates = element.find("coordinates")) {
        axis.coordinate = coordinates.getText();
        if (!axis.coordinate.empty() && !hasCoordinate(joint, axis.coordinate)) {
            coordinates.fail("'" + axis.coordinate + "' is not one coordinate of " + std::string("joint '") +
                             joint.name + "'");
        }
    }
    const Element direction = element.require("axis");
    axis.axis = direction.getVec3();
    if (axis.axis.norm() == 0.0) direction.fail("the axis of " + element.describe() + " has no direction");
    axis.function = readAxisFunction(element, !axis.coordinate.empty());
    return axis;
}

/** A coordinate that moves nothing would make the equations of motion singular. */
void checkThatCoordinatesMove(const Element& element, const Joint& joint) {
    for (const Coordinate& coordinate : joint.coordinates) {
        bool moves = false;
        for (const TransformAxis& axis : joint.axes)
            moves = moves || (axis.coordinate == coordinate.name && !axis.function.isConstant());
        if (!moves) element.fail("coordinate '" + coordinate.name + "' moves nothing in " + element.describe());
    }
}

void readSpatialTransform(Element& element, Joint& joint) {
    Element transform = element.require("SpatialTransform");
    const char* names[6] = {"rotation1", "rotation2", "rotation3", "translation1", "translation2", "translation3"};
    const std::vector<Element> children = transform.getChildren();
    if (children.size() != 6) {
        transform.fail("SpatialTransform of " + element.describe() + " has " + std::to_string(children.size()) +
                       " axes instead of 6");
    }
    for (std::size_t i = 0; i < 6; ++i) {
        if (children[i].getTag() != "TransformAxis" || children[i].getName() != names[i]) {
            children[i].fail("unexpected " + children[i].describe() + " where TransformAxis '" + names[i] +
                             "' should stand");
        }
        joint.axes[i] = readTransformAxis(children[i], joint);
    }
    checkThatCoordinatesMove(element, joint);
}

void readNewFrames(Element& element, Joint& joint, const FrameTable& frames) {
    const std::string path = makeJointPath(element);
    const BodyFrame parent = frames.resolve(element.require("socket_parent_frame"), path);
    const BodyFrame child = frames.resolve(element.require("socket_child_frame"), path);
    joint.parentBody = parent.body;
    joint.parentOffset = parent.X_BF;
    joint.childBody = child.body;
    joint.childOffset = child.X_BF;
    element.acceptTag("frames");
}

void readOldFrames(Element& element, const std::string& childBody, Joint& joint, const FrameTable& frames) {
    joint.parentBody = frames.resolveBody(element.require("parent_body"));
    joint.parentOffset = makePose(element.getVec3Or("location_in_parent", Vec3::Zero()),
                                  element.getVec3Or("orientation_in_parent", Vec3::Zero()));
    joint.childBody = childBody;
    joint.childOffset =
        makePose(element.getVec3Or("location", Vec3::Zero()), element.getVec3Or("orientation", Vec3::Zero()));
    if (element.getBoolOr("reverse", false)) {
        std::swap(joint.parentBody, joint.childBody);
        std::swap(joint.parentOffset, joint.childOffset);
    }
}

void checkNumberOfCoordinates(const Element& element, const Joint& joint, int expected) {
    const auto count = static_cast<int>(joint.coordinates.size());
    if (expected >= 0 && count != expected) {
        element.fail(element.describe() + " has " + std::to_string(count) + " coordinates instead of " +
                     std::to_string(expected));
    }
}

void readJoint(const JointElement& source, const FrameTable& frames) {
    Element element = source.element;
    const auto kind = getJointKinds().find(element.getTag());
    if (kind == getJointKinds().end())
        element.fail("unknown joint " + element.describe() + ": its bodies cannot be connected without it");
    Joint joint;
    joint.name = element.getRequiredName();
    joint.type = kind->second.type;
    joint.line = element.findLine();
    if (source.childBody.empty())
        readNewFrames(element, joint, frames);
    else
        readOldFrames(element, source.childBody, joint, frames);
    readCoordinates(element, joint);
    checkNumberOfCoordinates(element, joint, kind->second.coordinates);
    if (joint.type == JointType::Custom) readSpatialTransform(element, joint);
    element.refuseUnknown();
    element.updReading().model.joints.push_back(std::move(joint));
}

}  // namespace

void collectJoints(Element& model, BodyParts& parts) {
    Element jointSet = model.find("JointSet");
    if (!jointSet) return;
    for (const Element& member : jointSet.getSetMembers()) {
        parts.joints.push_back({member, ""});
        Element joint = member;
        const Element frames = joint.find("frames");
        if (!frames) continue;
        for (const Element& frame : frames.getChildren()) {
            if (frame.getTag() != "PhysicalOffsetFrame")
                frame.fail("unknown frame " + frame.describe() + " of " + joint.describe());
            addOffsetFrame(frame, makeJointPath(joint), parts);
        }
    }
}

void readJoints(const BodyParts& parts) {
    for (const JointElement& joint : parts.joints) readJoint(joint, parts.frames);
}

}  // namespace tautline::models
