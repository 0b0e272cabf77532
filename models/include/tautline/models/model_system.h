#pragma once
#include <Simbody.h>

#include <memory>

#include "tautline/models/model_builder.h"
#include "tautline/models/wrap_binding.h"
#include "tautline/simbody/cable.h"
#include "tautline/simbody/cable_subsystem.h"
#include "tautline/simbody/hill_muscle.h"

namespace tautline::models {

/**
 * A model as a Simbody system that can be simulated: bodies and joints, gravity, and for each muscle a
 * cable over its wrap objects with a Hill-type muscle that pulls at it.
 *
 * @throws ModelError as buildMultibody() does, and for a path whose first or last point is conditional,
 * naming the point and its line.
 */
class ModelSystem {
public:
    struct MuscleSlot {
        std::string name;
        /** "/forceset/<name>": how result files name it. */
        std::string path;
        Cable cable;
        HillMuscle muscle;
        std::vector<BoundWrap> wraps;
    };

    explicit ModelSystem(const ModelDescription& description);
    ModelSystem(const ModelSystem&) = delete;
    ModelSystem& operator=(const ModelSystem&) = delete;

    SimTK::MultibodySystem& updSystem() { return m_system; }
    const SimTK::MultibodySystem& getSystem() const { return m_system; }
    const BuiltModel& getModel() const { return m_model; }
    const std::vector<MuscleSlot>& getMuscles() const { return m_muscles; }
    std::vector<MuscleSlot>& updMuscles() { return m_muscles; }

    /** Realizes the topology and returns a state in the model's default pose. Call it once everything has
     * been added to the system. */
    SimTK::State makeDefaultState();

    /**
     * Moment arm -dl/dq of a muscle about a coordinate [m], coupled coordinates moving along. Needs
     * Stage::Position.
     */
    double calcMomentArm(const SimTK::State& state, const MuscleSlot& muscle, const std::string& coordinate) const;

private:
    void addMuscle(const ModelDescription& description, const Muscle& muscle, const std::vector<BoundWrap>& wraps);

    SimTK::MultibodySystem m_system;
    SimTK::SimbodyMatterSubsystem m_matter;
    SimTK::GeneralForceSubsystem m_forces;
    CableSubsystem m_cables;
    BuiltModel m_model;
    std::vector<CoordinateCoupler> m_couplers;
    std::vector<MuscleSlot> m_muscles;
};

/** A muscle's parameters in the terms of HillMuscle; what the file leaves out stays at its default. */
HillMuscleParameters toHillMuscleParameters(const Muscle& muscle);

}  // namespace tautline::models
