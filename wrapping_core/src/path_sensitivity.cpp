#include "tautline/path_sensitivity.h"

namespace tautline {
namespace {

/** Rate of the unit vector of a segment whose ends move. */
Vec3 calcDirectionRate(const StraightSegment& line, const Vec3& ARate, const Vec3& BRate) {
    const Vec3 relative = BRate - ARate;
    return line.length > 0 ? Vec3((relative - line.e.dot(relative) * line.e) / line.length) : Vec3(Vec3::Zero());
}

Vec3 calcStationVelocity(const Pose& X_GE, const SpatialVelocity& V, const Vec3& point_G) {
    return V.v + V.w.cross(point_G - X_GE.p);
}

void addForceRate(const Vec3& arm, const Vec3& armRate, const Vec3& force, const Vec3& forceRate, SpatialForce& rate) {
    rate.force += forceRate;
    rate.moment += armRate.cross(force) + arm.cross(forceRate);
}

}  // namespace

void PathSensitivity::setPath(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    m_problem = &problem, m_pose = &pose;
    m_chain.build(problem, pose, path.contacts);
    for (ChainContact& contact : m_chain.contacts) {
        contact.geodesic = path.contacts[contact.element].geodesic;
        contact.P = contact.geodesic.P.reexpressedBy(pose.X_GE[contact.element]);
        contact.Q = contact.geodesic.Q.reexpressedBy(pose.X_GE[contact.element]);
    }
    for (std::size_t j = 0; j < m_chain.segments.size(); ++j) m_chain.segments[j].line = path.segments[j];
}

/** Velocities of the segments' ends as material points, and eps' at constant xi. */
void PathSensitivity::calcRigidRates(const std::vector<SpatialVelocity>& V_GE) {
    const std::size_t n = m_chain.segments.size();
    m_ARate.resize(n), m_BRate.resize(n);
    for (std::size_t j = 0; j < n; ++j) {
        const StraightSegment& line = m_chain.segments[j].line;
        m_ARate[j] = calcStationVelocity(m_pose->X_GE[line.fromElement], V_GE[line.fromElement], line.A);
        m_BRate[j] = calcStationVelocity(m_pose->X_GE[line.toElement], V_GE[line.toElement], line.B);
    }
    m_rates.resize(kVariations * m_chain.contacts.size());
    for (std::size_t i = 0; i < m_chain.contacts.size(); ++i) {
        const ChainContact& contact = m_chain.contacts[i];
        const std::size_t in = contact.segmentIn, out = in + 1;
        const Vec3& w = V_GE[contact.element].w;
        const auto rate = [&](std::size_t segment, const Vec3& axis) {
            const StraightSegment& line = m_chain.segments[segment].line;
            return calcDirectionRate(line, m_ARate[segment], m_BRate[segment]).dot(axis) + line.e.dot(w.cross(axis));
        };
        m_rates[kVariations * i] = -rate(in, contact.P.N);
        m_rates[kVariations * i + 1] = -rate(in, contact.P.B);
        m_rates[kVariations * i + 2] = -rate(out, contact.Q.N);
        m_rates[kVariations * i + 3] = -rate(out, contact.Q.B);
    }
}

/** Adds what the geodesics' own change (m_rates = xi') moves the contact points by. */
void PathSensitivity::addXiRates(PathVariation& variation) {
    for (std::size_t i = 0; i < m_chain.contacts.size(); ++i) {
        const ChainContact& contact = m_chain.contacts[i];
        const Vec4 xiRate = Eigen::Map<const Vec4>(&m_rates[kVariations * i]);
        m_BRate[contact.segmentIn] += calcStartVariations(contact.P).x * xiRate;
        m_ARate[contact.segmentIn + 1] += calcEndVariations(contact.Q, contact.geodesic).x * xiRate;
        variation.xiRate[contact.element] = xiRate;
        variation.PRate[contact.element] = m_BRate[contact.segmentIn];
        variation.QRate[contact.element] = m_ARate[contact.segmentIn + 1];
    }
}

void PathSensitivity::calcForceRates(const std::vector<SpatialVelocity>& V_GE, PathVariation& variation) const {
    for (std::size_t j = 0; j < m_chain.segments.size(); ++j) {
        const StraightSegment& line = m_chain.segments[j].line;
        const Vec3 eRate = calcDirectionRate(line, m_ARate[j], m_BRate[j]);
        const int from = line.fromElement, to = line.toElement;
        addForceRate(line.A - m_pose->X_GE[from].p, m_ARate[j] - V_GE[from].v, line.e, eRate,
                     variation.forceRate[from]);
        addForceRate(line.B - m_pose->X_GE[to].p, m_BRate[j] - V_GE[to].v, -line.e, -eRate, variation.forceRate[to]);
    }
}

bool PathSensitivity::calcVariation(const std::vector<SpatialVelocity>& V_GE, PathVariation& variation) {
    const std::size_t n = m_pose->X_GE.size();
    variation.xiRate.assign(n, Vec4::Zero());
    variation.PRate.assign(n, Vec3::Zero());
    variation.QRate.assign(n, Vec3::Zero());
    variation.forceRate.assign(n, SpatialForce());
    calcRigidRates(V_GE);
    variation.lengthRate = 0;  // Eqn. 5.13: the geodesics' own change does not count
    for (std::size_t j = 0; j < m_chain.segments.size(); ++j)
        variation.lengthRate += m_chain.segments[j].line.e.dot(m_BRate[j] - m_ARate[j]);
    calcPathErrorJacobian(m_chain, m_jacobian);
    if (!m_chain.contacts.empty() && !m_jacobian.solveInPlace(m_rates)) return false;
    addXiRates(variation);
    calcForceRates(V_GE, variation);
    return true;
}

bool PathSensitivity::predictStarts(const std::vector<SpatialVelocity>& V_GE, double dt, PathSolution& path) {
    if (!calcVariation(V_GE, m_prediction)) return false;
    for (const ChainContact& contact : m_chain.contacts) {
        ObstacleContact& start = path.contacts[contact.element];
        start.start = calcCorrectedStart(*m_problem->getElement(contact.element).surface, start.start, start.geodesic.P,
                                         dt * m_prediction.xiRate[contact.element]);
    }
    return true;
}

}  // namespace tautline
