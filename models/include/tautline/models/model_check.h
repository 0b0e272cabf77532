// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tautline/models/path_study.h"

namespace tautline::models {

/** One obstacle of a path over the poses of a check; each number counts poses. */
struct CheckedObstacle {
    std::string name;
    std::string shape;  ///< "cylinder", "ellipsoid", ...
    int segment = 0;    ///< between points `segment` and `segment + 1` of the path, counted from 1
    int numTouched = 0;
    /** A point beside it lies inside it. */
    int numEntered = 0;
    /** OpenSim's rules pass it over: the path would touch a cylinder beyond its ends, or a one-sided object engages on
    another segment. */
    int numPassedOver = 0;
};

/** Something that OpenSim does otherwise at an obstacle, so that lengths differ. */
struct CheckedDeviation {
    enum class Kind {
        /** The path passes an object on several segments at once; in OpenSim it does so on one, and goes through it on
        the others. */
        SeveralSegments,
        /** In OpenSim a path over an ellipsoid lies in a plane; here it is a geodesic. Estimated with the plane through
        the ends and the place nearest to the middle of the straight line. */
        PlaneSection,
    };
    Kind kind;
    std::string obstacle;
    int numPoses = 0;     ///< in which lengths differ by more than 1e-6 m
    double byLength = 0;  ///< by how much the length here is more, or less if negative, where that is most [m]
    std::string where;    ///< the coordinates there
};

/** A muscle at rest, at its default activation, over the poses of a check. Fiber lengths in optimal ones. */
struct CheckedMuscle {
    double shortestFiber = 0, longestFiber = 0;
    std::string longestAt;          ///< coordinates
    double largestTendonForce = 0;  ///< in maximal isometric forces
    int numTooShort = 0;            ///< the path is too short for it: the fiber is at its shortest
    /** Beyond this length curves are only continued, not measured. */
    static constexpr double kLongFiber = 1.6;

    bool canBeTooLong() const { return longestFiber > kLongFiber; }
};

struct CheckedPath {
    std::string name;
    std::string type;  ///< of its owner in the file
    int numPoints = 0;
    double shortest = 0, longest = 0;  ///< [m]
    int numUnsound = 0;                ///< poses without a verified shortest path on the sides that are asked for
    std::string firstFault;            ///< of those, with its coordinates
    std::vector<CheckedObstacle> obstacles;
    std::vector<CheckedDeviation> deviations;
    std::optional<CheckedMuscle> muscle;
};

struct ModelCheck {
    int numPoses = 0;
    int numBrokenConstraints = 0;  ///< poses in which constraints cannot be met; they do not count for paths
    std::vector<CheckedPath> paths;
};

/** Solves all paths of a model over the ranges of its coordinates: in its default pose, along each free coordinate
alone, and in random poses, the same at each call.
@param reportProgress   called with the share done, 0 to 1; may be null */
ModelCheck checkModel(const ModelDescription& description, const std::function<void(double)>& reportProgress = nullptr);

}  // namespace tautline::models
