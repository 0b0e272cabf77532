// SPDX-License-Identifier: Apache-2.0
/** `tautline sweep` as a user runs it: the same table whoever does the runs, and in whatever pieces. */
#include <cmath>
#include <thread>

#include "program_support.h"
#include "sweep/sweep_journal.h"

namespace tautline::testing {
namespace {

const std::string kElbow = TAUTLINE_SOURCE_DIR "/models/elbow.osim";

/** Eight runs of the elbow. */
std::filesystem::path writeSweep(double duration) {
    return writeInput(getTestName() + "_sweep.json", R"({
        "options": {"duration": )" + toText(duration) +
                                              R"(, "lock": ["shoulder_flexion"]},
        "vary": [
            {"option": "pose", "name": "elbow_flexion", "from": 20, "to": 80, "count": 4, "unit": "deg"},
            {"option": "set", "name": "triceps_long/max_isometric_force", "values": ["*0.5", "900"]}],
        "table": [{"columns": "*|length", "values": ["first", "max"]},
                  {"columns": "*triceps_long|tension", "values": ["last"]}]})");
}

Outcome sweep(const std::filesystem::path& file, const std::filesystem::path& folder, const std::string& more = "") {
    return runTautline("sweep " + kElbow + " " + file.string() + " --out " + folder.string() + " " + more);
}

void expectSameTables(const std::filesystem::path& a, const std::filesystem::path& b) {
    for (const char* file : {"sweep.csv", "sweep.sto"}) {
        EXPECT_GT(readAll(a / file).size(), 100u);
        EXPECT_TRUE(readAll(a / file) == readAll(b / file)) << file;
    }
}

TEST(SweepCommand, HasTheNumbersThatSingleRunsHave) {
    const auto folder = makeFolder("sweep_numbers"), alone = makeFolder("sweep_alone");
    const Outcome outcome = sweep(writeSweep(0.05), folder);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(outcome.has("8 runs of ")) << outcome.text;
    const StorageTable table = readStorage(folder / "sweep.sto");
    ASSERT_EQ(table.rows.size(), 8u);
    ASSERT_EQ(runTautline("run " + kElbow + " --duration 0.05 --lock shoulder_flexion --pose elbow_flexion=60deg " +
                          "--set triceps_long/max_isometric_force=900 --out " + alone.string())
                  .exitCode,
              0);
    const StorageTable paths = readStorage(alone / "paths.sto");
    const std::vector<double>& row = table.rows[5];
    EXPECT_EQ(row[findColumn(table, "time")], 5);
    EXPECT_EQ(row[findColumn(table, "exit_code")], 0);
    EXPECT_EQ(row[findColumn(table, "pose.elbow_flexion")], 60);
    EXPECT_EQ(row[findColumn(table, "set.triceps_long/max_isometric_force")], 900);
    EXPECT_EQ(row[findColumn(table, "/forceset/brachialis|length.first")],
              paths.rows.front()[findColumn(paths, "/forceset/brachialis|length")]);
    EXPECT_EQ(row[findColumn(table, "/forceset/triceps_long|tension.last")],
              paths.rows.back()[findColumn(paths, "/forceset/triceps_long|tension")]);
    double most = 0;
    for (const std::vector<double>& r : paths.rows)
        most = std::max(most, r[findColumn(paths, "/forceset/biceps_long|length")]);
    EXPECT_EQ(row[findColumn(table, "/forceset/biceps_long|length.max")], most);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "runs"), {}), 0)
        << "files of runs that are done";
}

TEST(SweepCommand, IsTheSameForAnyNumberOfJobs) {
    const auto one = makeFolder("sweep_one"), three = makeFolder("sweep_three");
    ASSERT_EQ(sweep(writeSweep(0.05), one, "--jobs 1").exitCode, 0);
    ASSERT_EQ(sweep(writeSweep(0.05), three, "--jobs 3").exitCode, 0);
    expectSameTables(one, three);
}

/** Runs a sweep, and sends it a signal once two of its runs are in the journal. */
Outcome interruptSweep(const std::string& signal, const std::filesystem::path& file,
                       const std::filesystem::path& folder) {
    Outcome outcome;
    const std::string journal = (folder / "journal.jsonl").string();
    outcome.exitCode = runProgram("{ " TAUTLINE_PROGRAM " sweep " + kElbow + " " + file.string() + " --jobs 1 --out " +
                                      folder.string() + " & until [ -s " + journal + " ] && [ $(wc -l < " + journal +
                                      ") -ge 3 ]; do sleep 0.01; done; kill -s " + signal + " $!; wait $!; }",
                                  outcome.text);
    return outcome;
}

TEST(SweepCommand, GoesOnWhereItWasKilledOrInterrupted) {
    const auto file = writeSweep(0.5);
    const auto whole = makeFolder("sweep_whole");
    ASSERT_EQ(sweep(file, whole).exitCode, 0);
    for (const std::string signal : {"KILL", "INT", "TERM"}) {
        const auto folder = makeFolder("sweep_" + signal);
        const Outcome cut = interruptSweep(signal, file, folder);
        EXPECT_EQ(cut.exitCode, signal == "KILL" ? 137 : 130) << signal << ": " << cut.text;
        EXPECT_EQ(cut.has("interrupted; the same command goes on"), signal != "KILL") << cut.text;
        const Outcome outcome = sweep(file, folder);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
        EXPECT_TRUE(outcome.has("of them done before")) << outcome.text;
        expectSameTables(whole, folder);
        EXPECT_TRUE(sweep(file, folder).has("8 of them done before"));
    }
}

TEST(SweepCommand, ALineThatWasCutIsDoneAgainAndAnySpoiledOneIsRefused) {
    const auto file = writeSweep(0.05);
    const auto folder = makeFolder("sweep_cut"), whole = makeFolder("sweep_uncut");
    ASSERT_EQ(sweep(file, whole).exitCode, 0);
    const std::string journal = readAll(whole / "journal.jsonl");
    for (const std::size_t kept : {journal.size() - 1, journal.size() - 30, journal.find('\n') + 1}) {
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "journal.jsonl") << journal.substr(0, kept);
        EXPECT_EQ(sweep(file, folder).exitCode, 0);
        expectSameTables(whole, folder);
    }
    std::string spoiled = journal;
    spoiled[journal.find('\n') + 3] = '#';
    std::ofstream(folder / "journal.jsonl") << spoiled;
    const Outcome outcome = sweep(file, folder);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(outcome.has("journal.jsonl:2: this is no result of a run")) << outcome.text;
}

TEST(SweepCommand, AFolderOfAnotherSweepIsRefused) {
    const auto folder = makeFolder("sweep_other");
    ASSERT_EQ(sweep(writeSweep(0.05), folder).exitCode, 0);
    const std::string before = readAll(folder / "sweep.csv");
    const Outcome outcome = sweep(writeSweep(0.06), folder);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(outcome.has("is of another sweep")) << outcome.text;
    EXPECT_EQ(readAll(folder / "sweep.csv"), before);
}

TEST(SweepCommand, RunsThatFailAreListedWithTheirReasonsAndKept) {
    const auto folder = makeFolder("sweep_failing");
    const auto file = writeInput("failing.json", R"({"options": {"duration": 0.02},
        "vary": [{"option": "set", "name": "forearm/mass", "values": [1.5, "heavy", -1]}],
        "table": [{"columns": "*|length", "values": ["max"]}]})");
    const Outcome outcome = sweep(file, folder);
    EXPECT_EQ(outcome.exitCode, 3) << outcome.text;
    const std::string failed = readAll(folder / "failed.csv");
    EXPECT_NE(failed.find("1,refused,heavy,"), std::string::npos) << failed;
    EXPECT_NE(failed.find("elbow.osim:62: "), std::string::npos) << failed;
    EXPECT_NE(failed.find("2,refused,-1,"), std::string::npos) << failed;
    EXPECT_TRUE(std::filesystem::exists(folder / "runs" / "0000001" / "log.txt"));
    EXPECT_FALSE(std::filesystem::exists(folder / "runs" / "0000000"));
    const StorageTable table = readStorage(folder / "sweep.sto");
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_EQ(table.rows[1][findColumn(table, "exit_code")], 1);
    EXPECT_TRUE(std::isnan(table.rows[1][findColumn(table, "/forceset/brachialis|length.max")]));
    EXPECT_GT(table.rows[0][findColumn(table, "/forceset/brachialis|length.max")], 0);
    EXPECT_TRUE(sweep(file, folder, "--retry").has("1 of them done before"));
}

TEST(SweepCommand, TableThatMeetsNoColumnSaysSo) {
    const auto file = writeInput("columnless.json", R"({"command": "solve",
        "vary": [{"option": "pose", "name": "elbow_flexion", "values": [0.5]}],
        "table": [{"columns": "*|lenght", "values": ["max"]}]})");
    const Outcome outcome = sweep(file, makeFolder("sweep_columnless"));
    EXPECT_EQ(outcome.exitCode, 3);
    EXPECT_TRUE(outcome.has("no column of the results matches '*|lenght'")) << outcome.text;
}

TEST(SweepCommand, WhatNoRunCouldDoIsRefusedBeforeTheFirst) {
    const auto folder = makeFolder("sweep_refused");
    const auto expectRefusal = [&](const std::string& text, const std::string& words) {
        const Outcome outcome = sweep(writeInput("refused.json", text), folder);
        EXPECT_EQ(outcome.exitCode, 1) << outcome.text;
        EXPECT_TRUE(outcome.has(words)) << outcome.text;
        EXPECT_EQ(outcome.countLines(), 1) << outcome.text;
        EXPECT_FALSE(std::filesystem::exists(folder));
    };
    expectRefusal(R"({"vary": [{"option": "psoe", "name": "q", "values": [1]}]})", "run 0: ");
    expectRefusal(R"({"vary": [{"option": "duration", "values": [0.1, "long"]}]})", "run 1: ");
    expectRefusal("{", "parse error");
    EXPECT_TRUE(runTautline("sweep /nowhere.osim " + writeSweep(0.05).string() + " --out " + folder.string())
                    .has("/nowhere.osim: cannot be read"));
    EXPECT_FALSE(std::filesystem::exists(folder));
}

#ifdef TAUTLINE_MPI_PROGRAM

const std::string kRanks =
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 100 mpirun --oversubscribe -n ";

Outcome sweepOverRanks(const std::string& ranks, const std::filesystem::path& file, const std::filesystem::path& folder,
                       const std::string& more = "") {
    Outcome outcome;
    outcome.exitCode = runProgram(kRanks + ranks + " " TAUTLINE_MPI_PROGRAM " " + kElbow + " " + file.string() +
                                      " --out " + folder.string() + " " + more,
                                  outcome.text);
    return outcome;
}

TEST(SweepRanks, HaveTheSameTableAsJobs) {
    const auto file = writeSweep(0.05);
    const auto jobs = makeFolder("sweep_jobs"), ranks = makeFolder("sweep_ranks");
    ASSERT_EQ(sweep(file, jobs).exitCode, 0);
    const Outcome outcome = sweepOverRanks("4", file, ranks);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    expectSameTables(jobs, ranks);
}

TEST(SweepRanks, ADeadOneLosesOnlyItsRun) {
    const auto file = writeSweep(1.5);
    const auto jobs = makeFolder("sweep_of_jobs"), ranks = makeFolder("sweep_of_ranks");
    ASSERT_EQ(sweep(file, jobs).exitCode, 0);
    int killed = -1;
    std::thread killer([&ranks, &killed] {
        std::string text;
        for (int i = 0; i < 200 && !std::filesystem::exists(ranks / "runs"); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        killed = runProgram("kill -9 $(pgrep -f '^" TAUTLINE_MPI_PROGRAM ".*" + ranks.string() + "' | tail -1)", text);
    });
    const Outcome outcome = sweepOverRanks("4 --enable-recovery", file, ranks, "--lost-after 2");
    killer.join();
    EXPECT_EQ(killed, 0);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(outcome.has(" is lost: not heard of for 2 s")) << outcome.text;
    expectSameTables(jobs, ranks);
}

TEST(SweepRanks, OneAloneIsRefused) {
    const Outcome outcome = sweepOverRanks("1", writeSweep(0.05), makeFolder("sweep_lonely"));
    EXPECT_EQ(outcome.exitCode, 1) << outcome.text;
    EXPECT_TRUE(outcome.has("one rank alone")) << outcome.text;
}

#endif

TEST(SweepJournal, ResultsComeBackAsTheyWereWritten) {
    SweepResult result{7, 3, "a \"quoted\" reason,\nof two lines", {{"a|b max", 0.1}, {"c", -1e-300}, {"d", NAN}}};
    const SweepResult read = parseResult(toLine(result));
    EXPECT_EQ(read.run, 7);
    EXPECT_EQ(read.exitCode, 3);
    EXPECT_EQ(read.reason, result.reason);
    ASSERT_EQ(read.values.size(), 3u);
    EXPECT_EQ(read.values[0], result.values[0]);
    EXPECT_EQ(read.values[1], result.values[1]);
    EXPECT_TRUE(std::isnan(read.values[2].second));
    EXPECT_EQ(toLine(result).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace tautline::testing
