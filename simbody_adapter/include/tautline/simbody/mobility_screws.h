// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <vector>

namespace tautline {

/** A force on a body, as moment about ground's origin and force, in ground. */
struct BodyForceAtGround {
    SimTK::MobilizedBodyIndex body;
    SimTK::SpatialVec force;
};

/** How each mobility of a system moves the bodies outboard of it in one pose: by a screw, the angular velocity per unit
of speed and the velocity of the body at ground's origin. What many cables do to mobilities is found with it by a few
products each, where a multiplication by the system's Jacobian goes over all bodies. */
class MobilityScrews {
public:
    /** Stage: Position, of the matter subsystem. Call it again for another pose. */
    void update(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state);

    /** Adds what forces do to the mobilities that move their bodies against each other.
    @param forces   that sum to zero, as those of a cable do; overwritten
    @param[in,out] mobilityForces   one entry per mobility */
    void addBalancedForces(std::vector<BodyForceAtGround>& forces, SimTK::Vector& mobilityForces) const;

    int getNumMobilities() const { return static_cast<int>(m_screws.size()); }

private:
    struct Mobilizer {
        SimTK::MobilizedBodyIndex parent;
        int firstMobility = 0, numMobilities = 0;
    };

    std::vector<Mobilizer> m_mobilizers;  ///< by body
    std::vector<SimTK::SpatialVec> m_screws;
};

}  // namespace tautline
