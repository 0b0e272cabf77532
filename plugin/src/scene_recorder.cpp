// SPDX-License-Identifier: Apache-2.0
#include "scene_recorder.h"

#include <algorithm>

#include "tautline/paths/contact_witness.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/simbody/conversions.h"
#include "tautline/surfaces/surface_mesh.h"

namespace tautline {
namespace {

using models::BoundWrap;
using models::CorePath;

/** Arcs turn by so much between points [rad]. */
constexpr double kMaxAngle = 0.15;
/** How far surfaces without end are drawn around where they are touched, in their sizes. */
constexpr double kExtent = 2.0;
/** Places where a surface is touched are kept of every tenth frame: its picture has to reach them. */
constexpr std::size_t kTouchStride = 10;

/** A path for drawing: its points, each once, and which of them are ends of arcs. */
ReportPage::Path drawPath(const CorePath& core) {
    ReportPage::Path drawn;
    std::vector<Vector3>& points = drawn.points_G;
    calcDrawingPoints(*core.solution, *core.problem, *core.pose, kMaxAngle, points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::size_t next = 0;
    const auto advanceTo = [&](const Vector3& point) {
        const auto found = std::find(points.begin() + static_cast<std::ptrdiff_t>(next), points.end(), point);
        if (found != points.end()) next = static_cast<std::size_t>(found - points.begin());
        return next;
    };
    const std::vector<StraightSegment>& segments = core.solution->segments;
    for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
        if (core.problem->getElement(segments[i].toElement).isPoint()) continue;
        const std::size_t first = advanceTo(segments[i].B);
        drawn.arcs.push_back({first, advanceTo(segments[i + 1].A)});
    }
    return drawn;
}

/** The indices of a problem's obstacles, in their order. */
std::vector<int> listObstacles(const PathProblem& problem) {
    std::vector<int> obstacles;
    for (int e = 0; e < problem.getNumElements(); ++e)
        if (!problem.getElement(e).isPoint()) obstacles.push_back(e);
    return obstacles;
}

/** Each facet of four corners as two triangles. */
ReportPage::Mesh makeMesh(int body, const SimTK::Transform& X_BS, const SurfaceMesh& facets) {
    ReportPage::Mesh mesh{body, X_BS, facets.points, {}};
    for (const auto& [a, b, c, d] : facets.faces) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    }
    return mesh;
}

}  // namespace

SceneRecorder::SceneRecorder(const models::ModelDescription& description, const models::BuiltModel& bodies,
                             const std::vector<DrawnPath>& paths)
    : m_up(description.gravity.isZero() ? Vector3(Vector3::UnitY()) : Vector3(-description.gravity.normalized())),
      m_paths(paths) {
    for (std::size_t path = 0; path < m_paths.size(); ++path) {
        m_witnessesOfPath.emplace_back();
        for (const BoundWrap& wrap : m_paths[path].wraps) {
            m_witnessesOfPath.back().push_back(m_witnesses.size());
            m_witnesses.push_back({path, addObstacle(description, bodies, wrap), {}});
        }
    }
}

std::size_t SceneRecorder::addObstacle(const models::ModelDescription& description, const models::BuiltModel& bodies,
                                       const BoundWrap& wrap) {
    const auto found = std::find(m_objects.begin(), m_objects.end(), wrap.object);
    if (found != m_objects.end()) return static_cast<std::size_t>(found - m_objects.begin());
    const models::WrapObject& object = description.wrapObjects[wrap.object];
    m_objects.push_back(wrap.object);
    m_obstacles.push_back({bodies.getBodyIndex(object.body), toTransform(object.X_BW), wrap.surface, object.name, {}});
    return m_obstacles.size() - 1;
}

namespace {

double calcWitness(const models::CorePath& core, int element) {
    return calcContactWitness(*core.problem, *core.pose, *core.solution, element);
}

}  // namespace

void SceneRecorder::recordPath(std::size_t path, const CorePath& core, ReportPage::Frame& frame) {
    frame.paths.push_back(core.problem ? drawPath(core) : ReportPage::Path());
    const std::vector<int> elements = core.problem ? listObstacles(*core.problem) : std::vector<int>();
    for (std::size_t i = 0; i < m_witnessesOfPath[path].size(); ++i) {
        Witness& witness = m_witnesses[m_witnessesOfPath[path][i]];
        witness.values.push_back(core.problem ? calcWitness(core, elements[i]) : kNaN);
        if (!core.problem) continue;
        const int element = elements[i];
        if (!core.solution->contacts[static_cast<std::size_t>(element)].isTouched) continue;
        frame.touched.push_back(witness.obstacle);
        if (m_frames.size() % kTouchStride != 0) continue;
        const ObstacleContact& contact = core.solution->contacts[static_cast<std::size_t>(element)];
        for (int arc = 0; arc < contact.getNumArcs(); ++arc)
            m_obstacles[witness.obstacle].touched_S.push_back(contact.getArc(arc).geodesic.P.x);
    }
}

void SceneRecorder::recordFrame(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state,
                                const std::vector<CorePath>& paths) {
    ReportPage::Frame frame;
    frame.time = state.getTime();
    for (SimTK::MobilizedBodyIndex body(0); body < matter.getNumBodies(); ++body)
        frame.X_GB.push_back(matter.getMobilizedBody(body).getBodyTransform(state));
    for (std::size_t path = 0; path < m_paths.size(); ++path) recordPath(path, paths[path], frame);
    std::sort(frame.touched.begin(), frame.touched.end());
    frame.touched.erase(std::unique(frame.touched.begin(), frame.touched.end()), frame.touched.end());
    m_frames.push_back(std::move(frame));
}

void SceneRecorder::addTo(ReportPage& page) const {
    page.up = m_up;
    page.frames = m_frames;
    for (const DrawnPath& path : m_paths) page.paths.push_back(path.name);
    for (const Obstacle& obstacle : m_obstacles)
        page.surfaces.push_back(
            makeMesh(obstacle.body, obstacle.X_BS,
                     calcSurfaceMesh(*obstacle.surface, kExtent * obstacle.surface->getSize(), obstacle.touched_S)));
    for (const Witness& witness : m_witnesses) {
        ReportPage::Curve curve{witness.path, "witness of contacts [1]", m_obstacles[witness.obstacle].name, {}};
        curve.values.assign(page.curveTimes.size() - witness.values.size(), kNaN);
        curve.values.insert(curve.values.end(), witness.values.begin(), witness.values.end());
        page.curves.push_back(std::move(curve));
    }
}

}  // namespace tautline
