// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <map>
#include <string>

#include "tautline/models/model_paths.h"

namespace tautline::models {

/** Forces along paths for a system that somebody else has built: the host. Each mobilized body is called by its index,
"0" for the ground, which is also "ground", and by the name that the host gives it. */
class HostedForces {
public:
    using BodyNames = std::map<std::string, SimTK::MobilizedBodyIndex>;

    /** Reads a document of forces, see readForcesText(), and adds them to the host: a CablePathSubsystem with the cables,
    and the forces to the host's first GeneralForceSubsystem. The host's topology must be realized anew, and its
    default state is the pose in which a PathWrap without a range is bound to a segment of its path. Whatever is
    refused is refused before anything is added.

    @param host   with a matter and a force subsystem; with all bodies that the document names
    @param given   names of bodies; an index may have several
    @param fileName   names the document in messages
    @throws ModelError, as readForcesText() and for a host without a subsystem or a given name that is taken;
    InvalidInput, as Cable and the forces; what Simbody throws if the host's topology cannot be realized */
    HostedForces(SimTK::MultibodySystem& host, std::string_view text, const std::string& fileName,
                 const BodyNames& given = {});
    HostedForces(const HostedForces&) = delete;
    HostedForces& operator=(const HostedForces&) = delete;

    const ModelDescription& getDescription() const { return m_description; }
    const ModelPaths& getPaths() const { return *m_paths; }
    ModelPaths& updPaths() { return *m_paths; }
    const CablePathSubsystem& getCables() const { return *m_cables; }

private:
    BodyNames m_bodies;
    ModelDescription m_description;
    std::optional<CablePathSubsystem> m_cables;
    std::optional<ModelPaths> m_paths;
};

}  // namespace tautline::models
