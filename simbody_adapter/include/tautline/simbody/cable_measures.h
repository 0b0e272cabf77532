// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include "tautline/simbody/cable.h"
#include "tautline/simbody/cable_force_law.h"

namespace tautline {

/** The length of a cable as a Measure [m]: of other Measures (Integrate, Minimum, Delay, ...), of a
PeriodicEventReporter, of a task. Its first derivative is the exact rate. Stage: Position, Velocity. */
class CableLengthMeasure : public SimTK::Measure {
public:
    /** @param subsystem   that owns the Measure: any of the cable's System, such as the CablePathSubsystem */
    CableLengthMeasure(SimTK::Subsystem& subsystem, const Cable& cable);
};

/** The rate of the length [m/s]. Stage: Velocity. */
class CableRateMeasure : public SimTK::Measure {
public:
    CableRateMeasure(SimTK::Subsystem& subsystem, const Cable& cable);
};

/** The tension with which a force element pulls at its cable [N]. Stage: Velocity. */
class CableTensionMeasure : public SimTK::Measure {
public:
    CableTensionMeasure(SimTK::Subsystem& subsystem, const CableForce& force);
};

}  // namespace tautline
