// SPDX-License-Identifier: Apache-2.0
#include "read_paths.h"

#include <algorithm>
#include <map>
#include <type_traits>

#include "read_constraints.h"
#include "read_contact_geometry.h"
#include "read_functions.h"

namespace tautline::models {
namespace {

BodyFrame resolvePointFrame(Element& element, const FrameTable& frames) {
    Element socket = element.findSocket("parent_frame");
    if (!socket) socket = element.find("body");
    if (!socket) element.fail(element.describe() + " has no socket_parent_frame");
    if (socket.getTag() == "body") return {frames.resolveBody(socket), {}};
    // Relative paths lead from a point in a path in a force up to the model.
    return frames.resolve(socket, "/forceset/force/path/point");
}

ConditionalLocation readCondition(Element& element) {
    Element coordinate = element.findSocket("coordinate");
    if (!coordinate) coordinate = element.find("coordinate");
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
        Element coordinate = element.findSocket(axes[i] + "_coordinate");
        if (!coordinate) coordinate = element.find(axes[i] + "_coordinate");
        if (!coordinate) element.fail(element.describe() + " has no socket_" + axes[i] + "_coordinate");
        const std::string name = resolveCoordinate(coordinate).name;
        if (i > 0 && name != location.coordinate)
            coordinate.fail("the components of " + element.describe() + " move with different coordinates");
        location.coordinate = name;
    }
    return location;
}

enum class PointKind { Fixed, Conditional, Moving };

/** The tags of points, old ones among them. */
const std::map<std::string, PointKind>& getPointKinds() {
    static const std::map<std::string, PointKind> kKinds{{"PathPoint", PointKind::Fixed},
                                                         {"MusclePoint", PointKind::Fixed},
                                                         {"ConditionalPathPoint", PointKind::Conditional},
                                                         {"MuscleViaPoint", PointKind::Conditional},
                                                         {"ConditionalMuscleViaPoint", PointKind::Conditional},
                                                         {"MovingPathPoint", PointKind::Moving},
                                                         {"MovingMusclePoint", PointKind::Moving}};
    return kKinds;
}

PathPoint readPathPoint(Element element, PointKind kind, const FrameTable& frames) {
    PathPoint point;
    point.name = element.getName();
    point.line = element.findLine();
    const BodyFrame frame = resolvePointFrame(element, frames);
    point.body = frame.body;
    if (kind == PointKind::Moving) {
        point.kind = readMotion(element, frame.X_BF);
        element.skip({"location"}, "the location of a moving point is a function");
    } else {
        point.location = frame.X_BF * element.require("location").getVec3();
    }
    if (kind == PointKind::Conditional) point.kind = readCondition(element);
    element.skip({"Appearance", "VisibleObject", "display_preference"}, "only drawn");
    element.refuseUnknown();
    return point;
}

/** Two points of one name are told apart by a number. */
void makeNameUnique(const Element& element, const std::vector<PathPoint>& others, PathPoint& point) {
    const auto isTaken = [&](const std::string& name) {
        return std::any_of(others.begin(), others.end(), [&](const PathPoint& other) { return other.name == name; });
    };
    if (point.name.empty() || !isTaken(point.name)) return;
    const std::string name = point.name;
    for (int number = 2; isTaken(point.name); ++number) point.name = name + "_" + std::to_string(number);
    element.note("a second point '" + name + "' in one path; it is called '" + point.name + "'");
}

/** Of several objects with one name the first in the order of the bodies is meant. */
std::size_t resolveWrapObject(const Element& name) {
    const auto& wraps = name.updReading().model.wrapObjects;
    for (std::size_t i = 0; i < wraps.size(); ++i)
        if (wraps[i].name == name.getText() && !wraps[i].isContactGeometry) return i;
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
    if (found->second != WrapMethod::Hybrid)
        child.skipThis("PathWrap", "chooses the plane of an approximation, but the path is a geodesic");
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

/** The members of a set in any spelling. */
std::vector<Element> getMembers(Element& path, const std::vector<std::string>& setTags) {
    Element set = path.findAny(setTags);
    return set ? set.getSetMembers() : std::vector<Element>();
}

void requireTwoPoints(const Element& element, std::size_t numPoints, const std::string& owner) {
    if (numPoints < 2) element.fail("the path of " + owner + " has fewer than two points");
}

MusclePath readGeometryPath(Element& element, const std::string& owner, const FrameTable& frames) {
    MusclePath path;
    const std::vector<Element> points = getMembers(element, {"PathPointSet", "MusclePointSet"});
    requireTwoPoints(element, points.size(), owner);
    for (const Element& member : points) {
        const auto kind = getPointKinds().find(member.getTag());
        if (kind == getPointKinds().end()) {
            member.refuse("path point", Effect::Motion);
            continue;
        }
        PathPoint point = readPathPoint(member, kind->second, frames);
        makeNameUnique(member, path.points, point);
        path.points.push_back(std::move(point));
    }
    for (const Element& member : getMembers(element, {"PathWrapSet", "MuscleWrapSet"})) {
        if (member.getTag() == "PathWrap" || member.getTag() == "MuscleWrap")
            path.wraps.push_back(readPathWrap(member, points.size()));
        else
            member.refuse("path wrap", Effect::Motion);
    }
    path.areWrapsInOrder = element.getBoolOr("tautline_wraps_in_order", false);
    return path;
}

/** The wrap object that stands for a contact geometry, made once. */
std::size_t makeWrapObject(ModelDescription& model, const ContactGeometry& geometry, const WrapShape& shape) {
    for (std::size_t i = 0; i < model.wrapObjects.size(); ++i)
        if (model.wrapObjects[i].isContactGeometry && model.wrapObjects[i].name == geometry.name) return i;
    WrapObject object;
    object.name = geometry.name;
    object.body = geometry.body;
    object.X_BW = geometry.X_BS;
    object.shape = shape;
    object.isContactGeometry = true;
    object.line = geometry.line;
    model.wrapObjects.push_back(object);
    return model.wrapObjects.size() - 1;
}

/** A hint of NaN is none. */
std::optional<Vector3> readContactHint(Element& element) {
    const Element hint = element.find("contact_hint");
    if (!hint || hint.getText().find_first_of("nN") != std::string::npos) return std::nullopt;
    return hint.getVec3();
}

/** An obstacle on the segment after the last of so many points. */
PathWrap readObstacle(Element& element, std::size_t numPoints) {
    const Element socket = element.requireSocket("contact_geometry");
    ModelDescription& model = element.updReading().model;
    const std::optional<std::size_t> found = findContactGeometry(model, socket.getText());
    if (!found) socket.fail("there is no contact geometry '" + socket.getText() + "', the " + socket.describeField());
    PathWrap wrap;
    wrap.name = element.getName();
    wrap.line = element.findLine();
    const ContactGeometry geometry = model.contactGeometries[*found];
    std::visit(
        [&](const auto& shape) {
            if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, HalfSpaceShape>)
                socket.fail("a path cannot bend over the half space '" + geometry.name + "', the " +
                            socket.describeField());
            else
                wrap.wrapObject = makeWrapObject(model, geometry, shape);
        },
        geometry.shape);
    wrap.hint = readContactHint(element);
    wrap.range = {static_cast<int>(numPoints), static_cast<int>(numPoints) + 1};
    element.refuseUnknown();
    return wrap;
}

/** The path of Scholz et al. (2015): points and obstacles in the order in which the path passes them. */
MusclePath readScholzPath(Element& element, const std::string& owner, const FrameTable& frames) {
    MusclePath path;
    path.areWrapsInOrder = true;
    const Element elements = element.require("path_elements");
    const std::vector<Element> members = elements.getChildren();
    for (std::size_t i = 0; i < members.size(); ++i) {
        Element member = members[i];
        const bool isPoint = member.getTag() == "Scholz2015GeometryPathPoint";
        if (!isPoint && member.getTag() != "Scholz2015GeometryPathObstacle") {
            member.refuse("path element", Effect::Motion);
            continue;
        }
        const bool isEnd = i == 0 || i + 1 == members.size();
        if (isEnd && !isPoint) member.fail("the path of " + owner + " has an obstacle at its end");
        if (!isPoint) {
            path.wraps.push_back(readObstacle(member, path.points.size()));
            continue;
        }
        const Element station = member.require("PathPoint");
        PathPoint point = readPathPoint(station, PointKind::Fixed, frames);
        point.name = member.getName();
        makeNameUnique(member, path.points, point);
        path.points.push_back(std::move(point));
        member.refuseUnknown();
    }
    requireTwoPoints(element, path.points.size(), owner);
    element.skip(
        {"use_warm_start", "algorithm", "curve_segment_accuracy", "smoothness_tolerance", "solver_max_iterations"},
        "how another solver finds the same path");
    return path;
}

std::vector<MultivariateFunction> readFunctionList(Element& element, const std::string& tag, std::size_t numArguments) {
    std::vector<MultivariateFunction> functions;
    if (const Element list = element.find(tag))
        for (const Element& function : list.getChildren()) functions.push_back(readFunction(function, numArguments));
    return functions;
}

MusclePath readFunctionPath(Element& element, const std::string& owner, const FrameTable&) {
    PathFunctions functions;
    const Element coordinates = element.findAny({"coordinate_paths", "coordinates"});
    if (!coordinates) element.fail("the path of " + owner + " has no coordinate_paths");
    for (const std::string& path : coordinates.getWords())
        functions.coordinates.push_back(resolveCoordinate(coordinates, path).name);
    const std::size_t count = functions.coordinates.size();
    if (count == 0) coordinates.fail("the path of " + owner + " depends on no coordinate");
    functions.length = requireWrappedFunction(element.require("length_function"), count);
    functions.momentArms = readFunctionList(element, "moment_arm_functions", count);
    if (!functions.momentArms.empty() && functions.momentArms.size() != count)
        element.fail("the path of " + owner + " has " + std::to_string(functions.momentArms.size()) +
                     " moment arms for " + std::to_string(count) + " coordinates");
    if (const Element speed = element.findAny({"lengthening_speed_function", "speed_function"}))
        if (!speed.getChildren().empty()) functions.lengtheningSpeed = requireWrappedFunction(speed, 2 * count);
    element.skipThis("Model", "its length is evaluated, but nothing pulls along it", Effect::Forces);
    MusclePath path;
    path.functions = std::move(functions);
    return path;
}

using PathReader = MusclePath (*)(Element&, const std::string& owner, const FrameTable&);

const std::map<std::string, PathReader>& getPathReaders() {
    static const std::map<std::string, PathReader> kReaders{{"GeometryPath", readGeometryPath},
                                                            {"Scholz2015GeometryPath", readScholzPath},
                                                            {"FunctionBasedPath", readFunctionPath}};
    return kReaders;
}

}  // namespace

MusclePath readPath(Element element, const std::string& owner, const FrameTable& frames) {
    MusclePath path = getPathReaders().at(element.getTag())(element, owner, frames);
    path.line = element.findLine();
    element.skip({"Appearance", "VisibleObject", "display_preference", "default_color"}, "only drawn");
    element.refuseUnknown();
    return path;
}

MusclePath readOwnedPath(Element& owner, const FrameTable& frames) {
    std::vector<std::string> tags;
    for (const auto& [tag, reader] : getPathReaders()) tags.push_back(tag);
    const Element path = owner.findAny(tags);
    if (!path) owner.fail(owner.describe() + " has no GeometryPath");
    return readPath(path, owner.describe(), frames);
}

}  // namespace tautline::models
