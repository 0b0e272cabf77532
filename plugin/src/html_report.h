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

    /** First and last point of an arc. */
    using Range = std::array<std::size_t, 2>;
    struct Path {
        std::vector<SimTK::Vec3> points_G;
        std::vector<Range> arcs;
    };
    struct Frame {
        double time;
        std::vector<SimTK::Transform> X_GB;
        std::vector<Path> paths;
        std::vector<std::size_t> touched;  ///< surfaces
    };

    std::size_t findSurface(const Cable& cable, CableElementIndex element);
    Path recordPath(const SimTK::State& state, std::size_t path, std::vector<bool>& isTouched);
    /** The page's unit of length [m]: all coordinates are whole numbers of 16 bits. */
    double calcUnit() const;
    std::string describeFrames(double unit) const;
    std::string describeSurfaces() const;
    std::string describeCurves(const SimulationResult& result) const;
    std::string describeTable(const SimulationResult& result) const;
    std::string describeEvents(const SimulationResult& result) const;

    const models::ModelSystem& m_model;
    Vec3 m_up;
    std::vector<models::ModelSystem::PathView> m_paths;
    std::vector<Surface> m_surfaces;
    std::vector<std::vector<Obstacle>> m_obstacles;  ///< by path
    std::vector<Frame> m_frames;
};

}  // namespace tautline
