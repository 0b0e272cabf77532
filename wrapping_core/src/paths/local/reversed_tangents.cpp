// SPDX-License-Identifier: Apache-2.0
#include "paths/local/reversed_tangents.h"

#include <cmath>

#include "paths/equations/path_error.h"

namespace tautline {
namespace {

bool arrivesReversed(const PosedProblem& scene, const PathSolution& path, const StraightSegment& line) {
    const int e = line.toElement;
    if (e == line.fromElement) return false;
    return !scene.isPoint(e) && line.e.dot(scene.getPose(e).R * path.contacts[e].getArc(line.toArc).geodesic.P.t) < 0;
}

bool leavesReversed(const PosedProblem& scene, const PathSolution& path, const StraightSegment& line) {
    const int e = line.fromElement;
    if (e == line.toElement) return false;
    return !scene.isPoint(e) && line.e.dot(scene.getPose(e).R * path.contacts[e].getArc(line.fromArc).geodesic.Q.t) < 0;
}

}  // namespace

bool hasReversedTangent(const PosedProblem& scene, const PathSolution& path) {
    for (const StraightSegment& line : path.segments)
        if (arrivesReversed(scene, path, line) || leavesReversed(scene, path, line)) return true;
    return false;
}

void reverseTangents(const PosedProblem& scene, const std::vector<double>* startLengths, PathSolution& path) {
    const auto calcShift = [&](int arcNumber, double length, const DarbouxFrame& end, double lineLength) {
        const double curvature = std::abs(end.kappaN);
        const double back = curvature > 0 ? 2 * std::atan(curvature * lineLength) / curvature : 2 * lineLength;
        const bool knowsStart = startLengths && arcNumber < static_cast<int>(startLengths->size());
        if (!knowsStart || !(curvature > 0)) return -back;
        const double on = 2 * kPi / curvature - back, start = (*startLengths)[arcNumber];
        return std::abs(length - back - start) < std::abs(length + on - start) ? -back : on;
    };
    int next = 0;  // number of the arc after a line
    for (const StraightSegment& line : path.segments) {
        if (arrivesReversed(scene, path, line)) {
            ContactArc& arc = path.contacts[line.toElement].updArc(line.toArc);
            const double shift = calcShift(next, arc.start.length, arc.geodesic.P, line.length);
            const Surface& surface = scene.getSurface(line.toElement);
            arc.start = calcCorrectedStart(surface, arc.start, arc.geodesic.P, Vector4(-shift, 0, 0, shift));
        }
        if (leavesReversed(scene, path, line)) {
            ContactArc& arc = path.contacts[line.fromElement].updArc(line.fromArc);
            arc.start.length += calcShift(next - 1, arc.start.length, arc.geodesic.Q, line.length);
        }
        next += !scene.isPoint(line.toElement);
    }
}

}  // namespace tautline
