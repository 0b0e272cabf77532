// SPDX-License-Identifier: Apache-2.0
// A half turn over a cylinder, solved by the installed core and, if it is there, by the installed adapter.
#include <tautline/paths/path_solver.h>
#include <tautline/surfaces/cylinder.h>

#include <cmath>
#include <cstdio>
#ifdef WITH_SIMBODY
#include <tautline/simbody/cable.h>
#endif
#ifdef WITH_MODELS
#include <tautline/models/osim_reader.h>
#endif

namespace {

using namespace tautline;

const auto kCylinder = std::make_shared<Cylinder>(0.5);

double calcLength() {
    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("cylinder", kCylinder, Vector3(0.5, 0, 0));
    problem.addPoint("insertion");
    PathPose pose;
    pose.X_GE = {Pose(Vector3(-1, -0.5, 0)), Pose(), Pose(Vector3(-1, 0.5, 0))};
    return solvePath(problem, pose).length;
}

#ifdef WITH_SIMBODY
double calcLengthInSimbody() {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter(system);
    CablePathSubsystem cables(system);
    Cable cable(cables, matter.Ground(), SimTK::Vec3(-1, -0.5, 0), matter.Ground(), SimTK::Vec3(-1, 0.5, 0));
    cable.addObstacle(matter.Ground(), SimTK::Vec3(0), kCylinder, SimTK::Vec3(0.5, 0, 0));
    const SimTK::State state = system.realizeTopology();
    system.realize(state, SimTK::Stage::Position);
    return cable.getLength(state);
}
#else
double calcLengthInSimbody() {
    return calcLength();
}
#endif

bool readsModels() {
#ifdef WITH_MODELS
    const char* text = "<OpenSimDocument Version='40000'><Model name='empty'/></OpenSimDocument>";
    return models::readOsimText(text, "text").name == "empty";
#else
    return true;
#endif
}

}  // namespace

int main() {
    const double expected = 2 + 0.5 * kPi, core = calcLength(), adapter = calcLengthInSimbody();
    std::printf("%.15g %.15g\n", core, adapter);
    return std::abs(core - expected) < 1e-12 && std::abs(adapter - expected) < 1e-12 && readsModels() ? 0 : 1;
}
