#include "tautline/path_solver.h"

#include <algorithm>
#include <cmath>

#include "tautline/contact_switch.h"
#include "tautline/error.h"
#include "tautline/path_verification.h"
#include "tautline/segment_clearance.h"

namespace tautline {
namespace {

constexpr double kEndHeight = 1e-7;  ///< of ends that lie on a surface, in its sizes
constexpr double kSaddlePush = 0.1;  ///< of an arc on a saddle, sideways, in sizes
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

bool arrivesReversed(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                     const StraightSegment& line) {
    const int e = line.toElement;
    return !problem.getElement(e).isPoint() && line.e.dot(pose.X_GE[e].R * path.contacts[e].geodesic.P.t) < 0;
}

bool leavesReversed(const PathProblem& problem, const PathPose& pose, const PathSolution& path,
                    const StraightSegment& line) {
    const int e = line.fromElement;
    return !problem.getElement(e).isPoint() && line.e.dot(pose.X_GE[e].R * path.contacts[e].geodesic.Q.t) < 0;
}

/** True if a line meets its arc with e = -t, where eps vanishes too. */
bool hasCusp(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    for (const StraightSegment& line : path.segments)
        if (arrivesReversed(problem, pose, path, line) || leavesReversed(problem, pose, path, line)) return true;
    return false;
}

/** Takes an earlier path again; what was spent since stays counted. */
void goBack(const PathSolution& earlier, PathSolution& path) {
    const int iterations = path.iterations, shots = path.shots;
    path = earlier;
    path.iterations = iterations, path.shots = shots;
}

}  // namespace

PathSolver::PathSolver(const PathSolverOptions& options) : m_options(options), m_newton(options), m_minimizer(options) {
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
    finish(problem, pose, path.pathError <= m_options.pathErrorTolerance, path);
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
    bool isConverged = findStationaryPath(problem, pose, path);
    for (int repair = 0; isConverged && hasCusp(problem, pose, path); ++repair) {
        if (repair == kMaxRepairs) {
            isConverged = false;
            break;
        }
        turnCuspsRound(problem, pose, &m_startLengths, path);
        isConverged = findStationaryPath(problem, pose, path);
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
    for (int repair = 0; iterateContactSet(problem, pose, path); ++repair) {
        const PathVerification verification = verifyPath(problem, pose, path);
        if (verification.isMinimum()) return hasRightPassages(problem, pose, rule, path);
        if (repair == kMaxRepairs) return false;
        if (verification.condition == PathVerification::Condition::ReversedTangent)
            turnCuspsRound(problem, pose, nullptr, path);
        else if (verification.condition == PathVerification::Condition::Unstable)
            leaveSaddle(problem, pose, path);
        else
            return false;
    }
    return false;
}

/** Goes downhill to a path that is no saddle: from where Newton's method began, as a string would fall; if that too
ends on a saddle, from there, pushed sideways at the contact that holds it. */
void PathSolver::leaveSaddle(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    restoreStarts(path);
    if (!m_minimizer.minimize(problem, pose, path)) return;
    const PathVerification verification = verifyPath(problem, pose, path);
    if (verification.condition != PathVerification::Condition::Unstable) return;
    const Surface& surface = *problem.getElement(verification.element).surface;
    ObstacleContact& contact = path.contacts[verification.element];
    contact.start =
        calcCorrectedStart(surface, contact.start, contact.geodesic.P, Vec4(0, kSaddlePush * surface.getSize(), 0, 0));
    m_minimizer.minimize(problem, pose, path);
}

/** Seen from a point at distance l along a line that meets its arc with e = -t, the tangent point that is meant lies
2 atan(kappa l)/kappa back along the arc if that is a circle, or on by the rest of the circle: of the two the one that
leaves the arc nearer to its length in `startLengths` (by element), if those are given. */
void PathSolver::turnCuspsRound(const PathProblem& problem, const PathPose& pose,
                                const std::vector<double>* startLengths, PathSolution& path) const {
    const auto calcShift = [&](int e, const DarbouxFrame& end, double lineLength) {
        const double curvature = std::abs(end.kappaN), length = path.contacts[e].start.length;
        const double back = curvature > 0 ? 2 * std::atan(curvature * lineLength) / curvature : 2 * lineLength;
        if (!startLengths || !(curvature > 0)) return -back;
        const double on = 2 * kPi / curvature - back, start = (*startLengths)[e];
        return std::abs(length - back - start) < std::abs(length + on - start) ? -back : on;
    };
    for (const StraightSegment& line : path.segments) {
        if (arrivesReversed(problem, pose, path, line)) {
            ObstacleContact& contact = path.contacts[line.toElement];
            const DarbouxFrame& P = contact.geodesic.P;
            const double shift = calcShift(line.toElement, P, line.length);
            const Surface& surface = *problem.getElement(line.toElement).surface;
            contact.start = calcCorrectedStart(surface, contact.start, P, Vec4(-shift, 0, 0, shift));
        }
        if (leavesReversed(problem, pose, path, line)) {
            ObstacleContact& contact = path.contacts[line.fromElement];
            contact.start.length += calcShift(line.fromElement, contact.geodesic.Q, line.length);
        }
    }
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
    constexpr Level kPushed = {0.5, 1e-6, 4000};  // it slides off slowly
    path.wasCold = true;
    path.fault = {};
    m_string.lay(problem, pose, guides);
    for (const Level& level : kLevels) {
        if (tightenString(problem, pose, level.fineness, level.tolerance, level.maxSweeps, rule, path)) return true;
        double push = kStringPush;
        for (int i = 0; i < kMaxStringPushes && pushOffConjugatePoint(problem, pose, push, path); ++i, push *= 2)
            if (tightenString(problem, pose, kPushed.fineness, kPushed.tolerance, kPushed.maxSweeps, rule, path))
                return true;
    }
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

/** Calls visit(surface, contact, passage, element) for every obstacle with a hole, with its passages in `path`. */
template <class Visitor>
void visitHoles(const PathProblem& problem, const PathPose& pose, const PathSolution& path, Visitor visit) {
    std::size_t in = 0;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const PathElement& element = problem.getElement(e);
        if (element.isPoint() || !pose.hasElement(e)) continue;
        while (in + 1 < path.segments.size() && path.segments[in].toElement < e) ++in;
        if (!hasHole(*element.surface)) continue;
        const ObstacleContact& contact = path.contacts[e];
        const StraightSegment& out = path.segments[contact.isTouched ? in + 1 : in];
        visit(element, contact, calcHolePassage(*element.surface, pose.X_GE[e], contact, path.segments[in], out), e);
    }
}

bool PathSolver::hasRightPassages(const PathProblem& problem, const PathPose& pose, PassageRule rule,
                                  const PathSolution& path) const {
    bool isRight = true;
    visitHoles(problem, pose, path,
               [&](const PathElement& element, const ObstacleContact& contact, const HolePassage& passage, int) {
                   const auto* thread = std::get_if<ThreadHole>(&element.hint);
                   if (rule == PassageRule::AsBefore)
                       isRight = isRight && !hasLeftHole(*element.surface, contact.passage, passage);
                   else if (thread)
                       isRight = isRight && passage.count == thread->passages;
               });
    return isRight;
}

/** Notes the passages through holes, and which were lost since the path that this one was continued from. Those of a
path that did not converge, or has left the hole, are no course to keep: the ones before them stay. */
void PathSolver::updatePassages(const PathProblem& problem, const PathPose& pose, bool isConverged,
                                PathSolution& path) const {
    visitHoles(problem, pose, path,
               [&](const PathElement& element, const ObstacleContact& contact, const HolePassage& passage, int e) {
                   path.contacts[e].hasLeftHole = hasLeftHole(*element.surface, contact.passage, passage);
                   if (isConverged && !path.contacts[e].hasLeftHole) path.contacts[e].passage = passage;
               });
}

/** Newton's method from the starts in `path`, fast where they are near; where it leads to no path, the minimizer from
the same starts. @return true if the path error vanishes */
bool PathSolver::findStationaryPath(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    m_starts.resize(path.contacts.size());
    for (std::size_t e = 0; e < path.contacts.size(); ++e) m_starts[e] = path.contacts[e].start;
    if (m_newton.iterate(problem, pose, path)) return true;
    restoreStarts(path);
    return m_minimizer.minimize(problem, pose, path);
}

/** As above; where that path turns back at an arc, the minimizer's takes its place if it does not. */
bool PathSolver::findPathOfContacts(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    if (!findStationaryPath(problem, pose, path)) return false;
    if (!hasCusp(problem, pose, path)) return true;
    m_cusp = path;
    restoreStarts(path);
    if (!m_minimizer.minimize(problem, pose, path) || hasCusp(problem, pose, path)) goBack(m_cusp, path);
    return true;
}

/** The starts from which the last contact set was solved. */
void PathSolver::restoreStarts(PathSolution& path) const {
    for (std::size_t e = 0; e < path.contacts.size(); ++e) path.contacts[e].start = m_starts[e];
}

/** Newton on one contact set, then lift what has negative length and touch what is penetrated, one at a
time, until neither is left. The contacts of `path` are those that it was solved with, also where the search comes
to no end. @return true if converged so */
bool PathSolver::iterateContactSet(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const int maxChanges = 3 * problem.getNumElements() + 10;
    for (int change = 0; change <= maxChanges; ++change) {
        const bool isConverged = findPathOfContacts(problem, pose, path);
        updateClearances(problem, pose, path);
        if (!isConverged) return false;
        int worst = findWorstContact(problem, pose, path);
        if (worst < 0) {
            watchNearestPlaces(problem, pose, path);
            worst = findWorstContact(problem, pose, path);
        }
        if (worst < 0) return true;
        if (change < maxChanges) switchContact(problem, pose, worst, path);
    }
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

/** Clearances of all lifted obstacles on the segments that pass them. */
void PathSolver::updateClearances(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    int segment = 0;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const PathElement& element = problem.getElement(e);
        if (element.isPoint() || !pose.hasElement(e)) continue;
        while (segment + 1 < static_cast<int>(path.segments.size()) && path.segments[segment].toElement < e) ++segment;
        ObstacleContact& contact = path.contacts[e];
        const Surface& surface = *element.surface;
        if (contact.isTouched) continue;
        const StraightSegment& line = path.segments[segment];
        contact.segment = segment;
        findSegmentClearance(surface, pose.X_GE[e], line.A, line.B, contact.clearance);
    }
}

/** Looks for places where lifted obstacles are nearer to their segments than where they were watched so far. */
void PathSolver::watchNearestPlaces(const PathProblem& problem, const PathPose& pose, PathSolution& path) const {
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint() || !pose.hasElement(e) || path.contacts[e].isTouched) continue;
        const StraightSegment& line = path.segments[path.contacts[e].segment];
        takeNearerClearance(*problem.getElement(e).surface, pose.X_GE[e], line.A, line.B, path.contacts[e].clearance);
    }
}

/** @return the obstacle whose contact violates its condition most, those that must lift first; -1 if none does */
int PathSolver::findWorstContact(const PathProblem& problem, const PathPose& pose, const PathSolution& path) const {
    int lift = -1, touch = -1;
    double shortest = kShortestArc, deepest = kContactTolerance;
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (problem.getElement(e).isPoint() || !pose.hasElement(e)) continue;
        const ObstacleContact& contact = path.contacts[e];
        const double size = problem.getElement(e).surface->getSize();
        if (contact.isTouched) {
            const double length = contact.isSwitchedOff ? -kInfinity : contact.start.length / size;
            if (length < shortest) shortest = length, lift = e;
        } else if (!contact.isSwitchedOff) {
            const double depth = contact.clearance.distance * contact.clearance.scale;
            if (depth < deepest) deepest = depth, touch = e;
        }
    }
    return lift >= 0 ? lift : touch;
}

void PathSolver::finish(const PathProblem& problem, const PathPose& pose, bool isConverged, PathSolution& path) {
    updatePassages(problem, pose, isConverged, path);
    path.status = PathStatus::Solved;
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (!problem.getElement(e).isPoint() && pose.hasElement(e) && path.contacts[e].isSwitchedOff)
            path.status = PathStatus::EndInside;
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
