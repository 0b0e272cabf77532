// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_sensitivity.h"

#include "paths/equations/path_error.h"
#include "paths/problem/velocity_check.h"

namespace tautline {
namespace {

/** Rate of the unit vector of a segment whose ends move. */
Vector3 calcDirectionRate(const StraightSegment& line, const Vector3& ARate, const Vector3& BRate) {
    const Vector3 relative = BRate - ARate;
    return line.length > 0 ? Vector3((relative - line.e.dot(relative) * line.e) / line.length)
                           : Vector3(Vector3::Zero());
}

void addForceRate(const Vector3& arm, const Vector3& armRate, const Vector3& force, const Vector3& forceRate,
                  SpatialForce& rate) {
    rate.force += forceRate;
    rate.moment += armRate.cross(force) + arm.cross(forceRate);
}

}  // namespace

/** The path as a chain, and what one variation needs. */
struct PathSensitivity::Workspace {
    void calcRigidRates(const std::vector<SpatialVelocity>& V_GE);
    void addXiRates(PathVariation& variation);
    void calcForceRates(const std::vector<SpatialVelocity>& V_GE, PathVariation& variation) const;

    const PathProblem* problem = nullptr;
    const PathPose* pose = nullptr;
    Chain chain;
    PathJacobian jacobian;
    std::vector<double> rates;            ///< eps' at constant xi, then xi': four per contact
    std::vector<Vector3> ARates, BRates;  ///< of the segments' ends [m/s]
    PathVariation prediction;
};

PathSensitivity::PathSensitivity() : m_workspace(std::make_unique<Workspace>()) {}
PathSensitivity::PathSensitivity(PathSensitivity&&) noexcept = default;
PathSensitivity& PathSensitivity::operator=(PathSensitivity&&) noexcept = default;
PathSensitivity::~PathSensitivity() = default;

void PathSensitivity::setPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    Workspace& w = *m_workspace;
    w.pose = nullptr;
    const std::size_t numElements = static_cast<std::size_t>(problem.getNumElements());
    require(path.contacts.size() == numElements && pose.X_GE.size() == numElements, "path sensitivity: problem of ",
            numElements, " elements, but a path of ", path.contacts.size(), " and ", pose.X_GE.size(), " poses");
    w.chain.build(problem, pose, path.contacts);
    require(path.segments.size() == w.chain.segments.size(), "path sensitivity: contacts make ",
            w.chain.segments.size(), " straight segments, but the path has ", path.segments.size());
    w.problem = &problem, w.pose = &pose;
    for (ChainContact& contact : w.chain.contacts) {
        contact.geodesic = path.contacts[contact.element].getArc(contact.arc).geodesic;
        contact.P = contact.geodesic.P.reexpressedBy(pose.X_GE[contact.element]);
        contact.Q = contact.geodesic.Q.reexpressedBy(pose.X_GE[contact.element]);
    }
    for (std::size_t j = 0; j < w.chain.segments.size(); ++j) w.chain.segments[j].line = path.segments[j];
}

/** Velocities of the segments' ends as material points, and eps' at constant xi. */
void PathSensitivity::Workspace::calcRigidRates(const std::vector<SpatialVelocity>& V_GE) {
    const std::size_t n = chain.segments.size();
    ARates.resize(n), BRates.resize(n);
    for (std::size_t j = 0; j < n; ++j) {
        const StraightSegment& line = chain.segments[j].line;
        ARates[j] = calcStationVelocity(pose->X_GE[line.fromElement], V_GE[line.fromElement], line.A);
        BRates[j] = calcStationVelocity(pose->X_GE[line.toElement], V_GE[line.toElement], line.B);
    }
    rates.resize(kVariations * chain.contacts.size());
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const ChainContact& contact = chain.contacts[i];
        const std::size_t in = contact.segmentIn, out = in + 1;
        const Vector3& w = V_GE[contact.element].w;
        const auto rate = [&](std::size_t segment, const Vector3& axis) {
            const StraightSegment& line = chain.segments[segment].line;
            return calcDirectionRate(line, ARates[segment], BRates[segment]).dot(axis) + line.e.dot(w.cross(axis));
        };
        rates[kVariations * i] = -rate(in, contact.P.N);
        rates[kVariations * i + 1] = -rate(in, contact.P.B);
        rates[kVariations * i + 2] = -rate(out, contact.Q.N);
        rates[kVariations * i + 3] = -rate(out, contact.Q.B);
    }
}

/** Adds what the geodesics' own change (m_rates = xi') moves the contact points by. */
void PathSensitivity::Workspace::addXiRates(PathVariation& variation) {
    for (std::size_t i = 0; i < chain.contacts.size(); ++i) {
        const ChainContact& contact = chain.contacts[i];
        const Vector4 xiRate = Eigen::Map<const Vector4>(&rates[kVariations * i]);
        BRates[contact.segmentIn] += calcStartVariations(contact.P).x * xiRate;
        ARates[contact.segmentIn + 1] += calcEndVariations(contact.Q, contact.geodesic).x * xiRate;
        if (contact.arc == 0) {
            variation.xiRate[contact.element] = xiRate;
            variation.PRate[contact.element] = BRates[contact.segmentIn];
        }
        variation.QRate[contact.element] = ARates[contact.segmentIn + 1];
    }
}

void PathSensitivity::Workspace::calcForceRates(const std::vector<SpatialVelocity>& V_GE,
                                                PathVariation& variation) const {
    for (std::size_t j = 0; j < chain.segments.size(); ++j) {
        const StraightSegment& line = chain.segments[j].line;
        const Vector3 eRate = calcDirectionRate(line, ARates[j], BRates[j]);
        const int from = line.fromElement, to = line.toElement;
        addForceRate(line.A - pose->X_GE[from].p, ARates[j] - V_GE[from].v, line.e, eRate, variation.forceRate[from]);
        addForceRate(line.B - pose->X_GE[to].p, BRates[j] - V_GE[to].v, -line.e, -eRate, variation.forceRate[to]);
    }
}

bool PathSensitivity::calcVariation(const std::vector<SpatialVelocity>& V_GE, PathVariation& variation) {
    Workspace& w = *m_workspace;
    require(w.pose != nullptr, "path sensitivity: no path was set");
    requireVelocities(V_GE, *w.pose, "path sensitivity");
    const std::size_t n = V_GE.size();
    variation.xiRate.assign(n, Vector4::Zero());
    variation.PRate.assign(n, Vector3::Zero());
    variation.QRate.assign(n, Vector3::Zero());
    variation.forceRate.assign(n, SpatialForce());
    w.calcRigidRates(V_GE);
    variation.lengthRate = 0;  // Eqn. 5.13: the geodesics' own change does not count
    for (std::size_t j = 0; j < w.chain.segments.size(); ++j)
        variation.lengthRate += w.chain.segments[j].line.e.dot(w.BRates[j] - w.ARates[j]);
    calcPathErrorJacobian(w.chain, w.jacobian);
    if (!w.chain.contacts.empty() && !w.jacobian.solveInPlace(w.rates)) return false;
    w.addXiRates(variation);
    w.calcForceRates(V_GE, variation);
    return true;
}

bool PathSensitivity::predictStarts(const std::vector<SpatialVelocity>& V_GE, double dt, PathSolution& path) {
    Workspace& w = *m_workspace;
    if (!calcVariation(V_GE, w.prediction)) return false;
    for (std::size_t i = 0; i < w.chain.contacts.size(); ++i) {
        const ChainContact& contact = w.chain.contacts[i];
        ContactArc& arc = path.contacts[contact.element].updArc(contact.arc);
        const Vector4 xiRate = Eigen::Map<const Vector4>(&w.rates[kVariations * i]);
        arc.start =
            calcCorrectedStart(*w.problem->getElement(contact.element).surface, arc.start, arc.geodesic.P, dt * xiRate);
    }
    return true;
}

}  // namespace tautline
