// SPDX-License-Identifier: Apache-2.0
#include "frame_table.h"

#include <cmath>
#include <sstream>

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

}  // namespace

Pose makePose(const Vec3& origin, const Vec3& bodyFixedXyz) {
    const double cx = std::cos(bodyFixedXyz[0]), sx = std::sin(bodyFixedXyz[0]);
    const double cy = std::cos(bodyFixedXyz[1]), sy = std::sin(bodyFixedXyz[1]);
    const double cz = std::cos(bodyFixedXyz[2]), sz = std::sin(bodyFixedXyz[2]);
    Mat3 R;
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
    Element parent = element.require("socket_parent");
    const Vec3 translation = element.getVec3Or("translation", Vec3::Zero());
    const Vec3 orientation = element.getVec3Or("orientation", Vec3::Zero());
    element.skip({"FrameGeometry", "attached_geometry"}, "only drawn");
    element.acceptTag("WrapObjectSet");
    element.refuseUnknown();
    const OffsetFrame frame{path, parent, makePose(translation, orientation)};
    if (!m_offsetFrames.emplace(path, frame).second) element.fail("a second frame " + path);
}

BodyFrame FrameTable::resolve(const Element& socket, const std::string& owner) const {
    return resolveAtDepth(socket, owner, 0);
}

std::string FrameTable::resolveBody(const Element& bodyName) const {
    const std::string name = bodyName.getText();
    if (!hasBody(name)) bodyName.fail("there is no body '" + name + "', the " + bodyName.describeField());
    return name;
}

BodyFrame FrameTable::resolveAtDepth(const Element& socket, const std::string& owner, int depth) const {
    const std::string text = socket.getText();
    const std::string path = makeAbsolute(text, owner);
    const auto body = m_bodyOfPath.find(path);
    if (body != m_bodyOfPath.end()) return {body->second, {}};
    const auto frame = m_offsetFrames.find(path);
    if (frame == m_offsetFrames.end()) {
        if (hasBody(text)) return {text, {}};
        socket.fail("there is no body or frame '" + text + "', the " + socket.describeField());
    }
    // A chain longer than the table must come back to one of its own frames.
    if (depth > static_cast<int>(m_offsetFrames.size())) socket.fail("the frame '" + text + "' is its own parent");
    const BodyFrame parent = resolveAtDepth(frame->second.parentSocket, frame->second.path, depth + 1);
    return {parent.body, parent.X_BF * frame->second.X_PF};
}

}  // namespace tautline::models
