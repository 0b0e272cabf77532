// SPDX-License-Identifier: Apache-2.0
#include "read_constraints.h"

#include <tuple>

#include "read_functions.h"

namespace tautline::models {
namespace {

CoordinateCoupler readCoupler(Element& element) {
    CoordinateCoupler coupler;
    coupler.name = element.getName();
    coupler.line = element.findLine();
    const Element independent = element.require("independent_coordinate_names");
    const Element dependent = element.require("dependent_coordinate_name");
    coupler.independentCoordinate = resolveCoordinate(independent).name;
    coupler.dependentCoordinate = resolveCoordinate(dependent).name;
    if (coupler.independentCoordinate == coupler.dependentCoordinate)
        dependent.fail(element.describe() + " couples '" + coupler.dependentCoordinate + "' to itself");
    coupler.function = requireWrappedFunction(element.require("coupled_coordinates_function"));
    coupler.scaleFactor = element.getNumberOr("scale_factor", 1.0);
    return coupler;
}

/** The body of a point constraint and its point, from the frame that the file names. */
std::pair<std::string, Vec3> readBodyPoint(Element& element, const std::string& number, const FrameTable& frames) {
    Element socket = element.findAny({"socket_body_" + number, "body_" + number});
    if (!socket) element.fail(element.describe() + " has no socket_body_" + number);
    const BodyFrame frame = frames.resolve(socket, "/constraintset/" + element.getName());
    const Vec3 location = element.getVec3Or("location_body_" + number, Vec3::Zero());
    return {frame.body, frame.X_BF * location};
}

PointConstraint readPointConstraint(Element& element, const FrameTable& frames) {
    PointConstraint constraint;
    constraint.name = element.getName();
    constraint.line = element.findLine();
    std::tie(constraint.body1, constraint.location1) = readBodyPoint(element, "1", frames);
    std::tie(constraint.body2, constraint.location2) = readBodyPoint(element, "2", frames);
    if (constraint.body1 == constraint.body2)
        element.fail(element.describe() + " holds body '" + constraint.body1 + "' to itself");
    return constraint;
}

bool isEnforced(Element& element) {
    const Element enforced = element.find("isEnforced");
    const Element disabled = element.find("isDisabled");
    return (!enforced || enforced.getBool()) && !(disabled && disabled.getBool());
}

void readConstraint(Element element, const FrameTable& frames) {
    const std::string tag = element.getTag();
    const bool enforced = isEnforced(element);
    ModelConstraint constraint;
    if (tag == "CoordinateCouplerConstraint")
        constraint = readCoupler(element);
    else if (tag == "PointConstraint")
        constraint = readPointConstraint(element, frames);
    else
        element.fail("unknown constraint " + element.describe());
    element.refuseUnknown();
    if (enforced)
        element.updReading().model.constraints.push_back(constraint);
    else
        element.skipThis("ConstraintSet", "not enforced");
}

}  // namespace

const Coordinate& resolveCoordinate(const Element& socket) {
    const std::string path = socket.getText();
    const std::string name = path.substr(path.rfind('/') + 1);
    const Coordinate* coordinate = findCoordinate(socket.updReading().model, name);
    if (!coordinate) socket.fail("there is no coordinate '" + path + "', the " + socket.describeField());
    return *coordinate;
}

void readConstraints(Element& model, const FrameTable& frames) {
    Element set = model.find("ConstraintSet");
    if (!set) return;
    for (const Element& constraint : set.getSetMembers()) readConstraint(constraint, frames);
}

}  // namespace tautline::models
