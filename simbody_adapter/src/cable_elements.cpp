// SPDX-License-Identifier: Apache-2.0
#include "cable_elements.h"

#include <algorithm>
#include <utility>

#include "cable_path_subsystem_impl.h"
#include "tautline/error.h"
#include "tautline/simbody/conversions.h"

namespace tautline {

using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::State;

void CableElements::setEnds(CableElement origin, CableElement insertion) {
    m_elements = {std::move(origin), std::move(insertion)};
}

void CableElements::setMovingEnd(bool isOrigin, std::shared_ptr<const MovingStation> station) {
    (isOrigin ? m_elements.front() : m_elements.back()).moving = std::move(station);
}

CableElementIndex CableElements::insert(CableElement element) {
    const CableElementIndex index(size() - 1);
    if (element.name.empty()) element.name = (element.surface ? "obstacle" : "point") + std::to_string(index);
    for (const CableElement& other : m_elements)
        require(other.name != element.name, "cable '", m_cableName, "': there is an element '", element.name,
                "' already");
    check(element);
    m_elements.insert(m_elements.end() - 1, std::move(element));
    return index;
}

void CableElements::replace(CableElementIndex index, CableElement element) {
    check(element);
    m_elements[index] = std::move(element);
}

namespace {

/** A rotation is taken as it is, never re-orthogonalized: what is none would shear and scale a surface. */
bool isRotation(const SimTK::Rotation& R) {
    constexpr Real kRounding = 1e-8;
    const Matrix3 M = toEigen(R.asMat33());
    return (M.transpose() * M - Matrix3::Identity()).norm() < kRounding && M.determinant() > 0;
}

}  // namespace

/** @throws InvalidInput for what Simbody and the core would take as it is, or refuse later */
void CableElements::check(const CableElement& element) const {
    require(element.X_BE.p().isFinite(), "cable '", m_cableName, "': where '", element.name,
            "' is on its body is not finite: ", element.X_BE.p());
    require(isRotation(element.X_BE.R()), "cable '", m_cableName, "': the orientation of '", element.name,
            "' is no rotation: ", element.X_BE.R().asMat33());
    if (!element.surface) return;
    try {
        PathProblem().addObstacle(element.name, element.surface, element.hint);
    } catch (const InvalidInput& error) {
        throw InvalidInput("cable '" + m_cableName + "': " + error.what());
    }
}

const CableElement& CableElements::get(CableElementIndex element) const {
    require(element.isValid() && element < size(), "cable '", m_cableName, "': no element ", static_cast<int>(element),
            " of ", size());
    return m_elements[element];
}

const CableElement& CableElements::getObstacle(CableElementIndex element) const {
    const CableElement& found = get(element);
    require(found.surface != nullptr, "cable '", m_cableName, "': element '", found.name,
            "' is a point, not an obstacle");
    return found;
}

bool CableElements::hasMovingPoints() const {
    return std::any_of(begin(), end(), [](const CableElement& e) { return e.moving || e.isActive; });
}

int CableElements::countObstacles() const {
    return static_cast<int>(std::count_if(begin(), end(), [](const CableElement& e) { return e.surface != nullptr; }));
}

CableElementIndex CableElements::find(bool isObstacle, int number) const {
    int count = 0;
    for (CableElementIndex e(1); e < size() - 1; ++e)
        if ((m_elements[e].surface != nullptr) == isObstacle && count++ == number) return e;
    throw InvalidInput("cable '" + m_cableName + "': no " + (isObstacle ? "obstacle " : "via point ") +
                       std::to_string(number) + " of " + std::to_string(count));
}

PathProblem CableElements::makeProblem() const {
    PathProblem problem;
    for (const CableElement& element : m_elements) {
        if (element.surface)
            problem.addObstacle(element.name, element.surface, element.hint);
        else
            problem.addPoint(element.name);
    }
    return problem;
}

const SimTK::MobilizedBody& CableElements::getBody(const CableElement& element) const {
    return m_cables.getMatter().getMobilizedBody(element.body);
}

void CableElements::calcPose(const State& state, const std::vector<SimTK::Transform>& X_GB, PathPose& pose) const {
    pose.X_GE.resize(m_elements.size());
    pose.isActive.assign(m_elements.size(), 1);
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const CableElement& element = m_elements[e];
        const SimTK::Transform& X_GBody = X_GB[element.body];
        if (element.surface)
            pose.X_GE[e] = toPose(X_GBody * element.X_BE);
        else if (element.moving)
            pose.X_GE[e] = Pose(toEigen(X_GBody * element.moving->calcStation(state)));
        else  // the frame of a point is not turned on its body
            pose.X_GE[e] = {toEigen(X_GBody.R().asMat33()), toEigen(X_GBody * element.X_BE.p())};
        if (element.isActive) pose.isActive[e] = element.isActive(state);
    }
}

void CableElements::calcVelocities(const State& state, std::vector<SpatialVelocity>& V_GE) const {
    V_GE.resize(m_elements.size());
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const SimTK::MobilizedBody& body = getBody(m_elements[e]);
        const std::shared_ptr<const MovingStation>& moving = m_elements[e].moving;
        const SimTK::Vec3 station_B = moving ? moving->calcStation(state) : m_elements[e].X_BE.p();
        SimTK::Vec3 v_G = body.findStationVelocityInGround(state, station_B);
        if (moving) v_G += body.getBodyRotation(state) * moving->calcVelocity(state);
        V_GE[e] = {toEigen(body.getBodyAngularVelocity(state)), toEigen(v_G)};
    }
}

void CableElements::calcVelocities(const PathPose& pose, const std::vector<SpatialVec>& V_GB,
                                   std::vector<SpatialVelocity>& V_GE) const {
    V_GE.resize(V_GB.empty() || pose.X_GE.empty() ? 0 : m_elements.size());
    for (std::size_t e = 0; e < V_GE.size(); ++e) {
        const CableElement& element = m_elements[e];
        const SpatialVec& V = V_GB[element.body];
        V_GE[e] = {toEigen(V[0]), toEigen(V[1])};
        if (element.moving) continue;
        const Vector3 p_BE_E = toEigen(~element.X_BE.R() * element.X_BE.p());
        V_GE[e].v += V_GE[e].w.cross(pose.X_GE[e].R * p_BE_E);
    }
}

Vector3 CableElements::calcCentripetalAcceleration(const State& state, int element, const Vector3& w) const {
    const CableElement& at = m_elements[element];
    const Vector3 p_BE_G = toEigen(getBody(at).getBodyRotation(state) * at.X_BE.p());
    return w.cross(w.cross(p_BE_G));
}

SpatialVec CableElements::calcForceAboutBodyOrigin(const State& state, const PathPose& pose,
                                                   const std::vector<SpatialForce>& F_GE, int element) const {
    const SpatialVec F = toSpatialVec(F_GE[element]);
    const SimTK::Vec3 p_BE_G =
        toSimTK(pose.X_GE[element].p) - getBody(m_elements[element]).getBodyOriginLocation(state);
    return SpatialVec(F[0] + p_BE_G % F[1], F[1]);
}

void CableElements::addBodyForces(const State& state, const PathPose& pose, const std::vector<SpatialForce>& F_GE,
                                  Real tension, SimTK::Vector_<SpatialVec>& bodyForces) const {
    for (int e = 0; e < size(); ++e)
        bodyForces[m_elements[e].body] += tension * calcForceAboutBodyOrigin(state, pose, F_GE, e);
}

void CableElements::addForcesAtGround(const PathPose& pose, const std::vector<SpatialForce>& F_GE,
                                      std::vector<BodyForceAtGround>& forces) const {
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const Vector3 moment_G = F_GE[e].moment + pose.X_GE[e].p.cross(F_GE[e].force);
        const SpatialVec force(toSimTK(moment_G), toSimTK(F_GE[e].force));
        if (!forces.empty() && forces.back().body == m_elements[e].body)
            forces.back().force += force;
        else
            forces.push_back({m_elements[e].body, force});
    }
}

void CableElements::addMobilityForces(const State& state, const std::vector<SpatialForce>& F_GE, Real tension,
                                      SimTK::Vector& mobilityForces) const {
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const CableElement& element = m_elements[e];
        if (!element.moving) continue;
        const SimTK::Vec3 force_B = ~getBody(element).getBodyRotation(state) * toSimTK(F_GE[e].force);
        element.moving->addMobilityForces(state, tension * force_B, mobilityForces);
    }
}

}  // namespace tautline
