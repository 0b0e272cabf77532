// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <ostream>
#include <vector>

#include "page_options.h"
#include "scene_recorder.h"
#include "simulation.h"
#include "visualizer.h"

namespace tautline {

/** Those who look on at a run, as far as they are asked for: the page and the window of the visualizer. */
class RunWatcher {
public:
    /** @param model   not changed hereafter, but for what simulate() does */
    RunWatcher(const PageOptions& options, bool visualizes, const models::ModelDescription& description,
               const models::ModelSystem& model, std::ostream& out);

    /** A frame. Stage: Velocity. */
    void watch(const SimTK::State& state);
    /** Writes the page. */
    void finish(const SimulationResult& result, std::ostream& out) const;

private:
    const PageOptions& m_options;
    const models::ModelDescription& m_description;
    const models::ModelSystem& m_model;
    std::vector<models::ModelSystem::PathView> m_paths;
    Bones m_bones;
    std::optional<SceneRecorder> m_scene;
    std::optional<RunVisualizer> m_window;
};

}  // namespace tautline
