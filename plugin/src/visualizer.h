// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Simbody.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "report_page.h"
#include "tautline/models/model_system.h"

namespace tautline {

/** The folder in which the program `simbody-visualizer` is, where Simbody looks for it: $SIMBODY_HOME, then beside
Simbody's library. @throws std::runtime_error with the folders that were searched, or if there is no display */
std::filesystem::path findVisualizer();

/** A window of Simbody's visualizer that follows a simulation. */
class RunVisualizer {
public:
    /** Opens the window. @param folder   findVisualizer() @param bones   are drawn with what the system draws */
    RunVisualizer(const models::ModelSystem& model, const std::filesystem::path& folder,
                  const std::vector<ReportPage::Mesh>& bones);
    ~RunVisualizer();

    /** Shows a state, as long as the window is open. Stage: Velocity. */
    void show(const SimTK::State& state);
    bool isOpen() const { return m_visualizer != nullptr; }

private:
    std::unique_ptr<SimTK::Visualizer> m_visualizer;
};

}  // namespace tautline
