// SPDX-License-Identifier: Apache-2.0
#include "read_paths.h"

#include <map>

#include "read_constraints.h"
#include "read_functions.h"

namespace tautline::models {
namespace {

BodyFrame resolvePointFrame(Element& element, const FrameTable& frames) {
    const Element socket = element.findAny({"socket_parent_frame", "body"});
    if (!socket) element.fail(element.describe() + " has no socket_parent_frame");
    if (socket.getTag() == "body") return {frames.resolveBody(socket), {}};
    // Relative paths lead from a point in a path in a force up to the model.
    return frames.resolve(socket, "/forceset/force/path/point");
}

ConditionalLocation readCondition(Element& element) {
    const Element coordinate = element.findAny({"socket_coordinate", "coordinate"});
    if (!coordinate) element.fail(element.describe() + " has no socket_coordinate");
    const std::vector<double> range = element.require("range").getNumbers(2);
    return {resolveCoordinate(coordinate).name, {range[0], range[1]}};
}

MovingLocation readMotion(Element& element, const Pose& X_BF) {
    MovingLocation location;
    location.X_BF = X_BF;
    const std::string axes[3] = {"x", "y", "z"}, oldAxes[3] = {"X", "Y", "Z"};
    for (std::size_t i = 0; i < 3; ++i) {
        const Element function = element.findAny({axes[i] + "_location", oldAxes[i] + "Attachment"});
        if (function) location.location_F[i] = requireWrappedFunction(function);
        const Element coordinate = element.findAny({"socket_" + axes[i] + "_coordinate", axes[i] + "_coordinate"});
        if (!coordinate) element.fail(element.describe() + " has no socket_" + axes[i] + "_coordinate");
        const std::string name = resolveCoordinate(coordinate).name;
        if (i > 0 && name != location.coordinate)
            coordinate.fail("the components of " + element.describe() + " move with different coordinates");
        location.coordinate = name;
    }
    return location;
}

PathPoint readPathPoint(Element element, const FrameTable& frames) {
    const std::string tag = element.getTag();
    PathPoint point;
    point.name = element.getName();
    point.line = element.findLine();
    const BodyFrame frame = resolvePointFrame(element, frames);
    point.body = frame.body;
    if (tag == "MovingPathPoint") {
        point.kind = readMotion(element, frame.X_BF);
        element.skip({"location"}, "the location of a moving point is a function");
    } else if (tag == "PathPoint" || tag == "ConditionalPathPoint") {
        point.location = frame.X_BF * element.require("location").getVec3();
        if (tag == "ConditionalPathPoint") point.kind = readCondition(element);
    } else {
        element.fail("unknown path point " + element.describe());
    }
    element.skip({"Appearance", "VisibleObject", "display_preference"}, "only drawn");
    element.refuseUnknown();
    return point;
}

/** Of several objects with one name the first in the order of the bodies is meant. */
std::size_t resolveWrapObject(const Element& name) {
    const auto& wraps = name.updReading().model.wrapObjects;
    for (std::size_t i = 0; i < wraps.size(); ++i)
        if (wraps[i].name == name.getText()) return i;
    name.fail("there is no wrap object '" + name.getText() + "', the " + name.describeField());
}

WrapMethod readMethod(Element& element) {
    static const std::map<std::string, WrapMethod> kMethods{{"", WrapMethod::Hybrid},
                                                            {"Unassigned", WrapMethod::Hybrid},
                                                            {"hybrid", WrapMethod::Hybrid},
                                                            {"midpoint", WrapMethod::Midpoint},
                                                            {"axial", WrapMethod::Axial}};
    const Element child = element.find("method");
    if (!child) return WrapMethod::Hybrid;
    const auto found = kMethods.find(child.getText());
    if (found == kMethods.end()) child.fail("unknown method '" + child.getText() + "' of " + element.describe());
    return found->second;
}

std::array<int, 2> readWrapRange(Element& element, std::size_t points) {
    const Element child = element.find("range");
    if (!child) return {-1, -1};
    const std::vector<double> ends = child.getNumbers(2);
    const auto count = static_cast<double>(points);
    const double first = ends[0] == -1 ? 1 : ends[0], last = ends[1] == -1 ? count : ends[1];
    const bool whole = first == static_cast<int>(first) && last == static_cast<int>(last);
    if (!whole || first < 1 || last > count || first >= last) {
        child.fail("range " + child.getText() + " of " + element.describe() + " is no range of the path's " +
                   std::to_string(points) + " points");
    }
    return {static_cast<int>(ends[0]), static_cast<int>(ends[1])};
}

WrapStart readWrapStart(Element element) {
    WrapStart start;
    start.line = element.findLine();
    start.point = element.require("point").getVec3();
    const Element direction = element.require("direction");
    start.direction = direction.getVec3();
    if (start.direction.isZero(0)) direction.fail("the " + direction.describeField() + " is zero");
    start.length = element.requirePositive("length");
    element.refuseUnknown();
    return start;
}

PathWrap readPathWrap(Element element, std::size_t points) {
    if (element.getTag() != "PathWrap") element.fail("unknown path wrap " + element.describe());
    PathWrap wrap;
    wrap.name = element.getName();
    wrap.line = element.findLine();
    wrap.wrapObject = resolveWrapObject(element.require("wrap_object"));
    wrap.method = readMethod(element);
    wrap.range = readWrapRange(element, points);
    if (const Element hint = element.find("tautline_hint")) wrap.hint = hint.getVec3();
    if (const Element start = element.find("tautline_start")) wrap.start = readWrapStart(start);
    element.refuseUnknown();
    return wrap;
}

MusclePath readPath(Element element, const std::string& owner, const FrameTable& frames) {
    MusclePath path;
    path.line = element.findLine();
    Element points = element.require("PathPointSet");
    for (const Element& point : points.getSetMembers()) path.points.push_back(readPathPoint(point, frames));
    if (path.points.size() < 2) points.fail("the path of " + owner + " has fewer than two points");
    if (Element wraps = element.find("PathWrapSet"))
        for (const Element& wrap : wraps.getSetMembers()) path.wraps.push_back(readPathWrap(wrap, path.points.size()));
    path.areWrapsInOrder = element.getBoolOr("tautline_wraps_in_order", false);
    element.skip({"Appearance", "VisibleObject", "display_preference", "default_color"}, "only drawn");
    element.refuseUnknown();
    return path;
}

}  // namespace

MusclePath readOwnedPath(Element& owner, const FrameTable& frames) {
    for (const char* tag : {"Scholz2015GeometryPath", "FunctionBasedPath"})
        if (const Element other = owner.find(tag))
            other.fail("unknown path " + other.describe() + " of " + owner.describe());
    return readPath(owner.require("GeometryPath"), owner.describe(), frames);
}

}  // namespace tautline::models
