// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "report_page.h"
#include "tautline/models/model_builder.h"
#include "tautline/models/path_study.h"
#include "tautline/models/wrap_binding.h"

namespace tautline {

/** Collects what a page shows in 3D, frame by frame: poses of bodies, surfaces, paths with their arcs; and the
witnesses of contacts. */
class SceneRecorder {
public:
    struct DrawnPath {
        std::string name;
        std::vector<models::BoundWrap> wraps;  ///< in the order of its obstacles
    };

    /** @param bodies   of the description; only their indices are asked for */
    SceneRecorder(const models::ModelDescription& description, const models::BuiltModel& bodies,
                  const std::vector<DrawnPath>& paths);

    /** A frame of the page.
    @param matter   in which the bodies are
    @param state   of its system. Stage: Position
    @param paths   solved in this pose; one without a problem is not drawn */
    void recordFrame(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state,
                     const std::vector<models::CorePath>& paths);

    std::size_t getNumFrames() const { return m_frames.size(); }
    /** Adds all that was recorded. Witnesses are curves that end with the last of the page's curve times. */
    void addTo(ReportPage& page) const;

private:
    /** A wrap object; paths may share it. */
    struct Obstacle {
        int body = 0;
        SimTK::Transform X_BS;
        std::shared_ptr<const Surface> surface;
        std::string name;
        std::vector<Vector3> touched_S;  ///< where paths have touched it
    };
    struct Witness {
        std::size_t path = 0;
        std::size_t obstacle = 0;  ///< index into m_obstacles
        std::vector<double> values;
    };

    std::size_t addObstacle(const models::ModelDescription& description, const models::BuiltModel& bodies,
                            const models::BoundWrap& wrap);
    void recordPath(std::size_t path, const models::CorePath& core, ReportPage::Frame& frame);

    Vector3 m_up;
    std::vector<DrawnPath> m_paths;
    std::vector<Obstacle> m_obstacles;
    std::vector<std::size_t> m_objects;  ///< of the description, in the order of m_obstacles
    std::vector<std::vector<std::size_t>> m_witnessesOfPath;
    std::vector<Witness> m_witnesses;
    std::vector<ReportPage::Frame> m_frames;
};

}  // namespace tautline
