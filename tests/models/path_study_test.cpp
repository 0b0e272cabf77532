// SPDX-License-Identifier: Apache-2.0
/** Lengths, rates and moment arms of models in given poses. */
#include <algorithm>
#include <cmath>

#include "model_test_support.h"
#include "support/seeded_random.h"
#include "support/shared_data.h"
#include "tautline/error.h"
#include "tautline/models/coordinate_coupling.h"
#include "tautline/models/crossed_coordinates.h"
#include "tautline/models/model_system.h"
#include "tautline/models/parallel_study.h"
#include "tautline/models/path_study.h"

namespace tautline::models::testing {
namespace {

ModelDescription readElbow() {
    return readOsimFile(TAUTLINE_SOURCE_DIR "/models/elbow.osim");
}

std::string makeSpring(const std::string& name, const std::string& body1, const std::string& at1,
                       const std::string& body2, const std::string& at2) {
    const auto makeEnd = [](const std::string& point, const std::string& body, const std::string& at) {
        return "<PathPoint name=\"" + point + "\"><socket_parent_frame>" + body + "</socket_parent_frame><location>" +
               at + "</location></PathPoint>";
    };
    return "<PathSpring name=\"" + name + "\"><GeometryPath><PathPointSet><objects>" + makeEnd("a", body1, at1) +
           makeEnd("b", body2, at2) +
           "</objects></PathPointSet></GeometryPath><resting_length>1</resting_length><stiffness>1</stiffness>"
           "<dissipation>0</dissipation></PathSpring>";
}

std::string makePin(const std::string& name, const std::string& parent, const std::string& translation,
                    const std::string& child, const std::string& coordinate) {
    return makeJoint("PinJoint", name,
                     makeOffsetFrame("a", parent, translation, "0 0 0") +
                         makeOffsetFrame("b", "/bodyset/" + child, "0 0 0", "0 0 0"),
                     makeCoordinates({coordinate.c_str()}));
}

/** A parallelogram of two cranks (length 1, pivots at x = 0 and x = 1) and a rod on the first one's end, whose other
end a point constraint keeps on the second: u = v, w = -u. A spring from the ground to the end of the second crank. */
ModelDescription readParallelogram() {
    return readNew(makeBodySet(makeBody("left") + makeBody("right") + makeBody("rod")) +
                   makeJointSet(makePin("one", "/ground", "0 0 0", "left", "u") +
                                makePin("two", "/ground", "1 0 0", "right", "v") +
                                makePin("three", "/bodyset/left", "0 1 0", "rod", "w")) +
                   "<ConstraintSet><objects><PointConstraint name=\"p\"><socket_body_1>/bodyset/rod</socket_body_1>"
                   "<socket_body_2>/bodyset/right</socket_body_2><location_body_1>1 0 0</location_body_1>"
                   "<location_body_2>0 1 0</location_body_2></PointConstraint></objects></ConstraintSet>"
                   "<ForceSet><objects>" +
                   makeSpring("s", "/ground", "3 0 0", "/bodyset/right", "0 1 0") + "</objects></ForceSet>");
}

TEST(PathStudy, GivesLengthRateAndArmsInClosedForm) {
    // From (2, 0) to a point that turns with q on the unit circle.
    PathStudy study(
        readNew(makePinModel("<ForceSet><objects>" + makeSpring("s", "/ground", "2 0 0", "/bodyset/one", "1 0 0") +
                             "</objects></ForceSet>")));
    for (const double q : {0.3, 1.2, -2.0}) {
        ModelPose pose;
        pose.values["q"] = q, pose.speeds["q"] = 0.7;
        const PathAnswer path = study.solve(pose).paths.at(0);
        const double length = std::sqrt(5 - 4 * std::cos(q)), slope = 2 * std::sin(q) / length;
        EXPECT_NEAR(path.length, length, 1e-14);
        EXPECT_NEAR(path.rate, 0.7 * slope, 1e-14);
        EXPECT_NEAR(path.effectiveArms.at(0), -slope, 1e-14);
        EXPECT_NEAR(path.geometricArms.at(0), -slope, 1e-14);
        EXPECT_EQ(path.status, PathStatus::Solved);
        EXPECT_TRUE(path.explanation.empty());
    }
}

TEST(PathStudy, AnswersDependOnThePoseAlone) {
    const ModelDescription elbow = readElbow();
    std::vector<ModelPose> poses;
    tautline::testing::SeededRandom random(20261127);
    for (int i = 0; i < 40; ++i) {
        ModelPose pose;
        pose.values["shoulder_flexion"] = random.uniform(-1, 2);
        pose.values["elbow_flexion"] = random.uniform(-1, 2.2);
        poses.push_back(pose);
    }
    PathStudy forward(elbow), backward(elbow);
    std::vector<PoseAnswer> answers;
    for (const ModelPose& pose : poses) answers.push_back(forward.solve(pose));
    for (std::size_t i = poses.size(); i-- > 0;) {
        const PoseAnswer again = backward.solve(poses[i]);
        PathStudy fresh(elbow);
        const PoseAnswer cold = fresh.solve(poses[i]);
        for (std::size_t p = 0; p < again.paths.size(); ++p) {
            EXPECT_EQ(again.paths[p].status, answers[i].paths[p].status);
            EXPECT_NEAR(again.paths[p].length, answers[i].paths[p].length, 1e-13);
            EXPECT_NEAR(cold.paths[p].length, answers[i].paths[p].length, 1e-13);
            for (std::size_t c = 0; c < cold.paths[p].effectiveArms.size(); ++c)
                EXPECT_NEAR(cold.paths[p].effectiveArms[c], answers[i].paths[p].effectiveArms[c], 1e-10);
        }
    }
}

/** The models of the reference data, with coordinates to walk along. */
struct WalkedModel {
    const char* name;
    std::vector<const char*> coordinates;
};

const std::vector<const char*> kLegs = {"hip_flexion_r", "hip_adduction_r", "knee_angle_r",
                                        "ankle_angle_r", "hip_flexion_l",   "lumbar_bending"};
const std::vector<const char*> kArm = {"r_shoulder_elev", "r_elbow_flex"};
const WalkedModel kWalkedModels[] = {
    {"arm26", kArm},
    {"arm26_v20303", kArm},
    {"gait2392_thelen2003muscle", kLegs},
    {"walk_gait1018_subject01", kLegs},
    {"Rajagopal2016", kLegs},
    {"RajagopalLaiUhlrich2023", kLegs},
    {"subject_walk_scaled", kLegs},
    {"ThoracoscapularShoulderModel", {"shoulder_elv", "plane_elv", "scapula_abduction", "clav_prot"}},
    {"Scholz2015GeometryPathExample", {}},  // has no coordinates
};

class DataWalkedModels : public ::testing::TestWithParam<WalkedModel> {};

/** A walk through poses is as many cold solves, also where paths wrap over many objects. (2026-11-27: of paths that
were continued freely, ContactMode::Free, one came to be 13 mm longer.) */
TEST_P(DataWalkedModels, AnswersAreThoseOfColdSolves) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription model =
        readOsimFile(shared / "data" / "opensim" / "models" / (std::string(GetParam().name) + ".osim"), {{}, true});
    std::vector<std::string> coordinates;
    for (const char* name : GetParam().coordinates)
        if (findCoordinate(model, name)) coordinates.push_back(name);
    ASSERT_EQ(coordinates.empty(), GetParam().coordinates.empty());
    PathStudy walked(model), alone(model);
    constexpr int kNumFrames = 2 * kPosesPerBlock, kColdEvery = 7;
    for (int frame = 0; frame < kNumFrames; ++frame) {
        ModelPose pose;
        for (std::size_t k = 0; k < coordinates.size(); ++k)
            pose.values[coordinates[k]] = 0.5 + 0.5 * std::sin(0.05 * frame + 1.3 * static_cast<double>(k));
        const PoseAnswer warm = walked.solve(pose, frame);
        if (frame % kColdEvery != 0) continue;
        const PoseAnswer cold = alone.solve(pose);
        for (std::size_t p = 0; p < cold.paths.size(); ++p) {
            EXPECT_EQ(warm.paths[p].status, cold.paths[p].status) << cold.paths[p].explanation;
            EXPECT_NEAR(warm.paths[p].length, cold.paths[p].length, 1e-12) << walked.getPaths()[p].name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, DataWalkedModels, ::testing::ValuesIn(kWalkedModels),
                         [](const auto& tested) { return std::string(tested.param.name); });

/** Whoever solves a block, and whatever he solved before: to the last digit. */
TEST(PathStudy, AnswersDependOnTheirBlockAlone) {
    constexpr int kBlock = kPosesPerBlock;
    const ModelDescription elbow = readElbow();
    const auto makePose = [](int i) {
        ModelPose pose;
        pose.values["elbow_flexion"] = 1 + std::sin(0.03 * i);
        pose.values["shoulder_flexion"] = 0.5 * std::cos(0.02 * i);
        return pose;
    };
    PathStudy all(elbow), some(elbow);
    std::vector<PoseAnswer> answers;
    for (int i = 0; i < 3 * kBlock; ++i) answers.push_back(all.solve(makePose(i), i));
    for (const int block : {2, 0, 1})
        for (int i = block * kBlock; i < (block + 1) * kBlock; ++i) {
            const PoseAnswer answer = some.solve(makePose(i), i);
            for (std::size_t p = 0; p < answer.paths.size(); ++p) {
                EXPECT_EQ(answer.paths[p].length, answers[static_cast<std::size_t>(i)].paths[p].length);
                EXPECT_EQ(answer.paths[p].effectiveArms, answers[static_cast<std::size_t>(i)].paths[p].effectiveArms);
            }
        }
}

/** Lengths and moment arms of a study of the whole row, to the last digit. */
TEST(ParallelStudy, AnswersAreThoseOfOneStudyForAllNumbersOfThreads) {
    const ModelDescription elbow = readElbow();
    constexpr int kCount = 4 * kPosesPerBlock + 5;
    const auto makePose = [](int i) {
        ModelPose pose;
        pose.values["elbow_flexion"] = 1 + std::sin(0.03 * i);
        pose.values["shoulder_flexion"] = 0.5 * std::cos(0.02 * i);
        return pose;
    };
    PathStudy one(elbow);
    std::vector<PoseAnswer> expected;
    for (int i = 0; i < kCount; ++i) expected.push_back(one.solve(makePose(i), i));
    ParallelStudy study(elbow);
    for (const int numThreads : {1, 2, 3, 7}) {
        std::vector<PoseAnswer> answers;
        ASSERT_TRUE(study.solveMany(kCount, makePose, answers, {numThreads, {}}));
        ASSERT_EQ(answers.size(), expected.size());
        for (std::size_t i = 0; i < answers.size(); ++i)
            for (std::size_t p = 0; p < answers[i].paths.size(); ++p) {
                EXPECT_EQ(answers[i].paths[p].length, expected[i].paths[p].length) << i;
                EXPECT_EQ(answers[i].paths[p].effectiveArms, expected[i].paths[p].effectiveArms) << i;
            }
    }
}

// Symptom until 2026-11-28: studies for further threads moved the first one away.
TEST(ParallelStudy, TheStudyForNamesStaysWhereItIs) {
    ParallelStudy study(readElbow());
    const PathStudy& names = study.getStudy();
    std::vector<PoseAnswer> answers;
    study.solveMany(5 * kPosesPerBlock, [](int) { return ModelPose(); }, answers, {5, {}});
    EXPECT_EQ(&study.getStudy(), &names);
    EXPECT_EQ(names.getPaths().size(), answers.front().paths.size());
}

TEST(ParallelStudy, RefusesThePoseThatComesFirst) {
    ParallelStudy study(readElbow());
    const auto makePose = [](int i) {
        ModelPose pose;
        if (i >= 70) pose.values["elbow_flexion"] = std::numeric_limits<double>::infinity();
        if (i == 69) pose.values["no_such"] = 0;
        return pose;
    };
    std::vector<PoseAnswer> answers;
    for (const int numThreads : {1, 2, 7}) {
        try {
            study.solveMany(500, makePose, answers, {numThreads, {}});
            ADD_FAILURE() << "no error";
        } catch (const ModelError& error) {
            EXPECT_NE(std::string(error.what()).find("no_such"), std::string::npos) << error.what();
        }
    }
    EXPECT_TRUE(study.solveMany(0, makePose, answers));
    EXPECT_TRUE(answers.empty());
}

TEST(PathStudy, RefusesAPoseWhoseBlockWasNotSolvedUpToIt) {
    PathStudy study(readElbow());
    study.solve({}, 0);
    study.solve({}, 1);
    try {
        study.solve({}, 3);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(),
                     "path study: the pose at place 3 comes after that at 1, but poses of a block must be solved one "
                     "after another");
    }
    EXPECT_THROW(study.solve({}, -1), InvalidInput);
}

TEST(PathStudy, RatesAreSlopesOfLengthsAlongAMotion) {
    PathStudy study(readElbow());
    const double h = 1e-5;
    const auto poseAt = [](double t) {
        ModelPose pose;
        pose.values = {{"shoulder_flexion", 0.4 * std::sin(t)}, {"elbow_flexion", 0.9 + 0.5 * std::cos(2 * t)}};
        pose.speeds = {{"shoulder_flexion", 0.4 * std::cos(t)}, {"elbow_flexion", -std::sin(2 * t)}};
        return pose;
    };
    for (const double t : {0.1, 0.7, 1.9}) {
        const PoseAnswer now = study.solve(poseAt(t)), before = study.solve(poseAt(t - h)),
                         after = study.solve(poseAt(t + h));
        for (std::size_t p = 0; p < now.paths.size(); ++p)
            EXPECT_NEAR(now.paths[p].rate, (after.paths[p].length - before.paths[p].length) / (2 * h), 1e-8)
                << study.getPaths()[p].name;
    }
}

TEST(PathStudy, ALoopOfBodiesIsClosedAndFollowedByEffectiveArms) {
    PathStudy study(readParallelogram());
    ASSERT_EQ(study.getPaths().at(0).coordinates, (std::vector<std::string>{"u", "v", "w"}));
    for (const double angle : {0.2, -0.4, 0.9}) {
        ModelPose pose;  // the loop is open by a little: it is closed by the least change
        pose.values = {{"u", angle + 1e-3}, {"v", angle - 1e-3}, {"w", -angle}};
        const PoseAnswer answer = study.solve(pose);
        EXPECT_EQ(answer.constraintFault, "");
        const double u = answer.values[0];
        EXPECT_NEAR(answer.values[1], u, 1e-9);
        EXPECT_NEAR(answer.values[2], -u, 1e-9);
        EXPECT_NEAR(u, angle, 2e-3);
        // The end of the right crank stands at (1 - sin u, cos u).
        const double length = std::hypot(2 + std::sin(u), std::cos(u)), slope = 2 * std::cos(u) / length;
        EXPECT_NEAR(answer.paths[0].length, length, 1e-9);
        const std::vector<double>&effective = answer.paths[0].effectiveArms, &geometric = answer.paths[0].geometricArms;
        EXPECT_NEAR(effective.at(0), -slope, 1e-8);
        EXPECT_NEAR(effective.at(1), -slope, 1e-8);
        EXPECT_NEAR(effective.at(2), slope, 1e-8);
        EXPECT_EQ(geometric.at(0), 0.0) << "the spring does not end on this crank";
        EXPECT_NEAR(geometric.at(1), -slope, 1e-8);
        EXPECT_EQ(geometric.at(2), 0.0);
    }
}

TEST(PathStudy, ALoopThatCannotBeClosedIsAFaultOfThePoseAndStillAnswered) {
    ModelDescription open = readParallelogram();
    std::get<PointConstraint>(open.constraints.at(0)).location1 = Vector3(9, 0, 0);
    PathStudy study(open);
    const PoseAnswer answer = study.solve({});
    EXPECT_NE(answer.constraintFault.find("cannot be met"), std::string::npos) << answer.constraintFault;
    EXPECT_TRUE(std::isfinite(answer.paths.at(0).length));
}

/** As a lock is: the coupler makes v constant. */
TEST(PathStudy, ACoordinateThatIsHeldAloneIsLetGoForItsOwnArm) {
    const std::string coupler =
        "<ConstraintSet><objects><CoordinateCouplerConstraint "
        "name=\"c\"><coupled_coordinates_function><Constant><value>"
        "0.1</value></Constant></coupled_coordinates_function><independent_coordinate_names>u"
        "</independent_coordinate_names><dependent_coordinate_name>v</dependent_coordinate_name>"
        "</CoordinateCouplerConstraint></objects></ConstraintSet>";
    const ModelDescription model =
        readNew(makeBodySet(makeBody("left") + makeBody("right")) +
                makeJointSet(makePin("one", "/ground", "0 0 0", "left", "u") +
                             makePin("two", "/bodyset/left", "0 1 0", "right", "v")) +
                coupler + "<ForceSet><objects>" + makeSpring("s", "/ground", "3 0 0", "/bodyset/right", "0 1 0") +
                "</objects></ForceSet>");
    PathStudy study(model);
    const PoseAnswer answer = study.solve({});
    EXPECT_NEAR(answer.values[1], 0.1, 1e-15);
    EXPECT_NE(answer.paths[0].geometricArms.at(1), 0.0);
    EXPECT_EQ(answer.paths[0].effectiveArms, answer.paths[0].geometricArms);
}

TEST(PathStudy, OnlyWantedPathsAreSolved) {
    PathStudy study(readElbow(), [](const std::string& name) { return name.rfind("biceps", 0) == 0; });
    ASSERT_EQ(study.getPaths().size(), 2u);
    EXPECT_EQ(study.getPaths()[0].name, "biceps_long");
    PathStudy all(readElbow());
    EXPECT_EQ(study.solve({}).paths.at(0).length, all.solve({}).paths.at(3).length);
}

TEST(PathStudy, RefusesUnknownCoordinatesAndValuesThatAreNotFinite) {
    PathStudy study(readElbow());
    ModelPose pose;
    pose.values["wrist"] = 1;
    EXPECT_THROW(study.solve(pose), ModelError);
    pose.values = {{"elbow_flexion", std::nan("")}};
    try {
        study.solve(pose);
        FAIL();
    } catch (const ModelError& error) {
        EXPECT_STREQ(error.what(), "the value of coordinate 'elbow_flexion' is nan, but must be finite");
    }
}

/** A coordinate that is not counted as crossed has no arm, and so misses nothing. */
TEST(CrossedCoordinates, AreThoseThatChangeALength) {
    const ModelDescription elbow = readElbow();
    ModelSystem model(elbow);
    SimTK::State state = model.makeDefaultState();
    model.getSystem().realize(state, SimTK::Stage::Position);
    const std::vector<std::string>& names = model.getModel().getCoordinateNames();
    for (const ModelSystem::MuscleSlot& slot : model.getMuscles()) {
        const std::vector<std::string> crossed = findCrossedCoordinates(elbow, findMuscle(elbow, slot.name)->path);
        const std::vector<double> arms = model.calcMomentArms(state, slot.cable);
        for (std::size_t i = 0; i < names.size(); ++i)
            EXPECT_EQ(std::count(crossed.begin(), crossed.end(), names[i]) > 0, std::abs(arms[i]) > 1e-12) << slot.name;
    }
}

}  // namespace
}  // namespace tautline::models::testing
