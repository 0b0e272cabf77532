// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/hosted_forces.h"

#include <algorithm>

#include "tautline/models/osim_reader.h"

namespace tautline::models {
namespace {

SimTK::GeneralForceSubsystem& updForceSubsystem(SimTK::MultibodySystem& host) {
    for (SimTK::SubsystemIndex i(0); i < host.getNumSubsystems(); ++i) {
        if (!SimTK::ForceSubsystem::isInstanceOf(host.getSubsystem(i))) continue;
        SimTK::ForceSubsystem& forces = SimTK::ForceSubsystem::updDowncast(host.updSubsystem(i));
        if (SimTK::GeneralForceSubsystem::isInstanceOf(forces))
            return SimTK::GeneralForceSubsystem::updDowncast(forces);
    }
    throw ModelError("the host's system has no GeneralForceSubsystem");
}

SimTK::SimbodyMatterSubsystem& updMatterSubsystem(SimTK::MultibodySystem& host) {
    if (!host.hasMatterSubsystem()) throw ModelError("the host's system has no SimbodyMatterSubsystem");
    return host.updMatterSubsystem();
}

/** The indices of all bodies and the given names. */
HostedForces::BodyNames nameBodies(SimTK::MultibodySystem& host, const HostedForces::BodyNames& given) {
    HostedForces::BodyNames names;
    const int numBodies = updMatterSubsystem(host).getNumBodies();
    for (SimTK::MobilizedBodyIndex body(0); body < numBodies; ++body) names[std::to_string(body)] = body;
    for (const auto& [name, body] : given) {
        if (name.empty() || name == kGroundName || !names.emplace(name, body).second)
            throw ModelError("a body cannot be given the name '" + name + "', which is taken");
    }
    return names;
}

ModelDescription readForces(std::string_view text, const std::string& fileName, const HostedForces::BodyNames& bodies) {
    std::vector<std::string> names;
    for (const auto& [name, body] : bodies) names.push_back(name);
    return readForcesText(text, fileName, names);
}

/** The host's bodies in a system of our own, each fixed where it is in the host's default state: there wraps are bound,
and there a force that cannot be made fails. */
struct Rehearsal {
    Rehearsal(SimTK::MultibodySystem& host, const HostedForces::BodyNames& names)
        : matter(system), forces(system), cables(system) {
        SimTK::State pose = host.realizeTopology();
        host.realize(pose, SimTK::Stage::Position);
        const SimTK::SimbodyMatterSubsystem& bodies = host.getMatterSubsystem();
        const SimTK::Body::Rigid body(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(1)));
        for (SimTK::MobilizedBodyIndex i(1); i < bodies.getNumBodies(); ++i)
            SimTK::MobilizedBody::Weld(matter.updGround(), bodies.getMobilizedBody(i).getBodyTransform(pose), body,
                                       SimTK::Transform());
        model = BuiltModel::ofBodies(matter, names);
    }

    std::vector<std::vector<BoundWrap>> bind(const ModelDescription& description) {
        SimTK::State state = system.realizeTopology();
        system.realizeModel(state);
        return bindWraps(description, listPaths(description), model, state);
    }

    void addPaths(const ModelDescription& description, const std::vector<std::vector<BoundWrap>>& wraps) {
        const ModelPaths paths(description, wraps, model, forces, cables);
        system.realize(system.realizeTopology(), SimTK::Stage::Position);
    }

    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::GeneralForceSubsystem forces;
    CablePathSubsystem cables;
    BuiltModel model;
};

/** Muscles that a controller of the description drives. */
void prescribeExcitations(const ModelDescription& description, ModelPaths& paths) {
    for (const PrescribedControl& control : description.controls)
        for (ModelPaths::MuscleSlot& slot : paths.updMuscles())
            if (slot.name == control.actuator)
                slot.muscle.setExcitationFunction([function = control.control](const SimTK::State& state) {
                    return std::clamp(function.calcValue(state.getTime()), 0.0, 1.0);
                });
}

}  // namespace

HostedForces::HostedForces(SimTK::MultibodySystem& host, std::string_view text, const std::string& fileName,
                           const BodyNames& given)
    : m_bodies(nameBodies(host, given)), m_description(readForces(text, fileName, m_bodies)) {
    SimTK::GeneralForceSubsystem& forces = updForceSubsystem(host);
    const BuiltModel bodies = BuiltModel::ofBodies(updMatterSubsystem(host), m_bodies);
    Rehearsal rehearsal(host, m_bodies);
    const auto wraps = rehearsal.bind(m_description);
    rehearsal.addPaths(m_description, wraps);
    m_cables.emplace(host);
    m_paths.emplace(m_description, wraps, bodies, forces, *m_cables);
    prescribeExcitations(m_description, *m_paths);
}

}  // namespace tautline::models
