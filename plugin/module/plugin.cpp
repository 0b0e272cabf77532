// SPDX-License-Identifier: Apache-2.0
/** The functions of the border: each checks its arguments and calls one thing. */
#include "tautline/plugin.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "attachment.h"
#include "border.h"
#include "tautline/version.h"

using tautline::plugin::BorderError;
using tautline::plugin::guard;
using tautline::plugin::requirePointer;
using tautline::plugin::SystemWatch;

namespace {

#ifdef NDEBUG
constexpr int kKeepsAsserts = 0;
#else
constexpr int kKeepsAsserts = 1;
#endif

using Attachment = tautline_attachment;

const SimTK::State& getState(const void* state) {
    requirePointer(state, "state");
    return *static_cast<const SimTK::State*>(state);
}

SimTK::State& updState(void* state) {
    requirePointer(state, "state");
    return *static_cast<SimTK::State*>(state);
}

const Attachment& get(const Attachment* attachment) {
    requirePointer(attachment, "attachment");
    return *attachment;
}

Attachment& upd(Attachment* attachment) {
    requirePointer(attachment, "attachment");
    return *attachment;
}

/** Guards a query of one number. */
template <class Query>
tautline_result query(double* result, tautline_error* error, Query calc) {
    return guard(error, [&] {
        requirePointer(result, "the result");
        *result = calc();
    });
}

tautline_result attach(void* system, const char* description, const char* fileName, const tautline_body* bodies,
                       size_t numBodies, Attachment** attachment, tautline_error* error) {
    return guard(error, [&] {
        SystemWatch::dropOldHolds();
        requirePointer(system, "system");
        requirePointer(description, "description");
        requirePointer(attachment, "attachment");
        *attachment =
            new Attachment(*static_cast<SimTK::MultibodySystem*>(system), description, fileName, bodies, numBodies);
    });
}

void release(Attachment* attachment) {
    delete attachment;
}

size_t getNumNotes(const Attachment* attachment) {
    return attachment ? attachment->getNotes().size() : 0;
}

const char* getNote(const Attachment* attachment, size_t index) {
    return index < getNumNotes(attachment) ? attachment->getNotes()[index].c_str() : nullptr;
}

size_t getNumForces(const Attachment* attachment) {
    return attachment ? attachment->getForces().size() : 0;
}

const char* getForceName(const Attachment* attachment, size_t index) {
    return index < getNumForces(attachment) ? attachment->getForces()[index].name.c_str() : nullptr;
}

tautline_result getForceKind(const Attachment* attachment, const char* name, tautline_kind* kind,
                             tautline_error* error) {
    return guard(error, [&] {
        requirePointer(kind, "kind");
        *kind = get(attachment).getForce(name).kind;
    });
}

tautline_result setExcitation(const Attachment* attachment, void* state, const char* muscle, double excitation,
                              tautline_error* error) {
    return guard(error, [&] { get(attachment).getMuscle(muscle).setExcitation(updState(state), excitation); });
}

/** A function of the host's as one of the adapter's. */
std::function<SimTK::Real(const SimTK::State&)> wrapFunction(tautline_function function, void* data) {
    requirePointer(reinterpret_cast<const void*>(function), "the function");
    return [=](const SimTK::State& state) { return function(&state, state.getTime(), data); };
}

tautline_result setExcitationFunction(Attachment* attachment, const char* muscle, tautline_function excitation,
                                      void* data, tautline_error* error) {
    return guard(error, [&] {
        auto& force = upd(attachment).updMuscle(muscle);
        get(attachment).requireOpenTopology();
        force.setExcitationFunction(wrapFunction(excitation, data));
    });
}

tautline_result setTension(const Attachment* attachment, void* state, const char* name, double tension,
                           tautline_error* error) {
    return guard(error, [&] { get(attachment).getPrescribedTension(name).setTension(updState(state), tension); });
}

tautline_result setTensionFunction(Attachment* attachment, const char* name, tautline_function tension, void* data,
                                   tautline_error* error) {
    return guard(error, [&] {
        auto& force = upd(attachment).updPrescribedTension(name);
        get(attachment).requireOpenTopology();
        force.setTensionFunction(wrapFunction(tension, data));
    });
}

tautline_result equilibrate(const Attachment* attachment, void* state, tautline_error* error) {
    return guard(error, [&] {
        SimTK::State& updated = updState(state);
        get(attachment).getSystem().realize(updated, SimTK::Stage::Position);
        for (const Attachment::AttachedForce& force : attachment->getForces())
            if (force.kind == TAUTLINE_MUSCLE) attachment->getMuscle(force.name.c_str()).equilibrate(updated);
    });
}

tautline_result getLength(const Attachment* attachment, const void* state, const char* name, double* length,
                          tautline_error* error) {
    return query(length, error, [&] { return get(attachment).getForce(name).cable.getLength(getState(state)); });
}

tautline_result getRate(const Attachment* attachment, const void* state, const char* name, double* rate,
                        tautline_error* error) {
    return query(rate, error, [&] { return get(attachment).getForce(name).cable.getLengthRate(getState(state)); });
}

tautline_result getTension(const Attachment* attachment, const void* state, const char* name, double* tension,
                           tautline_error* error) {
    return query(tension, error, [&] {
        return get(attachment).getCableForce(get(attachment).getForce(name)).getTension(getState(state));
    });
}

tautline_status toStatus(tautline::PathStatus status) {
    switch (status) {
        case tautline::PathStatus::Solved:
            return TAUTLINE_PATH_SOLVED;
        case tautline::PathStatus::NotMinimum:
            return TAUTLINE_PATH_NOT_MINIMUM;
        case tautline::PathStatus::LeftDomain:
            return TAUTLINE_PATH_LEFT_DOMAIN;
        case tautline::PathStatus::EndInside:
            return TAUTLINE_PATH_END_INSIDE;
        case tautline::PathStatus::NotConverged:
            break;
    }
    return TAUTLINE_PATH_NOT_CONVERGED;
}

tautline_result calcStatus(const Attachment* attachment, const void* state, const char* name, tautline_status* status,
                           tautline_error* error) {
    return guard(error, [&] {
        requirePointer(status, "status");
        *status = toStatus(get(attachment).getForce(name).cable.calcStatus(getState(state)));
    });
}

tautline_result explainStatus(const Attachment* attachment, const void* state, const char* name, char* text,
                              size_t capacity, size_t* length, tautline_error* error) {
    return guard(error, [&] {
        if (capacity > 0) requirePointer(text, "text");
        const std::string told = get(attachment).getForce(name).cable.explainStatus(getState(state));
        if (capacity > 0) {
            const size_t copied = std::min(told.size(), capacity - 1);
            std::memcpy(text, told.data(), copied);
            text[copied] = '\0';
        }
        if (length) *length = told.size();
    });
}

tautline_result getNumObstacles(const Attachment* attachment, const char* name, size_t* number, tautline_error* error) {
    return guard(error, [&] {
        requirePointer(number, "number");
        *number = get(attachment).getForce(name).obstacles.size();
    });
}

void copy(const SimTK::Vec3& from, double* to) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

tautline_result getContact(const Attachment* attachment, const void* state, const char* name, size_t obstacle,
                           tautline_contact* contact, tautline_error* error) {
    return guard(error, [&] {
        requirePointer(contact, "contact");
        const Attachment::AttachedForce& force = get(attachment).getForce(name);
        if (obstacle >= force.obstacles.size())
            throw BorderError(TAUTLINE_UNKNOWN_NAME, "the path of '" + force.name + "' has no obstacle " +
                                                         std::to_string(obstacle) + ", but " +
                                                         std::to_string(force.obstacles.size()) + " of them");
        const tautline::CableElementIndex element = force.obstacles[obstacle];
        const SimTK::State& at = getState(state);
        SimTK::Vec3 P_G(SimTK::NaN), Q_G(SimTK::NaN);
        tautline_contact found;
        found.is_touched = force.cable.getContactPoints(at, element, P_G, Q_G);
        found.name = force.cable.getElementName(element).c_str();
        found.mobilized_body = force.cable.getElementBody(element);
        found.arc_length = found.is_touched ? force.cable.getArcLength(at, element) : 0;
        found.clearance = force.cable.getClearance(at, element);
        copy(found.is_touched ? P_G : SimTK::Vec3(SimTK::NaN), found.P);
        copy(found.is_touched ? Q_G : SimTK::Vec3(SimTK::NaN), found.Q);
        *contact = found;
    });
}

tautline_result calcMomentArm(const Attachment* attachment, const void* state, const char* name, int body, int mobility,
                              double* arm, tautline_error* error) {
    return query(arm, error, [&] {
        const tautline::Cable& cable = get(attachment).getForce(name).cable;
        const auto& matter = cable.getMatterSubsystem();
        if (body < 0 || body >= matter.getNumBodies())
            throw BorderError(TAUTLINE_UNKNOWN_NAME, "there is no mobilized body " + std::to_string(body));
        const SimTK::MobilizedBodyIndex index(body);
        const int numMobilities = matter.getMobilizedBody(index).getNumU(getState(state));
        if (mobility < 0 || mobility >= numMobilities)
            throw BorderError(TAUTLINE_UNKNOWN_NAME, "mobilized body " + std::to_string(body) + " has no mobility " +
                                                         std::to_string(mobility) + ", but " +
                                                         std::to_string(numMobilities) + " of them");
        return cable.calcMomentArm(getState(state), index, SimTK::MobilizerUIndex(mobility));
    });
}

tautline_result calcMomentArms(const Attachment* attachment, const void* state, const char* name, double* arms,
                               size_t numArms, tautline_error* error) {
    return guard(error, [&] {
        requirePointer(arms, "arms");
        SimTK::Vector unitForces;
        get(attachment).getForce(name).cable.calcUnitMobilityForces(getState(state), unitForces);
        if (numArms != static_cast<size_t>(unitForces.size()))
            throw BorderError(TAUTLINE_BAD_ARGUMENT, "room for " + std::to_string(numArms) +
                                                         " moment arms, but the system has " +
                                                         std::to_string(unitForces.size()) + " mobilities");
        for (int i = 0; i < unitForces.size(); ++i) arms[i] = unitForces[i];
    });
}

tautline_result calcPoints(const Attachment* attachment, const void* state, const char* name, double maxAngle,
                           double* points, size_t capacity, size_t* numPoints, tautline_error* error) {
    return guard(error, [&] {
        if (capacity > 0) requirePointer(points, "points");
        requirePointer(numPoints, "num_points");
        if (!(maxAngle > 0))
            throw BorderError(TAUTLINE_BAD_ARGUMENT, "max_angle is " + std::to_string(maxAngle) + ", not positive");
        const auto found = get(attachment).getForce(name).cable.calcDrawingPoints(getState(state), maxAngle);
        for (size_t i = 0; i < std::min(capacity, found.size()); ++i) copy(found[i], points + 3 * i);
        *numPoints = found.size();
    });
}

tautline_result getStatistics(const Attachment* attachment, const char* name, tautline_statistics* statistics,
                              tautline_error* error) {
    return guard(error, [&] {
        requirePointer(statistics, "statistics");
        const tautline::CableStatistics found = get(attachment).getForce(name).cable.getStatistics();
        *statistics = {found.numSolves,        found.numColdSolves, found.numFailures, found.numIterations,
                       found.numContactEvents, found.numSlips,      found.seconds};
    });
}

const tautline_plugin kPlugin{TAUTLINE_PLUGIN_ABI,
                              sizeof(tautline_plugin),
                              TAUTLINE_VERSION,
                              TAUTLINE_SIMBODY_VERSION,
                              kKeepsAsserts,
                              attach,
                              release,
                              getNumNotes,
                              getNote,
                              getNumForces,
                              getForceName,
                              getForceKind,
                              setExcitation,
                              setExcitationFunction,
                              setTension,
                              setTensionFunction,
                              equilibrate,
                              getLength,
                              getRate,
                              getTension,
                              calcStatus,
                              explainStatus,
                              getNumObstacles,
                              getContact,
                              calcMomentArm,
                              calcMomentArms,
                              calcPoints,
                              getStatistics};

std::string describeVersion(const int* version) {
    return std::to_string(version[0]) + "." + std::to_string(version[1]);
}

/** Of Simbody's versions the first two numbers tell layouts apart. */
void checkVersion(const int* version, const std::string& whose) {
    if (describeVersion(version) != TAUTLINE_SIMBODY_VERSION)
        throw BorderError(TAUTLINE_WRONG_SIMBODY, whose + " is Simbody " + describeVersion(version) +
                                                      ", but the module was built for " TAUTLINE_SIMBODY_VERSION);
}

void checkHost(const tautline_host& host) {
    if (host.abi != TAUTLINE_PLUGIN_ABI)
        throw BorderError(TAUTLINE_WRONG_ABI, "the host was built for number " + std::to_string(host.abi) +
                                                  " of tautline/plugin.h, the module for " +
                                                  std::to_string(TAUTLINE_PLUGIN_ABI));
    if (host.keeps_asserts != kKeepsAsserts)
        throw BorderError(TAUTLINE_WRONG_SIMBODY, std::string("the host was compiled ") +
                                                      (host.keeps_asserts ? "without" : "with") +
                                                      " NDEBUG, the module " + (kKeepsAsserts ? "without" : "with") +
                                                      " it, as Simbody's library was: their States differ");
    if (host.simbody_version[0] != 0) checkVersion(host.simbody_version, "the host's");
    int version[3] = {0, 0, 0};
    SimTK_version_simbody(&version[0], &version[1], &version[2]);
    checkVersion(version, "the library in this program");
}

}  // namespace

extern "C" __attribute__((visibility("default"))) tautline_result tautline_plugin_open(const tautline_host* host,
                                                                                       const tautline_plugin** plugin,
                                                                                       tautline_error* error) {
    return guard(error, [&] {
        requirePointer(host, "host");
        requirePointer(plugin, "plugin");
        checkHost(*host);
        SystemWatch::dropOldHolds();
        *plugin = &kPlugin;
    });
}
