// SPDX-License-Identifier: Apache-2.0
#include "read_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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

/** No body has a moment of inertia greater than the sum of the other two, nor a negative one, nor a product of inertia
greater than half the moment about the third axis. */
bool isPossible(const std::array<double, 6>& inertia) {
    const double sum = inertia[0] + inertia[1] + inertia[2];
    const double room = sum * kInertiaTolerance;
    for (std::size_t i = 0; i < 3; ++i)
        if (inertia[i] < 0.0 || 2 * inertia[i] > sum + room) return false;
    // The products are xy, xz, yz: each goes with the axis that it does not name.
    for (std::size_t i = 0; i < 3; ++i)
        if (2 * std::abs(inertia[3 + i]) > inertia[2 - i] + room) return false;
    return true;
}

/** As OpenSim's Body does: a body without mass has no inertia, and one whose inertia no body can have is taken for a
sphere with the root mean square of its moments. */
void repairInertia(const Element& element, Body& body) {
    auto& inertia = body.inertia;
    if (body.mass == 0.0) {
        if (std::any_of(inertia.begin(), inertia.end(), [](double value) { return value != 0.0; }))
            element.note(element.describe() + " has no mass, so its inertia is taken as zero");
        inertia.fill(0.0);
    } else if (!isPossible(inertia)) {
        const double moment = Vector3(inertia[0], inertia[1], inertia[2]).norm() / std::sqrt(3.0);
        inertia = {moment, moment, moment, 0.0, 0.0, 0.0};
        element.note("no body can have the moments of inertia of " + element.describe() +
                     "; it is taken for a sphere of " + std::to_string(moment) + " kg m^2");
    }
}

void readMassProperties(Element& element, Body& body) {
    const Element mass = element.require("mass");
    body.mass = mass.getNumber();
    if (body.mass < 0.0) mass.fail("negative mass " + mass.getText() + " of " + element.describe());
    body.massCenter = element.getVec3Or("mass_center", Vector3::Zero());
    body.inertia = readInertia(element);
    repairInertia(element, body);
}

void readComponents(Element& owner, const std::string& path, BodyParts& parts) {
    const Element components = owner.find("components");
    if (!components) return;
    for (const Element& component : components.getChildren()) addComponent(component, path, parts);
}

/** What the ground and the other bodies have in common. */
void readFrameParts(Element& element, const std::string& path, BodyParts& parts) {
    parts.wrapOwners.push_back({element, path});
    readComponents(element, path, parts);
    element.acceptTag("WrapObjectSet");
    element.skip({"FrameGeometry", "frame_geometry", "attached_geometry", "VisibleObject", "geometry_files", "geometry",
                  "GeometrySet", "use_default_geometry"},
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

/** Of a body that is there already: its mass and joint are not for a file to say. */
void readPartsOfBody(Element element, const std::vector<std::string>& names, std::set<std::string>& seen,
                     BodyParts& parts) {
    if (element.getTag() != "Body") element.fail("unknown body " + element.describe());
    const std::string name = element.getRequiredName();
    if (!seen.insert(name).second) element.fail("a second body '" + name + "'");
    if (std::find(names.begin(), names.end(), name) == names.end()) element.fail("the host has no body '" + name + "'");
    readFrameParts(element, "/bodyset/" + name, parts);
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

void addComponent(const Element& component, const std::string& ownerPath, BodyParts& parts) {
    using Adder = void (*)(const std::string&, const Element&, BodyParts&);
    static const std::map<std::string, Adder> kAdders{
        {"PhysicalOffsetFrame",
         [](const std::string& path, const Element& frame, BodyParts& to) {
             to.frames.addOffsetFrame(path, frame);
             to.wrapOwners.push_back({frame, path});
         }},
        {"StationDefinedFrame",
         [](const std::string& path, const Element& frame, BodyParts& to) {
             to.frames.addStationFrame(path, frame);
             to.wrapOwners.push_back({frame, path});
         }},
        {"Station",
         [](const std::string& path, const Element& station, BodyParts& to) { to.frames.addStation(path, station); }},
        {"Marker",
         [](const std::string& path, const Element& marker, BodyParts& to) { to.frames.addStation(path, marker); }}};
    const auto adder = kAdders.find(component.getTag());
    if (adder == kAdders.end()) return component.refuse("component", Effect::Motion);
    adder->second(ownerPath + "/" + component.getRequiredName(), component, parts);
}

void repairMasslessEnds(ModelDescription& model) {
    // A gram on a radius of gyration of a centimeter.
    constexpr double kLittleMass = 1e-3, kLittleInertia = 1e-7;
    std::set<std::string> parents;
    for (const Joint& joint : model.joints) parents.insert(joint.parentBody);
    for (const Joint& joint : model.joints) {
        const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                       [&](const Body& each) { return each.name == joint.childBody; });
        const bool isMasslessEnd = body != model.bodies.end() && body->mass == 0.0 && !parents.count(body->name);
        if (!isMasslessEnd || joint.coordinates.empty()) continue;
        body->mass = kLittleMass;
        body->inertia = {kLittleInertia, kLittleInertia, kLittleInertia, 0.0, 0.0, 0.0};
        model.notes.push_back({body->line, "body '" + body->name + "' moves at the end of joint '" + joint.name +
                                               "' without mass; it is given 1 gram"});
    }
}

void readBodies(Element& model, BodyParts& parts) {
    parts.frames.addBody(kGroundName);
    if (const Element ground = model.find("Ground")) readGround(ground, "/ground", parts);
    Element bodySet = model.find("BodySet");
    if (!bodySet) return;
    for (const Element& body : bodySet.getSetMembers()) readBody(body, parts);
}

void readPartsOfBodies(Element& document, const std::vector<std::string>& names, BodyParts& parts) {
    parts.frames.addBody(kGroundName);
    for (const std::string& name : names) parts.frames.addBody(name);
    if (const Element ground = document.find("Ground")) readGround(ground, "/ground", parts);
    Element bodySet = document.find("BodySet");
    if (!bodySet) return;
    std::set<std::string> seen;
    for (const Element& body : bodySet.getSetMembers()) readPartsOfBody(body, names, seen, parts);
}

}  // namespace tautline::models
