// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_problem.h"

#include <cmath>

#include "paths/hole_passages.h"
#include "tautline/error.h"

namespace tautline {
namespace {

constexpr int kMaxTurns = 100;  ///< more are a mistake, and a string of many thousand nodes

void checkHint(const StartHint& hint, const Surface& surface, const std::string& name) {
    if (const auto* near = std::get_if<PassNear>(&hint))
        require(near->point_S.allFinite(), "path: the hint of obstacle '", name, "' must be finite, but is (",
                near->point_S.transpose(), ")");
    if (const auto* side = std::get_if<PassOnSide>(&hint))
        require(side->direction_S.allFinite() && side->direction_S.norm() > 0, "path: the side of obstacle '", name,
                "' needs a finite direction that is not zero, got (", side->direction_S.transpose(), ")");
    if (const auto* winding = std::get_if<WindAround>(&hint))
        require(std::abs(winding->turns) <= kMaxTurns, "path: the turns about obstacle '", name, "' must be within ",
                kMaxTurns, ", but are ", winding->turns);
    if (const auto* thread = std::get_if<ThreadHole>(&hint)) {
        require(surface.getHole().has_value(), "path: obstacle '", name, "', ", surface.getDescription(),
                ", has no hole to thread");
        require(std::abs(thread->passages) <= kMaxTurns, "path: the passages through obstacle '", name,
                "' must be within ", kMaxTurns, ", but are ", thread->passages);
    }
}

StartHint toStartHint(const std::optional<Vec3>& hint_S) {
    return hint_S ? StartHint(PassNear{*hint_S}) : StartHint();
}

}  // namespace

int PathProblem::addPoint(std::string name) {
    m_elements.push_back({std::move(name), nullptr, {}});
    return getNumElements() - 1;
}

int PathProblem::addObstacle(std::string name, std::shared_ptr<const Surface> surface, const StartHint& hint) {
    require(surface != nullptr, "path: obstacle '", name, "' has no surface");
    checkHint(hint, *surface, name);
    m_elements.push_back({std::move(name), std::move(surface), hint});
    return getNumElements() - 1;
}

int PathProblem::addObstacle(std::string name, std::shared_ptr<const Surface> surface, std::optional<Vec3> hint_S) {
    return addObstacle(std::move(name), std::move(surface), toStartHint(hint_S));
}

void PathProblem::setHint(int element, const StartHint& hint) {
    require(element >= 0 && element < getNumElements(), "path: no element ", element, " of ", getNumElements());
    PathElement& obstacle = m_elements[element];
    require(!obstacle.isPoint(), "path: element '", obstacle.name, "' is a point and takes no hint");
    checkHint(hint, *obstacle.surface, obstacle.name);
    obstacle.hint = hint;
}

void PathProblem::setHint(int element, std::optional<Vec3> hint_S) {
    setHint(element, toStartHint(hint_S));
}

void PathProblem::validate() const {
    require(m_elements.size() >= 2, "path: needs an origin and an insertion, has ", m_elements.size(), " elements");
    require(m_elements.front().isPoint(), "path: begins with obstacle '", m_elements.front().name,
            "', not with a point");
    require(m_elements.back().isPoint(), "path: ends with obstacle '", m_elements.back().name, "', not with a point");
}

void PathPose::validate(const PathProblem& problem) const {
    const std::size_t n = static_cast<std::size_t>(problem.getNumElements());
    require(X_GE.size() == n, "path pose: has ", X_GE.size(), " poses for ", n, " elements");
    require(isActive.empty() || isActive.size() == n, "path pose: isActive has ", isActive.size(), " entries for ", n,
            " elements");
}

bool PathPose::isFinite() const {
    for (const Pose& X : X_GE)
        if (!X.p.allFinite() || !X.R.allFinite()) return false;
    return true;
}

}  // namespace tautline
