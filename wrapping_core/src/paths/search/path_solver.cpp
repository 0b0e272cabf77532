// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_solver.h"

#include <algorithm>
#include <cmath>

#include "paths/contacts/arc_changes.h"
#include "paths/equations/point_path.h"
#include "paths/local/reversed_tangents.h"
#include "paths/problem/posed_problem.h"
#include "paths/problem/search_limits.h"
#include "paths/search/route_check.h"
#include "paths/search/start_strategies.h"
#include "paths/search/threading.h"
#include "tautline/error.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/path_verification.h"
#include "tautline/paths/tolerances.h"

namespace tautline {
namespace {

/** Of a fixed point above an obstacle of its span, in the working pose [m]. */
struct EndHeight {
    int point, element;
    double height;
};

/** Off the surface that it lies on, by kEndOnSurface. */
void liftEnd(const PosedProblem& scene, const EndHeight& end, PathPose& pose) {
    const Surface& surface = scene.getSurface(end.element);
    const Pose& X_GS = scene.getPose(end.element);
    Vector3 N_S;
    surface.calcHeightAndNormal(X_GS.shiftBack(pose.X_GE[end.point].p), N_S);
    pose.X_GE[end.point].p += (kEndOnSurface * surface.getSize() - end.height) * X_GS.rotate(N_S);
}

/** Whether a path came from the one that was given. */
bool isLaidFromPrevious(const PathSolution& path) {
    return path.report.strategy == StartStrategy::Continued || path.report.strategy == StartStrategy::AlongPrevious;
}

/** How far apart two paths run about an obstacle: the larger of the distances of their first contact points and of the
lengths of their arcs, in sizes; infinite where they do not have the same arcs. */
double calcDifference(const PathElement& obstacle, const ObstacleContact& a, const ObstacleContact& b) {
    if (a.getNumArcs() != b.getNumArcs()) return kInfinity;
    double largest = 0;
    for (int i = 0; i < a.getNumArcs(); ++i) {
        const ContactArc &ofA = a.getArc(i), &ofB = b.getArc(i);
        largest = std::max(
            {largest, (ofA.geodesic.P.x - ofB.geodesic.P.x).norm(), std::abs(ofA.start.length - ofB.start.length)});
    }
    return largest / obstacle.surface->getSize();
}

/** The obstacle about which two paths of a problem with obstacles run farthest apart. */
int findLargestDifference(const PathProblem& problem, const PathSolution& a, const PathSolution& b) {
    int largest = -1;
    double difference = -1;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint()) continue;
        const double here = calcDifference(problem.getElement(e), a.contacts[e], b.contacts[e]);
        if (here > difference) difference = here, largest = e;
    }
    return largest;
}

}  // namespace

/** What a solve needs besides its path, kept so that a warm one allocates nothing. */
struct PathSolver::Workspace {
    explicit Workspace(const PathSolverOptions& options) : search(options) {}

    PathSearch search;
    PathPose workingPose;
    Vector3 origin_G = Vector3::Zero();  ///< of the frame of the working pose
    std::vector<EndHeight> endHeights;
    std::vector<double> startLengths;  ///< of the arcs in path order, while contacts are kept
    PathSolution cold;
};

PathSolver::PathSolver(const PathSolverOptions& options) : m_options(options) {
    options.validate();
    m_workspace = std::make_unique<Workspace>(options);
}

PathSolver::PathSolver(PathSolver&&) noexcept = default;
PathSolver& PathSolver::operator=(PathSolver&&) noexcept = default;
PathSolver::~PathSolver() = default;

PathSolver::Workspace& PathSolver::updWorkspace() {
    // A solver that was moved from is as good as new.
    if (!m_workspace) m_workspace = std::make_unique<Workspace>(m_options);
    return *m_workspace;
}

void PathSolver::solve(const PathProblem& problem, const PathPose& givenPose, PathSolution& path) {
    problem.validate();
    givenPose.validate(problem);
    require(path.isEmpty() || static_cast<int>(path.contacts.size()) == problem.getNumElements(),
            "path solver: the path to continue has ", path.contacts.size(), " elements, the problem ",
            problem.getNumElements());
    if (!begin(problem, givenPose, path)) return;
    if (!problem.hasObstacles()) return layPointPath(problem, givenPose, path);
    const PathPose& pose = calcWorkingPose(problem, givenPose);
    const bool isContinued = !path.isEmpty();
    if (!isContinued) path.contacts.assign(problem.getNumElements(), ObstacleContact());
    switchOffEnclosing({problem, pose}, path);
    const bool isFound = updWorkspace().search.findPath({problem, pose}, isContinued, path);
    finish(problem, pose, isFound, path);
    moveToGround(path);
    if (isContinued && m_options.comparesWithCold) compareWithCold(problem, givenPose, path);
}

/** Of a path that was continued, and runs as is asked: says whether the pose alone leads elsewhere, and at which
obstacle (RouteDeviation::Kind::Continued). */
void PathSolver::compareWithCold(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    if (path.status != PathStatus::Solved || !path.followsHints()) return;
    PathSolution& cold = m_workspace->cold;
    cold.contacts.clear();
    solve(problem, pose, cold);
    path.iterations += cold.iterations;
    path.shots += cold.shots;
    path.deviation = {};
    const bool isSame = cold.status == path.status && std::abs(cold.length / path.length - 1) < kContinuousLength;
    if (!isSame) path.deviation = {RouteDeviation::Kind::Continued, findLargestDifference(problem, path, cold)};
}

void PathSolver::solveKeepingContacts(const PathProblem& problem, const PathPose& givenPose, PathSolution& path) {
    givenPose.validate(problem);
    require(static_cast<int>(path.contacts.size()) == problem.getNumElements(),
            "path solver: solveKeepingContacts needs a path that was solved before");
    if (!begin(problem, givenPose, path)) return;
    if (!problem.hasObstacles()) return layPointPath(problem, givenPose, path);
    const PathPose& pose = calcWorkingPose(problem, givenPose);
    const PosedProblem scene{problem, pose};
    switchOffEnclosing(scene, path);
    const bool isConverged = findKeptPath(problem, pose, path) && std::isfinite(path.length);
    updateClearances(scene, path);
    watchNearestPlaces(scene, path);
    updatePassages(scene, isConverged, path);
    path.status = isConverged ? PathStatus::Solved : PathStatus::NotConverged;
    moveToGround(path);
}

/** Counts anew. @return false, and says NotConverged, in a pose that is not finite, and among obstacles
so small or large that squares of their sizes are no numbers: no path is there */
bool PathSolver::begin(const PathProblem& problem, const PathPose& pose, PathSolution& path) const {
    path.iterations = path.shots = 0;
    path.wasCold = false;
    path.fault = {};
    path.deviation = {};
    const int failedSteps = path.report.failedSteps;
    path.report = {};
    path.report.failedSteps = failedSteps;
    if (pose.isFinite() && problem.hasUsableSizes()) return true;
    path.status = PathStatus::NotConverged;
    path.pathError = kInfinity;
    return false;
}

/** Where ground's origin is moved to: near the path if that lies so far away that rounding of its coordinates would
decide about contacts. */
Vector3 PathSolver::chooseOrigin(const PathPose& pose) {
    const Vector3& first = pose.X_GE.front().p;
    const double span = (pose.X_GE.back().p - first).cwiseAbs().maxCoeff();
    return first.cwiseAbs().maxCoeff() > kFarFromOrigin * span ? first : Vector3(Vector3::Zero());
}

/** The pose in a ground whose origin is near the path, with every fixed point that lies on a surface of its span lifted
off by kEndOnSurface: the straight segment there would have no length, and no direction. The length changes by that
height at most. */
const PathPose& PathSolver::calcWorkingPose(const PathProblem& problem, const PathPose& pose) {
    PathPose& working = updWorkspace().workingPose;
    m_workspace->origin_G = chooseOrigin(pose);
    const bool isMoved = !m_workspace->origin_G.isZero();
    if (isMoved) {
        working = pose;
        for (Pose& X : working.X_GE) X.p -= m_workspace->origin_G;
    }
    const PathPose& unlifted = isMoved ? working : pose;
    std::vector<EndHeight>& ends = m_workspace->endHeights;
    ends.clear();
    const PosedProblem scene{problem, unlifted};
    scene.forEachSpanEnd([&](int point, int e) { ends.push_back({point, e, scene.calcHeight(point, e)}); });
    const auto isOnSurface = [&](const EndHeight& end) {
        return std::abs(end.height) < kEndOnSurface * scene.getSurface(end.element).getSize();
    };
    if (std::none_of(ends.begin(), ends.end(), isOnSurface)) return unlifted;
    if (!isMoved) working = pose;
    for (const EndHeight& end : ends)
        if (isOnSurface(end)) liftEnd({problem, working}, end, working);
    for (EndHeight& end : ends) end.height = PosedProblem{problem, working}.calcHeight(end.point, end.element);
    return working;
}

/** The straight segments from the frame of the working pose to ground. */
void PathSolver::moveToGround(PathSolution& path) const {
    if (m_workspace->origin_G.isZero()) return;
    for (StraightSegment& line : path.segments) {
        line.A += m_workspace->origin_G;
        line.B += m_workspace->origin_G;
    }
}

/** The path error may vanish where e = -t too: arcs are turned round there, to the length nearest that of the start. */
bool PathSolver::findKeptPath(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const PosedProblem scene{problem, pose};
    std::vector<double>& startLengths = m_workspace->startLengths;
    startLengths.clear();
    forEachArc(path.contacts, [&](const ContactArc& arc) { startLengths.push_back(arc.start.length); });
    for (int repair = 0; m_workspace->search.updLocalSolver().findStationaryPath(scene, path); ++repair) {
        if (!hasReversedTangent(scene, path)) return true;
        if (repair == kMaxRepairs) return false;
        reverseTangents(scene, &startLengths, path);
    }
    return false;
}

/** Switches off the obstacles in which an end of their span lies, since no string lies over them, and those that the
pose passes over. The side on which one was passed before, or the way through its hole, ends with that: an end may come
out anywhere. */
void PathSolver::switchOffEnclosing(const PosedProblem& scene, PathSolution& path) const {
    for (ObstacleContact& contact : path.contacts) {
        if (contact.isSwitchedOff) {
            contact.passage = HolePassage();
            contact.hasLeftHole = false;
            if (!contact.isTouched) contact.clearance = LineClearance();
        }
        contact.isSwitchedOff = false;
    }
    for (int e = 0; e < scene.size(); ++e)
        if (!scene.isPoint(e) && !scene.pose.hasElement(e)) {
            path.contacts[e] = ObstacleContact();
            path.contacts[e].isSwitchedOff = true;
        }
    for (const EndHeight& end : m_workspace->endHeights)
        if (end.height < kContactTolerance * scene.getSurface(end.element).getSize())
            path.contacts[end.element].isSwitchedOff = true;
}

/** Says how the solve ended. @param isFound   `path` is verified to be a minimum */
void PathSolver::finish(const PathProblem& problem, const PathPose& pose, bool isFound, PathSolution& path) const {
    const PosedProblem scene{problem, pose};
    const bool isConverged = path.pathError <= m_options.pathErrorTolerance && std::isfinite(path.length);
    updatePassages(scene, isConverged, path);
    if (path.wasCold) giveUpLostHoles(path);
    if (isConverged && problem.hasHints() && path.followsHints()) path.deviation = findDeviation(scene, path);
    if (isConverged && isLaidFromPrevious(path) && path.followsHints())
        path.deviation = findContinuedDeviation(scene, path);
    path.status = isConverged ? PathStatus::Solved : PathStatus::NotConverged;
    if (!isConverged) return;
    scene.forEachObstacle([&](int e) {
        if (path.contacts[e].isSwitchedOff) path.status = PathStatus::EndInside;
    });
    if (path.status == PathStatus::Solved && hasLeftAnyHole(path)) path.status = PathStatus::NotMinimum;
    if (isFound) return;
    const PathVerification verification = verifyPath(problem, pose, path);
    if (verification.condition == PathVerification::Condition::OutsideDomain)
        path.status = PathStatus::LeftDomain;
    else if (!verification.isMinimum())
        path.status = PathStatus::NotMinimum;
}

PathSolution solvePath(const PathProblem& problem, const PathPose& pose, const PathSolverOptions& options) {
    PathSolution path;
    PathSolver(options).solve(problem, pose, path);
    return path;
}

}  // namespace tautline
