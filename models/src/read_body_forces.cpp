// SPDX-License-Identifier: Apache-2.0
#include "read_body_forces.h"

#include <tuple>

#include "read_constraints.h"
#include "read_contact_geometry.h"
#include "read_forces.h"

namespace tautline::models {
namespace {

void keep(Element& element, decltype(BodyForce::law) law) {
    BodyForce force;
    force.name = element.getName();
    force.line = element.findLine();
    force.appliesForce = readAppliesForce(element);
    force.law = std::move(law);
    element.refuseUnknown();
    element.updReading().model.bodyForces.push_back(std::move(force));
}

double getNotNegativeOr(Element& element, const std::string& tag, double fallback) {
    const Element child = element.find(tag);
    const double value = child ? child.getNumber() : fallback;
    if (value < 0.0) child.fail("negative " + child.describeField() + ": " + child.getText());
    return value;
}

/** The coordinate of a force, in any spelling. */
const Coordinate& readCoordinateName(Element& element) {
    Element name = element.findSocket("coordinate");
    if (!name) name = element.findAny({"coordinate", "coordinates"});
    if (!name) element.fail(element.describe() + " has no coordinate");
    return resolveCoordinate(name);
}

/** The frame of one end, with the pose that the old layout gives beside its body's name. */
BodyFrame readEnd(Element& element, const std::string& number, const FrameTable& frames) {
    Element socket = element.findSocket("frame" + number);
    if (!socket) socket = element.find("body_" + number);
    if (!socket) element.fail(element.describe() + " has no socket_frame" + number);
    BodyFrame frame = frames.resolve(socket, "/forceset/" + element.getName());
    frame.X_BF = frame.X_BF * makePose(element.getVec3Or("location_body_" + number, Vector3::Zero()),
                                       element.getVec3Or("orientation_body_" + number, Vector3::Zero()));
    return frame;
}

std::array<double, 6> readSix(Element& element, const std::string& what) {
    std::array<double, 6> six{};
    const Vector3 rotational = element.getVec3Or("rotational_" + what, Vector3::Zero());
    const Vector3 translational = element.getVec3Or("translational_" + what, Vector3::Zero());
    for (int i = 0; i < 3; ++i) {
        six[static_cast<std::size_t>(i)] = rotational[i];
        six[static_cast<std::size_t>(i) + 3] = translational[i];
    }
    return six;
}

/** Points of two bodies, `body1` and `point1` or with sockets. */
std::pair<std::string, Vector3> readSpringEnd(Element& element, const std::string& number, const FrameTable& frames) {
    Element socket = element.findSocket("body" + number);
    if (!socket) socket = element.find("body" + number);
    if (!socket) element.fail(element.describe() + " has no socket_body" + number);
    const BodyFrame frame = frames.resolve(socket, "/forceset/" + element.getName());
    return {frame.body, frame.X_BF * element.getVec3Or("point" + number, Vector3::Zero())};
}

ContactMaterial readMaterial(Element& element, double stiffness, double dissipation) {
    ContactMaterial material;
    material.stiffness = getNotNegativeOr(element, "stiffness", stiffness);
    material.dissipation = getNotNegativeOr(element, "dissipation", dissipation);
    material.staticFriction = getNotNegativeOr(element, "static_friction", 0.0);
    material.dynamicFriction = getNotNegativeOr(element, "dynamic_friction", 0.0);
    material.viscousFriction = getNotNegativeOr(element, "viscous_friction", 0.0);
    return material;
}

template <class Shape>
bool isShape(const ModelDescription& model, std::size_t geometry) {
    return std::holds_alternative<Shape>(model.contactGeometries[geometry].shape);
}

}  // namespace

void readCoordinateLimitForce(Element& element, const FrameTable&) {
    const Coordinate& coordinate = readCoordinateName(element);
    // The file measures angles in degrees, in stiffness and damping as well.
    const double unit = isRotational(element.updReading().model, coordinate.name) ? kPi / 180 : 1.0;
    CoordinateLimitForce force;
    force.coordinate = coordinate.name;
    force.upperLimit = element.getNumberOr("upper_limit", 0.0) * unit;
    force.upperStiffness = getNotNegativeOr(element, "upper_stiffness", 1.0) / unit;
    force.lowerLimit = element.getNumberOr("lower_limit", 0.0) * unit;
    force.lowerStiffness = getNotNegativeOr(element, "lower_stiffness", 1.0) / unit;
    force.damping = getNotNegativeOr(element, "damping", 0.001) / unit;
    force.transition = element.find("transition") ? element.requirePositive("transition") * unit : 0.1 * unit;
    element.skip({"compute_dissipation_energy"}, "only measures the motion");
    keep(element, force);
}

void readCoordinateSpring(Element& element, const FrameTable&) {
    CoordinateSpringForce force;
    force.coordinate = readCoordinateName(element).name;
    force.stiffness = element.getNumberOr("stiffness", 0.0);
    force.restLength = element.getNumberOr("rest_length", 0.0);
    force.viscosity = getNotNegativeOr(element, "viscosity", 0.0);
    keep(element, force);
}

void readBushing(Element& element, const FrameTable& frames) {
    const BodyFrame frame1 = readEnd(element, "1", frames);
    const BodyFrame frame2 = readEnd(element, "2", frames);
    element.acceptTag("frames");
    keep(element, BushingForce{frame1.body, frame1.X_BF, frame2.body, frame2.X_BF, readSix(element, "stiffness"),
                               readSix(element, "damping")});
}

void readPointToPointSpring(Element& element, const FrameTable& frames) {
    PointToPointSpring force;
    std::tie(force.body1, force.point1) = readSpringEnd(element, "1", frames);
    std::tie(force.body2, force.point2) = readSpringEnd(element, "2", frames);
    force.stiffness = getNotNegativeOr(element, "stiffness", 1.0);
    force.restLength = getNotNegativeOr(element, "rest_length", 0.0);
    keep(element, force);
}

void readCoordinateActuator(Element& element, const FrameTable&) {
    CoordinateActuator actuator;
    actuator.coordinate = readCoordinateName(element).name;
    actuator.optimalForce = element.getNumberOr("optimal_force", 1.0);
    actuator.controlRange = readControlRange(element);
    if (element.getTag() == "ActivationCoordinateActuator") {
        constexpr double kActivationTime = 0.01, kDefaultActivation = 0.5;
        actuator.activationTime = element.find("activation_time_constant")
                                      ? element.requirePositive("activation_time_constant")
                                      : kActivationTime;
        actuator.defaultActivation = element.getNumberOr("default_activation", kDefaultActivation);
    }
    keep(element, actuator);
}

void readHuntCrossley(Element& element, const FrameTable&) {
    HuntCrossleyContact contact;
    const ModelDescription& model = element.updReading().model;
    Element set = element.findAny({"HuntCrossleyForce::ContactParametersSet", "contact_parameters"});
    if (!set) element.fail(element.describe() + " has no contact parameters");
    for (Element parameters : set.getSetMembers()) {
        const ContactMaterial material = readMaterial(parameters, 0.0, 0.0);
        const Element names = parameters.require("geometry");
        for (const std::string& name : names.getWords()) {
            const std::optional<std::size_t> geometry = findContactGeometry(model, name);
            if (!geometry || !(isShape<SphereShape>(model, *geometry) || isShape<HalfSpaceShape>(model, *geometry)))
                return element.refuse("contact of other surfaces than spheres and half spaces", Effect::Forces);
            contact.surfaces.push_back({*geometry, material});
        }
        parameters.refuseUnknown();
    }
    contact.transitionVelocity =
        element.find("transition_velocity") ? element.requirePositive("transition_velocity") : 0.01;
    keep(element, contact);
}

void readSmoothSphere(Element& element, const FrameTable&) {
    const ModelDescription& model = element.updReading().model;
    const Element sphereSocket = element.requireSocket("sphere"), planeSocket = element.requireSocket("half_space");
    const auto sphere = findContactGeometry(model, sphereSocket.getText());
    const auto halfSpace = findContactGeometry(model, planeSocket.getText());
    if (!sphere || !isShape<SphereShape>(model, *sphere))
        sphereSocket.fail("there is no contact sphere '" + sphereSocket.getText() + "', the " +
                          sphereSocket.describeField());
    if (!halfSpace || !isShape<HalfSpaceShape>(model, *halfSpace))
        planeSocket.fail("there is no half space '" + planeSocket.getText() + "', the " + planeSocket.describeField());
    SmoothSphereContact contact;
    contact.sphere = *sphere;
    contact.halfSpace = *halfSpace;
    contact.material = readMaterial(element, 1.0, 0.0);
    const auto readPositive = [&](const std::string& tag, double& value) {
        if (element.find(tag)) value = element.requirePositive(tag);
    };
    readPositive("transition_velocity", contact.transitionVelocity);
    readPositive("constant_contact_force", contact.constantContactForce);
    readPositive("hertz_smoothing", contact.hertzSmoothing);
    readPositive("hunt_crossley_smoothing", contact.huntCrossleySmoothing);
    element.skip({"force_visualization_scale_factor", "force_visualization_radius"}, "only drawn");
    keep(element, contact);
}

}  // namespace tautline::models
