// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>
#include <vector>

#include "simulation.h"
#include "tautline/models/model_system.h"

namespace tautline {

/** Collects what the page of a run shows in 3D: poses of bodies, surfaces, paths with their arcs. */
class ReportRecorder {
public:
    /** @param gravity   of the model: up is against it
    @throws std::runtime_error if the page's libraries were missing when the program was built */
    ReportRecorder(const models::ModelSystem& model, const Vec3& gravity);

    /** A frame of the page. Stage: Velocity. */
    void recordFrame(const SimTK::State& state);

    /** The page, which needs nothing but itself.
    @param title, summary   its first lines */
    std::string makePage(const std::string& title, const std::string& summary, const SimulationResult& result) const;

private:
    struct Obstacle {
        CableElementIndex element;
        std::size_t surface;  ///< index into m_surfaces
    };
    /** A surface on a body; paths may share it. */
    struct Surface {
        SimTK::MobilizedBodyIndex body;
        SimTK::Transform X_BS;
        std::shared_ptr<const tautline::Surface> surface;
        std::vector<Vec3> touched_S;  ///< where paths have touched it
    };

    std::size_t findSurface(const Cable& cable, CableElementIndex element);
    void recordPath(const SimTK::State& state, std::size_t path, std::vector<bool>& isTouched, std::string& points,
                    std::string& arcs);
    std::string describeSurfaces() const;
    std::string describeCurves(const SimulationResult& result) const;
    std::string describeTable(const SimulationResult& result) const;
    std::string describeEvents(const SimulationResult& result) const;

    const models::ModelSystem& m_model;
    Vec3 m_up;
    std::vector<models::ModelSystem::PathView> m_paths;
    std::vector<Surface> m_surfaces;
    std::vector<std::vector<Obstacle>> m_obstacles;  ///< by path
    std::vector<std::string> m_frames;
};

}  // namespace tautline
