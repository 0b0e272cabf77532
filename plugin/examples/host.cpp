// SPDX-License-Identifier: Apache-2.0
// A Simbody program that was never compiled against Tautline: it loads libtautline_plugin.so and hangs a pendulum
// between two muscles, one of which wraps over a cylinder.
#include <Simbody.h>
#include <dlfcn.h>
#include <tautline/plugin.h>

#include <cstdio>

using namespace SimTK;

static const char* const kDescription = R"(<TautlineForces>
    <Ground>
        <WrapObjectSet><objects>
            <WrapCylinder name="drum">
                <radius>0.04</radius>
                <length>0.2</length>
                <quadrant>+x</quadrant>
            </WrapCylinder>
        </objects></WrapObjectSet>
    </Ground>
    <ForceSet><objects>
        <Millard2012EquilibriumMuscle name="front">
            <GeometryPath>
                <PathPointSet><objects>
                    <PathPoint name="origin">
                        <socket_parent_frame>ground</socket_parent_frame>
                        <location>0.02 0.25 0</location>
                    </PathPoint>
                    <PathPoint name="insertion">
                        <socket_parent_frame>bob</socket_parent_frame>
                        <location>0.02 0.3 0</location>
                    </PathPoint>
                </objects></PathPointSet>
                <PathWrapSet><objects>
                    <PathWrap name="over">
                        <wrap_object>drum</wrap_object>
                    </PathWrap>
                </objects></PathWrapSet>
            </GeometryPath>
            <max_isometric_force>300</max_isometric_force>
            <optimal_fiber_length>0.15</optimal_fiber_length>
            <tendon_slack_length>0.3</tendon_slack_length>
        </Millard2012EquilibriumMuscle>
        <Thelen2003Muscle name="back">
            <GeometryPath>
                <PathPointSet><objects>
                    <PathPoint name="origin">
                        <socket_parent_frame>ground</socket_parent_frame>
                        <location>-0.1 0.25 0</location>
                    </PathPoint>
                    <PathPoint name="insertion">
                        <socket_parent_frame>bob</socket_parent_frame>
                        <location>-0.02 0.3 0</location>
                    </PathPoint>
                </objects></PathPointSet>
            </GeometryPath>
            <max_isometric_force>300</max_isometric_force>
            <optimal_fiber_length>0.15</optimal_fiber_length>
            <tendon_slack_length>0.3</tendon_slack_length>
        </Thelen2003Muscle>
    </objects></ForceSet>
</TautlineForces>)";

static tautline_error error;

static void check(tautline_result result) {
    if (result == TAUTLINE_OK) return;
    std::fprintf(stderr, "%s\n", error.message);
    std::exit(1);
}

static double calcExcitation(const void*, double time, void*) {
    return time < 0.5 ? 0.4 : 0.1;
}

int main(int argc, char** argv) {
    void* module = dlopen(argc > 1 ? argv[1] : "libtautline_plugin.so", RTLD_NOW);
    if (!module) {
        std::fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    const auto open = reinterpret_cast<tautline_plugin_open_function>(dlsym(module, TAUTLINE_PLUGIN_OPEN));
    const tautline_host host = TAUTLINE_HOST;
    const tautline_plugin* tautline = nullptr;
    check(open(&host, &tautline, &error));
    {
        MultibodySystem system;
        SimbodyMatterSubsystem matter(system);
        GeneralForceSubsystem forces(system);
        Force::Gravity gravity(forces, matter, -YAxis, 9.81);
        const Body::Rigid bob(MassProperties(2, Vec3(0), UnitInertia(0.01)));
        MobilizedBody::Pin pendulum(matter.Ground(), Vec3(0), bob, Vec3(0, 0.5, 0));

        const tautline_body names[] = {{"bob", pendulum.getMobilizedBodyIndex()}};
        tautline_attachment* muscles = nullptr;
        check(tautline->attach(&system, kDescription, "host.cpp", names, 1, &muscles, &error));
        check(tautline->set_excitation_function(muscles, "front", calcExcitation, nullptr, &error));

        State state = system.realizeTopology();
        check(tautline->set_excitation(muscles, &state, "back", 0.2, &error));
        check(tautline->equilibrate(muscles, &state, &error));
        RungeKuttaMersonIntegrator integrator(system);
        integrator.setAccuracy(1e-6);
        TimeStepper stepper(system, integrator);
        stepper.initialize(state);
        for (int i = 1; i <= 4; ++i) {
            stepper.stepTo(0.25 * i);
            const State& now = stepper.getState();
            system.realize(now, Stage::Velocity);
            std::printf("t = %.2f s: angle %.17g rad\n", now.getTime(), pendulum.getAngle(now));
            for (size_t m = 0; m < tautline->get_num_forces(muscles); ++m) {
                const char* name = tautline->get_force_name(muscles, m);
                double length, rate, tension, arm;
                check(tautline->get_length(muscles, &now, name, &length, &error));
                check(tautline->get_rate(muscles, &now, name, &rate, &error));
                check(tautline->get_tension(muscles, &now, name, &tension, &error));
                check(
                    tautline->calc_moment_arm(muscles, &now, name, pendulum.getMobilizedBodyIndex(), 0, &arm, &error));
                std::printf("    %s: length %.17g m, rate %.17g m/s, tension %.17g N, moment arm %.17g m\n", name,
                            length, rate, tension, arm);
            }
        }
        tautline->release(muscles);
    }
    dlclose(module);
}
