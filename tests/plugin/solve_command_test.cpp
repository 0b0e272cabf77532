// SPDX-License-Identifier: Apache-2.0
/** `tautline solve` as a user runs it. */
#include <cmath>

#include "program_support.h"

namespace tautline::testing {
namespace {

const std::string kElbow = TAUTLINE_SOURCE_DIR "/models/elbow.osim";

std::string makeMotion(const std::string& labels, const std::string& rows, const std::string& inDegrees) {
    return "Coordinates\nversion=1\n" + inDegrees + "\nendheader\ntime\t" + labels + "\n" + rows;
}

TEST(SolveCommand, AnswersAPoseWithATableAndFiles) {
    const std::filesystem::path folder = makeFolder("solve_pose");
    const Outcome outcome = runTautline("solve " + kElbow + " --pose elbow_flexion=90deg --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(outcome.has("triceps_long")) << outcome.text;
    const StorageTable paths = readStorage(folder / "paths.sto"), arms = readStorage(folder / "moment_arms.sto"),
                       coordinates = readStorage(folder / "coordinates.sto");
    ASSERT_EQ(paths.rows.size(), 1u);
    EXPECT_EQ(paths.rows[0][findColumn(paths, "/forceset/triceps_lateral|status")], 0.0);
    EXPECT_EQ(paths.rows[0][findColumn(paths, "/forceset/triceps_lateral|contact.elbow_back")], 1.0);
    EXPECT_NEAR(coordinates.rows[0][findColumn(coordinates, "/jointset/elbow/elbow_flexion/value")], std::acos(0.0),
                1e-15);
    // Over its cylinder of 21 mm about the elbow's axis.
    EXPECT_NEAR(arms.rows[0][findColumn(arms, "/forceset/triceps_lateral|moment_arm.elbow_flexion")], -0.021, 1e-4);
    EXPECT_EQ(std::count(arms.labels.begin(), arms.labels.end(), "/forceset/brachialis|moment_arm.shoulder_flexion"), 0)
        << "not crossed";
    EXPECT_EQ(readAll(folder / "statuses.csv"), "time,path,status,explanation\n");
}

TEST(SolveCommand, TakesDegreesAndRadiansAsTheHeaderSays) {
    const double degree = std::acos(-1.0) / 180;
    const auto degrees = writeInput("degrees.mot", makeMotion("elbow_flexion\tshoulder_flexion",
                                                              "0\t10\t0\n0.5\t40\t5\n1\t60\t0\n", "inDegrees=yes"));
    const auto radians =
        writeInput("radians.sto", makeMotion("/jointset/elbow/elbow_flexion/value\tshoulder/shoulder_flexion/value",
                                             "0 " + toText(10 * degree) + " 0\n0.5 " + toText(40 * degree) + " " +
                                                 toText(5 * degree) + "\n1 " + toText(60 * degree) + " 0\n",
                                             "inDegrees = no"));
    const auto folder1 = makeFolder("solve_degrees"), folder2 = makeFolder("solve_radians");
    ASSERT_EQ(runTautline("solve " + kElbow + " --motion " + degrees.string() + " --out " + folder1.string()).exitCode,
              0);
    ASSERT_EQ(runTautline("solve " + kElbow + " --motion " + radians.string() + " --out " + folder2.string()).exitCode,
              0);
    for (const char* file : {"paths.sto", "moment_arms.sto"}) {
        const StorageTable a = readStorage(folder1 / file), b = readStorage(folder2 / file);
        ASSERT_EQ(a.rows.size(), 3u);
        ASSERT_EQ(a.labels, b.labels);
        for (std::size_t i = 0; i < a.rows.size(); ++i)
            for (std::size_t j = 0; j < a.labels.size(); ++j)
                EXPECT_NEAR(a.rows[i][j], b.rows[i][j], 1e-12) << a.labels[j];
    }
}

TEST(SolveCommand, IsTheSameForAnyNumberOfThreads) {
    std::string rows;
    for (int i = 0; i < 300; ++i)
        rows += toText(0.01 * i) + "\t" + toText(60 + 50 * std::sin(0.05 * i)) + "\t" +
                toText(30 * std::cos(0.03 * i)) + "\n";
    const auto motion = writeInput("threads.mot", makeMotion("elbow_flexion\tshoulder_flexion", rows, "inDegrees=yes"));
    const auto solve = [&](const std::string& threads) {
        const auto folder = makeFolder("solve_threads_" + threads);
        EXPECT_EQ(runTautline("solve " + kElbow + " --motion " + motion.string() + " --threads " + threads + " --out " +
                              folder.string())
                      .exitCode,
                  0);
        return folder;
    };
    const auto one = solve("1");
    for (const char* threads : {"2", "5"}) {
        const auto several = solve(threads);
        for (const char* file : {"paths.sto", "moment_arms.sto", "coordinates.sto", "statuses.csv"})
            EXPECT_TRUE(readAll(one / file) == readAll(several / file)) << file << ", " << threads << " threads";
    }
    EXPECT_EQ(readStorage(one / "paths.sto").rows.size(), 300u);
    EXPECT_EQ(runTautline("solve " + kElbow + " --threads 0").exitCode, 105);
}

TEST(SolveCommand, TakesSpeedsFromTheFileIfItHasThem) {
    const auto motion = writeInput("speeds.sto", makeMotion("elbow_flexion/value\telbow_flexion/speed",
                                                            "0\t0.5\t2\n1\t0.5\t-3\n", "inDegrees=no"));
    const auto folder = makeFolder("solve_speeds");
    ASSERT_EQ(runTautline("solve " + kElbow + " --motion " + motion.string() + " --out " + folder.string()).exitCode,
              0);
    const StorageTable paths = readStorage(folder / "paths.sto"), arms = readStorage(folder / "moment_arms.sto");
    const std::size_t rate = findColumn(paths, "/forceset/brachialis|rate"),
                      arm = findColumn(arms, "/forceset/brachialis|moment_arm.elbow_flexion");
    EXPECT_NEAR(paths.rows[0][rate], -2 * arms.rows[0][arm], 1e-14);
    EXPECT_NEAR(paths.rows[1][rate], 3 * arms.rows[1][arm], 1e-14);
}

TEST(SolveCommand, SolvesOnlyThePathsThatMatch) {
    const auto folder = makeFolder("solve_pattern");
    ASSERT_EQ(
        runTautline("solve " + kElbow + " --muscles 'biceps_*' --muscles brach?alis --out " + folder.string()).exitCode,
        0);
    const StorageTable paths = readStorage(folder / "paths.sto");
    for (const std::string& label : paths.labels)
        EXPECT_TRUE(label == "time" || label.rfind("/forceset/b", 0) == 0) << label;
    EXPECT_GT(paths.labels.size(), 3u);
}

TEST(SolveCommand, RefusesWhatItCannotReadInOneLineAndWritesNothing) {
    const auto unknown =
        writeInput("unknown.mot", makeMotion("elbow_flexion\twrist\tthumb", "0\t1\t2\t3\n", "inDegrees=no"));
    const auto twice =
        writeInput("twice.mot", makeMotion("elbow_flexion\telbow/elbow_flexion/value", "0\t1\t2\n", "inDegrees=no"));
    const std::pair<std::string, const char*> cases[] = {
        {"--motion " + unknown.string(), "the model has no coordinates for these columns: wrist, thumb"},
        {"--motion " + twice.string(), "coordinate 'elbow_flexion' has two columns"},
        {"--motion no_such.mot", "no_such.mot: cannot be read"},
        {"--pose wrist=1",
         "--pose 'wrist=1': the model has no coordinate 'wrist'; it has shoulder_flexion, elbow_flexion"},
        {"--pose elbow_flexion=much", "'much' is not a number"},
        {"--pose elbow_flexion", "is not of the form NAME=VALUE"},
        {"--pose elbow_flexion=nan", "'nan' is not a number"},
        {"--pose elbow_flexion=1 --pose elbow_flexion=2", "--pose: 'elbow_flexion' is given twice"},
        {"--muscles 'glut*'", "--muscles 'glut*' matches none of triceps_long, "}};
    for (const auto& [options, message] : cases) {
        const auto folder = makeFolder("solve_refused");
        const Outcome outcome = runTautline("solve " + kElbow + " " + options + " --out " + folder.string());
        EXPECT_EQ(outcome.exitCode, 1) << options;
        EXPECT_TRUE(outcome.has(message)) << outcome.text;
        EXPECT_EQ(outcome.countLines(), 1) << outcome.text;
        EXPECT_FALSE(std::filesystem::exists(folder)) << options;
    }
}

TEST(SolveCommand, LeavesOutColumnsThatItIsToldToAndThoseOfForces) {
    const auto motion = writeInput("columns.sto", makeMotion("elbow_flexion\twrist\t/forceset/brachialis/activation",
                                                             "0\t1\t2\t0.5\n1\t1\t2\t0.5\n", "inDegrees=no"));
    const Outcome outcome = runTautline("solve " + kElbow + " --motion " + motion.string() + " --ignore 'wri*' --out " +
                                        makeFolder("solve_columns").string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(outcome.has("columns ignored as asked: wrist")) << outcome.text;
    EXPECT_TRUE(outcome.has("which play no part here: /forceset/brachialis/activation")) << outcome.text;
    EXPECT_TRUE(outcome.has("note: not in it and so at their defaults: shoulder_flexion")) << outcome.text;
}

TEST(SolveCommand, SaysIfAngleColumnsLookLikeDegrees) {
    const auto motion = writeInput("lying.mot", makeMotion("elbow_flexion", "0\t10\n1\t90\n", "version=1"));
    const Outcome outcome = runTautline("solve " + kElbow + " --motion " + motion.string() +
                                        " --allow-degraded --out " + makeFolder("solve_lying").string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(
        outcome.has("the header does not say inDegrees, read as radians, but these turn by more than four turns: "
                    "elbow_flexion"))
        << outcome.text;
}

}  // namespace
}  // namespace tautline::testing
