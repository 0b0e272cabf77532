// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <optional>
#include <ostream>
#include <vector>

#include "page_options.h"
#include "scene_recorder.h"
#include "tautline/models/path_study.h"

namespace tautline {

/** Looks on for the page while poses are solved. The bodies stand in a system of their own, where no path is solved. */
class StudyWatcher {
public:
    /** @param study   of the description */
    StudyWatcher(const PageOptions& options, const models::ModelDescription& description,
                 const models::PathStudy& study, std::ostream& out);

    /** The pose that the study has solved last. */
    void watch(double time, const models::PoseAnswer& answer);
    /** Writes the page. */
    void finish(const std::vector<double>& times, const std::vector<models::PoseAnswer>& answers,
                std::ostream& out) const;

private:
    const PageOptions& m_options;
    const models::ModelDescription& m_description;
    const models::PathStudy& m_study;
    SimTK::MultibodySystem m_system;
    SimTK::SimbodyMatterSubsystem m_matter{m_system};
    SimTK::GeneralForceSubsystem m_forces{m_system};  // Simbody 3.7 cannot realize a matter subsystem without one
    models::BuiltModel m_bodies;
    SimTK::State m_state;
    Bones m_bones;
    std::optional<SceneRecorder> m_scene;
};

}  // namespace tautline
