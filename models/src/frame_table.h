// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>

#include "element.h"

namespace tautline::models {

/** The pose of a frame from its origin and the body-fixed x-y-z angles that turn it: R = Rx Ry Rz. */
Pose makePose(const Vec3& origin, const Vec3& bodyFixedXyz);

/** A frame fixed to a body. */
struct BodyFrame {
    std::string body;
    Pose X_BF;
};

/** The bodies and offset frames of a model by their absolute paths, such as /jointset/knee/femur. */
class FrameTable {
public:
    void addBody(const std::string& name);
    /** @param path of the offset frame itself. Reads the whole element but its wrap objects. */
    void addOffsetFrame(const std::string& path, Element element);

    /** @param socket   an element whose text is a path: absolute, relative to `owner`, or the bare name of a body.
    @param owner    absolute path of the component that the socket belongs to. */
    BodyFrame resolve(const Element& socket, const std::string& owner) const;
    /** The same for an element that names a body, or the ground. */
    std::string resolveBody(const Element& bodyName) const;

private:
    struct OffsetFrame {
        std::string path;
        Element parentSocket;
        Pose X_PF;
    };

    BodyFrame resolveAtDepth(const Element& socket, const std::string& owner, int depth) const;
    bool hasBody(const std::string& name) const { return m_bodies.count(name) > 0; }

    std::map<std::string, std::string> m_bodies;  ///< name -> path
    std::map<std::string, std::string> m_bodyOfPath;
    std::map<std::string, OffsetFrame> m_offsetFrames;
};

}  // namespace tautline::models
