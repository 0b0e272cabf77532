// SPDX-License-Identifier: Apache-2.0
#include "read_joints.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "read_functions.h"

namespace tautline::models {
namespace {

struct JointKind {
    JointType type;
    /** -1: any number. */
    int coordinates;
    /** What the joint has beside frames and coordinates; may be null. */
    void (*readRest)(Element& element, Joint& joint) = nullptr;
};

void readSpatialTransform(Element& element, Joint& joint);
void readEllipsoid(Element& element, Joint& joint);

const std::map<std::string, JointKind>& getJointKinds() {
    static const std::map<std::string, JointKind> kKinds{
        {"WeldJoint", {JointType::Weld, 0}},
        {"PinJoint", {JointType::Pin, 1}},
        {"SliderJoint", {JointType::Slider, 1}},
        {"UniversalJoint", {JointType::Universal, 2}},
        {"BallJoint", {JointType::Ball, 3}},
        {"GimbalJoint", {JointType::Gimbal, 3}},
        {"PlanarJoint", {JointType::Planar, 3}},
        {"FreeJoint", {JointType::Free, 6}},
        {"EllipsoidJoint", {JointType::Ellipsoid, 3, readEllipsoid}},
        {"CustomJoint", {JointType::Custom, -1, readSpatialTransform}}};
    return kKinds;
}

/** A joint without a name is told from others by its line. */
std::string makeJointName(const Element& joint) {
    const std::string name = joint.getName();
    return name.empty() ? "joint_at_line_" + std::to_string(joint.findLine()) : name;
}

std::string makeJointPath(const Element& joint) {
    return "/jointset/" + makeJointName(joint);
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
    const Element defaultValue = element.findAny({"default_value", "initial_value"});
    coordinate.defaultValue = defaultValue ? defaultValue.getNumber() : 0.0;
    coordinate.defaultSpeed = element.getNumberOr("default_speed_value", 0.0);
    if (const Element range = element.find("range")) {
        const std::vector<double> ends = range.getNumbers(2);
        if (ends[0] > ends[1]) range.fail("empty range of " + element.describe());
        coordinate.range = {ends[0], ends[1]};
    }
    coordinate.clamped = element.getBoolOr("clamped", false);
    coordinate.locked = element.getBoolOr("locked", false);
    readPrescribedMotion(element, coordinate);
    element.skip({"motion_type", "is_free_to_satisfy_constraints", "keys", "restraint_function"},
                 "says nothing about the motion");
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

/** The function stands in the axis itself, or inside <function>, or is left out: then it is the coordinate. */
MultivariateFunction readAxisFunction(Element& element, std::size_t numArguments) {
    std::vector<Element> functions;
    for (const Element& child : element.getChildren()) {
        const std::string tag = child.getTag();
        if (tag == "coordinates" || tag == "axis") continue;
        functions.push_back(child);
    }
    if (functions.size() > 1) functions[1].fail("a second function in " + element.describe());
    const bool isWrapped = !functions.empty() && functions[0].getTag() == "function";
    if (isWrapped) functions = functions[0].getChildren();
    // A function of nothing is one of a coordinate that rests at 0.
    if (!functions.empty()) return readFunction(functions[0], std::max<std::size_t>(numArguments, 1));
    if (numArguments > 1) element.fail("no function of the coordinates in " + element.describe());
    return numArguments == 1 ? ScalarFunction::linear(1.0, 0.0) : ScalarFunction();
}

TransformAxis readTransformAxis(Element element, const Joint& joint) {
    TransformAxis axis;
    axis.line = element.findLine();
    if (const Element coordinates = element.find("coordinates")) {
        axis.coordinates = coordinates.getWords();
        for (const std::string& name : axis.coordinates)
            if (!hasCoordinate(joint, name))
                coordinates.fail("'" + name + "' is not a coordinate of joint '" + joint.name + "'");
    }
    const Element direction = element.require("axis");
    axis.axis = direction.getVec3();
    if (axis.axis.norm() == 0.0) direction.fail("the axis of " + element.describe() + " has no direction");
    axis.function = readAxisFunction(element, axis.coordinates.size());
    return axis;
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
}

Vector3 requireSemiAxes(Element& element, const std::string& tag) {
    const Element radii = element.require(tag);
    const Vector3 semiAxes = radii.getVec3();
    if (semiAxes.minCoeff() <= 0.0) radii.fail("the " + radii.describeField() + " are not all positive");
    return semiAxes;
}

void readEllipsoid(Element& element, Joint& joint) {
    joint.semiAxes = requireSemiAxes(element, "radii_x_y_z");
}

Pose readOffset(Element& element, const std::string& suffix) {
    return makePose(element.getVec3Or("location" + suffix, Vector3::Zero()),
                    element.getVec3Or("orientation" + suffix, Vector3::Zero()));
}

/** Of the parent or the child; documents before 30505 name the bodies and have no frames. */
Element findJointSocket(Element& element, const std::string& side) {
    const Element body = element.findSocket(side + "_body");
    return body ? body : element.requireSocket(side + "_frame");
}

void readNewFrames(Element& element, Joint& joint, const FrameTable& frames) {
    const std::string path = makeJointPath(element);
    const BodyFrame parent = frames.resolve(findJointSocket(element, "parent"), path);
    const BodyFrame child = frames.resolve(findJointSocket(element, "child"), path);
    joint.parentBody = parent.body;
    joint.parentOffset = parent.X_BF;
    joint.childBody = child.body;
    joint.childOffset = child.X_BF;
    element.acceptTag("frames");
    // Documents 30501 to 30504 have the offsets beside the names of the bodies.
    joint.parentOffset = joint.parentOffset * readOffset(element, "_in_parent");
    joint.childOffset = joint.childOffset * readOffset(element, "_in_child");
}

void readOldFrames(Element& element, const std::string& childBody, Joint& joint, const FrameTable& frames) {
    joint.parentBody = frames.resolveBody(element.require("parent_body"));
    joint.parentOffset = readOffset(element, "_in_parent");
    joint.childBody = childBody;
    joint.childOffset = readOffset(element, "");
}

void checkNumberOfCoordinates(const Element& element, const Joint& joint, int expected) {
    const auto count = static_cast<int>(joint.coordinates.size());
    if (expected >= 0 && count != expected) {
        element.fail(element.describe() + " has " + std::to_string(count) + " coordinates instead of " +
                     std::to_string(expected));
    }
}

/** What all joints have. */
Joint readCommon(const JointElement& source, Element& element, const FrameTable& frames) {
    Joint joint;
    joint.name = makeJointName(element);
    joint.line = element.findLine();
    if (source.childBody.empty())
        readNewFrames(element, joint, frames);
    else
        readOldFrames(element, source.childBody, joint, frames);
    if (element.getBoolOr("reverse", false)) {
        std::swap(joint.parentBody, joint.childBody);
        std::swap(joint.parentOffset, joint.childOffset);
    }
    readCoordinates(element, joint);
    element.skip({"use_euler_angles"}, "every coordinate is an angle or a length");
    return joint;
}

/** The z axis of the winging joint in the frame that rides on the ellipsoid: in its tangent plane, turned from y about
the normal; the other axes do not matter. */
Pose readWingingFrame(Element& element) {
    const std::vector<double> origin = element.require("scapula_winging_axis_origin").getNumbers(2);
    const double direction = element.getNumberOr("scapula_winging_axis_direction", 0.0);
    Matrix3 R;
    R.col(2) = Vector3(-std::sin(direction), std::cos(direction), 0.0);
    R.col(0) = Vector3::UnitZ();
    R.col(1) = R.col(2).cross(R.col(0));
    return {R, Vector3(origin[0], origin[1], 0.0)};
}

/** A scapula on the thorax (Seth et al. 2019): an ellipsoid joint whose frames are turned by a quarter about z, so that
abduction and elevation are positive, then a pin about the winging axis. Between them is a body without mass. */
void readScapulothoracic(const JointElement& source, Element& element, const FrameTable& frames) {
    Joint gliding = readCommon(source, element, frames);
    checkNumberOfCoordinates(element, gliding, 4);
    ModelDescription& model = element.updReading().model;
    Joint winging = gliding;
    Body link;
    link.name = gliding.name + "/winging";
    link.line = gliding.line;
    const Pose quarterTurn = makePose(Vector3::Zero(), Vector3(0.0, 0.0, kPi / 2));
    const Vector3 semiAxes = requireSemiAxes(element, "thoracic_ellipsoid_radii_x_y_z");
    gliding.type = JointType::Ellipsoid;
    gliding.parentOffset = gliding.parentOffset * quarterTurn;
    gliding.semiAxes = Vector3(semiAxes.y(), semiAxes.x(), semiAxes.z());
    gliding.childBody = link.name;
    gliding.childOffset = quarterTurn;
    gliding.coordinates.pop_back();
    winging.type = JointType::Pin;
    winging.parentBody = link.name;
    winging.parentOffset = readWingingFrame(element);
    winging.childOffset = winging.childOffset * winging.parentOffset;
    winging.coordinates.erase(winging.coordinates.begin(), winging.coordinates.end() - 1);
    element.refuseUnknown();
    model.bodies.push_back(link);
    model.joints.push_back(std::move(gliding));
    model.joints.push_back(std::move(winging));
}

void readJoint(const JointElement& source, const FrameTable& frames) {
    Element element = source.element;
    if (element.getTag() == "ScapulothoracicJoint") return readScapulothoracic(source, element, frames);
    const auto kind = getJointKinds().find(element.getTag());
    if (kind == getJointKinds().end())
        return element.refuseForGood("joint", "its bodies cannot be connected without it");
    Joint joint = readCommon(source, element, frames);
    joint.type = kind->second.type;
    checkNumberOfCoordinates(element, joint, kind->second.coordinates);
    if (kind->second.readRest) kind->second.readRest(element, joint);
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
        for (const Element& frame : frames.getChildren()) addComponent(frame, makeJointPath(joint), parts);
    }
}

void readJoints(const BodyParts& parts) {
    for (const JointElement& joint : parts.joints) readJoint(joint, parts.frames);
}

}  // namespace tautline::models
