// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <memory>
#include <optional>

#include "tautline/models/model_builder.h"
#include "tautline/models/model_paths.h"
#include "tautline/simbody/cable_path_subsystem.h"

namespace tautline::models {

/** A model as a Simbody system that can be simulated: bodies and joints, gravity, and for each muscle or path spring a
cable over its wrap objects with a muscle of the file's model or an elastic string that pulls at it.

@throws ModelError as buildMultibody() does, and for a path whose first or last point is conditional, naming the point
and its line. */
class ModelSystem {
public:
    using MuscleSlot = ModelPaths::MuscleSlot;
    using SpringSlot = ModelPaths::SpringSlot;
    using PathForceSlot = ModelPaths::PathForceSlot;
    using FunctionPathSlot = ModelPaths::FunctionPathSlot;
    using PathView = ModelPaths::PathView;

    explicit ModelSystem(const ModelDescription& description);
    ModelSystem(const ModelSystem&) = delete;
    ModelSystem& operator=(const ModelSystem&) = delete;

    SimTK::MultibodySystem& updSystem() { return m_system; }
    /** For forces of one's own, before makeDefaultState(). */
    SimTK::GeneralForceSubsystem& updForces() { return m_forces; }
    const SimTK::MultibodySystem& getSystem() const { return m_system; }
    const BuiltModel& getModel() const { return m_model; }
    const CablePathSubsystem& getCables() const { return m_cables; }
    const std::vector<MuscleSlot>& getMuscles() const { return m_paths->getMuscles(); }
    std::vector<MuscleSlot>& updMuscles() { return m_paths->updMuscles(); }
    const std::vector<SpringSlot>& getSprings() const { return m_paths->getSprings(); }
    const std::vector<PathForceSlot>& getPathForces() const { return m_paths->getPathForces(); }
    const std::vector<FunctionPathSlot>& getFunctionPaths() const { return m_paths->getFunctionPaths(); }
    /** The muscles, then the springs, then the other forces along cables, each in the order of the file. */
    std::vector<PathView> getPaths() const { return m_paths->getPaths(); }

    /** Realizes the topology and returns a state in the model's default pose. Call it once everything has been added to
    the system. */
    SimTK::State makeDefaultState();
    /** Sets the fibers of all muscles to where they and their tendons pull alike at rest, in the State's pose and at
    its activations. @return what was found, muscle by muscle. Realizes the State to Position. */
    std::vector<MuscleEquilibrium> equilibrateMuscles(SimTK::State& state) const;
    /** @throws ModelError with the coordinate and its value if a joint has lost a direction to move in, in this pose:
    no simulation can start there. Stage: Position. */
    void requireRegularPose(const SimTK::State& state) const;

    /** Effective moment arm -dl/dq of a muscle about a coordinate [m], as CoordinateCoupling defines it. Stage:
    Position. */
    double calcMomentArm(const SimTK::State& state, const MuscleSlot& muscle, const std::string& coordinate) const {
        return calcMomentArm(state, muscle.cable, coordinate);
    }
    /** The same for any cable of the system. */
    double calcMomentArm(const SimTK::State& state, const Cable& cable, const std::string& coordinate) const;
    /** Those about all coordinates, in the order of BuiltModel::getCoordinateNames(). For several cables in one pose, a
    CoordinateCoupling of one's own saves time. */
    std::vector<double> calcMomentArms(const SimTK::State& state, const Cable& cable) const;

private:
    SimTK::MultibodySystem m_system;
    SimTK::SimbodyMatterSubsystem m_matter;
    SimTK::GeneralForceSubsystem m_forces;
    CablePathSubsystem m_cables;
    BuiltModel m_model;
    std::optional<ModelPaths> m_paths;
    std::optional<SimTK::GeneralContactSubsystem> m_contacts;
};

}  // namespace tautline::models
