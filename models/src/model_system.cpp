// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/model_system.h"

#include <algorithm>

#include "body_forces.h"
#include "model_skeleton.h"
#include "tautline/models/coordinate_coupling.h"

namespace tautline::models {

ModelSystem::ModelSystem(const ModelDescription& description)
    : m_matter(m_system), m_forces(m_system), m_cables(m_system), m_model(buildMultibody(description, m_matter)) {
    addGravity(description, m_forces, m_model);
    addBodyForces(description, {m_system, m_forces, m_contacts, m_model});
    const ModelSkeleton skeleton(description);
    const auto wraps = bindWraps(description, listPaths(description), skeleton.model, skeleton.state);
    m_paths.emplace(description, wraps, m_model, m_forces, m_cables);
}

SimTK::State ModelSystem::makeDefaultState() {
    SimTK::State state = m_system.realizeTopology();
    m_system.realizeModel(state);
    m_model.setDefaultPose(state);
    return state;
}

std::vector<MuscleEquilibrium> ModelSystem::equilibrateMuscles(SimTK::State& state) const {
    m_system.realize(state, SimTK::Stage::Position);
    std::vector<MuscleEquilibrium> found;
    for (const MuscleSlot& slot : getMuscles()) found.push_back(slot.muscle.equilibrate(state));
    return found;
}

void ModelSystem::requireRegularPose(const SimTK::State& state) const {
    const std::string* singular = m_model.findSingularCoordinate(state);
    if (!singular) return;
    throw ModelError("coordinate '" + *singular + "' is at " + std::to_string(m_model.getCoordinate(state, *singular)) +
                     " where it moves nothing that other coordinates of its joint do not move, or nothing at all: a "
                     "simulation cannot start there");
}

double ModelSystem::calcMomentArm(const SimTK::State& state, const Cable& cable, const std::string& coordinate) const {
    m_model.getCoordinateSlot(coordinate);  // refuses unknown names
    const std::vector<std::string>& names = m_model.getCoordinateNames();
    const auto at = std::find(names.begin(), names.end(), coordinate);
    return calcMomentArms(state, cable)[static_cast<std::size_t>(at - names.begin())];
}

std::vector<double> ModelSystem::calcMomentArms(const SimTK::State& state, const Cable& cable) const {
    SimTK::Vector unitForces;
    cable.calcUnitMobilityForces(state, unitForces);
    return CoordinateCoupling(m_model, state).calcEffectiveArms(unitForces);
}

}  // namespace tautline::models
