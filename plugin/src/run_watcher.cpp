// SPDX-License-Identifier: Apache-2.0
#include "run_watcher.h"

#include "page_tables.h"

namespace tautline {

RunWatcher::RunWatcher(const PageOptions& options, bool visualizes, const models::ModelDescription& description,
                       const models::ModelSystem& model, std::ostream& out)
    : m_options(options), m_description(description), m_model(model), m_paths(model.getPaths()) {
    if (!options.report.empty() || visualizes) m_bones = loadBones(options, description, model.getModel(), out);
    if (!options.report.empty()) {
        std::vector<SceneRecorder::DrawnPath> paths;
        for (const auto& path : m_paths) paths.push_back({path.name, path.wraps});
        m_scene.emplace(description, model.getModel(), paths);
    }
    if (visualizes) m_window.emplace(model, findVisualizer(), m_bones.meshes);
}

void RunWatcher::watch(const SimTK::State& state) {
    if (m_window) m_window->show(state);
    if (!m_scene) return;
    std::vector<models::CorePath> paths;
    for (const auto& path : m_paths) {
        const Cable& cable = path.cable;
        paths.emplace_back();
        if (!cable.isDisabled(state))
            paths.back() = {&cable.getPathProblem(), &cable.getPathPose(state), &cable.getSolution(state)};
    }
    m_scene->recordFrame(m_model.getModel().getMatter(), state, paths);
}

void RunWatcher::finish(const SimulationResult& result, std::ostream& out) const {
    if (m_window && !m_window->isOpen()) out << "note: the window of the visualizer was closed before the end\n";
    if (m_scene) writePage(makeRunPage(m_model, result), m_options, m_description, *m_scene, m_bones, out);
}

}  // namespace tautline
