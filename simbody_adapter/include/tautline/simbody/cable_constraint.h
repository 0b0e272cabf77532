// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include "tautline/simbody/cable.h"

namespace tautline {

/** Holds the length L of a cable: a string that does not stretch, such as that of a pulley block. One holonomic
equation with its exact derivatives,

    L - L_0 = 0,     -sum F_B . V_GB = 0,     -sum (F_B . A_GB + dF_B/dt . V_GB) = 0,

F_B the unit force on body B; its multiplier is the tension. While contacts come and go, L and dL/dt are continuous, the
tension jumps. Where a string would go slack the constraint pushes like a rod: the tension is then negative, and it is
for the user to disable() the constraint.

The cable must be enabled, all of its elements added, and none of them a moving or conditional point. */
class CableConstraint : public SimTK::Constraint::Custom {
public:
    CableConstraint() = default;
    /** @param matter   of the cable's bodies
    @param length   L_0 [m], positive
    @throws InvalidInput with the value */
    CableConstraint(SimTK::SimbodyMatterSubsystem& matter, const Cable& cable, SimTK::Real length);

    const Cable& getCable() const;
    SimTK::Real getLength() const;
    /** The multiplier [N], 0 while the constraint is disabled. Stage: Acceleration. */
    SimTK::Real getTension(const SimTK::State& state) const;
};

}  // namespace tautline
