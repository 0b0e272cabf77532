/** The report program on scenes, run as a user runs it. */
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "support/run_program.h"
#include "support/shared_data.h"

namespace tautline::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

using nlohmann::json;
namespace fs = std::filesystem;

struct Outcome {
    int exitCode = -1;
    std::string text;  ///< standard output and error
    json results;      ///< what was written
};

/** A folder of the running test's own: tests of this program run side by side. */
fs::path makeOwnFolder() {
    const fs::path folder =
        fs::path(::testing::TempDir()) /
        (std::string("tautline_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder);
    return folder;
}

Outcome runScenes(const fs::path& folder, const std::string& options = "") {
    const fs::path out = makeOwnFolder() / "results.json";
    fs::remove(out);
    Outcome outcome;
    const std::string command =
        TAUTLINE_SCENES_PROGRAM " " + folder.string() + " --out " + out.string() + " " + options;
    outcome.exitCode = runProgram(command, outcome.text);
    std::ifstream stream(out);
    if (stream) outcome.results = json::parse(stream, nullptr, false);
    return outcome;
}

json readScenes(const fs::path& file) {
    std::ifstream stream(file);
    return json::parse(stream).at("scenes");
}

/** A line of height h over a unit sphere: tangents and arc in closed form. */
fs::path writeSphereScene(double lengthError) {
    const double h = 0.5, x = 2, d = std::hypot(x, h);
    const double arc = kPi - 2 * std::atan2(h, x) - 2 * std::acos(1 / d);
    const double length = 2 * std::sqrt(d * d - 1) + arc + lengthError;
    const double azimuth = kPi / 2 + arc / 2;
    const json P = {std::cos(azimuth), std::sin(azimuth), 0}, Q = {-std::cos(azimuth), std::sin(azimuth), 0};
    const json scene = {
        {"id", "sphere"},
        {"family", "own"},
        {"difficulty", "easy"},
        {"tags", {"sphere"}},
        {"origin", {-x, h, 0}},
        {"insertion", {x, h, 0}},
        {"obstacles",
         {{{"kind", "sphere"},
           {"params", {1.0}},
           {"R", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
           {"p", {0, 0, 0}},
           {"hint", {0.1, 1, 0}}}}},
        {"truth", {{"length", length}, {"contact", {true}}, {"segments", {{{"P", P}, {"Q", Q}, {"arc", arc}}}}}}};
    const fs::path folder = makeOwnFolder();
    std::ofstream(folder / "static.json") << json{{"scenes", {scene}}};
    return folder;
}

TEST(ScenesProgram, FindsTheClosedFormOfALineOverASphere) {
    const Outcome outcome = runScenes(writeSphereScene(0));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    ASSERT_EQ(outcome.results.at("scenes").size(), 1u);
    const json& scene = outcome.results.at("scenes")[0];
    EXPECT_EQ(scene.at("id"), "sphere");
    EXPECT_EQ(scene.at("status"), "solved");
    EXPECT_EQ(scene.at("contact"), json::array({true}));
    EXPECT_NE(outcome.text.find("[all]                          1       1"), std::string::npos) << outcome.text;
}

TEST(ScenesProgram, TellsAnAnswerThatIsNotTheListedOne) {
    const Outcome outcome = runScenes(writeSphereScene(1e-6));
    EXPECT_NE(outcome.text.find("sphere (easy) step 0: other minimum"), std::string::npos) << outcome.text;
}

TEST(ScenesProgram, RefusesAFolderThatIsNotThereAndAFileThatIsBroken) {
    EXPECT_NE(runScenes("/nowhere/at/all").exitCode, 0);
    const fs::path folder = writeSphereScene(0);
    std::ofstream(folder / "static.json") << "{\"scenes\": [{\"id\": 1}]}";
    const Outcome outcome = runScenes(folder);
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(outcome.text.find("static.json"), std::string::npos) << outcome.text;
}

void checkFields(const json& scene) {
    static const std::set<std::string> statuses = {"solved", "not_minimum", "left_domain", "end_inside",
                                                   "not_converged"};
    EXPECT_EQ(statuses.count(scene.at("status")), 1u) << scene.at("status");
    EXPECT_TRUE(scene.at("length").is_number() && scene.at("rate").is_number() && scene.at("iterations").is_number() &&
                scene.at("time_s").is_number());
    ASSERT_EQ(scene.at("contact").size(), scene.at("segments").size());
    for (std::size_t i = 0; i < scene.at("contact").size(); ++i) {
        const json& segment = scene.at("segments")[i];
        EXPECT_EQ(scene.at("contact")[i].get<bool>(), !segment.is_null());
        if (segment.is_null()) continue;
        EXPECT_EQ(segment.at("P").size(), 3u);
        EXPECT_EQ(segment.at("Q").size(), 3u);
        EXPECT_TRUE(segment.at("arc").is_number());
    }
}

TEST(DataScenesProgram, WritesEveryFieldOfEverySceneAndStep) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const Outcome outcome = runScenes(shared / "scenes");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    std::size_t expected = 0, next = 0;
    for (const char* file : {"static.json", "motion.json"})
        for (const json& truth : readScenes(shared / "scenes" / file)) {
            ++expected;
            ASSERT_LT(next, outcome.results.at("scenes").size());
            const json& scene = outcome.results.at("scenes")[next++];
            SCOPED_TRACE(truth.at("id").get<std::string>());
            EXPECT_EQ(scene.at("id"), truth.at("id"));
            checkFields(scene);
            if (!truth.contains("motion")) continue;
            EXPECT_EQ(scene.at("steps").size(), truth.at("time").at("steps").get<std::size_t>());
            for (const json& step : scene.at("steps")) {
                EXPECT_TRUE(step.at("t").is_number());
                checkFields(step);
            }
            EXPECT_EQ(scene.at("events").size(), truth.at("truth").at("events").size());
            for (const json& event : scene.at("events"))
                EXPECT_TRUE(event.contains("time") && event.contains("obstacle") && event.contains("kind"));
        }
    EXPECT_GT(expected, 0u);
    EXPECT_EQ(expected, outcome.results.at("scenes").size());
}

// Without hints: a verified minimum everywhere, and no longer than the listed one in 95 of 100 easy and medium scenes.
TEST(DataScenesProgram, FindsShortPathsWithoutHints) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const Outcome outcome = runScenes(shared / "scenes", "--no-hints");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    std::map<std::string, double> lengths;
    for (const json& scene : outcome.results.at("scenes")) {
        EXPECT_EQ(scene.at("status"), "solved") << scene.at("id");
        lengths[scene.at("id")] = scene.at("length");
    }
    int judged = 0, noLonger = 0;
    for (const json& scene : readScenes(shared / "scenes" / "static.json")) {
        if (scene.at("difficulty") == "hard") continue;
        ++judged;
        noLonger += lengths.at(scene.at("id")) <= scene.at("truth").at("length").get<double>() * (1 + 1e-9);
    }
    std::cout << noLonger << " of " << judged << " easy and medium scenes are no longer than their listed answers\n";
    EXPECT_GT(judged, 0);
    EXPECT_GE(100 * noLonger, 95 * judged);
}

}  // namespace
}  // namespace tautline::testing
