// SPDX-License-Identifier: Apache-2.0
#include "paths/reversed_tangents.h"

#include <cmath>

#include "paths/path_error.h"

namespace tautline {
namespace {

bool arrivesReversed(const PosedProblem& scene, const PathSolution& path, const StraightSegment& line) {
    const int e = line.toElement;
    return !scene.isPoint(e) && line.e.dot(scene.getPose(e).R * path.contacts[e].geodesic.P.t) < 0;
}

bool leavesReversed(const PosedProblem& scene, const PathSolution& path, const StraightSegment& line) {
    const int e = line.fromElement;
    return !scene.isPoint(e) && line.e.dot(scene.getPose(e).R * path.contacts[e].geodesic.Q.t) < 0;
}

}  // namespace

bool hasReversedTangent(const PosedProblem& scene, const PathSolution& path) {
    for (const StraightSegment& line : path.segments)
        if (arrivesReversed(scene, path, line) || leavesReversed(scene, path, line)) return true;
    return false;
}

void reverseTangents(const PosedProblem& scene, const std::vector<double>* startLengths, PathSolution& path) {
    const auto calcShift = [&](int e, const DarbouxFrame& end, double lineLength) {
        const double curvature = std::abs(end.kappaN), length = path.contacts[e].start.length;
        const double back = curvature > 0 ? 2 * std::atan(curvature * lineLength) / curvature : 2 * lineLength;
        if (!startLengths || !(curvature > 0)) return -back;
        const double on = 2 * kPi / curvature - back, start = (*startLengths)[e];
        return std::abs(length - back - start) < std::abs(length + on - start) ? -back : on;
    };
    for (const StraightSegment& line : path.segments) {
        if (arrivesReversed(scene, path, line)) {
            ObstacleContact& contact = path.contacts[line.toElement];
            const DarbouxFrame& P = contact.geodesic.P;
            const double shift = calcShift(line.toElement, P, line.length);
            const Surface& surface = scene.getSurface(line.toElement);
            contact.start = calcCorrectedStart(surface, contact.start, P, Vec4(-shift, 0, 0, shift));
        }
        if (leavesReversed(scene, path, line)) {
            ObstacleContact& contact = path.contacts[line.fromElement];
            contact.start.length += calcShift(line.fromElement, contact.geodesic.Q, line.length);
        }
    }
}

}  // namespace tautline
