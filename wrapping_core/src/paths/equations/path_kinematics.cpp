// SPDX-License-Identifier: Apache-2.0
#include "tautline/paths/path_kinematics.h"

#include <cmath>

#include "paths/problem/velocity_check.h"
#include "surfaces/arc_walker.h"

namespace tautline {
namespace {

void applyForce(const Pose& X_GE, const Vector3& point_G, const Vector3& force_G, SpatialForce& F_GE) {
    F_GE.force += force_G;
    F_GE.moment += (point_G - X_GE.p).cross(force_G);
}

}  // namespace

double calcLengthRate(const PathSolution& path, const PathPose& pose, const std::vector<SpatialVelocity>& V_GE) {
    requireVelocities(V_GE, pose, "length rate");
    double rate = 0;
    for (const StraightSegment& segment : path.segments) {
        const int from = segment.fromElement, to = segment.toElement;
        rate += segment.e.dot(calcStationVelocity(pose.X_GE[to], V_GE[to], segment.B) -
                              calcStationVelocity(pose.X_GE[from], V_GE[from], segment.A));
    }
    return rate;
}

void calcUnitForces(const PathSolution& path, const PathPose& pose, std::vector<SpatialForce>& F_GE) {
    F_GE.assign(pose.X_GE.size(), SpatialForce());
    for (const StraightSegment& segment : path.segments) {
        applyForce(pose.X_GE[segment.fromElement], segment.A, segment.e, F_GE[segment.fromElement]);
        applyForce(pose.X_GE[segment.toElement], segment.B, -segment.e, F_GE[segment.toElement]);
    }
}

void calcDrawingPoints(const PathSolution& path, const PathProblem& problem, const PathPose& pose, double maxAngle,
                       std::vector<Vector3>& points_G) {
    require(maxAngle > 0, "drawing points: maxAngle must be positive, but is ", maxAngle);
    points_G.clear();
    std::vector<Vector3> arc_S;
    for (const StraightSegment& segment : path.segments) {
        points_G.push_back(segment.A);
        points_G.push_back(segment.B);
        const ContactArc& contact = path.getArcAfter(segment);
        if (problem.getElement(segment.toElement).isPoint() || !(contact.geodesic.length > 0)) continue;
        const ShotGeodesic& arc = contact.geodesic;
        const double curvature = std::max({std::abs(arc.P.kappaN), std::abs(arc.Q.kappaN), std::abs(arc.maxKappaN),
                                           std::abs(arc.P.tauG), std::abs(arc.Q.tauG)});
        const int count = 2 + static_cast<int>(std::min(1000.0, arc.length * curvature / maxAngle));
        sampleGeodesic(*problem.getElement(segment.toElement).surface, contact.start, kAlongArc, count, arc_S);
        for (int i = 1; i + 1 < count; ++i) points_G.push_back(pose.X_GE[segment.toElement] * arc_S[i]);
    }
}

}  // namespace tautline
