// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <string>
#include <vector>

#include "tautline/models/function_based_path.h"
#include "tautline/models/model_builder.h"
#include "tautline/models/path_start.h"
#include "tautline/models/wrap_binding.h"
#include "tautline/simbody/cable.h"
#include "tautline/simbody/cable_forces.h"
#include "tautline/simbody/cable_path_subsystem.h"
#include "tautline/simbody/muscle.h"

namespace tautline::models {

/** The muscles, springs and other forces along paths of a description, as cables of a system and what pulls at them.
The slots are handles; their contents belong to the system. */
class ModelPaths {
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
        std::vector<std::string> coordinates;  ///< findCrossedCoordinates()
    };
    struct SpringSlot {
        std::string name;
        /** "/forceset/<name>". */
        std::string path;
        Cable cable;
        ElasticStringForce spring;
        std::vector<BoundWrap> wraps;
        PathStart start;
        std::vector<std::string> coordinates;  ///< findCrossedCoordinates()
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
        std::vector<std::string> coordinates;  ///< findCrossedCoordinates()
    };
    /** Of a muscle or any other force whose path is given by functions: nothing pulls along it. */
    struct FunctionPathSlot {
        std::string name;
        /** "/forceset/<name>". */
        std::string path;
        FunctionBasedPath function;
        std::vector<std::string> coordinates;  ///< findCrossedCoordinates()
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
        /** That can change its length: findCrossedCoordinates(). */
        const std::vector<std::string>& coordinates;
    };

    /** Adds all cables and forces.
    @param bodies   of the system that `forces` and `cables` belong to
    @param wraps   of each path, in the order of listPaths()
    @throws ModelError for a path whose first or last point is conditional, naming the point and its line; InvalidInput
    for what a cable or force refuses. What was added before stays. */
    ModelPaths(const ModelDescription& description, const std::vector<std::vector<BoundWrap>>& wraps,
               const BuiltModel& bodies, SimTK::GeneralForceSubsystem& forces, CablePathSubsystem& cables);

    const std::vector<MuscleSlot>& getMuscles() const { return m_muscles; }
    std::vector<MuscleSlot>& updMuscles() { return m_muscles; }
    const std::vector<SpringSlot>& getSprings() const { return m_springs; }
    const std::vector<PathForceSlot>& getPathForces() const { return m_pathForces; }
    std::vector<PathForceSlot>& updPathForces() { return m_pathForces; }
    const std::vector<FunctionPathSlot>& getFunctionPaths() const { return m_functionPaths; }
    /** The muscles, then the springs, then the other forces along cables, each in the order of the file. */
    std::vector<PathView> getPaths() const;

private:
    std::vector<MuscleSlot> m_muscles;
    std::vector<SpringSlot> m_springs;
    std::vector<PathForceSlot> m_pathForces;
    std::vector<FunctionPathSlot> m_functionPaths;
};

/** The paths of a description's muscles, springs and other forces, in this order. */
std::vector<const MusclePath*> listPaths(const ModelDescription& description);

}  // namespace tautline::models
