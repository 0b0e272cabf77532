// SPDX-License-Identifier: Apache-2.0
/** The walking models of the reference data: splines, conditional and moving points, couplers. */
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "model_test_support.h"
#include "support/shared_data.h"
#include "tautline/models/model_system.h"
#include "tautline/models/path_points.h"

namespace tautline::models::testing {
namespace {

struct Table {
    std::vector<std::string> labels;
    std::vector<std::vector<double>> rows;
};

/** Motions and storages: a header up to `endheader`, labels, numbers. */
Table readTable(const std::filesystem::path& file) {
    std::ifstream stream(file);
    Table table;
    std::string line;
    while (std::getline(stream, line) && line.rfind("endheader", 0) != 0) {
    }
    while (std::getline(stream, line)) {
        std::istringstream words(line);
        if (table.labels.empty()) {
            for (std::string word; words >> word;) table.labels.push_back(word);
            continue;
        }
        std::vector<double> row;
        for (double number; words >> number;) row.push_back(number);
        if (row.size() == table.labels.size()) table.rows.push_back(row);
    }
    return table;
}

/** /jointset/knee/angle/value -> angle. */
std::string findCoordinateName(const std::string& label) {
    const auto end = label.rfind("/value");
    const auto start = label.rfind('/', end - 1) + 1;
    return label.substr(start, end - start);
}

/** Poses a model as a frame of a motion in degrees says. */
void setFrame(const BuiltModel& model, const Table& motion, std::size_t frame, SimTK::State& state) {
    for (std::size_t i = 1; i < motion.labels.size(); ++i) {
        const std::string name = findCoordinateName(motion.labels[i]);
        const bool shifts = name == "pelvis_tx" || name == "pelvis_ty";
        model.setCoordinate(state, name, motion.rows[frame][i] * (shifts ? 1.0 : SimTK_DEGREE_TO_RADIAN));
    }
}

TEST(DataWalk1018, HasTheReferenceLengthsOverTheMotion) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const auto folder = shared / "data" / "opensim";
    BuiltSystem walk(readOsimFile(folder / "models" / "walk_gait1018_subject01.osim"));
    const Table motion = readTable(folder / "motions" / "walk_gait1018_state_reference.mot");
    const Table lengths =
        readTable(folder / "reference" / "std_testGeometryPathWrapping_walk_gait1018_muscle_lengths.sto");
    ASSERT_EQ(motion.rows.size(), 151u);
    ASSERT_EQ(lengths.rows.size(), 151u);
    ASSERT_EQ(walk.description.muscles.size() + 1, lengths.labels.size());
    double worst = 0.0;
    for (std::size_t frame = 0; frame < motion.rows.size(); ++frame) {
        setFrame(walk.model, motion, frame, walk.state);
        walk.system.realize(walk.state, SimTK::Stage::Position);
        for (std::size_t i = 0; i < walk.description.muscles.size(); ++i) {
            const Muscle& muscle = walk.description.muscles[i];
            ASSERT_EQ(lengths.labels[i + 1], "/forceset/" + muscle.name + "|length");
            const double length = calcPolygonLength(muscle.path, walk.model, walk.state);
            worst = std::max(worst, std::abs(length - lengths.rows[frame][i + 1]));
        }
    }
    std::cout << "18 muscles, 151 frames: worst " << worst << " m\n";
    EXPECT_LT(worst, 2e-7) << "1.5e-7 from offsets that the reference rounded to six digits";
}

TEST(DataWalk1018, CablesWithMovingAndConditionalPointsHaveTheReferenceLengths) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const auto folder = shared / "data" / "opensim";
    ModelSystem walk(readOsimFile(folder / "models" / "walk_gait1018_subject01.osim"));
    const Table motion = readTable(folder / "motions" / "walk_gait1018_state_reference.mot");
    const Table lengths =
        readTable(folder / "reference" / "std_testGeometryPathWrapping_walk_gait1018_muscle_lengths.sto");
    SimTK::State state = walk.makeDefaultState();
    double worst = 0.0;
    int numPassedOver = 0;
    for (std::size_t frame = 0; frame < motion.rows.size(); ++frame) {
        setFrame(walk.getModel(), motion, frame, state);
        walk.getSystem().realize(state, SimTK::Stage::Position);
        for (std::size_t i = 0; i < walk.getMuscles().size(); ++i) {
            const ModelSystem::MuscleSlot& muscle = walk.getMuscles()[i];
            ASSERT_EQ(lengths.labels[i + 1], muscle.path + "|length");
            worst = std::max(worst, std::abs(muscle.cable.getLength(state) - lengths.rows[frame][i + 1]));
            for (CableElementIndex e(0); e < muscle.cable.getNumElements(); ++e)
                numPassedOver += !muscle.cable.isActive(state, e);
        }
    }
    std::cout << "18 muscles, 151 frames: worst " << worst << " m, conditional points passed over " << numPassedOver
              << " times\n";
    EXPECT_GT(numPassedOver, 0);
    EXPECT_LT(worst, 2e-7) << "1.5e-7 from offsets that the reference rounded to six digits";
}

TEST(DataWalk1018, MomentArmsAndRatesAreSlopesOfTheLength) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const auto folder = shared / "data" / "opensim";
    ModelSystem walk(readOsimFile(folder / "models" / "walk_gait1018_subject01.osim"));
    const Table motion = readTable(folder / "motions" / "walk_gait1018_state_reference.mot");
    SimTK::State state = walk.makeDefaultState();
    const BuiltModel& model = walk.getModel();
    const double h = 1e-6;
    double worstArm = 0.0, worstRate = 0.0;
    for (const std::size_t frame : {10u, 60u, 110u}) {
        setFrame(model, motion, frame, state);
        for (const std::string& name : model.getCoordinateNames()) model.setCoordinateSpeed(state, name, 1.3);
        for (const std::string& name : model.getCoordinateNames()) {
            const double q = model.getCoordinate(state, name);
            SimTK::State less = state, more = state;
            model.setCoordinate(less, name, q - h);
            model.setCoordinate(more, name, q + h);
            for (SimTK::State* each : {&state, &less, &more}) walk.getSystem().realize(*each, SimTK::Stage::Velocity);
            for (const ModelSystem::MuscleSlot& muscle : walk.getMuscles()) {
                const double slope = (muscle.cable.getLength(more) - muscle.cable.getLength(less)) / (2 * h);
                worstArm = std::max(worstArm, std::abs(walk.calcMomentArm(state, muscle, name) + slope));
            }
        }
        SimTK::State before = state, after = state;
        before.updQ() = state.getQ() - h * state.getQDot();
        after.updQ() = state.getQ() + h * state.getQDot();
        for (SimTK::State* each : {&before, &after}) walk.getSystem().realize(*each, SimTK::Stage::Position);
        for (const ModelSystem::MuscleSlot& muscle : walk.getMuscles()) {
            const double rate = (muscle.cable.getLength(after) - muscle.cable.getLength(before)) / (2 * h);
            worstRate = std::max(worstRate, std::abs(muscle.cable.getLengthRate(state) - rate));
            EXPECT_NEAR(muscle.cable.calcPower(state, 1), -muscle.cable.getLengthRate(state), 1e-12);
        }
    }
    std::cout << "moment arms against differences " << worstArm << " m, rates " << worstRate << " m/s\n";
    EXPECT_LT(worstArm, 1e-8);
    EXPECT_LT(worstRate, 1e-8);
}

TEST(DataModels, AllPathsOfGait2392AreThePolygonsThroughTheirPoints) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const ModelDescription gait =
        readOsimFile(shared / "data" / "opensim" / "models" / "gait2392_thelen2003muscle.osim");
    ModelSystem system(gait);
    SimTK::State state = system.makeDefaultState();
    ASSERT_EQ(system.getMuscles().size(), 92u);
    for (const double knee : {-1.9, -1.0, -0.1, 0.1}) {
        for (const char* side : {"r", "l"})
            system.getModel().setCoordinate(state, std::string("knee_angle_") + side, knee);
        system.getSystem().realize(state, SimTK::Stage::Position);
        for (std::size_t i = 0; i < gait.muscles.size(); ++i)
            EXPECT_NEAR(system.getMuscles()[i].cable.getLength(state),
                        calcPolygonLength(gait.muscles[i].path, system.getModel(), state), 1e-13)
                << gait.muscles[i].name;
    }
}

TEST(DataModels, AreReadAndBuilt) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    struct Case {
        const char* file;
        std::size_t bodies, coordinates, muscles, wraps, constraints;
    };
    const Case cases[] = {{"gait2392_thelen2003muscle.osim", 12, 23, 92, 0, 0},
                          {"walk_gait1018_subject01.osim", 12, 10, 18, 0, 0},
                          {"Rajagopal2016.osim", 22, 39, 80, 40, 2},
                          {"RajagopalLaiUhlrich2023.osim", 22, 39, 80, 44, 2},
                          {"subject_walk_scaled.osim", 22, 33, 80, 44, 2}};
    for (const Case& expected : cases) {
        SCOPED_TRACE(expected.file);
        BuiltSystem built(readOsimFile(shared / "data" / "opensim" / "models" / expected.file));
        EXPECT_EQ(built.description.bodies.size(), expected.bodies);
        EXPECT_EQ(built.model.getCoordinateNames().size(), expected.coordinates);
        EXPECT_EQ(built.description.muscles.size(), expected.muscles);
        EXPECT_EQ(built.description.wrapObjects.size(), expected.wraps);
        EXPECT_EQ(built.description.constraints.size(), expected.constraints);
        built.system.realize(built.state, SimTK::Stage::Position);
        EXPECT_LT(built.state.getQErr().normInf(), 1e-12);
        built.system.realize(built.state, SimTK::Stage::Acceleration);
        EXPECT_FALSE(std::isnan(built.state.getUDot().norm()));
    }
}

/** All nine models, each path in its default pose. */
TEST(DataModels, AllNineHaveTheirPathsInTheDefaultPose) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const auto folder = shared / "data" / "opensim" / "models";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path().filename().string());
        const ModelDescription description = readOsimFile(entry.path());
        ModelSystem model(description);
        SimTK::State state = model.makeDefaultState();
        model.getSystem().realize(state, SimTK::Stage::Position);
        int solved = 0, others = 0;
        for (const auto& path : model.getPaths()) {
            EXPECT_TRUE(std::isfinite(path.cable.getLength(state))) << path.name;
            const bool isSolved = path.cable.getStatus(state) == PathStatus::Solved;
            ++(isSolved ? solved : others);
            if (!isSolved)
                std::cout << entry.path().filename().string() << ": " << path.name << ": "
                          << path.cable.explainStatus(state) << "\n";
        }
        std::cout << entry.path().filename().string() << ": " << solved << " paths solved, " << others << " not; "
                  << description.notes.size() << " notes\n";
        EXPECT_GT(solved, 0);
        ++files;
    }
    EXPECT_EQ(files, 9);
}

}  // namespace
}  // namespace tautline::models::testing
