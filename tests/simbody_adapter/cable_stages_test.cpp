// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "adapter_scenes.h"
#include "tautline/muscles/thelen_2003.h"
#include "tautline/simbody/cable_constraint.h"
#include "tautline/simbody/cable_forces.h"
#include "tautline/simbody/muscle.h"

namespace tautline::testing {
namespace {

using Query = std::function<void(const State&)>;

std::shared_ptr<const MuscleModel> makeMuscleModel() {
    return std::make_shared<Thelen2003>(Thelen2003Parameters());
}

/** Every query of a cable, with the name that its stage error must give. */
std::map<std::string, Query> makePositionQueries(const MechanismScene& scene) {
    const Cable cable = scene.cable;
    const CableElementIndex sphere = scene.sphere, point = scene.point;
    return {{"Cable::getLength()", [=](const State& s) { cable.getLength(s); }},
            {"Cable::getStatus()", [=](const State& s) { cable.getStatus(s); }},
            {"Cable::calcStatus()", [=](const State& s) { cable.calcStatus(s); }},
            {"Cable::getPathError()", [=](const State& s) { cable.getPathError(s); }},
            {"Cable::getSolution()", [=](const State& s) { cable.getSolution(s); }},
            {"Cable::calcVerification()", [=](const State& s) { cable.calcVerification(s); }},
            {"Cable::isActive()", [=](const State& s) { cable.isActive(s, point); }},
            {"Cable::calcStation()", [=](const State& s) { cable.calcStation(s, point); }},
            {"Cable::isTouched()", [=](const State& s) { cable.isTouched(s, sphere); }},
            {"Cable::getArcLength()", [=](const State& s) { cable.getArcLength(s, sphere); }},
            {"Cable::getContactPoints()",
             [=](const State& s) {
                 SimTK::Vec3 P, Q;
                 cable.getContactPoints(s, sphere, P, Q);
             }},
            {"Cable::getContactFrames()",
             [=](const State& s) {
                 Transform X_GP, X_GQ;
                 cable.getContactFrames(s, sphere, X_GP, X_GQ);
             }},
            {"Cable::getClearance()", [=](const State& s) { cable.getClearance(s, sphere); }},
            {"Cable::getWitness()", [=](const State& s) { cable.getWitness(s, sphere); }},
            {"Cable::calcDrawingPoints()", [=](const State& s) { cable.calcDrawingPoints(s); }},
            {"Cable::applyBodyForces()",
             [=](const State& s) {
                 SimTK::Vector_<SimTK::SpatialVec> F(5, SimTK::SpatialVec(SimTK::Vec3(0)));
                 cable.applyBodyForces(s, 1, F);
             }},
            {"Cable::applyMobilityForces()",
             [=](const State& s) {
                 SimTK::Vector f(s.getNU(), Real(0));
                 cable.applyMobilityForces(s, 1, f);
             }},
            {"Cable::calcUnitBodyForces()",
             [=](const State& s) {
                 SimTK::Vector_<SimTK::SpatialVec> F;
                 cable.calcUnitBodyForces(s, F);
             }},
            {"Cable::getContactTangents()",
             [=](const State& s) {
                 SimTK::UnitVec3 t_P, t_Q;
                 cable.getContactTangents(s, sphere, t_P, t_Q);
             }},
            {"Cable::calcOriginTangent()", [=](const State& s) { cable.calcOriginTangent(s); }},
            {"Cable::calcInsertionTangent()", [=](const State& s) { cable.calcInsertionTangent(s); }},
            {"Cable::calcResampledPoints()", [=](const State& s) { cable.calcResampledPoints(s, 5); }},
            {"Cable::calcResampledArc()", [=](const State& s) { cable.calcResampledArc(s, sphere, 5); }},
            {"Cable::calcResampledArcFrames()", [=](const State& s) { cable.calcResampledArcFrames(s, sphere, 5); }},
            {"Cable::calcUnitForceAboutBodyOrigin()",
             [=](const State& s) { cable.calcUnitForceAboutBodyOrigin(s, point); }},
            {"Cable::calcUnitForceAboutElementOrigin()",
             [=](const State& s) { cable.calcUnitForceAboutElementOrigin(s, point); }},
            {"Cable::calcUnitBodyForces()#mobility",
             [=](const State& s) {
                 SimTK::Vector f;
                 cable.calcUnitMobilityForces(s, f);
             }},
            {"Cable::fixContacts()", [=](const State& s) {
                 State copy = s;
                 copy.invalidateAllCacheAtOrAbove(Stage::Position);
                 cable.fixContacts(copy);
             }}};
}

TEST(CableStages, AskedTooEarlyThrowsTheStageError) {
    MechanismScene scene;
    State state = scene.makeState(0);
    scene.system.realize(state, Stage::Time);
    for (const auto& [name, query] : makePositionQueries(scene)) {
        SCOPED_TRACE(name);
        EXPECT_THROW(query(state), SimTK::Exception::StageTooLow);
        EXPECT_MESSAGE(query(state), name.substr(0, name.find('#')));
    }
    const std::map<std::string, Query> velocityQueries = {
        {"Cable::getLengthRate()", [&](const State& s) { scene.cable.getLengthRate(s); }},
        {"Cable::getLengthAccelerationBias()", [&](const State& s) { scene.cable.getLengthAccelerationBias(s); }},
        {"Cable::calcPower()", [&](const State& s) { scene.cable.calcPower(s, 1); }}};
    scene.system.realize(state, Stage::Position);
    for (const auto& [name, query] : makePositionQueries(scene))
        if (name != "Cable::fixContacts()") {
            EXPECT_NO_THROW(query(state)) << name;
        }
    for (const auto& [name, query] : velocityQueries) {
        EXPECT_THROW(query(state), SimTK::Exception::StageTooLow) << name;
        EXPECT_MESSAGE(query(state), name);
    }
    scene.system.realize(state, Stage::Velocity);
    for (const auto& [name, query] : velocityQueries) EXPECT_NO_THROW(query(state)) << name;
    state.updQ()[0] += 0.01;
    scene.system.realize(state, Stage::Time);
    EXPECT_THROW(scene.cable.getLength(state), SimTK::Exception::StageTooLow);
}

// 2026-11-25: ten of these calls ended in a segmentation fault.
TEST(CableStages, BeforeTopologyEveryCallThrowsTheStageError) {
    MechanismScene scene;
    const CableElementIndex sphere = scene.sphere;
    const Cable cable = scene.cable;
    const ElasticStringForce string(scene.forces, cable, 1, 1, 0);
    const PrescribedTensionForce tension(scene.forces, cable, 1);
    const Muscle muscle(scene.forces, cable, makeMuscleModel());
    const CableConstraint constraint(scene.matter, cable, 4);
    PathSolution path;
    path.contacts.resize(cable.getNumElements());
    const std::map<std::string, std::function<void(State&)>> calls = {
        {"isDisabled", [&](State& s) { cable.isDisabled(s); }},
        {"disable", [&](State& s) { cable.disable(s); }},
        {"enable", [&](State& s) { cable.enable(s); }},
        {"areContactsFixed", [&](State& s) { cable.areContactsFixed(s); }},
        {"fixContacts", [&](State& s) { cable.fixContacts(s); }},
        {"releaseContacts", [&](State& s) { cable.releaseContacts(s); }},
        {"continueFrom", [&](State& s) { cable.continueFrom(s, path); }},
        {"getLength", [&](State& s) { cable.getLength(s); }},
        {"getLengthRate", [&](State& s) { cable.getLengthRate(s); }},
        {"getWitness", [&](State& s) { cable.getWitness(s, sphere); }},
        {"string.getTension", [&](State& s) { string.getTension(s); }},
        {"string.getStretch", [&](State& s) { string.getStretch(s); }},
        {"string.getPowerDissipation", [&](State& s) { string.getPowerDissipation(s); }},
        {"setTension", [&](State& s) { tension.setTension(s, 2); }},
        {"setExcitation", [&](State& s) { muscle.setExcitation(s, 0.2); }},
        {"getExcitation", [&](State& s) { muscle.getExcitation(s); }},
        {"setActivation", [&](State& s) { muscle.setActivation(s, 0.2); }},
        {"getActivation", [&](State& s) { muscle.getActivation(s); }},
        {"setFiberLength", [&](State& s) { muscle.setFiberLength(s, 0.1); }},
        {"equilibrate", [&](State& s) { muscle.equilibrate(s); }},
        {"getFiberLength", [&](State& s) { muscle.getFiberLength(s); }},
        {"calcDynamics", [&](State& s) { muscle.calcDynamics(s); }},
        {"constraint.getTension", [&](State& s) { constraint.getTension(s); }}};
    const auto expectStageErrors = [&] {
        for (const auto& [name, call] : calls) {
            State state;
            EXPECT_THROW(call(state), SimTK::Exception::StageTooLow) << name;
        }
    };
    expectStageErrors();
    scene.system.realizeTopology();
    expectStageErrors();  // a State that is none of the System's
}

/** Whether a query throws the stage error, and by a check of ours: Simbody's own are gone where it was built for
Release, and the name of the method in the message tells whose check it was. */
::testing::AssertionResult isRefusedByTautline(const Query& query, const State& state) {
    try {
        query(state);
    } catch (const SimTK::Exception::StageTooLow& error) {
        const std::string message = error.what();
        for (const char* method : {"Cable::", "CableForce::", "CableConstraint::", "Muscle::"})
            if (message.find(method) != std::string::npos) return ::testing::AssertionSuccess();
        return ::testing::AssertionFailure() << "refused by another's check: " << message;
    }
    return ::testing::AssertionFailure() << "answered too early";
}

TEST(CableStages, ForcesAskedTooEarlyThrowTheStageErrorToo) {
    MechanismScene scene;
    const ElasticStringForce string(scene.forces, scene.cable, 1, 1, 0);
    const CableSpringForce spring(scene.forces, scene.cable, 1, 1, 1);
    const PrescribedTensionForce tension(scene.forces, scene.cable, 1);
    const Muscle muscle(scene.forces, scene.cable, makeMuscleModel());
    const CableConstraint constraint(scene.matter, scene.cable, 4);
    scene.system.realizeTopology();
    State state = scene.makeState(0);
    const auto expectStage = [&](Stage stage, const std::vector<Query>& queries) {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            scene.system.realize(state, stage.prev());
            EXPECT_TRUE(isRefusedByTautline(queries[i], state)) << stage.getName() << " query " << i;
            scene.system.realize(state, stage);
            EXPECT_NO_THROW(queries[i](state)) << stage.getName() << " query " << i;
            state.invalidateAllCacheAtOrAbove(stage);
        }
    };
    expectStage(Stage::Position,
                {[&](const State& s) { string.getStretch(s); }, [&](const State& s) { muscle.getFiberLength(s); },
                 [&](const State& s) { muscle.getPennation(s); }, [&](const State& s) { muscle.getTendonLength(s); },
                 [&](const State& s) { muscle.calcEnergy(s); }});
    expectStage(
        Stage::Velocity,
        {[&](const State& s) { string.getTension(s); }, [&](const State& s) { spring.getTension(s); },
         [&](const State& s) { tension.getTension(s); }, [&](const State& s) { muscle.getTension(s); },
         [&](const State& s) { string.calcPower(s); }, [&](const State& s) { string.getPowerDissipation(s); },
         [&](const State& s) { muscle.getFiberVelocity(s); }, [&](const State& s) { muscle.getActiveFiberForce(s); },
         [&](const State& s) { muscle.getPassiveFiberForce(s); }, [&](const State& s) { muscle.getTendonForce(s); },
         [&](const State& s) { muscle.getTendonPower(s); }, [&](const State& s) { muscle.getMusclePower(s); }});
    expectStage(Stage::Acceleration, {[&](const State& s) { constraint.getTension(s); }});
}

/** Two at Position for each cable with obstacles, one more for each that is not convex; none at any other stage. */
TEST(CableStages, ACableHasItsWitnessesAtPosition) {
    MechanismScene scene;
    scene.cable.addObstacle(scene.matter.Ground(), SimTK::Vec3(0, 5, 0), std::make_shared<Torus>(0.3, 0.1));
    scene.system.realizeTopology();
    const State state = scene.makeState(0);
    scene.system.realize(state, Stage::Acceleration);
    for (Stage stage = Stage::Time; stage <= Stage::Acceleration; stage = stage.next())
        EXPECT_EQ(state.getNEventTriggersByStage(stage), stage == Stage::Position ? 2 : 0) << stage.getName();
}

TEST(CableStages, SettersInvalidateTheirStage) {
    MechanismScene scene;
    PrescribedTensionForce tension(scene.forces, scene.cable, 1);
    Muscle muscle(scene.forces, scene.cable, makeMuscleModel());
    scene.system.realizeTopology();
    State state = scene.makeState(0);
    const auto realizeAndSet = [&](const std::function<void(State&)>& set) {
        scene.system.realize(state, Stage::Acceleration);
        set(state);
        return state.getSystemStage();
    };
    EXPECT_EQ(realizeAndSet([&](State& s) { scene.cable.fixContacts(s); }), Stage::Time);
    EXPECT_EQ(realizeAndSet([&](State& s) { scene.cable.releaseContacts(s); }), Stage::Time);
    EXPECT_EQ(realizeAndSet([&](State& s) { scene.cable.disable(s); }), Stage::Time);
    EXPECT_EQ(realizeAndSet([&](State& s) { scene.cable.enable(s); }), Stage::Time);
    EXPECT_EQ(realizeAndSet([&](State& s) { scene.cable.continueFrom(s, scene.cable.getSolution(s)); }), Stage::Time);
    EXPECT_EQ(realizeAndSet([&](State& s) { tension.setTension(s, 2); }), Stage::Velocity);
    EXPECT_EQ(realizeAndSet([&](State& s) { muscle.setExcitation(s, 0.2); }), Stage::Velocity);
    EXPECT_EQ(realizeAndSet([&](State& s) { muscle.setActivation(s, 0.2); }), Stage::Velocity);
    EXPECT_EQ(realizeAndSet([&](State& s) { muscle.setFiberLength(s, 0.1); }), Stage::Velocity);
    EXPECT_EQ(realizeAndSet([&](State& s) { muscle.equilibrate(s); }), Stage::Velocity);
}

TEST(CableStages, BuildingInvalidatesTheTopology) {
    MechanismScene scene;
    const auto build = [&](const std::function<void()>& change) {
        scene.system.realizeTopology();
        change();
        return !scene.system.systemTopologyHasBeenRealized();
    };
    MobilizedBody ground = scene.matter.Ground();
    EXPECT_TRUE(build([&] { scene.cable.addViaPoint(ground, SimTK::Vec3(1)); }));
    EXPECT_TRUE(build([&] { scene.cable.addObstacle(ground, SimTK::Vec3(5), std::make_shared<Sphere>(0.1)); }));
    EXPECT_TRUE(build([&] { scene.cable.setHint(scene.sphere, PassOnSide{Vector3(0, 1, 0)}); }));
    EXPECT_TRUE(build([&] { scene.cable.setOptions(PathSolverOptions()); }));
    EXPECT_TRUE(build([&] { scene.cable.setDisabledByDefault(true); }));
    EXPECT_TRUE(build([&] { Cable(scene.cables, ground, SimTK::Vec3(0), ground, SimTK::Vec3(1)); }));
    EXPECT_FALSE(build([&] { scene.cable.setContactListener(nullptr); }));
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

/** A string whose end a slider carries through a sphere and out again: x from -1.5 to 1.5, radius 0.5. */
TEST(CableStages, AcceptedStepsThatAreNoSolutionAreCounted) {
    BareScene scene;
    MobilizedBody::Slider slider(scene.matter.Ground(), Transform(), makeBody(), Transform());
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(0, 3, 0), slider, SimTK::Vec3(0, 0.1, 0));
    cable.addObstacle(scene.matter.Ground(), Transform(), std::make_shared<Sphere>(0.5));
    Cable clear(scene.cables, scene.matter.Ground(), SimTK::Vec3(0, 3, 0), slider, SimTK::Vec3(0, 1, 0));
    State state = scene.system.realizeTopology();
    slider.setOneQ(state, 0, -1.5);
    slider.setOneU(state, 0, 1);
    SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
    integrator.setMaximumStepSize(0.01);
    integrator.setReturnEveryInternalStep(true);
    SimTK::TimeStepper stepper(scene.system, integrator);
    stepper.setReportAllSignificantStates(true);
    stepper.initialize(state);
    Real largestError = 0;
    while (integrator.getTime() < 3) {
        stepper.stepTo(3);
        scene.cables.countStep(integrator.getState());
        largestError = std::max(largestError, cable.getPathError(integrator.getState()));
    }
    const CableStatistics statistics = cable.getStatistics();
    EXPECT_GE(statistics.numSteps, 300);
    // Inside for a chord of the sphere at 0.1 above its center.
    const Real share = 2 * std::sqrt(0.24) / 3;
    EXPECT_NEAR(Real(statistics.numDegradedSteps) / Real(statistics.numSteps), share, 0.02);
    EXPECT_EQ(clear.getStatistics().numSteps, statistics.numSteps);
    EXPECT_EQ(clear.getStatistics().numDegradedSteps, 0);
    EXPECT_EQ(statistics.largestPathError, largestError);
    EXPECT_LE(clear.getStatistics().largestPathError, clear.getOptions().pathErrorTolerance);
    clear.resetStatistics();
    EXPECT_EQ(clear.getStatistics().numSteps, 0);
    EXPECT_EQ(clear.getStatistics().largestPathError, 0);
}

TEST(CableStages, StatusIsJudgedInFullWithContactsFixed) {
    BareScene scene;
    MobilizedBody::Slider slider(scene.matter.Ground(), Transform(), makeBody(), Transform());
    Cable cable(scene.cables, scene.matter.Ground(), SimTK::Vec3(0, 3, 0), slider, SimTK::Vec3(0, 0.1, 0));
    cable.addObstacle(scene.matter.Ground(), Transform(), std::make_shared<Sphere>(0.5));
    State state = scene.system.realizeTopology();
    slider.setOneQ(state, 0, -1.5);
    scene.system.realize(state, Stage::Position);
    cable.fixContacts(state);
    const auto calcStatusAt = [&](Real x) {
        slider.setOneQ(state, 0, x);
        scene.system.realize(state, Stage::Position);
        EXPECT_EQ(cable.getStatus(state), PathStatus::Solved);
        return cable.calcStatus(state);
    };
    EXPECT_EQ(calcStatusAt(-1), PathStatus::Solved);
    EXPECT_EQ(calcStatusAt(-0.3), PathStatus::EndInside);
}

}  // namespace
}  // namespace tautline::testing
