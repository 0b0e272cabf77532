/** A mass on an elastic string over fixed obstacles keeps its energy through lift-offs and touchdowns. */
#include <cstdio>
#include <map>

#include "adapter_scenes.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

/** The mass swings in the x-y plane to the right of the obstacles, held there by springs, so that the string
from the left bears on their tops while the mass is low and lifts while it is high: it cannot pass to another
side, since the line between its ends stays above their centres, and it is always taut.

The springs are soft on purpose: Simbody comes to an event by cubic interpolation within the step, an error
of order (frequency x step)^4 at each, which at ten times the stiffness is 1.4e-9 of the energy per event and
a hundred times what the integrator loses without events. */
/** An obstacle fixed in ground, its top towards +y. */
struct FixedObstacle {
    std::shared_ptr<const Surface> surface;
    SimTK::Vec3 center;
};

struct SwingingMass : BareScene {
    explicit SwingingMass(const std::vector<FixedObstacle>& obstacles) {
        MobilizedBody::Planar mass(matter.Ground(), Transform(), makeBody(), Transform());
        body = mass;
        const SimTK::MobilizerUIndex x(1), y(2);
        SimTK::Force::MobilityLinearSpring(forces, mass, x, 4, 1.3);
        SimTK::Force::MobilityLinearSpring(forces, mass, y, 3, 0.3);
        cable = Cable(cables, matter.Ground(), SimTK::Vec3(-1, 0.2, 0), mass, SimTK::Vec3(0));
        for (const FixedObstacle& obstacle : obstacles)
            cable.addObstacle(matter.Ground(), Transform(obstacle.center), obstacle.surface, SimTK::Vec3(0, 0.3, 0));
        cable.setContactListener([this](const ContactEvent& event) {
            ++numEvents[event.obstacle];
            ++numEvents[0];
            jump = std::max(jump, std::abs(event.lengthAfter - event.lengthBefore));
        });
        ElasticStringForce(forces, cable, 1.2, 1);
    }

    State makeStart() {
        State state = system.realizeTopology();
        body.setOneQ(state, 1, 1.15);
        body.setOneQ(state, 2, 0.8);
        body.setOneU(state, 1, 0.1);
        return state;
    }

    MobilizedBody body;
    Cable cable;
    std::map<int, int> numEvents;  ///< by element; of all under 0, the origin
    Real jump = 0;
};

void expectEnergyKept(const std::vector<FixedObstacle>& obstacles) {
    SwingingMass scene(obstacles);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-10);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeStart());
    const Real initial = scene.system.calcEnergy(integrator.getState());
    Real largestKinetic = 0, worst = 0, shortest = SimTK::Infinity;
    for (int i = 1; i <= 2000; ++i) {
        stepper.stepTo(0.01 * i);
        const State& state = integrator.getState();
        scene.system.realize(state, Stage::Dynamics);
        largestKinetic = std::max(largestKinetic, scene.system.calcKineticEnergy(state));
        worst = std::max(worst, std::abs(scene.system.calcEnergy(state) - initial));
        shortest = std::min(shortest, scene.cable.getLength(state));
    }
    const CableStatistics statistics = scene.cable.getStatistics();
    std::printf(
        "[measured] energy error %.1e of the largest kinetic energy, %d events, length jump %.1e m, "
        "%ld solves, %.2f iterations and %.2f us each, %ld failed, %d steps\n",
        worst / largestKinetic, scene.numEvents[0], scene.jump, statistics.numSolves,
        double(statistics.numIterations) / double(statistics.numSolves),
        1e6 * statistics.seconds / double(statistics.numSolves), statistics.numFailures, integrator.getNumStepsTaken());
    EXPECT_GT(shortest, 1.2);
    EXPECT_GE(scene.numEvents[0], 8);
    for (std::size_t i = 1; i <= obstacles.size(); ++i)
        EXPECT_GE(scene.numEvents[static_cast<int>(i)], 4) << "obstacle " << i;
    EXPECT_LT(scene.jump, 1e-9);
    EXPECT_EQ(statistics.numFailures, 0);
    EXPECT_LT(worst, 1e-8 * largestKinetic);
}

TEST(Energy, IsKeptOverACylinder) {
    expectEnergyKept({{std::make_shared<Cylinder>(0.3), SimTK::Vec3(0)}});
}
TEST(Energy, IsKeptOverASphere) {
    expectEnergyKept({{std::make_shared<Sphere>(0.3), SimTK::Vec3(0)}});
}
TEST(Energy, IsKeptOverAnEllipsoid) {
    expectEnergyKept({{std::make_shared<Ellipsoid>(Vec3(0.4, 0.3, 0.35)), SimTK::Vec3(0)}});
}
TEST(Energy, IsKeptOverACylinderAndASphere) {
    expectEnergyKept({{std::make_shared<Cylinder>(0.25), SimTK::Vec3(-0.4, 0.0, 0)},
                      {std::make_shared<Sphere>(0.3), SimTK::Vec3(0.25, 0.0, 0)}});
}

}  // namespace
}  // namespace tautline::testing
