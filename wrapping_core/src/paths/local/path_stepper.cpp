// SPDX-License-Identifier: Apache-2.0
#include "paths/local/path_stepper.h"

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

constexpr double kMaxMove = 0.5;  ///< of P and of the length in one step, in sizes of the surface
constexpr double kMaxTurn = 0.6;  ///< of the start direction in one step [rad]

double calcLargest(const std::vector<double>& v) {
    double largest = 0;
    for (double x : v) largest = std::max(largest, std::abs(x));
    return largest;
}

}  // namespace

double calcNorm(const std::vector<double>& v) {
    double sum = 0;
    for (double x : v) sum += x * x;
    return std::sqrt(sum);
}

bool PathStepper::begin(const PathProblem& problem, const PathPose& pose, PathSolution& path) {
    m_problem = &problem, m_pose = &pose;
    path.errorHistory.clear();
    path.errorHistory.reserve(m_options.maxIterations + 1);
    m_chain.build(problem, pose, path.contacts);
    m_trial.build(problem, pose, path.contacts);
    int numShots = 0;
    const bool isFinite = shootUnknownArcs(problem, pose, m_options.geodesics, path.contacts, m_chain, numShots);
    if (!isFinite) shortenBrokenArcs();
    path.shots += numShots;
    path.pathError = calcPathError(m_chain, m_eps);
    path.errorHistory.push_back(path.pathError);
    return isFinite;
}

/** Where an arc cannot be shot, all are drawn as points of their surfaces: a path that is finite, if not more. */
void PathStepper::shortenBrokenArcs() {
    for (ChainContact& contact : m_chain.contacts) {
        const Surface& surface = *m_problem->getElement(contact.element).surface;
        const Vector3 anywhere = Vector3::Constant(surface.getSize());
        contact.start.point =
            surface.findSurfacePoint(contact.start.point.p.allFinite() ? contact.start.point.p : anywhere);
        contact.start.tangent = surface.calcFrame(contact.start.point, Vector3::UnitX()).t;
        contact.start.length = 0;
    }
    shootChain(*m_problem, *m_pose, m_options.geodesics, m_chain);
}

double PathStepper::calcStepFraction(const std::vector<double>& step) const {
    double fraction = 1;
    for (std::size_t i = 0; i < m_chain.contacts.size(); ++i) {
        const double limit = kMaxMove * getSize(i);
        const double* d = &step[kVariations * i];
        const double move = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[3])});
        if (move * fraction > limit) fraction = limit / move;
        if (std::abs(d[2]) * fraction > kMaxTurn) fraction = kMaxTurn / std::abs(d[2]);
    }
    return fraction;
}

bool PathStepper::tryStep(const std::vector<double>& step, double fraction, PathSolution& path) {
    for (std::size_t i = 0; i < m_chain.contacts.size(); ++i) {
        const ChainContact& contact = m_chain.contacts[i];
        const Vector4 correction = fraction * Eigen::Map<const Vector4>(&step[kVariations * i]);
        m_trial.contacts[i].start = calcCorrectedStart(*m_problem->getElement(contact.element).surface, contact.start,
                                                       contact.geodesic.P, correction);
    }
    path.shots += static_cast<int>(m_trial.contacts.size());
    if (!shootChain(*m_problem, *m_pose, m_options.geodesics, m_trial)) return false;
    calcPathError(m_trial, m_trialEps);
    return true;
}

void PathStepper::acceptTrial(PathSolution& path) {
    std::swap(m_chain, m_trial);
    std::swap(m_eps, m_trialEps);
    path.pathError = calcLargest(m_eps);
    path.errorHistory.push_back(path.pathError);
}

void PathStepper::store(PathSolution& path) const {
    path.segments.resize(m_chain.segments.size());
    for (std::size_t j = 0; j < m_chain.segments.size(); ++j) path.segments[j] = m_chain.segments[j].line;
    for (const ChainContact& from : m_chain.contacts) {
        path.contacts[from.element].segment = -1;
        ContactArc& to = path.contacts[from.element].updArc(from.arc);
        to.start = from.start;
        to.start.point.p = from.geodesic.P.x;  // of (u, v), to the last digit
        to.start.tangent = from.geodesic.P.t;
        to.geodesic = from.geodesic;
        to.shot = {m_problem->getElement(from.element).surface->getId(), m_options.geodesics.accuracy};
    }
    path.length = calcLength(m_chain);
}

}  // namespace tautline
