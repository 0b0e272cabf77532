// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <map>
#include <string>

#include "element.h"

namespace tautline::models {

/** The pose of a frame from its origin and the body-fixed x-y-z angles that turn it: R = Rx Ry Rz. */
Pose makePose(const Vector3& origin, const Vector3& bodyFixedXyz);

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
    /** A frame whose origin and axes are given by stations. */
    void addStationFrame(const std::string& path, Element element);
    /** A named point: a station or a marker. */
    void addStation(const std::string& path, Element element);

    /** @param socket   an element whose text is a path: absolute, relative to `owner`, or the bare name of a body.
    @param owner    absolute path of the component that the socket belongs to. */
    BodyFrame resolve(const Element& socket, const std::string& owner) const;
    /** The same for an element that names a body, or the ground. */
    std::string resolveBody(const Element& bodyName) const;
    /** The frame at an absolute path; its body is empty if there is none. */
    BodyFrame resolvePath(const std::string& path) const;

private:
    struct OffsetFrame {
        std::string path;
        Element parentSocket;
        Pose X_PF;
    };
    /** Axis `alongAB` (0, 1, 2) points from a to b, axis `acrossABC` along ab x ac; either may be reversed. */
    struct StationFrame {
        std::string path;
        std::array<Element, 4> stations;  ///< a, b, c, origin
        int alongAB = 0, acrossABC = 1;
        double signAlong = 1.0, signAcross = 1.0;
    };
    struct Station {
        std::string path;
        Element parentSocket;
        Vector3 location;
    };
    struct BodyPoint {
        std::string body;
        Vector3 location_B;
    };

    BodyFrame resolveAtDepth(const Element& socket, const std::string& owner, int depth) const;
    BodyFrame findAtDepth(const std::string& path, int depth) const;
    BodyFrame calcStationFrame(const StationFrame& frame, int depth) const;
    BodyPoint resolveStation(const Element& socket, const std::string& owner, int depth) const;
    bool hasBody(const std::string& name) const { return m_bodies.count(name) > 0; }

    std::map<std::string, std::string> m_bodies;  ///< name -> path
    std::map<std::string, std::string> m_bodyOfPath;
    std::map<std::string, OffsetFrame> m_offsetFrames;
    std::map<std::string, StationFrame> m_stationFrames;
    std::map<std::string, Station> m_stations;
    /** Frames that have been asked for: chains of them are followed once. */
    mutable std::map<std::string, BodyFrame> m_resolved;
};

}  // namespace tautline::models
