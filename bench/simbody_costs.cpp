// SPDX-License-Identifier: Apache-2.0
/** What cables cost in Simbody: a swinging chain with many of them, and systems of the kind of Simbody's examples with
its own cables and with ours. README.md says how to read the table. */
#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <sstream>

#include "simbody_adapter/peer_scenes.h"
#include "tautline/simbody/cable.h"
#include "tautline/surfaces/cylinder.h"

namespace {

using namespace tautline;
using SimTK::MobilizedBody;
using SimTK::Real;
using SimTK::State;
using SimTK::Transform;

/** CPU time of this process [s]. */
double getCpuTime() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/** A chain of links that swings in its plane, with cables from link to next link over a cylinder near the joint
between them: radii, offsets and sides differ, so that each cable touches and lifts at angles of its own. The cables
pull at nothing: all studies take the same steps but for those that events end. */
struct SwingingChain {
    static constexpr int kLinks = 20;
    static constexpr Real kLength = 0.1;  ///< of a link [m]

    explicit SwingingChain(int numCables) {
        SimTK::Force::Gravity(forces, matter, -SimTK::YAxis, 9.81);
        const SimTK::Body::Rigid link(
            SimTK::MassProperties(0.1, SimTK::Vec3(0), SimTK::UnitInertia(kLength * kLength / 12)));
        std::vector<MobilizedBody> links{matter.Ground()};
        const SimTK::Vec3 end(0, -kLength / 2, 0);
        for (int i = 0; i < kLinks; ++i)
            links.push_back(
                MobilizedBody::Pin(links.back(), Transform(i == 0 ? SimTK::Vec3(0) : end), link, Transform(-end)));
        for (int c = 0; c < numCables; ++c) addCable(links, c);
    }

    void addCable(const std::vector<MobilizedBody>& links, int c) {
        const int joint = 1 + c % (kLinks - 1), round = c / (kLinks - 1);
        const Real side = round % 2 == 0 ? 1 : -1, radius = 0.008 + 0.0007 * (round % 5);
        const Real beside = side * (0.0065 + 0.0008 * (round % 6));
        const SimTK::Vec3 origin(beside, 0.02, 0), insertion(beside, 0, 0.003);
        Cable cable(cables, links[joint], origin, links[joint + 1], insertion);
        const SimTK::Vec3 center(side * 0.0005 * (round % 7), -kLength / 2, 0);
        cable.addObstacle(links[joint], Transform(center), std::make_shared<Cylinder>(radius));
    }

    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    CablePathSubsystem cables{system};
};

struct StudyCost {
    double cpu = 0;
    long events = 0, realizations = 0, solves = 0;
};

enum class Contacts { None, Events, Tracked, Free };

void chooseContacts(const SwingingChain& chain, Contacts contacts, State& state) {
    const ContactMode mode = contacts == Contacts::Tracked ? ContactMode::Tracked
                             : contacts == Contacts::Free  ? ContactMode::Free
                                                           : ContactMode::Events;
    chain.cables.setContactMode(state, mode);
}

StudyCost simulateChain(int numCables, Contacts contacts, Real duration) {
    SwingingChain chain(contacts == Contacts::None ? 0 : numCables);
    State state = chain.system.realizeTopology();
    state.updQ()[0] = 0.5;
    SimTK::RungeKuttaMersonIntegrator integrator(chain.system);
    integrator.setAccuracy(1e-4);
    chooseContacts(chain, contacts, state);
    SimTK::TimeStepper stepper(chain.system, integrator);
    stepper.initialize(state);
    chain.system.realize(integrator.getState(), SimTK::Stage::Acceleration);
    for (CableIndex c(0); c < chain.cables.getNumCables(); ++c) chain.cables.getCable(c).resetStatistics();
    StudyCost cost;
    const long realizations = chain.system.getNumRealizationsOfThisStage(SimTK::Stage::Position);
    const double begin = getCpuTime();
    stepper.stepTo(duration);
    cost.cpu = getCpuTime() - begin;
    cost.realizations = chain.system.getNumRealizationsOfThisStage(SimTK::Stage::Position) - realizations;
    for (CableIndex c(0); c < chain.cables.getNumCables(); ++c) {
        const CableStatistics statistics = chain.cables.getCable(c).getStatistics();
        cost.events += statistics.numContactEvents;
        cost.solves += statistics.numSolves;
    }
    return cost;
}

void printChain(int numCables, Real duration) {
    std::printf("chain of %d links, %d cables, %g s, RungeKuttaMerson at 1e-4\n", SwingingChain::kLinks, numCables,
                duration);
    std::printf("%-16s %9s %7s %9s %10s %22s\n", "contacts", "CPU [s]", "events", "realized", "solves",
                "us/cable/realization");
    const std::pair<Contacts, const char*> rows[] = {{Contacts::None, "without cables"},
                                                     {Contacts::Events, "events"},
                                                     {Contacts::Tracked, "tracked"},
                                                     {Contacts::Free, "free"}};
    for (const auto& [contacts, name] : rows) {
        const StudyCost cost = simulateChain(numCables, contacts, duration);
        const double each = 1e6 * cost.cpu / (static_cast<double>(cost.realizations) * numCables);
        std::printf("%-16s %9.3f %7ld %9ld %10ld %22.2f\n", name, cost.cpu, cost.events, cost.realizations, cost.solves,
                    each);
    }
}

/** Ten seconds at the accuracy of Simbody's examples. */
template <class Scene>
double measureExample() {
    std::ostringstream printed;  // CablePath reports on itself
    std::streambuf* const out = std::cout.rdbuf(printed.rdbuf());
    Scene scene;
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setAccuracy(1e-3);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.initialize(scene.makeStart());
    const double begin = getCpuTime();
    stepper.stepTo(10);
    const double cpu = getCpuTime() - begin;
    std::cout.rdbuf(out);
    return cpu;
}

void printExample(const char* name, double theirs, double ours) {
    std::printf("%-24s CablePath %.3f s, Tautline %.3f s, %.2f of it\n", name, theirs, ours, ours / theirs);
}

void printExamples() {
    namespace t = tautline::testing;
    printExample("tangled chain:", measureExample<t::BallChainScene<t::SimbodyCables>>(),
                 measureExample<t::BallChainScene<t::TautlineCables>>());
    printExample("two bicubic maps:", measureExample<t::SaddlesScene<t::SimbodyCables>>(),
                 measureExample<t::SaddlesScene<t::TautlineCables>>());
    printExample("bumpy map:", measureExample<t::BumpScene<t::SimbodyCables>>(),
                 measureExample<t::BumpScene<t::TautlineCables>>());
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("What cables cost in Simbody");
    int numCables = 200;
    Real duration = 2;
    app.add_option("--cables", numCables, "in the chain")->check(CLI::Range(1, 10000));
    app.add_option("--duration", duration, "of the chain's study [s]")->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);
    printChain(numCables, duration);
    printExamples();
    return 0;
}
