// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_problem.h"
#include "tautline/simbody/cable.h"
#include "tautline/simbody/mobility_screws.h"

namespace tautline {

/** One element of a cable and where it is fixed. */
struct CableElement {
    std::string name;
    SimTK::MobilizedBodyIndex body;
    SimTK::Transform X_BE;
    std::shared_ptr<const Surface> surface;  ///< null: a point
    StartHint hint;
    std::shared_ptr<const MovingStation> moving = nullptr;        ///< of a point; null: it is fixed at X_BE
    std::function<bool(const SimTK::State&)> isActive = nullptr;  ///< null: always
};

/** The elements of a cable in path order, origin first and insertion last: how they move with their bodies, and how
forces on them act on those. Per-element arrays have this order; E is an element's frame, B that of its body. */
class CableElements {
public:
    /** @param cableName   for messages */
    CableElements(const CablePathSubsystemImpl& cables, std::string cableName)
        : m_cables(cables), m_cableName(std::move(cableName)) {}

    void setEnds(CableElement origin, CableElement insertion);
    void setMovingEnd(bool isOrigin, std::shared_ptr<const MovingStation> station);
    /** @param element   before the insertion; without a name it gets one
    @throws InvalidInput if its name is taken or its hint does not suit its surface */
    CableElementIndex insert(CableElement element);
    /** @throws InvalidInput as insert() */
    void replace(CableElementIndex index, CableElement element);

    int size() const { return static_cast<int>(m_elements.size()); }
    auto begin() const { return m_elements.begin(); }
    auto end() const { return m_elements.end(); }
    const CableElement& operator[](int element) const { return m_elements[element]; }
    /** @throws InvalidInput if there is no such element, or if it is a point */
    const CableElement& get(CableElementIndex element) const;
    const CableElement& getObstacle(CableElementIndex element) const;
    bool hasMovingPoints() const;
    int countObstacles() const;
    /** The obstacle, or via point, of this number. @throws InvalidInput if there are not that many */
    CableElementIndex find(bool isObstacle, int number) const;

    PathProblem makeProblem() const;

    /** Of all elements in ground. Stage: Position of the bodies. @param X_GB   of all bodies */
    void calcPose(const SimTK::State& state, const std::vector<SimTK::Transform>& X_GB, PathPose& pose) const;
    /** Of all elements in ground, at their origins. Stage: Velocity of the bodies. */
    void calcVelocities(const SimTK::State& state, std::vector<SpatialVelocity>& V_GE) const;
    /** At a pose of earlier, without the motion of moving points on their bodies.
    @param V_GB   of all bodies, about their origins; empty: not known, and neither is V_GE then */
    void calcVelocities(const PathPose& pose, const std::vector<SimTK::SpatialVec>& V_GB,
                        std::vector<SpatialVelocity>& V_GE) const;
    /** What the turning of its body gives an element's origin [m/s^2], in ground, without that of the body's origin.
    @param w   angular velocity of the body in ground [rad/s] */
    Vector3 calcCentripetalAcceleration(const SimTK::State& state, int element, const Vector3& w) const;

    /** Of one element on its body, in ground [N m, N]. */
    SimTK::SpatialVec calcForceAboutBodyOrigin(const SimTK::State& state, const PathPose& pose,
                                               const std::vector<SpatialForce>& F_GE, int element) const;
    /** @param F_GE         of unit tension on the elements, about their origins, in ground
    @param[in,out] bodyForces   by body, about the bodies' origins, in ground [N m, N] */
    void addBodyForces(const SimTK::State& state, const PathPose& pose, const std::vector<SpatialForce>& F_GE,
                       SimTK::Real tension, SimTK::Vector_<SimTK::SpatialVec>& bodyForces) const;
    /** The same about ground's origin; ground is a body, too, so that they sum to zero. @param[out] forces   appended,
    neighbors on one body together */
    void addForcesAtGround(const PathPose& pose, const std::vector<SpatialForce>& F_GE,
                           std::vector<BodyForceAtGround>& forces) const;
    /** Of the points that coordinates move.
    @param F_GE, tension            as above
    @param[in,out] mobilityForces   by mobility [N or N m] */
    void addMobilityForces(const SimTK::State& state, const std::vector<SpatialForce>& F_GE, SimTK::Real tension,
                           SimTK::Vector& mobilityForces) const;

private:
    void check(const CableElement& element) const;
    const SimTK::MobilizedBody& getBody(const CableElement& element) const;

    const CablePathSubsystemImpl& m_cables;
    std::string m_cableName;
    std::vector<CableElement> m_elements;
};

}  // namespace tautline
