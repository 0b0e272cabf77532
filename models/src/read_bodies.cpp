// SPDX-License-Identifier: Apache-2.0
#include "read_bodies.h"

#include <algorithm>

namespace tautline::models {
namespace {

/** Room for the rounding of moments of inertia that files give with few digits. */
constexpr double kInertiaTolerance = 1e-6;

std::array<double, 6> readInertia(Element& body) {
    std::array<double, 6> inertia{};
    if (const Element numbers = body.find("inertia")) {
        const std::vector<double> values = numbers.getNumbers(6);
        std::copy(values.begin(), values.end(), inertia.begin());
        return inertia;
    }
    const char* tags[6] = {"inertia_xx", "inertia_yy", "inertia_zz", "inertia_xy", "inertia_xz", "inertia_yz"};
    for (std::size_t i = 0; i < 6; ++i) inertia[i] = body.requireNumber(tags[i]);
    return inertia;
}

/** No body has a principal moment greater than the sum of the other two, nor a negative one. */
void checkInertia(const Element& body, const std::array<double, 6>& inertia) {
    const double sum = inertia[0] + inertia[1] + inertia[2];
    for (std::size_t i = 0; i < 3; ++i) {
        const bool possible = inertia[i] >= 0.0 && 2 * inertia[i] <= sum * (1 + kInertiaTolerance);
        if (!possible) body.fail("impossible moments of inertia of " + body.describe());
    }
}

void readMassProperties(Element& element, Body& body) {
    const Element mass = element.require("mass");
    body.mass = mass.getNumber();
    if (body.mass < 0.0) mass.fail("negative mass " + mass.getText() + " of " + element.describe());
    body.massCenter = element.require("mass_center").getVec3();
    body.inertia = readInertia(element);
    checkInertia(element, body.inertia);
}

void readComponents(Element& owner, const std::string& path, BodyParts& parts) {
    const Element components = owner.find("components");
    if (!components) return;
    for (const Element& component : components.getChildren()) {
        if (component.getTag() != "PhysicalOffsetFrame")
            component.fail("unknown component " + component.describe() + " of " + owner.describe());
        addOffsetFrame(component, path, parts);
    }
}

/** What the ground and the other bodies have in common. */
void readFrameParts(Element& element, const std::string& path, BodyParts& parts) {
    parts.wrapOwners.push_back({element, path});
    readComponents(element, path, parts);
    element.acceptTag("WrapObjectSet");
    element.skip({"FrameGeometry", "frame_geometry", "attached_geometry", "VisibleObject", "geometry_files"},
                 "only drawn");
    element.refuseUnknown();
}

void readOldJoint(Element& body, const std::string& name, BodyParts& parts) {
    Element holder = body.find("Joint");
    if (!holder) return;
    const std::vector<Element> joints = holder.getChildren();
    if (joints.size() > 1) joints[1].fail("a second joint in " + body.describe());
    if (!joints.empty()) parts.joints.push_back({joints[0], name});
}

void readGround(Element ground, const std::string& path, BodyParts& parts) {
    for (const char* tag : {"mass", "mass_center", "inertia", "inertia_xx", "inertia_yy", "inertia_zz", "inertia_xy",
                            "inertia_xz", "inertia_yz", "Joint"})
        ground.acceptTag(tag);  // of the ground without meaning
    readFrameParts(ground, path, parts);
}

void readBody(Element element, BodyParts& parts) {
    if (element.getTag() != "Body") element.fail("unknown body " + element.describe());
    Body body;
    body.name = element.getRequiredName();
    body.line = element.findLine();
    if (body.name == kGroundName) return readGround(element, "/ground", parts);
    auto& model = element.updReading().model;
    if (findBody(model, body.name)) element.fail("a second body '" + body.name + "'");
    readMassProperties(element, body);
    readOldJoint(element, body.name, parts);
    parts.frames.addBody(body.name);
    readFrameParts(element, "/bodyset/" + body.name, parts);
    model.bodies.push_back(body);
}

}  // namespace

void addOffsetFrame(const Element& frame, const std::string& ownerPath, BodyParts& parts) {
    const std::string path = ownerPath + "/" + frame.getRequiredName();
    parts.frames.addOffsetFrame(path, frame);
    parts.wrapOwners.push_back({frame, path});
}

void readBodies(Element& model, BodyParts& parts) {
    parts.frames.addBody(kGroundName);
    if (const Element ground = model.find("Ground")) readGround(ground, "/ground", parts);
    Element bodySet = model.find("BodySet");
    if (!bodySet) return;
    for (const Element& body : bodySet.getSetMembers()) readBody(body, parts);
}

}  // namespace tautline::models
