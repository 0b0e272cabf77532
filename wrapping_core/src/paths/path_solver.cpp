// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_solver.h"

#include <cmath>

#include "paths/cold_search.h"
#include "paths/hole_passages.h"
#include "paths/obstacle_walk.h"
#include "paths/path_cusps.h"
#include "tautline/error.h"
#include "tautline/paths/contact_switch.h"
#include "tautline/paths/path_verification.h"

namespace tautline {
namespace {

constexpr double kEndHeight = 1e-7;  ///< of ends that lie on a surface, in its sizes
constexpr int kMaxRepairs = 4;       ///< of cusps, while contacts are kept

/** Calls visit(point, obstacle) with either end of its strand for every obstacle that takes part. */
template <class Visitor>
void visitStrandEnds(const PathProblem& problem, const PathPose& pose, Visitor visit) {
    int first = 0;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (!problem.getElement(e).isPoint() || !pose.hasElement(e)) continue;
        for (int obstacle = first + 1; obstacle < e; ++obstacle) {
            if (problem.getElement(obstacle).isPoint() || !pose.hasElement(obstacle)) continue;
            visit(first, obstacle);
            visit(e, obstacle);
        }
        first = e;
    }
}

}  // namespace

/** What a solve needs besides its path, kept so that a warm one allocates nothing. */
struct PathSolver::Workspace {
    explicit Workspace(const PathSolverOptions& options) : search(options), coldSearch(options, search) {}

    ContactSearch search;
    ColdSearch coldSearch;
    PathSolution previous;  ///< contacts of the path that is continued: a search that fails leaves no course behind
    PathSolution loose;     ///< a continuation that is a minimum, but has left a hole
    PathPose liftedPose;
    std::vector<double> startLengths;  ///< of the arcs by element, while contacts are kept
};

PathSolver::PathSolver(const PathSolverOptions& options) : m_options(options) {
    options.validate();
    m_workspace = std::make_unique<Workspace>(options);
}

PathSolver::PathSolver(PathSolver&&) noexcept = default;
PathSolver& PathSolver::operator=(PathSolver&&) noexcept = default;
PathSolver::~PathSolver() = default;

void PathSolver::solve(const PathProblem& problem, const PathPose& givenPose, PathSolution& path) {
    problem.validate();
    givenPose.validate(problem);
    require(path.isEmpty() || static_cast<int>(path.contacts.size()) == problem.getNumElements(),
            "path solver: the path to continue has ", path.contacts.size(), " elements, the problem ",
            problem.getNumElements());
    if (!begin(givenPose, path)) return;
    const PathPose& pose = calcLiftedPose(problem, givenPose);
    finish(problem, pose, findPath(problem, pose, path), path);
}

void PathSolver::solveKeepingContacts(const PathProblem& problem, const PathPose& givenPose, PathSolution& path) {
    givenPose.validate(problem);
    require(static_cast<int>(path.contacts.size()) == problem.getNumElements(),
            "path solver: solveKeepingContacts needs a path that was solved before");
    if (!begin(givenPose, path)) return;
    const PathPose& pose = calcLiftedPose(problem, givenPose);
    switchOffEnclosing(problem, pose, path);
    const bool isConverged = findKeptPath(problem, pose, path) && std::isfinite(path.length);
    updateClearances(problem, pose, path);
    watchNearestPlaces(problem, pose, path);
    updatePassages(problem, pose, isConverged, path);
    path.status = isConverged ? PathStatus::Solved : PathStatus::NotConverged;
}

/** Counts anew. @return false, and says NotConverged, in a pose that is not finite: no path is there */
bool PathSolver::begin(const PathPose& pose, PathSolution& path) const {
    path.iterations = path.shots = 0;
    path.wasCold = false;
    path.fault = {};
    if (pose.isFinite()) return true;
    path.status = PathStatus::NotConverged;
    path.pathError = kInfinity;
    return false;
}

/** The pose with every fixed point that lies on a surface of its strand lifted off by kEndHeight: the straight
segment there would have no length, and no direction. The length changes by that height at most. */
const PathPose& PathSolver::calcLiftedPose(const PathProblem& problem, const PathPose& pose) {
    PathPose& lifted = m_workspace->liftedPose;
    bool isLifted = false;
    Vec3 N_S;
    const auto lift = [&](int point, int e) {
        const Surface& surface = *problem.getElement(e).surface;
        const Pose& X_GS = pose.X_GE[e];
        const double size = surface.getSize();
        const double height = surface.calcHeightAndNormal(X_GS.shiftBack(pose.X_GE[point].p), N_S);
        if (!(std::abs(height) < kEndHeight * size)) return;
        if (!isLifted) lifted = pose;
        isLifted = true;
        lifted.X_GE[point].p += (kEndHeight * size - height) * (X_GS.R * N_S);
    };
    visitStrandEnds(problem, pose, lift);
    return isLifted ? lifted : pose;
}

/** Continues the path; anew along it where that fails; then anew from the hints. A continuation that has left a hole is
the answer where none goes through it again. Without a start and without leave to look for one, the straight line is the
start. @return true if a verified minimum was found */
bool PathSolver::findPath(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    ContactSearch& search = m_workspace->search;
    ColdSearch& coldSearch = m_workspace->coldSearch;
    const bool isContinued = !path.isEmpty();
    if (!isContinued) path.contacts.assign(problem.getNumElements(), ObstacleContact());
    switchOffEnclosing(problem, pose, path);
    if (!m_options.allowsColdStart) return search.findMinimum(problem, pose, PassageRule(), path);
    m_workspace->previous.contacts = path.contacts;
    if (!isContinued) return coldSearch.findPathFromHints(problem, pose, path);
    if (search.findMinimum(problem, pose, PassageRule(), path)) return true;
    const bool isLoose = path.pathError <= m_options.pathErrorTolerance && verifyPath(problem, pose, path).isMinimum();
    if (isLoose) m_workspace->loose = path;
    const bool isFound = coldSearch.findPathAlong(problem, pose, m_workspace->previous, path) ||
                         coldSearch.findPathFromHints(problem, pose, path);
    if (!isLoose || (isFound && hasRightPassages(problem, pose, PassageRule(), path))) return isFound;
    goBack(m_workspace->loose, path);
    path.wasCold = true;
    return true;
}

/** The path error may vanish at a cusp too: arcs are turned round there, to the length nearest that of the start. */
bool PathSolver::findKeptPath(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    std::vector<double>& startLengths = m_workspace->startLengths;
    startLengths.resize(path.contacts.size());
    for (std::size_t e = 0; e < path.contacts.size(); ++e) startLengths[e] = path.contacts[e].start.length;
    for (int repair = 0; m_workspace->search.findStationaryPath(problem, pose, path); ++repair) {
        if (!hasCusp(problem, pose, path)) return true;
        if (repair == kMaxRepairs) return false;
        turnCuspsRound(problem, pose, &startLengths, path);
    }
    return false;
}

/** Switches off the obstacles in which an end of their strand lies: no string lies over them. The side on which one was
passed before, or the way through its hole, ends with that: an end may come out anywhere. */
void PathSolver::switchOffEnclosing(const PathProblem& problem, const PathPose& pose, PathSolution& path) const {
    for (ObstacleContact& contact : path.contacts) {
        if (contact.isSwitchedOff) contact.passage = HolePassage(), contact.hasLeftHole = false;
        if (contact.isSwitchedOff && !contact.isTouched) contact.clearance = LineClearance();
        contact.isSwitchedOff = false;
    }
    visitStrandEnds(problem, pose, [&](int point, int e) {
        const Surface& surface = *problem.getElement(e).surface;
        const double height = surface.calcHeight(pose.X_GE[e].shiftBack(pose.X_GE[point].p));
        if (height < kContactTolerance * surface.getSize()) path.contacts[e].isSwitchedOff = true;
    });
}

/** Says how the solve ended. @param isFound   `path` is verified to be a minimum */
void PathSolver::finish(const PathProblem& problem, const PathPose& pose, bool isFound, PathSolution& path) const {
    const bool isConverged = path.pathError <= m_options.pathErrorTolerance && std::isfinite(path.length);
    updatePassages(problem, pose, isConverged, path);
    if (path.wasCold) giveUpLostHoles(path);
    path.status = isConverged ? PathStatus::Solved : PathStatus::NotConverged;
    if (!isConverged) return;
    visitObstacles(problem, pose, [&](int e) {
        if (path.contacts[e].isSwitchedOff) path.status = PathStatus::EndInside;
    });
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
