// SPDX-License-Identifier: Apache-2.0
#include "study_watcher.h"

#include "page_tables.h"

namespace tautline {

StudyWatcher::StudyWatcher(const PageOptions& options, const models::ModelDescription& description,
                           const models::PathStudy& study, std::ostream& out)
    : m_options(options),
      m_description(description),
      m_study(study),
      m_bodies(models::buildMultibody(description, m_matter)),
      m_state(m_system.realizeTopology()),
      m_bones(loadBones(options, description, m_bodies, out)) {
    m_system.realizeModel(m_state);
    std::vector<SceneRecorder::DrawnPath> paths;
    for (const models::StudiedPath& path : study.getPaths()) paths.push_back({path.name, path.wraps});
    m_scene.emplace(description, m_bodies, paths);
}

void StudyWatcher::watch(double time, const models::PoseAnswer& answer) {
    m_state.setTime(time);
    for (std::size_t i = 0; i < answer.values.size(); ++i)
        m_bodies.setCoordinate(m_state, m_study.getCoordinateNames()[i], answer.values[i]);
    m_system.realize(m_state, SimTK::Stage::Position);
    std::vector<models::CorePath> paths;
    for (std::size_t i = 0; i < m_study.getPaths().size(); ++i) paths.push_back(m_study.getCorePath(i));
    m_scene->recordFrame(m_matter, m_state, paths);
}

void StudyWatcher::finish(const std::vector<double>& times, const std::vector<models::PoseAnswer>& answers,
                          std::ostream& out) const {
    writePage(makeStudyPage(m_study, times, answers), m_options, m_description, *m_scene, m_bones, out);
}

}  // namespace tautline
