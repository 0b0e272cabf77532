#include "frame_table.h"

#include <sstream>

namespace tautline::models {

namespace {

/** The absolute path of `path` seen from the component `owner`, without . and .. */
std::string makeAbsolute(const std::string& path, const std::string& owner) {
    std::istringstream steps(path.rfind('/', 0) == 0 ? path : owner + "/" + path);
    std::vector<std::string> names;
    for (std::string step; std::getline(steps, step, '/');) {
        if (step.empty() || step == ".") continue;
        if (step != "..") {
            names.push_back(step);
        } else if (!names.empty()) {
            names.pop_back();
        }
    }
    std::string absolute;
    for (const std::string& name : names) absolute += "/" + name;
    return absolute;
}

}  // namespace

void FrameTable::addBody(const std::string& name) {
    m_bodies[name] = "/bodyset/" + name;
    m_bodyOfPath["/bodyset/" + name] = name;
    if (name == groundName) m_bodyOfPath["/ground"] = name;
}

void FrameTable::addOffsetFrame(const std::string& path, Element element) {
    Element parent = element.require("socket_parent");
    const Triple translation = element.getTripleOr("translation", {});
    const Triple orientation = element.getTripleOr("orientation", {});
    element.skip({"FrameGeometry", "attached_geometry"}, "only drawn");
    element.acceptTag("WrapObjectSet");
    element.refuseUnknown();
    const OffsetFrame frame{path, parent, makeRigidOffset(translation, orientation)};
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
    if (depth > static_cast<int>(m_offsetFrames.size())) {
        socket.fail("the frame '" + text + "' is its own parent");
    }
    const BodyFrame parent = resolveAtDepth(frame->second.parentSocket, frame->second.path, depth + 1);
    return {parent.body, compose(parent.X_BF, frame->second.X_PF)};
}

}  // namespace tautline::models
