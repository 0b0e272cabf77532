#include "tautline/path_newton.h"

#include <algorithm>
#include <cmath>

#include "tautline/error.h"

namespace tautline {
namespace {

constexpr double kMaxMove = 0.5;        ///< of P and of the length in one step, in sizes of the surface
constexpr double kMaxTurn = 0.6;        ///< of the start direction in one step [rad]
constexpr double kLeastFraction = 0.1;  ///< of a Newton step within these limits; damped steps go before shorter ones
constexpr int kMaxHalvings = 6;         ///< of a Newton step that does not lower the error
constexpr int kMaxDampings = 8;         ///< tenfold increases of the damping of a least-squares step

double calcNorm(const std::vector<double>& v) {
    double sum = 0;
    for (double x : v) sum += x * x;
    return std::sqrt(sum);
}

double calcLargest(const std::vector<double>& v) {
    double largest = 0;
    for (double x : v) largest = std::max(largest, std::abs(x));
    return largest;
}

}  // namespace

void PathSolverOptions::validate() const {
    require(pathErrorTolerance > 0 && pathErrorTolerance <= 0.1,
            "path solver: pathErrorTolerance must be in (0, 0.1], but is ", pathErrorTolerance);
    require(maxIterations >= 1, "path solver: maxIterations must be at least 1, but is ", maxIterations);
    require(geodesics.accuracy > 0 && geodesics.accuracy <= 0.1,
            "path solver: geodesic accuracy must be in (0, 0.1], but is ", geodesics.accuracy);
    require(geodesics.maxSteps >= 1, "path solver: geodesic maxSteps must be at least 1, but is ", geodesics.maxSteps);
}

/** Thesis Sec. 4.6: shoot, assemble, solve, correct, until the path error vanishes. Where Newton's step does
not lower the error, or does not exist (a chord through a sphere's centre leaves the side open, and the
Jacobian singular), damped least-squares steps take its place. */
bool PathNewton::iterate(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    path.errorHistory.clear();
    m_chain.build(problem, pose, path.contacts);
    m_trial = m_chain;  // the same contacts and segments; steps change the geodesics only
    const bool isFinite = shootChain(problem, pose, m_options.geodesics, m_chain);
    if (!isFinite) shortenBrokenArcs(problem, pose);
    path.shots += static_cast<int>(m_chain.contacts.size());
    path.pathError = calcPathError(m_chain, m_eps);
    path.errorHistory.push_back(path.pathError);
    for (int i = 0; isFinite && path.pathError > m_options.pathErrorTolerance && i < m_options.maxIterations; ++i) {
        ++path.iterations;
        if (!tryNewtonStep(problem, pose, path) && !tryDampedSteps(problem, pose, path)) break;
        std::swap(m_chain, m_trial);
        std::swap(m_eps, m_trialEps);
        path.pathError = calcLargest(m_eps);
        path.errorHistory.push_back(path.pathError);
    }
    storeChain(path);
    return isFinite && path.pathError <= m_options.pathErrorTolerance;
}

/** Where an arc cannot be shot, all are drawn as points of their surfaces: a path that is finite, if not more. */
void PathNewton::shortenBrokenArcs(const PathProblem& problem, const PathPose& pose) {
    for (ChainContact& contact : m_chain.contacts) {
        const Surface& surface = *problem.getElement(contact.element).surface;
        const Vec3 anywhere = Vec3::Constant(surface.getSize());
        contact.start.point =
            surface.findSurfacePoint(contact.start.point.p.allFinite() ? contact.start.point.p : anywhere);
        contact.start.tangent = surface.calcFrame(contact.start.point, Vec3::UnitX()).t;
        contact.start.length = 0;
    }
    shootChain(problem, pose, m_options.geodesics, m_chain);
}

/** Applies a fraction of m_step to m_trial. @return true if the error is lower there */
bool PathNewton::tryStep(const PathProblem& problem, const PathPose& pose, double fraction, PathSolution& path) {
    applyStep(problem, fraction);
    path.shots += static_cast<int>(m_trial.contacts.size());
    if (!shootChain(problem, pose, m_options.geodesics, m_trial)) return false;
    calcPathError(m_trial, m_trialEps);
    return calcNorm(m_trialEps) < calcNorm(m_eps);
}

bool PathNewton::tryNewtonStep(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    if (!calcNewtonStep()) return false;
    double fraction = calcStepFraction(problem);
    // So long a step means that the Jacobian is next to singular: a chord near a sphere's centre can turn freely.
    if (fraction < kLeastFraction && tryDampedSteps(problem, pose, path)) return true;
    if (fraction < kLeastFraction && !calcNewtonStep()) return false;
    for (int halving = 0; halving <= kMaxHalvings; ++halving, fraction /= 2)
        if (tryStep(problem, pose, fraction, path)) return true;
    return false;
}

bool PathNewton::tryDampedSteps(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    const double norm = calcNorm(m_eps);
    // Damping of the order of the squared error keeps the convergence quadratic on a singular Jacobian too.
    double damping = std::min(1e-2, norm * norm);
    for (int i = 0; i < kMaxDampings; ++i, damping *= 10)
        if (calcDampedStep(problem, damping) && tryStep(problem, pose, calcStepFraction(problem), path)) return true;
    return false;
}

/** m_step = -J^-1 eps (thesis Eqn. 4.57). */
bool PathNewton::calcNewtonStep() {
    calcPathErrorJacobian(m_chain, m_jacobian);
    m_step.resize(m_eps.size());
    for (std::size_t i = 0; i < m_eps.size(); ++i) m_step[i] = -m_eps[i];
    return m_jacobian.solveInPlace(m_step);
}

/** m_step = -D (D J^T J D + damping I)^-1 D J^T eps, D the sizes of the surfaces for moves and 1 for turns. */
bool PathNewton::calcDampedStep(const PathProblem& problem, double damping) {
    calcPathErrorJacobian(m_chain, m_jacobian);
    const int n = static_cast<int>(m_eps.size());
    const auto scale = [&](int column) {
        const int element = m_chain.contacts[column / kVariations].element;
        return column % kVariations == 2 ? 1.0 : problem.getElement(element).surface->getSize();
    };
    m_normal.reset(n);
    m_step.assign(n, 0.0);
    for (int column = 0; column < n; ++column) {
        const int first = std::max(0, column - kPathBandwidth), last = std::min(n - 1, column + kPathBandwidth);
        for (int row = first; row <= last; ++row) {
            const double entry = m_jacobian.get(row, column) * scale(column);
            m_step[column] -= entry * m_eps[row];
            const int from = std::max(0, row - kPathBandwidth), to = std::min(n - 1, row + kPathBandwidth);
            for (int other = from; other <= to; ++other)
                m_normal.upd(other, column) += entry * m_jacobian.get(row, other) * scale(other);
        }
        m_normal.upd(column, column) += damping;
    }
    if (!m_normal.solveInPlace(m_step)) return false;
    for (int column = 0; column < n; ++column) m_step[column] *= scale(column);
    return true;
}

/** Largest fraction of m_step, up to 1, that keeps every geodesic within the step limits. */
double PathNewton::calcStepFraction(const PathProblem& problem) const {
    double fraction = 1;
    for (std::size_t i = 0; i < m_chain.contacts.size(); ++i) {
        const double limit = kMaxMove * problem.getElement(m_chain.contacts[i].element).surface->getSize();
        const double* d = &m_step[kVariations * i];
        const double move = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[3])});
        if (move * fraction > limit) fraction = limit / move;
        if (std::abs(d[2]) * fraction > kMaxTurn) fraction = kMaxTurn / std::abs(d[2]);
    }
    return fraction;
}

void PathNewton::applyStep(const PathProblem& problem, double fraction) {
    for (std::size_t i = 0; i < m_chain.contacts.size(); ++i) {
        const ChainContact& contact = m_chain.contacts[i];
        const Vec4 correction = fraction * Eigen::Map<const Vec4>(&m_step[kVariations * i]);
        m_trial.contacts[i].start = calcCorrectedStart(*problem.getElement(contact.element).surface, contact.start,
                                                       contact.geodesic.P, correction);
    }
}

void PathNewton::storeChain(PathSolution& path) const {
    path.segments.resize(m_chain.segments.size());
    for (std::size_t j = 0; j < m_chain.segments.size(); ++j) path.segments[j] = m_chain.segments[j].line;
    for (const ChainContact& from : m_chain.contacts) {
        ObstacleContact& to = path.contacts[from.element];
        to.start = from.start;
        to.start.tangent = from.geodesic.P.t;
        to.geodesic = from.geodesic;
        to.segment = -1;
    }
    path.length = calcLength(m_chain);
}

}  // namespace tautline
