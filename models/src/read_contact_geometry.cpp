// SPDX-License-Identifier: Apache-2.0
#include "read_contact_geometry.h"

#include <map>

namespace tautline::models {
namespace {

using ContactShape = decltype(ContactGeometry::shape);
using ShapeReader = ContactShape (*)(Element&);

ContactShape readEllipsoid(Element& element) {
    const Element radii = element.require("radii");
    const EllipsoidShape shape{radii.getVec3()};
    if (shape.semiAxes.minCoeff() <= 0.0) radii.fail("the " + radii.describeField() + " are not all positive");
    return shape;
}

ContactShape readTorus(Element& element) {
    const TorusShape shape{element.requirePositive("tube_radius"), element.requirePositive("torus_radius")};
    if (shape.tubeRadius >= shape.ringRadius) element.fail(element.describe() + " has no hole");
    return shape;
}

const std::map<std::string, ShapeReader>& getShapeReaders() {
    static const std::map<std::string, ShapeReader> kReaders{
        {"ContactSphere",
         [](Element& element) -> ContactShape { return SphereShape{element.requirePositive("radius")}; }},
        {"ContactCylinder",
         [](Element& element) -> ContactShape { return CylinderShape{element.requirePositive("radius")}; }},
        {"ContactEllipsoid", readEllipsoid},
        {"ContactTorus", readTorus},
        {"ContactHalfSpace", [](Element&) -> ContactShape { return HalfSpaceShape(); }}};
    return kReaders;
}

void readContactGeometry(Element element, const FrameTable& frames) {
    const auto reader = getShapeReaders().find(element.getTag());
    if (reader == getShapeReaders().end()) {
        return element.skipThis("ContactGeometrySet", "acts only through contact forces, which are refused with it",
                                Effect::Forces);
    }
    ContactGeometry geometry;
    geometry.name = element.getRequiredName();
    geometry.line = element.findLine();
    Element socket = element.findSocket("frame");
    if (!socket) socket = element.require("body_name");
    const BodyFrame frame = frames.resolve(socket, "/contactgeometryset/" + geometry.name);
    geometry.body = frame.body;
    geometry.X_BS = frame.X_BF * makePose(element.getVec3Or("location", Vector3::Zero()),
                                          element.getVec3Or("orientation", Vector3::Zero()));
    geometry.shape = reader->second(element);
    element.skip({"Appearance", "display_preference", "color", "VisibleObject"}, "only drawn");
    element.refuseUnknown();
    auto& geometries = element.updReading().model.contactGeometries;
    for (const ContactGeometry& other : geometries)
        if (other.name == geometry.name) element.fail("a second contact geometry '" + geometry.name + "'");
    geometries.push_back(geometry);
}

}  // namespace

void readContactGeometries(Element& model, const FrameTable& frames) {
    Element set = model.find("ContactGeometrySet");
    if (!set) return;
    for (const Element& geometry : set.getSetMembers()) readContactGeometry(geometry, frames);
}

std::optional<std::size_t> findContactGeometry(const ModelDescription& model, const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    for (std::size_t i = 0; i < model.contactGeometries.size(); ++i)
        if (model.contactGeometries[i].name == name) return i;
    return std::nullopt;
}

}  // namespace tautline::models
