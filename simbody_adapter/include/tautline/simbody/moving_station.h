// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <functional>

namespace tautline {

/** Where a point of a cable is on its body B while it is not fixed there: x(q, t), measured and expressed in B.
Must be smooth in the State if the length rate is to be exact. Called by many threads at once. */
class MovingStation {
public:
    virtual ~MovingStation() = default;

    /** x [m]. The State is realized to Time at least and its bodies' poses are known. */
    virtual SimTK::Vec3 calcStation(const SimTK::State& state) const = 0;

    /** dx/dt, B held still [m/s]. The velocities of the bodies are known. */
    virtual SimTK::Vec3 calcVelocity(const SimTK::State& state) const = 0;

    /** Adds what a force on the point does beside its action on B: force_B . d(velocity)/du_i to each mobility i of
    the system. Without it the power of the cable's forces is not -tension * length rate; the difference is then
    the work of whatever moves the point. Stage: Position. */
    virtual void addMobilityForces(const SimTK::State& state, const SimTK::Vec3& force_B,
                                   SimTK::Vector& mobilityForces) const = 0;
};

/** A station that is a function of one coordinate whose speed u is its derivative: x(q), as in moving path points
of musculoskeletal models. Its mobility force is force_B . x'(q). */
class CoordinateStation : public MovingStation {
public:
    using Curve = std::function<SimTK::Vec3(SimTK::Real)>;

    /** @param body       the mobilizer of the coordinate
    @param calcCurve  x(q) [m]
    @param calcSlope  x'(q), consistent with it
    @throws InvalidInput for an empty function */
    CoordinateStation(const SimTK::MobilizedBody& body, SimTK::MobilizerQIndex q, SimTK::MobilizerUIndex u,
                      Curve calcCurve, Curve calcSlope);

    SimTK::Vec3 calcStation(const SimTK::State& state) const override;
    SimTK::Vec3 calcVelocity(const SimTK::State& state) const override;
    void addMobilityForces(const SimTK::State& state, const SimTK::Vec3& force_B,
                           SimTK::Vector& mobilityForces) const override;

private:
    SimTK::MobilizedBody m_body;
    SimTK::MobilizerQIndex m_q;
    SimTK::MobilizerUIndex m_u;
    Curve m_calcCurve, m_calcSlope;
};

}  // namespace tautline
