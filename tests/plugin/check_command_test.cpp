// SPDX-License-Identifier: Apache-2.0
/** `tautline check` as a user runs it. */
#include <nlohmann/json.hpp>

#include "program_support.h"

namespace tautline::testing {
namespace {

const std::string kModels = TAUTLINE_SOURCE_DIR "/models/";

nlohmann::json checkAsJson(const std::string& arguments, int exitCode = 0) {
    const Outcome outcome = runTautline("check --json " + arguments);
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.text;
    return nlohmann::json::parse(outcome.text);
}

TEST(CheckCommand, PrintsWhatAModelHasAndWhereItsPathsWrap) {
    const Outcome outcome = runTautline("check " + kModels + "elbow.osim");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    for (const char* part :
         {"model 'elbow', 2 bodies, 2 coordinates, 6 muscles", "elbow_flexion", "humeral_head", "muscle at rest"})
        EXPECT_TRUE(outcome.has(part)) << part << "\n" << outcome.text;
    EXPECT_FALSE(outcome.has("warning")) << outcome.text;
}

TEST(CheckCommand, GivesTheSameAsJson) {
    const nlohmann::json json = checkAsJson(kModels + "elbow.osim");
    EXPECT_EQ(json.at("model"), "elbow");
    ASSERT_EQ(json.at("paths").size(), 6u);
    const nlohmann::json& triceps = json["paths"][1];
    EXPECT_EQ(triceps.at("name"), "triceps_lateral");
    EXPECT_EQ(triceps.at("posesNotSolved"), 0);
    EXPECT_EQ(triceps.at("wraps").at(0).at("name"), "elbow_back");
    EXPECT_GT(triceps["wraps"][0].at("posesTouched"), 0);
    EXPECT_LT(triceps["wraps"][0]["posesTouched"], json.at("poses"));
    EXPECT_LT(triceps.at("shortest"), triceps.at("longest"));
    EXPECT_EQ(json.at("notSupported").size(), 0u);
}

TEST(CheckCommand, ListsWhatIsNotSupportedAndChecksTheRest) {
    const nlohmann::json json = checkAsJson(kModels + "rejected/unknown_force.osim", 3);
    ASSERT_EQ(json.at("notSupported").size(), 1u);
    EXPECT_EQ(json["notSupported"][0].at("type"), "ElasticFoundationForce");
    EXPECT_EQ(json["notSupported"][0].at("changes"), "forces");
    const Outcome joint = runTautline("check " + kModels + "rejected/unknown_joint.osim");
    EXPECT_EQ(joint.exitCode, 1);
}

/** The arm turns a full circle about a string whose end is 1.1 cm from the axis of a cylinder of 0.8 cm. */
TEST(CheckCommand, CountsPosesInWhichAWrapIsTouched) {
    const nlohmann::json json = checkAsJson(kModels + "accepted/one_sided_cylinder.osim");
    const nlohmann::json& wrap = json.at("paths").at(0).at("wraps").at(0);
    EXPECT_EQ(wrap.at("shape"), "cylinder");
    EXPECT_GT(wrap.at("posesTouched"), json.at("poses").get<int>() / 4);
    EXPECT_EQ(wrap.at("posesPointInside"), 0) << "both ends are farther than that from its axis";
    EXPECT_EQ(wrap.at("posesPassedOver"), 0);
}

}  // namespace
}  // namespace tautline::testing
