// SPDX-License-Identifier: Apache-2.0
// A forearm on a pin, held up by a muscle that wraps over a cylinder at the elbow.
#include <Simbody.h>
#include <tautline/muscles/millard_2012.h>
#include <tautline/simbody/cable.h>
#include <tautline/simbody/muscle.h>
#include <tautline/surfaces/cylinder.h>
using namespace SimTK;

int main() {
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    GeneralForceSubsystem forces(system);
    tautline::CablePathSubsystem cables(system);
    Force::Gravity(forces, matter, -YAxis, 9.81);
    const Body::Rigid bone(MassProperties(1.5, Vec3(0), UnitInertia(0.01)));
    MobilizedBody::Pin forearm(matter.Ground(), Vec3(0), bone, Vec3(0, 0.15, 0));

    tautline::Cable path(cables, matter.Ground(), Vec3(-0.02, 0.3, 0), forearm, Vec3(-0.03, 0.1, 0));
    path.addObstacle(matter.Ground(), Vec3(0), std::make_shared<tautline::Cylinder>(0.03), Vec3(-0.03, 0, 0));
    tautline::Millard2012Parameters parameters;
    parameters.tendonSlackLength = 0.12;
    parameters.defaultExcitation = parameters.defaultActivation = 0.2;
    tautline::Muscle muscle(forces, path, std::make_shared<tautline::Millard2012>(parameters));

    State state = system.realizeTopology();
    system.realize(state, Stage::Position);
    muscle.equilibrate(state);
    RungeKuttaMersonIntegrator integrator(system);
    TimeStepper stepper(system, integrator);
    stepper.initialize(state);
    stepper.stepTo(1.0);
    system.realize(stepper.getState(), Stage::Velocity);
    std::cout << "elbow " << forearm.getAngle(stepper.getState()) << " rad, muscle "
              << path.getLength(stepper.getState()) << " m, " << muscle.getTension(stepper.getState()) << " N\n";
}
