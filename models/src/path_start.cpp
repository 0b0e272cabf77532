#include "tautline/models/path_start.h"

#include <algorithm>
#include <cmath>

#include "tautline/path_error.h"
#include "tautline/simbody/conversions.h"

namespace tautline::models {

namespace {

GeodesicStart makeStart(const Surface& surface, const WrapStart& given) {
    GeodesicStart start;
    start.point = surface.findSurfacePoint(toEigen(toVec3(given.point)));
    start.tangent = surface.calcFrame(start.point, toEigen(toVec3(given.direction))).t;
    start.length = given.length;
    return start;
}

std::vector<ObstacleContact> makeContacts(const PathStart& start) {
    std::vector<ObstacleContact> contacts(start.size());
    for (std::size_t e = 0; e < start.size(); ++e) {
        if (!start[e]) continue;
        contacts[e].isTouched = true;
        contacts[e].start = *start[e];
    }
    return contacts;
}

PathIteration calcErrors(const Chain& chain, const std::vector<double>& eps, std::size_t numElements) {
    PathIteration errors;
    errors.obstacleErrors.assign(numElements, 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const double square = Eigen::Map<const Vec4>(&eps[kVariations * i]).squaredNorm();
        errors.obstacleErrors[chain.contacts[i].element] = std::sqrt(square);
        sum += square;
    }
    errors.error = std::sqrt(sum);
    return errors;
}

/** xi = -J^-1 eps, and each geodesic's start corrected by it (thesis Eqn. 4.57, Sec. 4.5). */
bool correctStarts(const PathProblem& problem, const std::vector<double>& eps, PathJacobian& jacobian, Chain& chain) {
    calcPathErrorJacobian(chain, jacobian);
    std::vector<double> step(eps.size());
    std::transform(eps.begin(), eps.end(), step.begin(), [](double error) { return -error; });
    if (!jacobian.solveInPlace(step)) return false;
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        ChainContact& contact = chain.contacts[i];
        contact.start = calcCorrectedStart(*problem.getElement(contact.element).surface, contact.start,
                                           contact.geodesic.P, Eigen::Map<const Vec4>(&step[kVariations * i]));
    }
    return true;
}

}  // namespace

PathStart makePathStart(const MusclePath& path, const std::vector<BoundWrap>& wraps, const Cable& cable) {
    PathStart start;
    std::size_t next = 0;
    for (CableElementIndex e(0); e < cable.getNumElements(); ++e) {
        if (!cable.isObstacle(e)) continue;
        const std::optional<WrapStart>& given = path.wraps[wraps[next++].wrap].start;
        if (!given) continue;
        start.resize(static_cast<std::size_t>(cable.getNumElements()));
        start[static_cast<std::size_t>(e)] = makeStart(*cable.getSurface(e), *given);
    }
    return start;
}

PathInPose makePathInPose(const Cable& cable, const SimTK::State& state) {
    PathInPose path;
    for (CableElementIndex e(0); e < cable.getNumElements(); ++e) {
        const SimTK::MobilizedBody& body = cable.getMatterSubsystem().getMobilizedBody(cable.getElementBody(e));
        SimTK::Transform X_BE = cable.getElementFrame(e);
        if (cable.isObstacle(e)) {
            path.problem.addObstacle(cable.getElementName(e), cable.getSurface(e));
        } else {
            path.problem.addPoint(cable.getElementName(e));
            X_BE.updP() = cable.calcStation(state, e);
        }
        path.pose.X_GE.push_back(toPose(body.getBodyTransform(state) * X_BE));
        path.pose.isActive.push_back(cable.isActive(state, e));
    }
    return path;
}

IteratedPath iteratePath(const PathInPose& path, const PathStart& start, double tolerance, int maxIterations) {
    IteratedPath result;
    result.start = start;
    Chain chain;
    chain.build(path.problem, path.pose, makeContacts(start));
    PathJacobian jacobian;
    std::vector<double> eps;
    for (int i = 0;; ++i) {
        if (!shootChain(path.problem, path.pose, GeodesicOptions(), chain)) break;
        result.largestError = calcPathError(chain, eps);
        result.iterations.push_back(calcErrors(chain, eps, start.size()));
        for (const ChainContact& contact : chain.contacts) result.start[contact.element] = contact.start;
        if (result.largestError <= tolerance || i == maxIterations) break;
        if (!correctStarts(path.problem, eps, jacobian, chain)) break;
    }
    return result;
}

PathSolution makePathSolution(const PathInPose& path, const PathStart& start) {
    PathSolution solution;
    solution.contacts = makeContacts(start);
    PathSolver solver;
    solver.solveKeepingContacts(path.problem, path.pose, solution);
    return solution;
}

}  // namespace tautline::models
