// SPDX-License-Identifier: Apache-2.0
#include "frame_table.h"

#include <cmath>
#include <sstream>
#include <tuple>

namespace tautline::models {
namespace {

/** The absolute path of `path` seen from the component `owner`, without . and .. */
std::string makeAbsolute(const std::string& path, const std::string& owner) {
    std::istringstream steps(path.rfind('/', 0) == 0 ? path : owner + "/" + path);
    std::vector<std::string> names;
    for (std::string step; std::getline(steps, step, '/');) {
        if (step.empty() || step == ".") continue;
        if (step != "..")
            names.push_back(step);
        else if (!names.empty())
            names.pop_back();
    }
    std::string absolute;
    for (const std::string& name : names) absolute += "/" + name;
    return absolute;
}

/** The number and sign of an axis such as +x or -z. */
std::pair<int, double> readAxis(Element& element, const std::string& tag, const std::string& fallback) {
    const Element child = element.find(tag);
    const std::string text = child ? child.getText() : fallback;
    static const std::map<std::string, std::pair<int, double>> kAxes{
        {"+x", {0, 1.0}}, {"+y", {1, 1.0}}, {"+z", {2, 1.0}}, {"-x", {0, -1.0}}, {"-y", {1, -1.0}}, {"-z", {2, -1.0}}};
    const auto axis = kAxes.find(text);
    if (axis == kAxes.end()) child.fail("unknown axis '" + text + "', the " + child.describeField());
    return axis->second;
}

}  // namespace

Pose makePose(const Vector3& origin, const Vector3& bodyFixedXyz) {
    const double cx = std::cos(bodyFixedXyz[0]), sx = std::sin(bodyFixedXyz[0]);
    const double cy = std::cos(bodyFixedXyz[1]), sy = std::sin(bodyFixedXyz[1]);
    const double cz = std::cos(bodyFixedXyz[2]), sz = std::sin(bodyFixedXyz[2]);
    Matrix3 R;
    R << cy * cz, -cy * sz, sy,                                    //
        cx * sz + sx * sy * cz, cx * cz - sx * sy * sz, -sx * cy,  //
        sx * sz - cx * sy * cz, sx * cz + cx * sy * sz, cx * cy;
    return {R, origin};
}

void FrameTable::addBody(const std::string& name) {
    m_bodies[name] = "/bodyset/" + name;
    m_bodyOfPath["/bodyset/" + name] = name;
    if (name == kGroundName) m_bodyOfPath["/ground"] = name;
}

void FrameTable::addOffsetFrame(const std::string& path, Element element) {
    Element parent = element.requireSocket("parent");
    const Vector3 translation = element.getVec3Or("translation", Vector3::Zero());
    const Vector3 orientation = element.getVec3Or("orientation", Vector3::Zero());
    element.skip({"FrameGeometry", "attached_geometry"}, "only drawn");
    element.acceptTag("WrapObjectSet");
    element.refuseUnknown();
    const OffsetFrame frame{path, parent, makePose(translation, orientation)};
    if (!m_offsetFrames.emplace(path, frame).second) element.fail("a second frame " + path);
}

void FrameTable::addStationFrame(const std::string& path, Element element) {
    StationFrame frame{path,
                       {element.requireSocket("point_a"), element.requireSocket("point_b"),
                        element.requireSocket("point_c"), element.requireSocket("origin_point")}};
    std::tie(frame.alongAB, frame.signAlong) = readAxis(element, "ab_axis", "+x");
    std::tie(frame.acrossABC, frame.signAcross) = readAxis(element, "ab_x_ac_axis", "+y");
    if (frame.alongAB == frame.acrossABC) element.fail("both axes of " + element.describe() + " are the same");
    element.skip({"FrameGeometry", "attached_geometry"}, "only drawn");
    element.acceptTag("WrapObjectSet");
    element.refuseUnknown();
    if (!m_stationFrames.emplace(path, frame).second) element.fail("a second frame " + path);
}

void FrameTable::addStation(const std::string& path, Element element) {
    const Element parent = element.requireSocket("parent_frame");
    const Vector3 location = element.getVec3Or("location", Vector3::Zero());
    element.skip({"fixed", "Appearance", "VisibleObject"}, "says nothing about the motion");
    element.refuseUnknown();
    m_stations.emplace(path, Station{path, parent, location});
}

BodyFrame FrameTable::resolve(const Element& socket, const std::string& owner) const {
    return resolveAtDepth(socket, owner, 0);
}

BodyFrame FrameTable::resolvePath(const std::string& path) const {
    return findAtDepth(path, 0);
}

std::string FrameTable::resolveBody(const Element& bodyName) const {
    const std::string name = bodyName.getText();
    if (!hasBody(name)) bodyName.fail("there is no body '" + name + "', the " + bodyName.describeField());
    return name;
}

BodyFrame FrameTable::resolveAtDepth(const Element& socket, const std::string& owner, int depth) const {
    const std::string text = socket.getText();
    // A chain longer than the table must come back to one of its own frames.
    if (depth > static_cast<int>(m_offsetFrames.size() + m_stationFrames.size()))
        socket.fail("the frame '" + text + "' is its own parent");
    const BodyFrame found = findAtDepth(makeAbsolute(text, owner), depth);
    if (!found.body.empty()) return found;
    if (hasBody(text)) return {text, {}};
    // Between 30508 and 40000 the bodies stood beside the joints and not in a set.
    const std::string name = text.substr(text.rfind('/') + 1);
    if (socket.updReading().model.documentVersion < 40000 && hasBody(name)) return {name, {}};
    socket.fail("there is no body or frame '" + text + "', the " + socket.describeField());
}

BodyFrame FrameTable::findAtDepth(const std::string& path, int depth) const {
    const auto body = m_bodyOfPath.find(path);
    if (body != m_bodyOfPath.end()) return {body->second, {}};
    const auto resolved = m_resolved.find(path);
    if (resolved != m_resolved.end()) return resolved->second;
    const auto stationFrame = m_stationFrames.find(path);
    if (stationFrame != m_stationFrames.end()) return m_resolved[path] = calcStationFrame(stationFrame->second, depth);
    const auto frame = m_offsetFrames.find(path);
    if (frame == m_offsetFrames.end()) return {};
    const BodyFrame parent = resolveAtDepth(frame->second.parentSocket, frame->second.path, depth + 1);
    return m_resolved[path] = {parent.body, parent.X_BF * frame->second.X_PF};
}

FrameTable::BodyPoint FrameTable::resolveStation(const Element& socket, const std::string& owner, int depth) const {
    const std::string path = makeAbsolute(socket.getText(), owner);
    const auto station = m_stations.find(path);
    if (station == m_stations.end())
        socket.fail("there is no station '" + socket.getText() + "', the " + socket.describeField());
    const BodyFrame frame = resolveAtDepth(station->second.parentSocket, station->second.path, depth + 1);
    return {frame.body, frame.X_BF * station->second.location};
}

BodyFrame FrameTable::calcStationFrame(const StationFrame& frame, int depth) const {
    std::array<BodyPoint, 4> points;
    for (std::size_t i = 0; i < 4; ++i) {
        points[i] = resolveStation(frame.stations[i], frame.path, depth);
        if (points[i].body != points[0].body)
            frame.stations[i].fail("the stations of the frame " + frame.path + " are on different bodies");
    }
    const Vector3 ab = points[1].location_B - points[0].location_B, ac = points[2].location_B - points[0].location_B;
    const Vector3 across = ab.cross(ac);
    if (across.norm() <= 1e-12 * ab.norm() * ac.norm())
        frame.stations[0].fail("the stations a, b and c of the frame " + frame.path + " lie on a line");
    const int third = 3 - frame.alongAB - frame.acrossABC;
    Matrix3 R;
    R.col(frame.alongAB) = frame.signAlong * ab.normalized();
    R.col(frame.acrossABC) = frame.signAcross * across.normalized();
    R.col(third) = R.col((third + 1) % 3).cross(R.col((third + 2) % 3));
    return {points[0].body, {R, points[3].location_B}};
}

}  // namespace tautline::models
