// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tautline/models/model_description.h"
#include "tautline/models/wrap_binding.h"
#include "tautline/paths/parallel_blocks.h"
#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"

namespace tautline::models {

/** Values [rad or m] and speeds of coordinates by name. Coordinates that are not named stand at their defaults, driven
ones where their motion has them at `time`; their speeds are 0, those of driven ones as their motion says. */
struct ModelPose {
    double time = 0.0;  ///< [s]
    std::map<std::string, double> values;
    std::map<std::string, double> speeds;
};

/** What a path does at one of its obstacles. */
struct ObstacleAnswer {
    bool isTouched = false;
    int numArcs = 0;             ///< more than 1 where the path bridges hollows of the surface
    bool isSwitchedOff = false;  ///< a point beside it lies inside it, as OpenSim switches it off
    double arcLength = 0.0;      ///< of all arcs together [m]
};

/** A path in one pose. Always finite, whatever the status, but for effective arms. */
struct PathAnswer {
    double length = 0.0;  ///< [m]
    double rate = 0.0;    ///< lengthening speed [m/s]
    PathStatus status = PathStatus::NotConverged;
    /** Whether it passes its obstacles as quadrants, rings and hints ask. */
    RouteDeviation::Kind deviation = RouteDeviation::Kind::None;
    std::string explanation;                ///< why it is not solved or not as asked; empty if it is both
    std::vector<ObstacleAnswer> obstacles;  ///< in the order of StudiedPath::obstacles
    /** As CoordinateCoupling defines them, in the order of StudiedPath::coordinates; an effective one is NaN where
    constraints hold the coordinate. */
    std::vector<double> geometricArms, effectiveArms;

    bool followsHints() const { return deviation == RouteDeviation::Kind::None; }
    /** False if it passes an obstacle on another side than its quadrant asks, or a ring outside its hole, where OpenSim
    would not let it. An ellipsoid or a sphere that is clear of the path is on no side, as in OpenSim, and the point of
    a hint is where a path begins, no demand. */
    bool keepsSides = true;
    /** Whether the path is a verified shortest one; objects that a point has entered are switched off as in OpenSim. */
    bool isSound() const { return (status == PathStatus::Solved || status == PathStatus::EndInside) && keepsSides; }
};

/** A model in one pose. */
struct PoseAnswer {
    /** Of all coordinates as they stand once the constraints hold, in the order of PathStudy::getCoordinateNames(). */
    std::vector<double> values, speeds;
    /** Why the constraints do not hold; empty if they do. */
    std::string constraintFault;
    std::vector<PathAnswer> paths;  ///< in the order of PathStudy::getPaths()
};

/** A path of a model as results name it. */
struct StudiedPath {
    std::string name;
    std::string path;  ///< "/forceset/<name>"
    std::vector<std::string> obstacles;
    std::vector<std::string> coordinates;  ///< findCrossedCoordinates()
    std::vector<BoundWrap> wraps;          ///< in the order of `obstacles`
};

/** A path as the core sees it, in the pose that was solved last; null for a path that is given by functions. */
struct CorePath {
    const PathProblem* problem = nullptr;
    const PathPose* pose = nullptr;
    const PathSolution* solution = nullptr;
};

/** Lengths, lengthening speeds, contacts and moment arms of a model's paths in poses that are given by coordinates,
such as those of a measured motion. Forces play no part.

In each pose coordinates are set as given, clipped to no range, couplers give their dependent coordinates values and
speeds, and other constraints are met by the least change of coordinates.

Poses of a row, such as the frames of a motion, are solved in blocks of kPosesPerBlock, as solveMany() of the core does:
the first pose of each by itself, the others continued from the one before, which saves the search. A continued path is
kept only where it runs as one that is found anew has to (ContactMode::Free), so that it is the same path; its last
digits depend on where it was continued from. So an answer depends on no more than the poses of its block, whoever
solves the blocks, in whichever order. */
class PathStudy {
public:
    /** @param isWanted   by name of the path; the others are not solved
    @throws ModelError as ModelSystem does */
    explicit PathStudy(const ModelDescription& description,
                       const std::function<bool(const std::string&)>& isWanted = nullptr);
    ~PathStudy();
    PathStudy(PathStudy&&) noexcept;
    PathStudy& operator=(PathStudy&&) noexcept;

    /** Those that are wanted: muscles, path springs, other forces, then paths that are given by functions. */
    const std::vector<StudiedPath>& getPaths() const;
    /** All, in the order of the file. */
    const std::vector<std::string>& getCoordinateNames() const;
    /** "/jointset/<joint>/<coordinate>" in the same order: how files of states name them. */
    std::vector<std::string> getCoordinatePaths() const;

    /** @param place   of the pose in its row, from 0 on: within a block one after another. 0 for a pose that stands
    alone: its answer is a function of the pose, whatever was solved before
    @throws ModelError naming a coordinate that the model does not have, or whose value or speed is not finite;
    InvalidInput if the pose before it in its block is not the one that was solved last */
    PoseAnswer solve(const ModelPose& pose, int place = 0);

    /** For the core's functions; valid until the next pose is solved. @param path   as in getPaths(), after solve() */
    CorePath getCorePath(std::size_t path) const;

private:
    class Implementation;
    std::unique_ptr<Implementation> m_implementation;
};

}  // namespace tautline::models
