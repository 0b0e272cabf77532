// SPDX-License-Identifier: Apache-2.0
/** Ten seconds of systems of the kind of Simbody's ExampleCablePath and CableOverBicubicSurfaces: kinetic and potential
energy and what the strings' damping has taken stay together what they were. `simbody_costs` in bench/ tells what the
same systems cost with Simbody's own CablePath. */
#include <cstdio>

#include "adapter_scenes.h"
#include "peer_scenes.h"

namespace tautline::testing {
namespace {

template <class Scene>
class EnergyBook {
public:
    /** @param accuracy   of the integrator */
    EnergyBook(Scene& scene, Real accuracy) : m_scene(scene) {
        for (const auto& path : scene.paths)
            path.cable.setContactListener([this](const ContactEvent&) { ++numEvents; });
        SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
        integrator.setAccuracy(accuracy);
        integrator.setReturnEveryInternalStep(true);
        SimTK::TimeStepper stepper(scene.system, integrator);
        stepper.setReportAllSignificantStates(true);
        stepper.initialize(scene.makeStart());
        scene.system.realize(stepper.getState(), Stage::Dynamics);
        m_initial = scene.calcBookedEnergy(stepper.getState());
        while (integrator.getTime() < kDuration) {
            stepper.stepTo(kDuration);
            addEntry(stepper.getState());
        }
        for (const auto& path : scene.paths) dissipated += path.getDissipatedEnergy(stepper.getState());
        std::printf(
            "[measured] energy error %.1e of the largest kinetic energy (%.3g J; %.3g J dissipated), %d events "
            "in %d steps\n",
            worst / largestKinetic, largestKinetic, dissipated, numEvents, integrator.getNumStepsTaken());
    }

    static constexpr Real kDuration = 10;
    Real worst = 0, largestKinetic = 0, dissipated = 0;  ///< [J]
    int numEvents = 0, numUnsolved = 0;

private:
    void addEntry(const State& state) {
        m_scene.system.realize(state, Stage::Dynamics);
        worst = std::max(worst, std::abs(m_scene.calcBookedEnergy(state) - m_initial));
        largestKinetic = std::max(largestKinetic, m_scene.system.calcKineticEnergy(state));
        for (const auto& path : m_scene.paths) {
            const PathStatus status = path.cable.calcStatus(state);
            numUnsolved += status != PathStatus::Solved && status != PathStatus::EndInside;
        }
    }

    Scene& m_scene;
    Real m_initial = 0;
};

/** Links pass through each other, and an eyelet through a sphere now and then. */
TEST(PeerMotions, TwoCablesInATangledChainKeepTheirBooks) {
    BallChainScene<TautlineCables> scene;
    const EnergyBook book(scene, 1e-8);
    EXPECT_GE(book.numEvents, 10);
    EXPECT_EQ(book.numUnsolved, 0);
    EXPECT_GT(book.dissipated, book.largestKinetic);
    EXPECT_LT(book.worst, 1e-6 * book.largestKinetic);
}

TEST(PeerMotions, ABodyOnAStringOverTwoBicubicMapsKeepsItsBooks) {
    SaddlesScene<TautlineCables> scene;
    const EnergyBook book(scene, 1e-9);
    EXPECT_EQ(book.numUnsolved, 0);
    EXPECT_GT(book.dissipated, 0.1 * book.largestKinetic);
    EXPECT_LT(book.worst, 1e-6 * book.largestKinetic);
}

/** The string lifts off the map and comes down on it again, and slips nowhere. */
TEST(PeerMotions, ABodyOnAStringOverABumpyMapKeepsItsBooks) {
    BumpScene<TautlineCables> scene;
    const EnergyBook book(scene, 1e-8);
    EXPECT_EQ(book.numEvents, 2);
    EXPECT_EQ(book.numUnsolved, 0);
    EXPECT_GT(book.dissipated, 0.1 * book.largestKinetic);
    EXPECT_LT(book.worst, 1e-6 * book.largestKinetic);
}

}  // namespace
}  // namespace tautline::testing
