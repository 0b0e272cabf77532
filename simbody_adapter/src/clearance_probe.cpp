// SPDX-License-Identifier: Apache-2.0
#include "tautline/simbody/clearance_probe.h"

#include "same_pose.h"
#include "tautline/paths/segment_clearance.h"

namespace tautline {
namespace {

/** Normalized distance that may be read as zero where contact has just been made. */
constexpr double kRounding = 1e-7;

/** Clearances are watched on the side where the middle of the arc lies. */
LineClearance watchAtMiddle(const Surface& surface, const GeodesicStart& arc) {
    GeodesicStart half = arc;
    half.length *= 0.5;
    ShotGeodesic geodesic;
    surface.shootGeodesic(half, ShootingOptions(), geodesic);
    LineClearance clearance;
    clearance.keptC = geodesic.endPoint;
    clearance.keptN = geodesic.Q.N;
    return clearance;
}

const StraightSegment& findPassingSegment(const PathSolution& path, int element) {
    std::size_t segment = 0;
    while (path.segments[segment].toElement < element) ++segment;
    return path.segments[segment];
}

}  // namespace

/** Continues from where the last path without the obstacle was, else from where the string is now; anew only if
there was none so far, since that costs milliseconds. */
bool ClearanceProbe::solveWithout(const PathPose& without, const PathSolution& path) {
    const PathSolverOptions options = m_cable.getOptions();
    const auto solveFrom = [&](const PathSolution& start, const PathSolverOptions& how) {
        PathSolution found = start;
        PathSolver(how).solve(m_cable.getPathProblem(), without, found);
        if (found.status != PathStatus::Solved) return false;
        m_loose = found;
        return true;
    };
    if (!m_loose.isEmpty() && solveFrom(m_loose, options.withoutSearch())) return true;
    PathSolution released = path;
    released.contacts[m_obstacle] = ObstacleContact();
    if (solveFrom(released, options.withoutSearch())) return true;
    return m_loose.isEmpty() && solveFrom(PathSolution(), options);
}

LineClearance ClearanceProbe::calcClearance(const SimTK::State& state) {
    const PathSolution& path = m_cable.getSolution(state);
    const ObstacleContact& contact = path.contacts[m_obstacle];
    if (!contact.isTouched) {
        m_loose = path;
        return contact.clearance;
    }
    if (!isKnown(m_cable.getPathPose(state), contact.start)) {
        m_pose = m_cable.getPathPose(state);
        m_arc = contact.start;
        m_depth = calcDepth(path);
    }
    return m_depth;
}

bool ClearanceProbe::isKnown(const PathPose& pose, const GeodesicStart& arc) const {
    return isSamePose(m_pose, pose) && m_arc.length == arc.length && m_arc.point.p == arc.point.p &&
           m_arc.tangent == arc.tangent;
}

/** At m_pose. */
LineClearance ClearanceProbe::calcDepth(const PathSolution& path) {
    PathPose without = m_pose;
    without.isActive[m_obstacle] = 0;
    const Surface& surface = *m_cable.getSurface(m_obstacle);
    LineClearance clearance = watchAtMiddle(surface, m_arc);
    if (!solveWithout(without, path)) return clearance;
    const StraightSegment& segment = findPassingSegment(m_loose, m_obstacle);
    findSegmentClearance(surface, without.X_GE[m_obstacle], segment.A, segment.B, clearance);
    // A line that ends before the surface or is clear of it belongs to a string that would go elsewhere.
    const bool passes = clearance.lineCoordinate > 0 && clearance.lineCoordinate < segment.length;
    clearance.found = clearance.found && passes && clearance.distance * clearance.scale < kRounding;
    return clearance;
}

}  // namespace tautline
