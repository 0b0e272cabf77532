// SPDX-License-Identifier: Apache-2.0
#include "read_wrap_objects.h"

#include <map>

namespace tautline::models {
namespace {

Quadrant readQuadrant(Element& element) {
    static const std::map<std::string, Quadrant> kQuadrants{
        {"", Quadrant::All},      {"all", Quadrant::All},   {"Unassigned", Quadrant::All}, {"x", Quadrant::PlusX},
        {"+x", Quadrant::PlusX},  {"-x", Quadrant::MinusX}, {"y", Quadrant::PlusY},        {"+y", Quadrant::PlusY},
        {"-y", Quadrant::MinusY}, {"z", Quadrant::PlusZ},   {"+z", Quadrant::PlusZ},       {"-z", Quadrant::MinusZ}};
    const Element child = element.find("quadrant");
    if (!child) return Quadrant::All;
    const auto found = kQuadrants.find(child.getText());
    if (found == kQuadrants.end()) child.fail("unknown quadrant '" + child.getText() + "' of " + element.describe());
    return found->second;
}

EllipsoidShape readEllipsoid(Element& element) {
    const Element dimensions = element.require("dimensions");
    const EllipsoidShape shape{dimensions.getVec3()};
    for (double semiAxis : shape.semiAxes) {
        if (semiAxis <= 0.0) {
            dimensions.fail("dimensions of " + element.describe() + " are " + dimensions.getText() +
                            ", not all positive");
        }
    }
    return shape;
}

TorusShape readTorus(Element& element) {
    const TorusShape shape{element.requirePositive("inner_radius"), element.requirePositive("outer_radius")};
    if (shape.tubeRadius >= shape.ringRadius) element.fail(element.describe() + " has no hole");
    return shape;
}

ParaboloidShape readParaboloid(Element& element) {
    return {element.requirePositive("a"), element.requirePositive("b")};
}

EllipticTorusShape readEllipticTorus(Element& element) {
    const EllipticTorusShape shape{element.requirePositive("ring_radius"), element.requirePositive("radial_semi_axis"),
                                   element.requirePositive("axial_semi_axis")};
    if (shape.radialSemiAxis >= shape.ringRadius) element.fail(element.describe() + " has no hole");
    return shape;
}

SurfaceForm readForm(Element& element) {
    const Element child = element.find("tautline_form");
    if (!child || child.getText() == "implicit") return SurfaceForm::Implicit;
    if (child.getText() != "parametric") {
        child.fail("unknown tautline_form '" + child.getText() + "' of " + element.describe() +
                   ": implicit or parametric");
    }
    return SurfaceForm::Parametric;
}

void readShape(Element& element, WrapObject& wrap) {
    const std::string tag = element.getTag();
    if (tag == "WrapCylinder")
        wrap.shape = CylinderShape{element.requirePositive("radius"), element.requirePositive("length")};
    else if (tag == "WrapSphere")
        wrap.shape = SphereShape{element.requirePositive("radius")};
    else if (tag == "WrapEllipsoid")
        wrap.shape = readEllipsoid(element);
    else if (tag == "WrapTorus")
        wrap.shape = readTorus(element);
    else if (tag == "TautlineWrapParaboloid")
        wrap.shape = readParaboloid(element);
    else if (tag == "TautlineWrapEllipticTorus")
        wrap.shape = readEllipticTorus(element);
    else
        element.fail("unknown wrap object " + element.describe());
}

void checkUnique(const Element& element, const WrapObject& wrap, const ModelDescription& model) {
    for (const WrapObject& other : model.wrapObjects)
        if (other.name == wrap.name && other.body == wrap.body)
            element.fail("a second wrap object '" + wrap.name + "' of body '" + wrap.body + "'");
}

void readWrapObject(Element element, const BodyFrame& owner) {
    WrapObject wrap;
    wrap.name = element.getRequiredName();
    wrap.line = element.findLine();
    wrap.body = owner.body;
    readShape(element, wrap);
    wrap.form = readForm(element);
    const Vec3 translation = element.getVec3Or("translation", Vec3::Zero());
    const Vec3 rotation = element.getVec3Or("xyz_body_rotation", Vec3::Zero());
    wrap.X_BW = owner.X_BF * makePose(translation, rotation);
    wrap.quadrant = readQuadrant(element);
    wrap.active = element.getBoolOr("active", true);
    element.skip({"Appearance", "VisibleObject", "display_preference", "color", "FrameGeometry"}, "only drawn");
    element.refuseUnknown();
    auto& model = element.updReading().model;
    checkUnique(element, wrap, model);
    model.wrapObjects.push_back(wrap);
}

BodyFrame findOwner(const FrameElement& owner, const FrameTable& frames) {
    Element element = owner.element;
    if (element.getTag() != "PhysicalOffsetFrame")
        return {owner.path == "/ground" ? kGroundName : element.getName(), {}};
    const Element parent = element.require("socket_parent");
    const BodyFrame base = frames.resolve(parent, owner.path);
    const Vec3 translation = element.getVec3Or("translation", Vec3::Zero());
    const Vec3 orientation = element.getVec3Or("orientation", Vec3::Zero());
    return {base.body, base.X_BF * makePose(translation, orientation)};
}

}  // namespace

void readWrapObjects(const BodyParts& parts) {
    for (const FrameElement& owner : parts.wrapOwners) {
        Element element = owner.element;
        Element set = element.find("WrapObjectSet");
        if (!set) continue;
        for (const Element& wrap : set.getSetMembers()) readWrapObject(wrap, findOwner(owner, parts.frames));
    }
}

}  // namespace tautline::models
