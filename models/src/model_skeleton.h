// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include "tautline/models/model_builder.h"

namespace tautline::models {

/** The bodies of a model without its paths and forces, for poses that shall cost no path. */
struct ModelSkeleton {
    explicit ModelSkeleton(const ModelDescription& description)
        : matter(system), forces(system), model(buildMultibody(description, matter)), state(system.realizeTopology()) {
        system.realizeModel(state);
    }
    ModelSkeleton(const ModelSkeleton&) = delete;
    ModelSkeleton& operator=(const ModelSkeleton&) = delete;

    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::GeneralForceSubsystem forces;  // Simbody 3.7 cannot realize a matter subsystem without one
    BuiltModel model;
    SimTK::State state;
};

}  // namespace tautline::models
