// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <memory>
#include <string>
#include <vector>

#include "system_watch.h"
#include "tautline/plugin.h"
#include "tautline/simbody/cable.h"
#include "tautline/simbody/cable_forces.h"
#include "tautline/simbody/muscle.h"

/** What the handle of the border stands for. It keeps indices and no handles of Simbody's, so that it may outlive the
system. All queries throw BorderError: TAUTLINE_UNKNOWN_NAME, TAUTLINE_SYSTEM_GONE. */
struct tautline_attachment {
public:
    struct AttachedForce {
        std::string name;
        tautline_kind kind;
        tautline::Cable cable;
        SimTK::ForceIndex force;
        std::vector<tautline::CableElementIndex> obstacles;
    };

    /** @throws as HostedForces */
    tautline_attachment(SimTK::MultibodySystem& system, const char* description, const char* fileName,
                        const tautline_body* bodies, std::size_t numBodies);
    ~tautline_attachment();
    tautline_attachment(const tautline_attachment&) = delete;
    tautline_attachment& operator=(const tautline_attachment&) = delete;

    /** @throws BorderError TAUTLINE_SYSTEM_GONE */
    const SimTK::MultibodySystem& getSystem() const;
    const std::vector<std::string>& getNotes() const { return m_notes; }
    const std::vector<AttachedForce>& getForces() const { return m_forces; }
    const AttachedForce& getForce(const char* name) const;
    /** That pulls along the path. */
    const tautline::CableForce& getCableForce(const AttachedForce& force) const;
    /** @throws BorderError TAUTLINE_BAD_ARGUMENT if the force is of another kind */
    const tautline::Muscle& getMuscle(const char* name) const;
    tautline::Muscle& updMuscle(const char* name);
    const tautline::PrescribedTensionForce& getPrescribedTension(const char* name) const;
    tautline::PrescribedTensionForce& updPrescribedTension(const char* name);
    /** @throws BorderError TAUTLINE_WRONG_STAGE if the system's topology is realized */
    void requireOpenTopology() const;

private:
    void requireSystem() const;
    const AttachedForce& getForceOfKind(const char* name, tautline_kind kind, const char* what) const;

    SimTK::MultibodySystem& m_system;
    SimTK::SubsystemIndex m_forceSubsystem;
    std::vector<AttachedForce> m_forces;
    std::vector<std::string> m_notes;
    std::shared_ptr<tautline::plugin::SystemWatch> m_watch;
};
