// SPDX-License-Identifier: Apache-2.0
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

/** A folder with one file of scenes, and no other file of scenes. */
fs::path writeScenes(const char* file, const json& scenes) {
    const fs::path folder = makeOwnFolder();
    for (const char* name : {"static.json", "motion.json"}) fs::remove(folder / name);
    std::ofstream(folder / file) << json{{"scenes", scenes}};
    return folder;
}

constexpr double kHalfSpan = 2;  ///< the line runs from x = -2 to 2, the unit sphere is at 0

/** Angle by which a string between two points of height h turns over the unit sphere. */
double calcSphereArc(double h) {
    return kPi - 2 * std::atan2(h, kHalfSpan) - 2 * std::acos(1 / std::hypot(kHalfSpan, h));
}

/** Length of that string, straight where h > 1. */
double calcSphereLength(double h) {
    if (h > 1) return 2 * kHalfSpan;
    return 2 * std::sqrt(kHalfSpan * kHalfSpan + h * h - 1) + calcSphereArc(h);
}

json makeSphereSegments(double h) {
    if (h > 1) return json::array({nullptr});
    const double arc = calcSphereArc(h), azimuth = kPi / 2 + arc / 2;
    const json P = {std::cos(azimuth), std::sin(azimuth), 0}, Q = {-std::cos(azimuth), std::sin(azimuth), 0};
    return json::array({{{"P", P}, {"Q", Q}, {"arc", arc}}});
}

/** A line of height h over a unit sphere, without its answer. */
json makeUnlistedScene(double h) {
    return {{"id", "sphere"},
            {"family", "own"},
            {"difficulty", "easy"},
            {"tags", {"sphere"}},
            {"origin", {-kHalfSpan, h, 0}},
            {"insertion", {kHalfSpan, h, 0}},
            {"obstacles",
             {{{"kind", "sphere"},
               {"params", {1.0}},
               {"R", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
               {"p", {0, 0, 0}},
               {"hint", {0.1, 1, 0}}}}}};
}

/** The same with tangents and arc in closed form. */
json makeSphereScene(double lengthError = 0) {
    constexpr double h = 0.5;
    json scene = makeUnlistedScene(h);
    scene["truth"] = {
        {"length", calcSphereLength(h) + lengthError}, {"contact", {true}}, {"segments", makeSphereSegments(h)}};
    return scene;
}

fs::path writeSphereScene(double lengthError) {
    return writeScenes("static.json", json::array({makeSphereScene(lengthError)}));
}

/** A line whose height swings as mean + amplitude cos(2 pi frequency (t - peak)), sampled at t = 0, 0.01, 0.02 ... */
struct Swing {
    double mean = 0, amplitude = 0, frequency = 0, peak = 0;
    int steps = 0;

    double calcHeight(double t) const { return mean + amplitude * std::cos(2 * kPi * frequency * (t - peak)); }
    /** dL/dt: each end pulls along its straight part, which rises by half the arc. */
    double calcLengthRate(double t) const {
        const double w = 2 * kPi * frequency, h = calcHeight(t);
        return h > 1 ? 0 : 2 * std::sin(calcSphereArc(h) / 2) * amplitude * w * std::sin(w * (t - peak));
    }
    /** How long before and after the peak the line touches the sphere as a tangent. */
    double calcTimeFromPeak() const { return std::acos((1 - mean) / amplitude) / (2 * kPi * frequency); }
};

/** Up from the sphere for 6 ms and down again, in the middle of the step from 0.01 to 0.02 s. */
constexpr Swing kHop = {0.9109, 0.1, 25, 0.015, 4};
/** Down onto the sphere for 6 ms and up again, in the same step. */
constexpr Swing kDip = {1.0891, -0.1, 25, 0.015, 4};
/** Slow enough that the line leaves the sphere in one step and comes down in another. */
constexpr Swing kJump = {0.98, 0.05, 2, 0.123, 30};

json makeUnlistedScene(const Swing& swing) {
    const json still = {{"amp", 0}, {"freq", 1}, {"phase", 0}}, stillness = {still, still, still};
    const json wave = {{"amp", swing.amplitude},
                       {"freq", swing.frequency},
                       {"phase", kPi / 2 - 2 * kPi * swing.frequency * swing.peak}};
    json scene = makeUnlistedScene(swing.mean);
    scene["motion"] = {{"origin", {still, wave, still}},
                       {"insertion", {still, wave, still}},
                       {"obstacles", {{{"translation", stillness}, {"rotation", stillness}}}}};
    scene["time"] = {{"start", 0}, {"dt", 0.01}, {"steps", swing.steps}};
    return scene;
}

json makeSphereScene(const Swing& swing) {
    json scene = makeUnlistedScene(swing), truth;
    for (int k = 0; k < swing.steps; ++k) {
        const double t = 0.01 * k, h = swing.calcHeight(t);
        truth["length"].push_back(calcSphereLength(h));
        truth["rate"].push_back(swing.calcLengthRate(t));
        truth["contact"].push_back(h > 1 ? "0" : "1");
    }
    const double before = swing.peak - swing.calcTimeFromPeak(), after = swing.peak + swing.calcTimeFromPeak();
    const bool isDown = swing.amplitude < 0;
    truth["events"] = {{{"time", before}, {"obstacle", 0}, {"kind", isDown ? "touchdown" : "liftoff"}},
                       {{"time", after}, {"obstacle", 0}, {"kind", isDown ? "liftoff" : "touchdown"}}};
    truth["segments_start"] = makeSphereSegments(swing.calcHeight(0));
    scene["truth"] = truth;
    return scene;
}

/** Runs the moving scene alone. */
Outcome runMoving(const json& scene) {
    return runScenes(writeScenes("motion.json", json::array({scene})));
}

bool hasText(const Outcome& outcome, const std::string& text) {
    return outcome.text.find(text) != std::string::npos;
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
    EXPECT_EQ(outcome.exitCode, 1);
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

TEST(ScenesProgram, RefusesAFolderWithoutSceneFiles) {
    const fs::path folder = makeOwnFolder() / "empty";
    fs::create_directories(folder);
    const Outcome outcome = runScenes(folder);
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_TRUE(outcome.results.is_null());
    for (const std::string& name : {folder.string(), std::string("static.json"), std::string("motion.json")})
        EXPECT_TRUE(hasText(outcome, name)) << outcome.text;
}

TEST(ScenesProgram, RefusesAnswersThatLackAStepOrASegment) {
    json moving = makeSphereScene(kJump), still = makeSphereScene();
    moving["truth"]["rate"].erase(0);
    still["truth"]["segments"][0] = nullptr;
    for (const Outcome& outcome : {runMoving(moving), runScenes(writeScenes("static.json", json::array({still})))}) {
        EXPECT_EQ(outcome.exitCode, 2) << outcome.text;
        EXPECT_TRUE(hasText(outcome, "scene 'sphere': its truth")) << outcome.text;
    }
}

TEST(ScenesProgram, SolvesStaticScenesWithoutListedAnswer) {
    const json scenes = {makeSphereScene(), makeUnlistedScene(0.5), makeUnlistedScene(2)};
    const Outcome outcome = runScenes(writeScenes("static.json", scenes));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(hasText(outcome, "no answer listed")) << outcome.text;
    EXPECT_TRUE(hasText(
        outcome,
        "[all]                          3       1       0       0       0       0              0                 2"))
        << outcome.text;
    ASSERT_EQ(outcome.results.at("scenes").size(), 3u);
    EXPECT_NEAR(outcome.results.at("scenes")[1].at("length"), calcSphereLength(0.5), 1e-9);
    EXPECT_NEAR(outcome.results.at("scenes")[2].at("length"), 2 * kHalfSpan, 1e-9);
}

TEST(ScenesProgram, FollowsMovingScenesWithoutListedAnswer) {
    const Outcome outcome = runMoving(makeUnlistedScene(kJump));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    ASSERT_EQ(outcome.results.at("scenes").size(), 1u);
    const json& scene = outcome.results.at("scenes")[0];
    ASSERT_EQ(scene.at("steps").size(), static_cast<std::size_t>(kJump.steps));
    for (const json& step : scene.at("steps"))
        EXPECT_NEAR(step.at("length"), calcSphereLength(kJump.calcHeight(step.at("t"))), 1e-9);
    ASSERT_EQ(scene.at("events").size(), 2u);
    EXPECT_EQ(scene.at("events")[0].at("kind"), "liftoff");
    EXPECT_EQ(scene.at("events")[1].at("kind"), "touchdown");
}

TEST(ScenesProgram, TellsWhatItCouldNotSolveWhereNoAnswerIsListed) {
    json scene = makeUnlistedScene(0.5);
    scene["origin"] = {0, 0.5, 0};  // inside the sphere
    const Outcome outcome = runScenes(writeScenes("static.json", json::array({scene})));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(hasText(outcome, "no listed answer, 1 of 1 steps not solved")) << outcome.text;
    EXPECT_EQ(outcome.results.at("scenes")[0].at("status"), "end_inside");
}

TEST(ScenesProgram, FailsWhereAnAnswerIsNoPath) {
    json inside = makeSphereScene();
    inside["origin"] = {0, 0.5, 0};
    const Outcome outcome = runScenes(writeScenes("static.json", json::array({makeSphereScene(), inside})));
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(hasText(outcome, "step 0: wrong")) << outcome.text;
}

TEST(ScenesProgram, FailsWhereASceneThrowsAndSolvesTheOthers) {
    json impossible = makeSphereScene();
    impossible["obstacles"][0]["params"] = {-1.0};
    const Outcome outcome = runScenes(writeScenes("static.json", {impossible, makeSphereScene()}));
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(hasText(outcome, "sphere (easy) threw: ")) << outcome.text;
    ASSERT_EQ(outcome.results.at("scenes").size(), 2u);
    EXPECT_EQ(outcome.results.at("scenes")[0].at("status"), "threw");
    EXPECT_EQ(outcome.results.at("scenes")[1].at("status"), "solved");
}

TEST(ScenesProgram, AllowsThreeOtherMinimaInAHundredWithHintsAndAnyNumberWithout) {
    json scenes = json::array({makeSphereScene(1e-6)});
    while (scenes.size() < 34) scenes.push_back(makeSphereScene());
    EXPECT_EQ(runScenes(writeScenes("static.json", scenes)).exitCode, 0);  // 1 of 34
    scenes.erase(33), scenes.erase(32);
    const fs::path folder = writeScenes("static.json", scenes);
    const Outcome outcome = runScenes(folder);  // 1 of 32
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(hasText(outcome, "more than the 3 in 100")) << outcome.text;
    EXPECT_EQ(runScenes(folder, "--no-hints").exitCode, 0);
    scenes.push_back(makeUnlistedScene(0.5)), scenes.push_back(makeUnlistedScene(0.5));
    EXPECT_EQ(runScenes(writeScenes("static.json", scenes)).exitCode, 1);  // scenes without answers do not count
}

TEST(ScenesProgram, PassesAMovingSceneThatIsAsListed) {
    const Outcome outcome = runMoving(makeSphereScene(kJump));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(hasText(outcome, "[all]                          1       1")) << outcome.text;
}

TEST(ScenesProgram, FailsWhereAMovingSceneIsNotAsListed) {
    const json listed = makeSphereScene(kJump);
    const auto expectFailure = [](const json& scene, const std::string& text) {
        const Outcome outcome = runMoving(scene);
        EXPECT_EQ(outcome.exitCode, 1) << text;
        EXPECT_TRUE(hasText(outcome, "[all]                          1       0       0       0       1"))
            << outcome.text;
        EXPECT_TRUE(hasText(outcome, text)) << outcome.text;
    };
    const auto change = [&listed](const std::string& list, int index, const json& value) {
        json scene = listed;
        scene["truth"][list][index] = value;
        return scene;
    };
    const json& truth = listed.at("truth");
    expectFailure(change("length", 7, truth.at("length")[7].get<double>() + 1e-6), "step 7: other minimum");
    expectFailure(change("rate", 3, truth.at("rate")[3].get<double>() + 2e-7), "rates differ");
    expectFailure(change("contact", 2, "0"), "step 2: other minimum");
    json late = listed;
    late["truth"]["events"][1]["time"] = truth.at("events")[1].at("time").get<double>() + 2e-6;
    expectFailure(late, "events differ");
    json single = listed;
    single["truth"]["events"].erase(1);
    expectFailure(single, "events differ");
}

// Both events of the pair lie in one step, before which and after which the contact is the same.
TEST(ScenesProgram, FindsALiftOffAndATouchdownWithinOneStep) {
    const Outcome outcome = runMoving(makeSphereScene(kHop));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    for (const json& step : outcome.results.at("scenes")[0].at("steps"))
        EXPECT_EQ(step.at("contact"), json::array({true}));
    const json& events = outcome.results.at("scenes")[0].at("events");
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].at("kind"), "liftoff");
    EXPECT_NEAR(events[0].at("time"), kHop.peak - kHop.calcTimeFromPeak(), 1e-6);
    EXPECT_EQ(events[1].at("kind"), "touchdown");
    EXPECT_NEAR(events[1].at("time"), kHop.peak + kHop.calcTimeFromPeak(), 1e-6);
}

TEST(ScenesProgram, FindsATouchdownAndALiftOffWithinOneStep) {
    const Outcome outcome = runMoving(makeSphereScene(kDip));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    for (const json& step : outcome.results.at("scenes")[0].at("steps"))
        EXPECT_EQ(step.at("contact"), json::array({false}));
    const json& events = outcome.results.at("scenes")[0].at("events");
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].at("kind"), "touchdown");
    EXPECT_EQ(events[1].at("kind"), "liftoff");
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
    // On the straight line two cylinders, or an ellipsoid and a cylinder, overlap: there the string has a kink.
    const std::set<std::string> inGrooves = {"s00362", "m00032"};
    for (const json& scene : outcome.results.at("scenes")) {
        if (inGrooves.count(scene.at("id")) == 0) {
            EXPECT_EQ(scene.at("status"), "solved") << scene.at("id");
        }
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
