// SPDX-License-Identifier: Apache-2.0
/** The field's models through all commands. */
#include <nlohmann/json.hpp>

#include "program_support.h"
#include "support/shared_data.h"

namespace tautline::testing {
namespace {

/** A model of the reference data and a motion for it; empty: it is solved in its default pose. */
struct FieldModel {
    const char* name;
    const char* motion;
    const char* ignored;  ///< columns of the motion that the model has no coordinates for
    int numPaths;
};

constexpr FieldModel kModels[] = {
    {"arm26", "arm26_InverseKinematics.mot", "", 6},
    {"arm26_v20303", "arm26_InverseKinematics.mot", "", 6},
    {"gait2392_thelen2003muscle", "gait2392_subject01_walk1_ik.mot", "", 92},
    {"walk_gait1018_subject01", "walk_gait1018_state_reference.mot", "", 18},
    {"Rajagopal2016", "example3DWalking_coordinates.sto", "", 80},
    {"RajagopalLaiUhlrich2023", "example3DWalking_coordinates.sto", "", 80},
    {"subject_walk_scaled", "example3DWalking_coordinates.sto", "", 80},
    {"ThoracoscapularShoulderModel", "", "", 33},
    {"Scholz2015GeometryPathExample", "", "", 1},
};

class DataFieldModels : public ::testing::TestWithParam<FieldModel> {
protected:
    static std::filesystem::path findData() {
        const std::filesystem::path shared = findSharedFolder();
        return shared.empty() ? shared : shared / "data" / "opensim";
    }
    static std::string getModel(const std::filesystem::path& data) {
        return (data / "models" / (std::string(GetParam().name) + ".osim")).string();
    }
};

TEST_P(DataFieldModels, AreChecked) {
    const std::filesystem::path data = findData();
    if (data.empty()) GTEST_SKIP();
    const Outcome outcome = runTautline("check --json " + getModel(data));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    const nlohmann::json json = nlohmann::json::parse(outcome.text);
    ASSERT_EQ(json.at("paths").size(), static_cast<std::size_t>(GetParam().numPaths));
    EXPECT_EQ(json.at("notSupported").size(), 0u);
    for (const nlohmann::json& path : json["paths"]) EXPECT_GT(path.at("shortest"), 0.0) << path;
}

TEST_P(DataFieldModels, AreSolvedAlongAMotion) {
    const std::filesystem::path data = findData();
    if (data.empty()) GTEST_SKIP();
    const std::filesystem::path folder = makeFolder(std::string("field_solve_") + GetParam().name);
    std::string options;
    if (*GetParam().motion) options += " --motion " + (data / "motions" / GetParam().motion).string();
    if (*GetParam().ignored) options += std::string(" --ignore '") + GetParam().ignored + "'";
    const Outcome outcome = runTautline("solve " + getModel(data) + options + " --out " + folder.string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    const StorageTable paths = readStorage(folder / "paths.sto");
    for (const auto& row : paths.rows)
        for (const double number : row) ASSERT_TRUE(std::isfinite(number));
}

TEST_P(DataFieldModels, RunForAFifthOfASecond) {
    const std::filesystem::path data = findData();
    if (data.empty()) GTEST_SKIP();
    const std::filesystem::path folder = makeFolder(std::string("field_run_") + GetParam().name);
    const Outcome outcome =
        runTautline("run " + getModel(data) + " --duration 0.2 --accuracy 1e-3 --out " + folder.string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_EQ(readStorage(folder / "states.sto").rows.size(), 21u);
}

INSTANTIATE_TEST_SUITE_P(, DataFieldModels, ::testing::ValuesIn(kModels),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace tautline::testing
