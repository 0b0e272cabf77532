#pragma once
#include <optional>
#include <vector>

#include "tautline/models/wrap_binding.h"
#include "tautline/path_solver.h"
#include "tautline/simbody/cable.h"

namespace tautline::models {

/** Geodesics from which the iteration of a path starts: one entry per element of its cable, none where the
 * element is a point or lifted at first. Empty: the solver finds a start. */
using PathStart = std::vector<std::optional<GeodesicStart>>;

/** The starts that a file gives for the wraps of a path; empty if it gives none. The points are put onto their
 * surfaces and the directions made tangent. */
PathStart makePathStart(const MusclePath& path, const std::vector<BoundWrap>& wraps, const Cable& cable);

/** A cable's path as the core sees it in one state. */
struct PathInPose {
    PathProblem problem;
    PathPose pose;
};

/** Needs Stage::Position. */
PathInPose makePathInPose(const Cable& cable, const SimTK::State& state);

/** Path errors before an iteration, as norms: sqrt(sum eps^2) of all obstacles and of each (thesis Fig. 8.4). */
struct PathIteration {
    double error = 0.0;
    /** One per element; 0 where there is no contact. */
    std::vector<double> obstacleErrors;
};

struct IteratedPath {
    /** The geodesics after the last iteration. */
    PathStart start;
    /** The first is that of the start given, the last that of the answer. */
    std::vector<PathIteration> iterations;
    double largestError = 0.0;  ///< max |eps| of the answer
};

/**
 * The path iteration of thesis Sec. 4.6 and nothing else: Newton's full steps on the path error of a given
 * contact set, without damping and without changing contacts, until max |eps| <= tolerance, a step cannot be
 * made, or `maxIterations` are done.
 */
IteratedPath iteratePath(const PathInPose& path, const PathStart& start, double tolerance = 1e-12,
                         int maxIterations = 20);

/** A path with these contacts from which PathSolver::solve() and Cable::continueFrom() go on. */
PathSolution makePathSolution(const PathInPose& path, const PathStart& start);

}  // namespace tautline::models
