// SPDX-License-Identifier: Apache-2.0
/** Muscles on cables over wrap objects: binding, lengths and moment arms. */
#include "tautline/models/model_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "model_test_support.h"
#include "support/shared_data.h"

namespace tautline::models::testing {
namespace {

struct ReferenceRow {
    std::string muscle, coordinate;  ///< coordinate: of a moment arm, else empty
    std::vector<std::pair<std::string, double>> pose;
    double value = 0.0;
};

/** Rows of `muscle[,coordinate],name=value;...,number`. */
std::vector<ReferenceRow> readRows(const std::filesystem::path& file, bool hasCoordinate) {
    std::ifstream stream(file);
    std::vector<ReferenceRow> rows;
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) {
        std::istringstream fields(line);
        ReferenceRow row;
        std::string pose, value;
        std::getline(fields, row.muscle, ',');
        if (hasCoordinate) std::getline(fields, row.coordinate, ',');
        std::getline(fields, pose, ',');
        std::getline(fields, value);
        row.value = std::stod(value);
        std::istringstream settings(pose);
        for (std::string setting; std::getline(settings, setting, ';');) {
            const auto equals = setting.find('=');
            row.pose.emplace_back(setting.substr(0, equals), std::stod(setting.substr(equals + 1)));
        }
        rows.push_back(row);
    }
    return rows;
}

struct Arm26 {
    explicit Arm26(const std::filesystem::path& shared, const std::string& file = "arm26.osim")
        : model(readOsimFile(shared / "data" / "opensim" / "models" / file)), state(model.makeDefaultState()) {}

    /** Default pose but for these coordinates, clipped to their ranges as the references were. */
    void setPose(const std::vector<std::pair<std::string, double>>& pose) {
        model.getModel().setDefaultPose(state);
        for (const auto& [name, value] : pose) {
            const auto& range = model.getModel().getCoordinateSlot(name).range;
            model.getModel().setCoordinate(state, name, std::clamp(value, range[0], range[1]));
        }
        model.getSystem().realize(state, SimTK::Stage::Position);
    }

    const ModelSystem::MuscleSlot& getMuscle(const std::string& name) const {
        for (const auto& slot : model.getMuscles())
            if (slot.name == name) return slot;
        throw ModelError("no muscle " + name);
    }

    ModelSystem model;
    SimTK::State state;
};

/** What the reference can be held to: OpenSim places the tangent points of an oblique cylinder path approximately, and
a true geodesic is never longer. Its README gives 1e-7, 2e-6 and 2.4e-5 m for lengths, 2e-5 and 2e-4 m for moment arms,
to the digits printed; these bounds are what rounds to them. */
double getLengthTolerance(const std::string& muscle) {
    return muscle == "BICshort" ? 1e-7 : muscle == "TRIlat" ? 2.5e-6 : 2.45e-5;
}
double getArmTolerance(const std::string& muscle) {
    return muscle == "BICshort" ? 1e-9 : muscle == "TRIlat" ? 2.5e-5 : 2.5e-4;
}

TEST(DataMuscles, LengthsOfArm26AgreeWithTheReference) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    Arm26 arm(shared);
    const auto rows = readRows(shared / "data/opensim/reference/arm26_osim_lengths.csv", false);
    ASSERT_EQ(rows.size(), 45u);
    std::map<std::string, double> worst;
    for (const ReferenceRow& row : rows) {
        arm.setPose(row.pose);
        const Cable& cable = arm.getMuscle(row.muscle).cable;
        EXPECT_EQ(cable.getStatus(arm.state), PathStatus::Solved);
        const double difference = cable.getLength(arm.state) - row.value;
        worst[row.muscle] = std::max(worst[row.muscle], std::abs(difference));
        EXPECT_LT(std::abs(difference), getLengthTolerance(row.muscle)) << row.muscle;
        EXPECT_LT(difference, 1e-7) << row.muscle << ": a geodesic is never longer";
    }
    for (const auto& [muscle, value] : worst) std::cout << muscle << ": largest difference " << value << " m\n";
}

TEST(DataMuscles, MomentArmsOfArm26AgreeWithTheReference) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    Arm26 arm(shared);
    const auto rows = readRows(shared / "data/opensim/reference/arm26_osim_moment_arms.csv", true);
    ASSERT_EQ(rows.size(), 100u);
    std::map<std::string, double> worst;
    for (const ReferenceRow& row : rows) {
        arm.setPose(row.pose);
        const double moment = arm.model.calcMomentArm(arm.state, arm.getMuscle(row.muscle), row.coordinate);
        worst[row.muscle] = std::max(worst[row.muscle], std::abs(moment - row.value));
        EXPECT_LT(std::abs(moment - row.value), getArmTolerance(row.muscle)) << row.muscle << " " << row.coordinate;
    }
    for (const auto& [muscle, value] : worst) std::cout << muscle << ": largest difference " << value << " m\n";
}

TEST(DataMuscles, BothLayoutsOfArm26GiveTheSameLengths) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    Arm26 present(shared), old(shared, "arm26_v20303.osim");
    for (double shoulder : {-1.0, 0.0, 0.8, 2.0})
        for (double elbow : {0.0, 0.5, 1.2, 2.0}) {
            present.setPose({{"r_shoulder_elev", shoulder}, {"r_elbow_flex", elbow}});
            old.setPose({{"r_shoulder_elev", shoulder}, {"r_elbow_flex", elbow}});
            for (const auto& slot : present.model.getMuscles())
                EXPECT_NEAR(slot.cable.getLength(present.state), old.getMuscle(slot.name).cable.getLength(old.state),
                            1e-14)
                    << slot.name << " at " << shoulder << ", " << elbow;
        }
}

TEST(ModelSystem, MomentArmIsMinusTheSlopeOfTheLength) {
    ModelSystem model(readOsimFile(TAUTLINE_SOURCE_DIR "/models/elbow.osim"));
    SimTK::State state = model.makeDefaultState();
    // Central differences: truncation h^2 and rounding 1e-16/h balance near 1e-5, leaving about 1e-10.
    const double h = 1e-5;
    for (double elbow : {0.1, 0.5, 1.0, 1.8})
        for (const std::string& coordinate : model.getModel().getCoordinateNames())
            for (const auto& slot : model.getMuscles()) {
                const auto calcLength = [&](double offset) {
                    model.getModel().setDefaultPose(state);
                    model.getModel().setCoordinate(state, model.getModel().getCoordinateNames().back(), elbow);
                    model.getModel().setCoordinate(state, coordinate,
                                                   model.getModel().getCoordinate(state, coordinate) + offset);
                    model.getSystem().realize(state, SimTK::Stage::Position);
                    return slot.cable.getLength(state);
                };
                const double slope = (calcLength(h) - calcLength(-h)) / (2 * h);
                calcLength(0);
                EXPECT_NEAR(model.calcMomentArm(state, slot, coordinate), -slope, 1e-8)
                    << slot.name << " " << coordinate;
            }
}

TEST(ModelSystem, WrapsAreBoundToTheSegmentsOfTheirRanges) {
    const ModelDescription description = readOsimFile(TAUTLINE_SOURCE_DIR "/models/elbow.osim");
    const ModelSystem model(description);
    for (std::size_t i = 0; i < description.muscles.size(); ++i) {
        const MusclePath& path = description.muscles[i].path;
        ASSERT_EQ(model.getMuscles()[i].wraps.size(), path.wraps.size());
        for (const BoundWrap& wrap : model.getMuscles()[i].wraps) {
            EXPECT_EQ(static_cast<int>(wrap.segment) + 1, path.wraps[wrap.wrap].range[0])
                << description.muscles[i].name;
            EXPECT_TRUE(wrap.alternatives.empty());
        }
    }
}

TEST(ModelSystem, AConditionalEndIsRefusedByNameAndLine) {
    const std::string path =
        "<Thelen2003Muscle name=\"quad\"><GeometryPath name=\"path\"><PathPointSet><objects>\n"
        "<ConditionalPathPoint name=\"p2\"><socket_parent_frame>/bodyset/b</socket_parent_frame><location>0 1 "
        "0</location>"
        "<socket_coordinate>/jointset/j/q</socket_coordinate><range>0 1</range></ConditionalPathPoint>\n"
        "<PathPoint name=\"p3\"><socket_parent_frame>/bodyset/b</socket_parent_frame><location>0 2 "
        "0</location></PathPoint>\n"
        "</objects></PathPointSet></GeometryPath><max_isometric_force>100</max_isometric_force>"
        "<optimal_fiber_length>0.1</optimal_fiber_length><tendon_slack_length>0.2</tendon_slack_length></"
        "Thelen2003Muscle>\n";
    const std::string joint =
        "<PinJoint name=\"j\"><socket_parent_frame>/ground</socket_parent_frame>"
        "<socket_child_frame>/bodyset/b</socket_child_frame><coordinates><Coordinate "
        "name=\"q\"/></coordinates></PinJoint>\n";
    const ModelDescription description =
        readOsimText(wrapInDocument(makeBodySet(makeBody("b")) + makeJointSet(joint) + "<ForceSet><objects>" + path +
                                        "</objects></ForceSet>",
                                    "40000"),
                     "quad.osim");
    try {
        ModelSystem model(description);
        FAIL() << "not refused";
    } catch (const ModelError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("quad.osim:"), std::string::npos) << message;
        EXPECT_NE(message.find("'quad'"), std::string::npos) << message;
        EXPECT_NE(message.find("'p2'"), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace tautline::models::testing
