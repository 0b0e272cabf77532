// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "path_force_laws.h"
#include "tautline/models/model_builder.h"

namespace tautline::models {

/** What forces are added to. */
struct ForceTarget {
    SimTK::MultibodySystem& system;
    SimTK::GeneralForceSubsystem& forces;
    /** Made when the first contact force needs it. */
    std::optional<SimTK::GeneralContactSubsystem>& contacts;
    const BuiltModel& model;
};

/** The control that a model prescribes for an actuator; null if it prescribes none. */
Control findControl(const ModelDescription& description, const std::string& actuator);

/** Adds the forces without a path. */
void addBodyForces(const ModelDescription& description, ForceTarget target);

}  // namespace tautline::models
