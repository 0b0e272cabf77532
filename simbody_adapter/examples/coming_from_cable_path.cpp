// SPDX-License-Identifier: Apache-2.0
/** One scene with Simbody's CablePath and with Tautline's Cable: a mass hangs on a spring cable over a pulley. The page
simbody_adapter/guide/coming_from_cable_path.md shows both. Ends with 0 if they move alike. */
#include <Simbody.h>
#include <tautline/simbody/cable.h>
#include <tautline/simbody/cable_forces.h>

#include <cmath>
#include <iostream>

struct Answer {
    double length, rate, height;
};

namespace before {
using namespace SimTK;

Answer simulate(double time) {
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    CableTrackerSubsystem cables(system);
    GeneralForceSubsystem forces(system);
    Force::Gravity(forces, matter, -YAxis, 9.81);
    const Body::Rigid body(MassProperties(1, Vec3(0), UnitInertia(0.01)));
    MobilizedBody::Slider mass(matter.Ground(), Transform(Rotation(-Pi / 2, ZAxis), Vec3(0.25, 0, 0)), body,
                               Transform(Rotation(-Pi / 2, ZAxis)));

    CablePath path(cables, matter.Ground(), Vec3(-1, 0, 0), mass, Vec3(0));
    CableObstacle::Surface pulley(path, matter.Ground(), Transform(), ContactGeometry::Cylinder(0.25));
    pulley.setContactPointHints(Vec3(-0.1, 0.23, 0), Vec3(0.24, 0.05, 0));
    CableSpring spring(forces, path, 100, 1.85, 0.1);

    State state = system.realizeTopology();
    mass.setOneQ(state, 0, 0.5);
    path.setIntegratedCableLengthDot(state, 0);
    system.realize(state, Stage::Position);
    RungeKuttaMersonIntegrator integrator(system);
    integrator.setAccuracy(1e-6);
    TimeStepper stepper(system, integrator);
    stepper.initialize(state);
    stepper.stepTo(time);

    const State& last = stepper.getState();
    system.realize(last, Stage::Velocity);
    return {path.getCableLength(last), path.getCableLengthDot(last), mass.getBodyOriginLocation(last)[1]};
}
}  // namespace before

namespace after {
using namespace SimTK;

Answer simulate(double time) {
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    tautline::CablePathSubsystem cables(system);
    GeneralForceSubsystem forces(system);
    Force::Gravity(forces, matter, -YAxis, 9.81);
    const Body::Rigid body(MassProperties(1, Vec3(0), UnitInertia(0.01)));
    MobilizedBody::Slider mass(matter.Ground(), Transform(Rotation(-Pi / 2, ZAxis), Vec3(0.25, 0, 0)), body,
                               Transform(Rotation(-Pi / 2, ZAxis)));

    tautline::Cable path(cables, matter.Ground(), Vec3(-1, 0, 0), mass, Vec3(0));
    path.addObstacle(matter.Ground(), Transform(), std::make_shared<ContactGeometry::Cylinder>(0.25), Vec3(0, 0.25, 0));
    tautline::ElasticStringForce spring(forces, path, 100, 1.85, 0.1);

    State state = system.realizeTopology();
    mass.setOneQ(state, 0, 0.5);
    RungeKuttaMersonIntegrator integrator(system);
    integrator.setAccuracy(1e-6);
    TimeStepper stepper(system, integrator);
    stepper.initialize(state);
    stepper.stepTo(time);

    const State& last = stepper.getState();
    system.realize(last, Stage::Velocity);
    return {path.getLength(last), path.getLengthRate(last), mass.getBodyOriginLocation(last)[1]};
}
}  // namespace after

int main() {
    std::streambuf* const output = std::cout.rdbuf(nullptr);  // CablePath tells of every iteration
    const Answer old = before::simulate(1);
    std::cout.rdbuf(output);
    const Answer now = after::simulate(1);
    std::cout << "CablePath: length " << old.length << " m, rate " << old.rate << " m/s, mass at " << old.height
              << " m\n"
              << "Tautline:  length " << now.length << " m, rate " << now.rate << " m/s, mass at " << now.height
              << " m\n";
    const double worst =
        std::max({std::abs(old.length - now.length), std::abs(old.rate - now.rate), std::abs(old.height - now.height)});
    if (worst < 1e-4) return 0;
    std::cout << "they differ by " << worst << "\n";
    return 1;
}
