// SPDX-License-Identifier: Apache-2.0
// One spring over a cylinder, by Simbody's CablePath and by Tautline, each in a system of its own.
#include <Simbody.h>
#include <tautline/simbody/cable.h>
#include <tautline/simbody/cable_forces.h>
#include <tautline/surfaces/cylinder.h>

#include <iostream>
using namespace SimTK;

/** A pendulum, for both. */
struct Pendulum {
    MultibodySystem system;
    SimbodyMatterSubsystem matter{system};
    GeneralForceSubsystem forces{system};
    MobilizedBody::Pin bob{matter.Ground(), Vec3(0), Body::Rigid(MassProperties(1, Vec3(0), UnitInertia(1))),
                           Vec3(0, 0.4, 0)};
};

double solveWithCablePath() {
    Pendulum pendulum;
    CableTrackerSubsystem cables(pendulum.system);
    CablePath path(cables, pendulum.matter.Ground(), Vec3(-0.2, 0.1, 0), pendulum.bob, Vec3(0, 0.1, 0));
    CableObstacle::Surface drum(path, pendulum.matter.Ground(), Transform(), ContactGeometry::Cylinder(0.05));
    drum.setContactPointHints(Vec3(-0.02, 0.045, 0), Vec3(0.05, 0.01, 0));
    CableSpring spring(pendulum.forces, path, 100, 0.3, 0.1);
    const State state = pendulum.system.realizeTopology();
    pendulum.system.realize(state, Stage::Velocity);
    return path.getCableLength(state);
}

double solveWithTautline() {
    Pendulum pendulum;
    tautline::CablePathSubsystem cables(pendulum.system);
    tautline::Cable cable(cables, pendulum.matter.Ground(), Vec3(-0.2, 0.1, 0), pendulum.bob, Vec3(0, 0.1, 0));
    cable.addObstacle(pendulum.matter.Ground(), Transform(), std::make_shared<tautline::Cylinder>(0.05),
                      tautline::PassOnSide{tautline::Vector3(1, 1, 0)});
    tautline::ElasticStringForce spring(pendulum.forces, cable, 0.3, 100, 0.1);
    const State state = pendulum.system.realizeTopology();
    pendulum.system.realize(state, Stage::Velocity);
    return cable.getLength(state);
}

int main() {
    const double theirs = solveWithCablePath(), ours = solveWithTautline();
    std::cout << "CablePath " << theirs << " m, Tautline " << ours << " m\n";
    return std::abs(theirs - ours) < 1e-6 ? 0 : 1;
}
