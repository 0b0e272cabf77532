// SPDX-License-Identifier: Apache-2.0
#include "attachment.h"

#include "border.h"
#include "tautline/models/hosted_forces.h"

using tautline::plugin::BorderError;
namespace models = tautline::models;

namespace {

models::HostedForces::BodyNames readNames(const tautline_body* bodies, std::size_t numBodies) {
    models::HostedForces::BodyNames names;
    if (numBodies > 0) tautline::plugin::requirePointer(bodies, "bodies");
    for (std::size_t i = 0; i < numBodies; ++i) {
        tautline::plugin::requirePointer(bodies[i].name, "the name of a body");
        if (bodies[i].mobilized_body < 0)
            throw BorderError(TAUTLINE_BAD_ARGUMENT, "body '" + std::string(bodies[i].name) +
                                                         "' is the mobilized body " +
                                                         std::to_string(bodies[i].mobilized_body));
        if (!names.emplace(bodies[i].name, SimTK::MobilizedBodyIndex(bodies[i].mobilized_body)).second)
            throw BorderError(TAUTLINE_BAD_ARGUMENT, "two bodies of the name '" + std::string(bodies[i].name) + "'");
    }
    return names;
}

/** What was read over or read otherwise, in lines. */
std::vector<std::string> listNotes(const models::ModelDescription& description) {
    std::vector<std::string> notes;
    const auto add = [&](int line, const std::string& text) {
        notes.push_back(description.fileName + ":" + std::to_string(line) + ": " + text);
    };
    for (const models::SkippedElements& skipped : description.skipped)
        add(skipped.firstLine, skipped.element + " in " + skipped.owner + " is passed over: " + skipped.reason);
    for (const models::ReadingNote& note : description.notes) add(note.line, note.text);
    for (const models::Muscle& muscle : description.muscles)
        for (const std::string& note : muscle.notes) add(muscle.line, "muscle '" + muscle.name + "': " + note);
    return notes;
}

std::vector<tautline::CableElementIndex> listObstacles(const tautline::Cable& cable) {
    std::vector<tautline::CableElementIndex> obstacles;
    for (tautline::CableElementIndex i(0); i < cable.getNumElements(); ++i)
        if (cable.isObstacle(i)) obstacles.push_back(i);
    return obstacles;
}

/** A handle as one of what its force really is. Handles hold a pointer and nothing else, and are all alike. */
template <class Handle>
Handle& as(SimTK::Force& force) {
    static_assert(sizeof(Handle) == sizeof(SimTK::Force));
    return static_cast<Handle&>(force);
}

template <class Handle>
const Handle& as(const SimTK::Force& force) {
    return as<Handle>(const_cast<SimTK::Force&>(force));
}

SimTK::GeneralForceSubsystem& updForces(SimTK::MultibodySystem& system, SimTK::SubsystemIndex index) {
    return SimTK::GeneralForceSubsystem::updDowncast(SimTK::ForceSubsystem::updDowncast(system.updSubsystem(index)));
}

}  // namespace

tautline_attachment::tautline_attachment(SimTK::MultibodySystem& system, const char* description, const char* fileName,
                                         const tautline_body* bodies, std::size_t numBodies)
    : m_system(system) {
    models::HostedForces hosted(system, description, fileName ? fileName : "description", readNames(bodies, numBodies));
    m_notes = listNotes(hosted.getDescription());
    const auto add = [this](const auto& slot, const SimTK::Force& force, tautline_kind kind) {
        m_forces.push_back({slot.name, kind, slot.cable, force.getForceIndex(), listObstacles(slot.cable)});
        m_forceSubsystem = force.getForceSubsystem().getMySubsystemIndex();
    };
    for (const auto& slot : hosted.getPaths().getMuscles()) add(slot, slot.muscle, TAUTLINE_MUSCLE);
    for (const auto& slot : hosted.getPaths().getSprings()) add(slot, slot.spring, TAUTLINE_SPRING);
    for (const auto& slot : hosted.getPaths().getPathForces()) {
        const models::PathForce& read = *findPathForce(hosted.getDescription(), slot.name);
        const bool isPrescribed = std::holds_alternative<models::PrescribedTension>(read.tension);
        add(slot, slot.force, isPrescribed ? TAUTLINE_PRESCRIBED_TENSION : TAUTLINE_OTHER_FORCE);
    }
    m_watch = tautline::plugin::SystemWatch::watch(system);
}

tautline_attachment::~tautline_attachment() {
    m_watch->endHandle();
}

void tautline_attachment::requireSystem() const {
    if (m_watch->isSystemGone())
        throw BorderError(TAUTLINE_SYSTEM_GONE, "the system of the attachment has been destroyed");
}

const SimTK::MultibodySystem& tautline_attachment::getSystem() const {
    requireSystem();
    return m_system;
}

void tautline_attachment::requireOpenTopology() const {
    requireSystem();
    if (m_system.systemTopologyHasBeenRealized())
        throw BorderError(TAUTLINE_WRONG_STAGE, "the topology of the system is realized already");
}

const tautline_attachment::AttachedForce& tautline_attachment::getForce(const char* name) const {
    requireSystem();
    tautline::plugin::requirePointer(name, "name");
    for (const AttachedForce& force : m_forces)
        if (force.name == name) return force;
    throw BorderError(TAUTLINE_UNKNOWN_NAME, "there is no force '" + std::string(name) + "'");
}

const tautline::CableForce& tautline_attachment::getCableForce(const AttachedForce& force) const {
    return as<tautline::CableForce>(updForces(m_system, m_forceSubsystem).getForce(force.force));
}

const tautline_attachment::AttachedForce& tautline_attachment::getForceOfKind(const char* name, tautline_kind kind,
                                                                              const char* what) const {
    const AttachedForce& force = getForce(name);
    if (force.kind != kind) throw BorderError(TAUTLINE_BAD_ARGUMENT, "force '" + force.name + "' is not " + what);
    return force;
}

const tautline::Muscle& tautline_attachment::getMuscle(const char* name) const {
    return as<tautline::Muscle>(getCableForce(getForceOfKind(name, TAUTLINE_MUSCLE, "a muscle")));
}

tautline::Muscle& tautline_attachment::updMuscle(const char* name) {
    const AttachedForce& force = getForceOfKind(name, TAUTLINE_MUSCLE, "a muscle");
    return as<tautline::Muscle>(updForces(m_system, m_forceSubsystem).updForce(force.force));
}

const tautline::PrescribedTensionForce& tautline_attachment::getPrescribedTension(const char* name) const {
    return as<tautline::PrescribedTensionForce>(
        getCableForce(getForceOfKind(name, TAUTLINE_PRESCRIBED_TENSION, "a prescribed tension")));
}

tautline::PrescribedTensionForce& tautline_attachment::updPrescribedTension(const char* name) {
    const AttachedForce& force = getForceOfKind(name, TAUTLINE_PRESCRIBED_TENSION, "a prescribed tension");
    return as<tautline::PrescribedTensionForce>(updForces(m_system, m_forceSubsystem).updForce(force.force));
}
