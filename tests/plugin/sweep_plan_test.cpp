// SPDX-License-Identifier: Apache-2.0
/** What a file of a sweep says, and what is refused of it. */
#include "sweep/sweep_plan.h"

#include <cmath>

#include "program_support.h"

namespace tautline::testing {
namespace {

SweepPlan readPlan(const std::string& text) {
    return readSweepPlan(writeInput(getTestName() + "_plan.json", text));
}

/** The message with which a file is refused. */
std::string refuse(const std::string& text) {
    try {
        readPlan(text);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

using Runs = std::vector<std::vector<std::string>>;

TEST(SweepPlan, GridHasEveryValueWithEveryOtherTheLastFastest) {
    const SweepPlan plan = readPlan(R"({"vary": [
        {"option": "pose", "name": "q", "from": 0, "to": 90, "count": 3, "unit": "deg"},
        {"option": "states", "values": ["a.sto", "b.sto"]}]})");
    const Runs expected{{"0deg", "a.sto"},  {"0deg", "b.sto"},  {"45deg", "a.sto"},
                        {"45deg", "b.sto"}, {"90deg", "a.sto"}, {"90deg", "b.sto"}};
    EXPECT_EQ(plan.runs, expected);
    EXPECT_EQ(plan.command, "run");
    EXPECT_EQ(plan.variables[0].getLabel(), "pose q");
    EXPECT_EQ(plan.variables[1].getLabel(), "states");
}

TEST(SweepPlan, ListTakesTheFirstOfEachThenTheSecond) {
    const SweepPlan plan = readPlan(R"({"sampling": {"method": "list"}, "vary": [
        {"option": "speed", "name": "q", "values": [1, -2.5, 1e-3]},
        {"option": "set", "name": "m/f", "values": ["*0.8", "7", 3]}]})");
    EXPECT_EQ(plan.runs, (Runs{{"1", "*0.8"}, {"-2.5", "7"}, {"0.001", "3"}}));
}

TEST(SweepPlan, ScaleOfLogarithmsHasEqualRatios) {
    const SweepPlan plan = readPlan(R"({"vary": [
        {"option": "accuracy", "from": 1e-8, "to": 1e-2, "count": 4, "scale": "log"}]})");
    ASSERT_EQ(plan.getNumRuns(), 4);
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(std::stod(plan.runs[static_cast<std::size_t>(i)][0]) / std::pow(10, -8 + 2 * i), 1, 1e-14);
    EXPECT_EQ(plan.runs[3][0], "0.01");
}

TEST(SweepPlan, DrawnRunsLieInTheirRangesAndDependOnTheSeedAlone) {
    const auto make = [](const std::string& method, int seed) {
        return readPlan(R"({"sampling": {"method": ")" + method + R"(", "runs": 200, "seed": )" + std::to_string(seed) +
                        R"(}, "vary": [{"option": "pose", "name": "q", "from": -1, "to": 3},
                            {"option": "states", "values": ["a", "b", "c", "d"]}]})");
    };
    for (const char* method : {"random", "latin_hypercube"}) {
        const SweepPlan plan = make(method, 5);
        ASSERT_EQ(plan.getNumRuns(), 200);
        std::map<std::string, int> counts;
        for (const std::vector<std::string>& run : plan.runs) {
            const double q = std::stod(run[0]);
            EXPECT_TRUE(q >= -1 && q < 3) << run[0];
            ++counts[run[1]];
        }
        for (const char* word : {"a", "b", "c", "d"}) EXPECT_NEAR(counts[word], 50, method[0] == 'l' ? 0 : 25) << word;
        EXPECT_EQ(plan.runs, make(method, 5).runs);
        EXPECT_NE(plan.runs, make(method, 6).runs);
    }
}

TEST(SweepPlan, MakesTheCommandLineOfARun) {
    const SweepPlan plan = readPlan(R"({"command": "solve",
        "options": {"muscles": ["a*", "b"], "gravity": [0, -9.8, 0], "allow-degraded": true, "all": false, "x": 1.5},
        "vary": [{"option": "pose", "name": "q", "values": [0.1]}, {"option": "motion", "values": ["walk.mot"]}]})");
    const std::vector<std::string> expected{
        "solve",     "m.osim",   "--threads", "1",     "--muscles",        "a*",  "--muscles", "b",
        "--gravity", "0",        "-9.8",      "0",     "--allow-degraded", "--x", "1.5",       "--pose",
        "q=0.1",     "--motion", "walk.mot",  "--out", "out/there"};
    EXPECT_EQ(plan.makeArguments(0, "m.osim", "out/there"), expected);
}

TEST(SweepPlan, WhatItDoesNotSayHasDefaults) {
    const SweepPlan run = readPlan(R"({"vary": [{"option": "states", "values": ["a"]}]})");
    EXPECT_EQ(run.table.size(), 2u);
    EXPECT_EQ(run.keep, SweepPlan::Keep::Failed);
    const SweepPlan solve = readPlan(R"({"command": "solve", "keep": "all", "vary": [{"option": "pose", "name": "q",
        "values": [1]}], "table": [{"columns": "*|rate", "values": ["mean", "first"]}]})");
    ASSERT_EQ(solve.table.size(), 1u);
    EXPECT_EQ(solve.table[0].pattern, "*|rate");
    EXPECT_EQ(solve.table[0].values, (std::vector<std::string>{"mean", "first"}));
    EXPECT_EQ(solve.keep, SweepPlan::Keep::All);
}

TEST(SweepPlan, BadFilesAreRefusedWithThePlace) {
    const std::string vary = R"("vary": [{"option": "pose", "name": "q", "values": [1]}])";
    for (
        const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
            {"{", "parse error at line 1, column 2"},
            {"[]", "plan.json: / must be an object"},
            {"{}", R"(has no "vary")"},
            {R"({"vary": []})", "/vary must be an array that is not empty"},
            {R"({"vary": [3]})", "/vary/0 is 3 and must be an object"},
            {R"({"vary": [{"name": "q", "values": [1]}]})", R"(/vary/0 has no "option")"},
            {R"({"vary": [{"option": "pose", "values": []}]})", "/vary/0/values must be an array that is not empty"},
            {R"({"vary": [{"option": "pose", "values": [true]}]})", "/vary/0/values/0 is true and must be a string"},
            {R"({"vary": [{"option": "pose", "from": 1}]})", R"(/vary/0 has no "to")"},
            {R"({"vary": [{"option": "pose", "from": "1", "to": 2, "count": 2}]})",
             R"(/vary/0/from is "1" and must be a number)"},
            {R"({"vary": [{"option": "pose", "from": 1, "to": 2}]})", R"(/vary/0 has no "count")"},
            {R"({"vary": [{"option": "pose", "from": 1, "to": 2, "count": 1}]})",
             "/vary/0/count is 1 and must be a whole number from 2 to"},
            {R"({"vary": [{"option": "pose", "from": 1, "to": 2, "count": 2.5}]})", "/vary/0/count is 2.5 and must be"},
            {R"({"vary": [{"option": "pose", "from": 0, "to": 2, "count": 2, "scale": "log"}]})",
             "goes from 0 to 2, but both must be positive"},
            {R"({"vary": [{"option": "pose", "values": [1], "unit": "rad"}]})", "must be one of deg"},
            {R"({"vary": [{"option": "pose", "values": [1], "vlaues": [2]}]})",
             R"(/vary/0 has the unknown key "vlaues"; known are name, option, unit, values)"},
            {R"({"vary": [{"option": "pose", "name": "q", "values": [1]}, {"option": "pose", "name": "q", "values": [1]}]})",
             "/vary/1 varies 'pose q', which another one does"},
            {"{" + vary + R"(, "sampling": {"method": "sobol"}})",
             "must be one of grid, list, random, latin_hypercube"},
            {"{" + vary + R"(, "sampling": {"method": "random", "seed": 1}})", R"(/sampling has no "runs")"},
            {"{" + vary + R"(, "sampling": {"method": "random", "runs": 3}})", R"(/sampling has no "seed")"},
            {"{" + vary + R"(, "sampling": {"method": "grid", "runs": 3}})", R"(has the unknown key "runs")"},
            {"{" + vary + R"(, "command": "check"})", R"(/command is "check" and must be one of run, solve)"},
            {"{" + vary + R"(, "options": {"out": "x"}})", "/options/out is \"x\" and cannot be given"},
            {"{" + vary + R"(, "keep": "some"})", "must be one of none, failed, all"},
            {"{" + vary + R"(, "table": [{"columns": "*", "values": ["median"]}]})",
             R"(/table/0/values/0 is "median" and must be one of first, last, min, max, mean)"},
            {"{" + vary + R"(, "threads": 3})", R"(has the unknown key "threads")"},
            {R"({"sampling": {"method": "list"}, "vary": [{"option": "a", "values": [1]}, {"option": "b", "values": [1, 2]}]})",
             "is a list, but 'b' has 2 values and 'a' has 1"}}) {
        const std::string said = refuse(text);
        EXPECT_NE(said.find(words), std::string::npos) << text << "\n" << said;
        EXPECT_NE(said.find("plan.json: "), std::string::npos) << said;
    }
    EXPECT_THROW(readSweepPlan("/nowhere/plan.json"), std::runtime_error);
}

TEST(SweepPlan, MoreRunsThanCanBeAreRefused) {
    std::string vary;
    for (int i = 0; i < 8; ++i)
        vary += (i ? ", " : "") + std::string(R"({"option": "pose", "name": ")") + std::to_string(i) +
                R"(", "from": 0, "to": 1, "count": 10})";
    EXPECT_NE(refuse(R"({"vary": [)" + vary + "]}").find("asks for more than 1000000 runs"), std::string::npos);
}

}  // namespace
}  // namespace tautline::testing
