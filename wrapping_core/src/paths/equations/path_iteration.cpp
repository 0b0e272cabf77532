// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_iteration.h"

#include <algorithm>
#include <cmath>

#include "paths/equations/path_error.h"
#include "tautline/error.h"

namespace tautline {
namespace {

PathIteration calcErrors(const Chain& chain, const std::vector<double>& eps, std::size_t numElements) {
    PathIteration errors;
    errors.obstacleErrors.assign(numElements, 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const double square = Eigen::Map<const Vector4>(&eps[kVariations * i]).squaredNorm();
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
                                           contact.geodesic.P, Eigen::Map<const Vector4>(&step[kVariations * i]));
    }
    return true;
}

}  // namespace

IteratedPath iteratePath(const PathProblem& problem, const PathPose& pose, const PathStart& start, double tolerance,
                         int maxIterations) {
    problem.validate();
    pose.validate(problem);
    require(static_cast<int>(start.size()) == problem.getNumElements(), "path iteration: ", start.size(),
            " starts for ", problem.getNumElements(), " elements");
    IteratedPath result;
    result.start = start;
    Chain chain;
    chain.build(problem, pose, makePathSolution(start).contacts);
    PathJacobian jacobian;
    std::vector<double> eps;
    for (int i = 0;; ++i) {
        if (!shootChain(problem, pose, ShootingOptions(), chain)) break;
        result.largestError = calcPathError(chain, eps);
        result.iterations.push_back(calcErrors(chain, eps, start.size()));
        for (const ChainContact& contact : chain.contacts) result.start[contact.element] = contact.start;
        if (result.largestError <= tolerance || i == maxIterations) break;
        if (!correctStarts(problem, eps, jacobian, chain)) break;
    }
    return result;
}

PathSolution makePathSolution(const PathStart& start) {
    PathSolution path;
    path.contacts.resize(start.size());
    for (std::size_t e = 0; e < start.size(); ++e) {
        if (!start[e]) continue;
        path.contacts[e].isTouched = true;
        path.contacts[e].start = *start[e];
    }
    return path;
}

}  // namespace tautline
