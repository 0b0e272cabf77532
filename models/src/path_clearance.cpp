#include "tautline/models/path_clearance.h"

#include "tautline/models/path_start.h"

namespace tautline::models {

namespace {

/** Takes an obstacle out of contact, to be watched on the side where the middle of its arc lies. */
void liftAtMiddle(const Surface& surface, ObstacleContact& contact) {
    GeodesicStart half = contact.start;
    half.length *= 0.5;
    Geodesic geodesic;
    surface.shootGeodesic(half, GeodesicOptions(), geodesic);
    contact.isTouched = false;
    contact.clearance = LineClearance();
    contact.clearance.keptC = geodesic.endPoint;
    contact.clearance.keptN = geodesic.Q.N;
}

}  // namespace

LineClearance calcClearance(const Cable& cable, const SimTK::State& state, CableElementIndex obstacle) {
    const PathSolution& path = cable.getSolution(state);
    if (!path.contacts[obstacle].isTouched) return path.contacts[obstacle].clearance;
    const PathInPose inPose = makePathInPose(cable, state);
    PathSolution loose = path;
    liftAtMiddle(*cable.getSurface(obstacle), loose.contacts[obstacle]);
    PathSolver solver(cable.getOptions());
    solver.solveKeepingContacts(inPose.problem, inPose.pose, loose);
    LineClearance clearance = loose.contacts[obstacle].clearance;
    clearance.found = clearance.found && loose.status == PathStatus::Solved;
    return clearance;
}

}  // namespace tautline::models
