// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <memory>
#include <optional>

#include "tautline/models/function_based_path.h"
#include "tautline/models/model_builder.h"
#include "tautline/models/path_start.h"
#include "tautline/models/wrap_binding.h"
#include "tautline/simbody/cable.h"
#include "tautline/simbody/cable_forces.h"
#include "tautline/simbody/cable_subsystem.h"
#include "tautline/simbody/muscle.h"

namespace tautline::models {

/** A model as a Simbody system that can be simulated: bodies and joints, gravity, and for each muscle or path spring a
cable over its wrap objects with a muscle of the file's model or an elastic string that pulls at it.

@throws ModelError as buildMultibody() does, and for a path whose first or last point is conditional, naming the point
and its line. */
class ModelSystem {
public:
    using Muscle = tautline::Muscle;  // not the description of one
    struct MuscleSlot {
        std::string name;
        /** "/forceset/<name>": how result files name it. */
        std::string path;
        Cable cable;
        Muscle muscle;
        std::vector<BoundWrap> wraps;
        PathStart start;
    };
    struct SpringSlot {
        std::string name;
        /** "/forceset/<name>". */
        std::string path;
        Cable cable;
        ElasticStringForce spring;
        std::vector<BoundWrap> wraps;
        PathStart start;
    };
    /** Of a PathForce. */
    struct PathForceSlot {
        std::string name;
        /** "/forceset/<name>". */
        std::string path;
        Cable cable;
        CableForce force;
        std::vector<BoundWrap> wraps;
        PathStart start;
    };
    /** Of a muscle or any other force whose path is given by functions: nothing pulls along it. */
    struct FunctionPathSlot {
        std::string name;
        /** "/forceset/<name>". */
        std::string path;
        FunctionBasedPath function;
    };
    /** What all forces along cables have in common; valid as long as the system. */
    struct PathView {
        const std::string& name;
        const std::string& path;
        const Cable& cable;
        const CableForce& force;
        /** In the order of the cable's obstacles. */
        const std::vector<BoundWrap>& wraps;
        const PathStart& start;
    };

    explicit ModelSystem(const ModelDescription& description);
    ModelSystem(const ModelSystem&) = delete;
    ModelSystem& operator=(const ModelSystem&) = delete;

    SimTK::MultibodySystem& updSystem() { return m_system; }
    /** For forces of one's own, before makeDefaultState(). */
    SimTK::GeneralForceSubsystem& updForces() { return m_forces; }
    const SimTK::MultibodySystem& getSystem() const { return m_system; }
    const BuiltModel& getModel() const { return m_model; }
    const std::vector<MuscleSlot>& getMuscles() const { return m_muscles; }
    std::vector<MuscleSlot>& updMuscles() { return m_muscles; }
    const std::vector<SpringSlot>& getSprings() const { return m_springs; }
    const std::vector<PathForceSlot>& getPathForces() const { return m_pathForces; }
    const std::vector<FunctionPathSlot>& getFunctionPaths() const { return m_functionPaths; }
    /** The muscles, then the springs, then the other forces along cables, each in the order of the file. */
    std::vector<PathView> getPaths() const;

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
    Cable addCable(const ModelDescription& description, const std::string& kind, const std::string& name,
                   const MusclePath& path, const std::vector<BoundWrap>& wraps);
    /** A cable, or a function of coordinates. */
    template <class Owner>
    void addOwner(const ModelDescription& description, const Owner& owner, const std::vector<BoundWrap>& wraps);
    void add(const ModelDescription& description, const models::Muscle& muscle, const std::vector<BoundWrap>& wraps);
    void add(const ModelDescription& description, const PathSpring& spring, const std::vector<BoundWrap>& wraps);
    void add(const ModelDescription& description, const PathForce& force, const std::vector<BoundWrap>& wraps);

    SimTK::MultibodySystem m_system;
    SimTK::SimbodyMatterSubsystem m_matter;
    SimTK::GeneralForceSubsystem m_forces;
    CableSubsystem m_cables;
    BuiltModel m_model;
    std::vector<MuscleSlot> m_muscles;
    std::vector<SpringSlot> m_springs;
    std::vector<PathForceSlot> m_pathForces;
    std::vector<FunctionPathSlot> m_functionPaths;
    std::optional<SimTK::GeneralContactSubsystem> m_contacts;
};

}  // namespace tautline::models
