#include "tautline/path_solver.h"

#include <algorithm>
#include <cmath>

#include "tautline/contact_switch.h"
#include "tautline/error.h"
#include "tautline/path_cusps.h"
#include "tautline/path_verification.h"

namespace tautline {
namespace {

constexpr double kEndHeight = 1e-7;  ///< of ends that lie on a surface, in its sizes
constexpr int kMaxRepairs = 4;       ///< of cusps and saddles, in the search from one start
constexpr double kStringPush = 0.1;  ///< the first one of a string that goes beyond a conjugate point, in sizes
constexpr int kMaxStringPushes = 6;  ///< each twice the one before
constexpr int kMaxOtherSides = 4;    ///< obstacles that are tried from the other side

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

PathSolver::PathSolver(const PathSolverOptions& options) : m_options(options), m_search(options) {
    options.validate();
}

void PathSolver::solve(const PathProblem& problem, const PathPose& givenPose, PathSolution& path) {
    problem.validate();
    require(static_cast<int>(givenPose.X_GE.size()) == problem.getNumElements(), "path solver: ", givenPose.X_GE.size(),
            " poses for ", problem.getNumElements(), " elements");
    require(path.isEmpty() || static_cast<int>(path.contacts.size()) == problem.getNumElements(),
            "path solver: the path to continue has ", path.contacts.size(), " elements, the problem ",
            problem.getNumElements());
    const PathPose& pose = calcLiftedPose(problem, givenPose);
    path.iterations = path.shots = 0;
    path.wasCold = false;
    path.fault = {};
    const bool isContinued = !path.isEmpty();
    if (m_options.allowsColdStart)
        m_previous.contacts = path.contacts;  // what a search that fails leaves behind is no course to follow
    if (!isContinued) path.contacts.assign(problem.getNumElements(), ObstacleContact());
    switchOffEnclosing(problem, pose, path);
    // Without a start and without leave to look for one, the straight line is the start.
    bool isFound = (isContinued || !m_options.allowsColdStart) && findPath(problem, pose, PassageRule::AsBefore, path);
    if (!isFound && m_options.allowsColdStart) {
        isFound = isContinued && findColdPath(problem, pose, calcPreviousGuides(problem, pose, m_previous),
                                              PassageRule::AsBefore, path);
        if (!isFound) {
            StartGuides guides = calcHintGuides(problem, pose);
            isFound = findColdPath(problem, pose, guides, PassageRule::AsHinted, path) ||
                      findColdPathWithoutPoints(problem, pose, guides, path) ||
                      findOtherSides(problem, pose, guides, path);
        }
    }
    finish(problem, pose, isFound, path);
}

void PathSolver::solveKeepingContacts(const PathProblem& problem, const PathPose& givenPose, PathSolution& path) {
    require(static_cast<int>(path.contacts.size()) == problem.getNumElements(),
            "path solver: solveKeepingContacts needs a path that was solved before");
    require(static_cast<int>(givenPose.X_GE.size()) == problem.getNumElements(), "path solver: ", givenPose.X_GE.size(),
            " poses for ", problem.getNumElements(), " elements");
    const PathPose& pose = calcLiftedPose(problem, givenPose);
    path.iterations = path.shots = 0;
    path.wasCold = false;
    path.fault = {};
    switchOffEnclosing(problem, pose, path);
    m_startLengths.resize(path.contacts.size());
    for (std::size_t e = 0; e < path.contacts.size(); ++e) m_startLengths[e] = path.contacts[e].start.length;
    bool isConverged = m_search.findStationaryPath(problem, pose, path);
    for (int repair = 0; isConverged && hasCusp(problem, pose, path); ++repair) {
        if (repair == kMaxRepairs) {
            isConverged = false;
            break;
        }
        turnCuspsRound(problem, pose, &m_startLengths, path);
        isConverged = m_search.findStationaryPath(problem, pose, path);
    }
    updateClearances(problem, pose, path);
    watchNearestPlaces(problem, pose, path);
    updatePassages(problem, pose, isConverged, path);
    path.status = isConverged ? PathStatus::Solved : PathStatus::NotConverged;
}

/** The pose with every fixed point that lies on a surface of its strand lifted off by kEndHeight: the straight
segment there would have no length, and no direction. The length changes by the power 3/2 of that height. */
const PathPose& PathSolver::calcLiftedPose(const PathProblem& problem, const PathPose& pose) {
    bool isLifted = false;
    Vec3 N_S;
    const auto lift = [&](int point, int e) {
        const Surface& surface = *problem.getElement(e).surface;
        const Pose& X_GS = pose.X_GE[e];
        const double size = surface.getSize();
        const double height = surface.calcHeight(X_GS.shiftBack(pose.X_GE[point].p), N_S);
        if (!(std::abs(height) < kEndHeight * size)) return;
        if (!isLifted) m_liftedPose = pose;
        isLifted = true;
        m_liftedPose.X_GE[point].p += (kEndHeight * size - height) * (X_GS.R * N_S);
    };
    visitStrandEnds(problem, pose, lift);
    return isLifted ? m_liftedPose : pose;
}

/** Continues from the contact set and starts in `path`. @return true if a verified minimum was found */
bool PathSolver::findPath(const PathProblem& problem, const PathPose& pose, PassageRule rule, PathSolution& path) {
    for (int repair = 0; m_search.search(problem, pose, path); ++repair) {
        const PathVerification verification = verifyPath(problem, pose, path);
        if (verification.isMinimum()) return hasRightPassages(problem, pose, rule, path);
        if (repair == kMaxRepairs) return false;
        if (verification.condition == PathVerification::Condition::ReversedTangent)
            turnCuspsRound(problem, pose, nullptr, path);
        else if (verification.condition == PathVerification::Condition::Unstable)
            m_search.leaveSaddle(problem, pose, path);
        else
            return false;
    }
    return false;
}

/** Lets a string fall taut along the guides, ever finer, until Newton's method leads on from it to a
verified minimum. */
bool PathSolver::findColdPath(const PathProblem& problem, const PathPose& pose, const StartGuides& guides,
                              PassageRule rule, PathSolution& path) {
    struct Level {
        double fineness, tolerance;
        int maxSweeps;
    };
    constexpr Level kLevels[] = {{1.0, 2e-3, 400}, {0.5, 2e-4, 1500}, {0.25, 2e-5, 3000}};
    constexpr Level kPatient = {0.5, 1e-6, 6000};  // for strings that slide off slowly
    path.wasCold = true;
    path.fault = {};
    m_string.lay(problem, pose, guides);
    const auto tighten = [&](const Level& level) {
        return tightenString(problem, pose, level.fineness, level.tolerance, level.maxSweeps, rule, path);
    };
    for (const Level& level : kLevels) {
        if (tighten(level)) return true;
        double push = kStringPush;
        for (int i = 0; i < kMaxStringPushes && pushOffConjugatePoint(problem, pose, push, path); ++i, push *= 2)
            if (tighten(kPatient)) return true;
    }
    // A string in which nothing is wrong may still slide, slower than was asked for.
    if (m_string.findFault(problem).kind == StringFault::Kind::None && tighten(kPatient)) return true;
    path.fault = m_string.findFault(problem);
    return false;
}

/** @return true if the path that the relaxed string suggests leads on to a verified minimum */
bool PathSolver::tightenString(const PathProblem& problem, const PathPose& pose, double fineness, double tolerance,
                               int maxSweeps, PassageRule rule, PathSolution& path) {
    m_string.relax(problem, pose, fineness, tolerance, maxSweeps);
    for (ObstacleContact& contact : path.contacts) contact.clearance = LineClearance();
    m_string.extractContacts(problem, pose, path.contacts);
    return findPath(problem, pose, rule, path);
}

/** An arc beyond its conjugate point is shortest among geodesics nearby, but not among curves: only the string, which
can bend inside the arc, leads on from there. Laid symmetrically it stays, so that it is pushed sideways.
@return false if the path is no such one */
bool PathSolver::pushOffConjugatePoint(const PathProblem& problem, const PathPose& pose, double push,
                                       const PathSolution& path) {
    if (!(path.pathError <= m_options.pathErrorTolerance)) return false;
    const PathVerification verification = verifyPath(problem, pose, path);
    if (verification.condition != PathVerification::Condition::ConjugatePoint) return false;
    const int e = verification.element;
    m_string.push(e,
                  push * problem.getElement(e).surface->getSize() * (pose.X_GE[e].R * path.contacts[e].geodesic.P.B));
    return true;
}

/** Where points near the path lead to no minimum (they may be far from any), the sides that the straight lines between
the others suggest may. @return false with `path` as it was */
bool PathSolver::findColdPathWithoutPoints(const PathProblem& problem, const PathPose& pose, StartGuides guides,
                                           PathSolution& path) {
    bool hasPoints = false;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (!std::holds_alternative<PassNear>(problem.getElement(e).hint)) continue;
        hasPoints = hasPoints || !guides[e].empty();
        guides[e].clear();
    }
    if (!hasPoints) return false;
    m_previous = path;
    if (findColdPath(problem, pose, guides, PassageRule::AsHinted, path)) return true;
    goBack(m_previous, path);
    return false;
}

/** Where the side that the straight line or a point near the path suggests leads to no minimum (surfaces that overlap
there, a contact that would have to be two), the other side of one obstacle may. @return false with `path` as it was */
bool PathSolver::findOtherSides(const PathProblem& problem, const PathPose& pose, StartGuides& guides,
                                PathSolution& path) {
    int tries = 0;
    m_previous = path;
    for (int e = 0; e < problem.getNumElements() && tries < kMaxOtherSides; ++e) {
        const PathElement& element = problem.getElement(e);
        if (element.isPoint() || !pose.hasElement(e) || !m_previous.contacts[e].isTouched ||
            !(std::holds_alternative<std::monostate>(element.hint) || std::holds_alternative<PassNear>(element.hint)))
            continue;
        const std::vector<Vec3> hinted = guides[e];
        guides[e] = {calcOppositeGuide(problem, pose, m_previous, e)};
        if (guides[e].front().allFinite() && ++tries &&
            findColdPath(problem, pose, guides, PassageRule::AsHinted, path))
            return true;
        guides[e] = hinted;
    }
    goBack(m_previous, path);
    return false;
}

/** Switches off the obstacles in which an end of their strand lies: no string lies over them. */
void PathSolver::switchOffEnclosing(const PathProblem& problem, const PathPose& pose, PathSolution& path) const {
    Vec3 N_S;
    for (ObstacleContact& contact : path.contacts) contact.isSwitchedOff = false;
    visitStrandEnds(problem, pose, [&](int point, int e) {
        const Surface& surface = *problem.getElement(e).surface;
        const double height = surface.calcHeight(pose.X_GE[e].shiftBack(pose.X_GE[point].p), N_S);
        if (height < kContactTolerance * surface.getSize()) path.contacts[e].isSwitchedOff = true;
    });
}

/** Says how the solve ended. @param isFound   `path` is verified to be a minimum */
void PathSolver::finish(const PathProblem& problem, const PathPose& pose, bool isFound, PathSolution& path) const {
    const bool isConverged = path.pathError <= m_options.pathErrorTolerance;
    updatePassages(problem, pose, isConverged, path);
    path.status = PathStatus::Solved;
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (!problem.getElement(e).isPoint() && pose.hasElement(e) && path.contacts[e].isSwitchedOff)
            path.status = PathStatus::EndInside;
    if (isFound) return;
    if (!isConverged) {
        path.status = PathStatus::NotConverged;
        return;
    }
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
