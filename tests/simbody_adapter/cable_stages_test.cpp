#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

TEST(CableStages, AskedTooEarlyThrowsTheStageError) {
    MechanismScene scene;
    const Cable& cable = scene.cable;
    State state = scene.makeState(0);
    scene.system.realize(state, Stage::Time);
    SimTK::Vector_<SimTK::SpatialVec> F_G;
    EXPECT_MESSAGE(cable.getLength(state), "Cable::getLength()");
    EXPECT_THROW(cable.getLength(state), SimTK::Exception::StageTooLow);
    EXPECT_THROW(cable.isTouched(state, scene.sphere), SimTK::Exception::StageTooLow);
    EXPECT_THROW(cable.getSolution(state), SimTK::Exception::StageTooLow);
    EXPECT_THROW(cable.calcUnitBodyForces(state, F_G), SimTK::Exception::StageTooLow);
    EXPECT_THROW(cable.calcDrawingPoints(state), SimTK::Exception::StageTooLow);
    scene.system.realize(state, Stage::Position);
    EXPECT_NO_THROW(cable.getLength(state));
    EXPECT_MESSAGE(cable.getLengthRate(state), "Cable::getLengthRate()");
    EXPECT_THROW(cable.getLengthRate(state), SimTK::Exception::StageTooLow);
    EXPECT_THROW(cable.calcPower(state, 1), SimTK::Exception::StageTooLow);
    scene.system.realize(state, Stage::Velocity);
    EXPECT_NO_THROW(cable.getLengthRate(state));
    state.updQ()[0] += 0.01;
    scene.system.realize(state, Stage::Time);
    EXPECT_THROW(cable.getLength(state), SimTK::Exception::StageTooLow);
}

TEST(CableStages, OneSolvePerPose) {
    MechanismScene scene;
    State state = scene.makeState(0);
    scene.cable.resetStatistics();
    scene.system.realize(state, Stage::Acceleration);
    scene.cable.getLength(state);
    scene.cable.getLengthRate(state);
    EXPECT_EQ(scene.cable.getStatistics().numSolves, 1);
    state.updU() *= 2;
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(scene.cable.getStatistics().numSolves, 1);
    state.updQ()[0] += 1e-3;
    scene.system.realize(state, Stage::Velocity);
    EXPECT_EQ(scene.cable.getStatistics().numSolves, 2);
    EXPECT_EQ(scene.cable.getStatistics().numColdSolves, 2);
    EXPECT_GT(scene.cable.getStatistics().seconds, 0);
}

TEST(CableStages, ADisabledCableSolvesNothingAndSaysSo) {
    MechanismScene scene;
    State state = scene.makeState(0);
    scene.cable.disable(state);
    scene.cable.resetStatistics();
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(scene.cable.getStatistics().numSolves, 0);
    EXPECT_MESSAGE(scene.cable.getLength(state), "cable 'mechanism' is disabled");
    scene.cable.enable(state);
    scene.system.realize(state, Stage::Position);
    EXPECT_GT(scene.cable.getLength(state), 4);
}

}  // namespace
}  // namespace tautline::testing
