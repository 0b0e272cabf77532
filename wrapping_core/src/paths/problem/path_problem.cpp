// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_problem.h"

#include <cmath>

#include "tautline/error.h"
#include "tautline/paths/tolerances.h"

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

/** True where the z axis of S is inside the body as far as one can see both ways, as that of a cylinder. Asked for just
beside the axis, since the functions of some surfaces have no gradient on it. */
bool isEndlessAlongZ(const Surface& surface) {
    constexpr double kFar = 1e3, kBeside = 1e-3;  // in sizes
    const auto isInside = [&](double z) {
        return surface.calcHeight(surface.getSize() * Vector3(0.6 * kBeside, 0.8 * kBeside, z)) < 0;
    };
    return isInside(kFar) && isInside(-kFar);
}

/** The side on which a hint asks the path to run: that of its direction, or outward at the foot of its point. Along the
axis of an endless body there are no sides. */
Vector3 calcSide(const StartHint& hint, const Surface& surface, bool isEndless) {
    Vector3 side = Vector3::Constant(kNaN);
    if (const auto* asked = std::get_if<PassOnSide>(&hint)) side = asked->direction_S;
    const auto* near = std::get_if<PassNear>(&hint);
    const bool isOnAxis = near && isEndless && !(near->point_S.head<2>().norm() > kOnTheAxis * surface.getSize());
    if (near && !isOnAxis)
        side = surface.calcFrame(surface.findSurfacePoint(near->point_S), Vector3(0.48, 0.64, 0.6)).N;
    if (isEndless && side.head<2>().norm() > 0) side.z() = 0;
    return side.normalized();
}

/** Whether the point of a hint lies in the hole of its surface: over or under the disc that spans it, by less than half
of its radius or, in a thick ring, than the size of the surface. */
bool isThroughHole(const StartHint& hint, const Surface& surface) {
    const auto* near = std::get_if<PassNear>(&hint);
    const std::optional<Hole> hole = surface.getHole();
    if (!near || !hole) return false;
    const Vector3 over = surface.getSize() * hole->getAxis();
    return hole->isBeside(near->point_S) || hole->countCrossings(near->point_S - over, near->point_S + over) != 0;
}

StartHint toStartHint(const std::optional<Vector3>& hint_S) {
    return hint_S ? StartHint(PassNear{*hint_S}) : StartHint();
}

}  // namespace

int PathProblem::addPoint(std::string name) {
    PathElement point;
    point.name = std::move(name);
    m_elements.push_back(std::move(point));
    return getNumElements() - 1;
}

int PathProblem::addObstacle(std::string name, std::shared_ptr<const Surface> surface, const StartHint& hint) {
    require(surface != nullptr, "path: obstacle '", name, "' has no surface");
    checkHint(hint, *surface, name);
    PathElement obstacle;
    obstacle.name = std::move(name);
    obstacle.surface = std::move(surface);
    obstacle.hasHole = obstacle.surface->getHole().has_value();
    obstacle.isEndless = isEndlessAlongZ(*obstacle.surface);
    m_hasObstacles = true;
    m_hasHoles = m_hasHoles || obstacle.hasHole;
    const double size = obstacle.surface->getSize();
    m_hasUsableSizes = m_hasUsableSizes && std::isnormal(size * size);
    m_elements.push_back(std::move(obstacle));
    setHint(getNumElements() - 1, hint);
    return getNumElements() - 1;
}

int PathProblem::addObstacle(std::string name, std::shared_ptr<const Surface> surface, std::optional<Vector3> hint_S) {
    return addObstacle(std::move(name), std::move(surface), toStartHint(hint_S));
}

void PathProblem::setHint(int element, const StartHint& hint) {
    require(element >= 0 && element < getNumElements(), "path: no element ", element, " of ", getNumElements());
    PathElement& obstacle = m_elements[element];
    require(!obstacle.isPoint(), "path: element '", obstacle.name, "' is a point and takes no hint");
    checkHint(hint, *obstacle.surface, obstacle.name);
    const auto count = [](const StartHint& said) { return std::holds_alternative<std::monostate>(said) ? 0 : 1; };
    m_numHints += count(hint) - count(obstacle.hint);
    obstacle.hint = hint;
    obstacle.side_S = calcSide(hint, *obstacle.surface, obstacle.isEndless);
    obstacle.isAskedThroughHole = isThroughHole(hint, *obstacle.surface);
}

void PathProblem::setHint(int element, std::optional<Vector3> hint_S) {
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

/** A number times 0 is 0 if it is finite, else no number; sums show that without a branch. */
bool PathPose::isFinite() const {
    double sum = 0;
    for (const Pose& X : X_GE) sum += (0.0 * X.R).sum() + (0.0 * X.p).sum();
    return sum == 0;
}

}  // namespace tautline
