// SPDX-License-Identifier: Apache-2.0
/** The tautline program as a user runs it. */
#include <Simbody.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "program_support.h"
#include "support/shared_data.h"

namespace tautline {
namespace {

using testing::makeFolder;
using testing::Outcome;
using testing::readAll;
using testing::runTautline;

const std::string kElbow = TAUTLINE_SOURCE_DIR "/models/elbow.osim";

TEST(Program, AnswersHelpAndVersion) {
    EXPECT_EQ(runTautline("--help").exitCode, 0);
    EXPECT_NE(runTautline("run --help").text.find("--duration"), std::string::npos);
    const Outcome version = runTautline("--version");
    EXPECT_EQ(version.exitCode, 0);
    EXPECT_EQ(version.text.substr(0, 9), "tautline ");
}

TEST(Program, RefusesAWrongCommandOrOptionWithANonZeroExit) {
    for (const char* arguments :
         {"", "jump", "run", "run --durration 1 x.osim", "run x.osim --duration -1", "run x.osim --duration soon"}) {
        const Outcome outcome = runTautline(arguments);
        EXPECT_NE(outcome.exitCode, 0) << arguments;
        EXPECT_FALSE(outcome.text.empty()) << arguments;
    }
}

// 2026-11-25: the first aborted, the next three went on with exit 0 or a limit of 300 digits, the last overflowed an
// int.
TEST(Program, RefusesNumbersThatAreNoneOrOutOfRangeByNameAndLimit) {
    const std::pair<const char*, const char*> cases[] = {
        {"--accuracy nan", "--accuracy is nan, but must be in [1e-14, 0.1]"},
        {"--duration nan", "--duration is nan, but must be above 0 and at most 1000000 s"},
        {"--interval nan", "--interval is nan, but must be above 0 and finite"},
        {"--duration inf", "--duration is inf, but must be above 0 and at most 1000000 s"},
        {"--interval 1e-300", " rows of the duration of 1 s, but there may be at most 10000000"},
        {"--accuracy 0.5", "--accuracy is 0.5, but must be in [1e-14, 0.1]"},
        {"--accuracy 0", "--accuracy is 0, but must be in"},
        {"--accuracy=-inf", "--accuracy is -inf, but must be in"},
        {"--duration 0", "--duration is 0, but must be above 0"},
        {"--duration 2e6", "--duration is 2000000, but must be above 0 and at most 1000000 s"},
        {"--interval 0", "--interval is 0, but must be above 0 and finite"},
        {"--interval inf", "--interval is inf, but must be above 0 and finite"}};
    for (const auto& [option, message] : cases) {
        const Outcome outcome = runTautline("run " + kElbow + " " + option);
        EXPECT_EQ(outcome.exitCode, 1) << option;
        EXPECT_NE(outcome.text.find(message), std::string::npos) << option << ": " << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    }
}

TEST(Program, NamesAMissingFileInOneLine) {
    const Outcome outcome = runTautline("run no_such_model.osim");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.text.find("no_such_model.osim"), std::string::npos);
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
}

TEST(Program, BadInputLeavesNoResults) {
    const std::filesystem::path folder = makeFolder("refused");
    const Outcome outcome = runTautline("run " + kElbow + " --excitation soleus=1 --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(Program, LeavesOutWhatItIsToldToIgnoreAndSaysWhatThatChanges) {
    const std::string file = TAUTLINE_SOURCE_DIR "/models/rejected/unknown_force.osim";
    const std::string options = " --duration 0.01 --out " + makeFolder("ignored").string();
    const Outcome refused = runTautline("run " + file + options);
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_NE(refused.text.find("unknown force ElasticFoundationForce 'floor'"), std::string::npos) << refused.text;
    for (const char* ignored : {"floor", "ElasticFoundationForce"}) {
        const Outcome read = runTautline("run " + file + options + " --ignore " + ignored);
        EXPECT_EQ(read.exitCode, 0) << read.text;
        EXPECT_NE(read.text.find("left out, changes forces:\n  ignored as asked: 1 ElasticFoundationForce in ForceSet"),
                  std::string::npos)
            << read.text;
        EXPECT_EQ(read.text.find("changes nothing"), std::string::npos) << "nothing of that kind is in the file";
    }
}

TEST(Program, RefusesAStartInGimbalLock) {
    const Outcome outcome = runTautline("run " TAUTLINE_SOURCE_DIR "/models/accepted/singular_start.osim --out " +
                                        makeFolder("singular").string());
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.text.find("coordinate 'rz' is at 0.000000 where it moves nothing"), std::string::npos)
        << outcome.text;
}

TEST(Program, SimulatesTheElbowAndWritesStorageFiles) {
    const std::filesystem::path folder = makeFolder("elbow");
    const Outcome outcome = runTautline("run " + kElbow + " --duration 0.2 --out " + folder.string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("excitation: 0.05 for all"), std::string::npos) << outcome.text;
    const StorageTable states = readStorage(folder / "states.sto"), paths = readStorage(folder / "paths.sto");
    ASSERT_EQ(states.rows.size(), 21u);
    ASSERT_EQ(paths.rows.size(), 21u);
    EXPECT_EQ(states.rows.back()[0], 0.2);
    const auto column = [&paths](const std::string& label) {
        const auto at = std::find(paths.labels.begin(), paths.labels.end(), label);
        EXPECT_NE(at, paths.labels.end()) << label;
        return static_cast<std::size_t>(at - paths.labels.begin());
    };
    // The rate is the slope of the length: central differences over 0.02 s, smooth motion.
    const std::size_t length = column("/forceset/triceps_long|length"), rate = column("/forceset/triceps_long|rate");
    for (std::size_t k = 5; k + 1 < paths.rows.size(); ++k)
        EXPECT_NEAR((paths.rows[k + 1][length] - paths.rows[k - 1][length]) / 0.02, paths.rows[k][rate], 2e-3);
    EXPECT_GT(paths.rows.back()[column("/forceset/triceps_long|tension")], 0);
    EXPECT_EQ(readAll(folder / "events.csv").substr(0, 38), "time,path,obstacle,kind,length_change\n");
}

TEST(Program, ASecondRunGivesTheSameFilesBitForBit) {
    const std::filesystem::path first = makeFolder("first"), second = makeFolder("second");
    const std::string command = "run " + kElbow + " --duration 0.3 --excitation brachialis=0.4 --out ";
    ASSERT_EQ(runTautline(command + first.string()).exitCode, 0);
    ASSERT_EQ(runTautline(command + second.string()).exitCode, 0);
    for (const char* name : {"states.sto", "paths.sto", "events.csv"})
        EXPECT_EQ(readAll(first / name), readAll(second / name)) << name;
}

TEST(Program, ExcitationMovesTheArm) {
    const std::filesystem::path weak = makeFolder("weak"), strong = makeFolder("strong");
    ASSERT_EQ(runTautline("run " + kElbow + " --duration 0.3 --out " + weak.string()).exitCode, 0);
    ASSERT_EQ(
        runTautline("run " + kElbow + " --duration 0.3 --excitation brachialis=1 --out " + strong.string()).exitCode,
        0);
    const StorageTable a = readStorage(weak / "states.sto"), b = readStorage(strong / "states.sto");
    std::size_t elbow = 0;
    for (std::size_t i = 0; i < a.labels.size(); ++i)
        if (a.labels[i].find("elbow") != std::string::npos && a.labels[i].find("/value") != std::string::npos)
            elbow = i;
    ASSERT_GT(elbow, 0u);
    EXPECT_GT(b.rows.back()[elbow], a.rows.back()[elbow] + 0.05);
}

TEST(Program, DrawsCurvesWithGnuplot) {
    const std::filesystem::path folder = makeFolder("curves");
    const Outcome outcome = runTautline("run " TAUTLINE_SOURCE_DIR
                                        "/models/four_surfaces_parametric.osim --duration 1.5 "
                                        "--interval 0.1 --plot --out " +
                                        folder.string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_EQ(outcome.text.find("warning"), std::string::npos) << outcome.text;
    const std::string curves = readAll(folder / "curves_string.svg"), start = readAll(folder / "start_string.svg");
    for (const char* title : {"length [m]", "rate [m/s]", "signed distance d [m]", "over_ellipsoid", "</svg>"})
        EXPECT_NE(curves.find(title), std::string::npos) << title;
    for (const char* title : {"path errors over iterations", "through_torus", "</svg>"})
        EXPECT_NE(start.find(title), std::string::npos) << title;
    // As often as the script is run.
    EXPECT_EQ(std::system(("cd '" + folder.string() + "' && rm *.svg && gnuplot curves.gp").c_str()), 0);
    EXPECT_EQ(readAll(folder / "curves_string.svg"), curves);
}

TEST(Program, SaysThatGnuplotIsMissingBeforeItSimulates) {
    const std::filesystem::path folder = makeFolder("no_gnuplot");
    std::string text;
    const std::string command = "PATH=/nowhere " TAUTLINE_PROGRAM " run " + kElbow + " --plot --out " + folder.string();
    EXPECT_EQ(testing::runProgram(command, text), 1);
    EXPECT_NE(text.find("--plot needs gnuplot"), std::string::npos) << text;
    EXPECT_FALSE(std::filesystem::exists(folder));
}

using Edits = std::vector<std::pair<std::string, std::string>>;

/** One of our models with some things in it replaced: the first place of each. */
std::string writeEditedModel(const std::string& name, const Edits& edits) {
    std::string text = readAll(TAUTLINE_SOURCE_DIR "/models/" + name);
    for (const auto& [from, to] : edits) {
        EXPECT_NE(text.find(from), std::string::npos) << from;
        text.replace(text.find(from), from.size(), to);
    }
    // Tests run side by side.
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    const std::filesystem::path file =
        std::filesystem::path(::testing::TempDir()) / (test + "_" + std::filesystem::path(name).filename().string());
    std::ofstream(file) << text;
    return file.string();
}

TEST(Program, AStartThatLeadsNowhereEndsTheRun) {
    // The string laid through the torus the wrong way. (Laid along the ring it finds its way, 2026-11-25.)
    const std::string file = writeEditedModel("four_surfaces_implicit.osim",
                                              {{"<direction>-0.4 0 1</direction>", "<direction>0.4 0 -1</direction>"}});
    const std::filesystem::path folder = makeFolder("no_start");
    const Outcome outcome = runTautline("run " + file + " --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.text.find("tautline: path 'string': the start that the model gives leads to no shortest path"),
              std::string::npos)
        << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(folder / "paths.sto"));
}

TEST(Program, TheLastOfTwoEqualOptionsCounts) {
    const std::filesystem::path folder = makeFolder("last");
    const Outcome outcome = runTautline(
        "run " TAUTLINE_SOURCE_DIR "/models/paraboloid.osim --duration 1 --duration 0.5 --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_EQ(readStorage(folder / "paths.sto").rows.back()[0], 0.5);
}

/** A ring that is nearly closed: a string through it touches it on both sides, which one arc cannot say. */
/** A string in the groove between two spheres that overlap. */
TEST(Program, DegradedStepsMakeItFailUnlessTheyAreAllowed) {
    const auto makeSphere = [](const std::string& name, const std::string& z) {
        return "<WrapSphere name=\"" + name + "\"><translation>0 0 " + z +
               "</translation><radius>0.025</radius></WrapSphere>";
    };
    const std::string file =
        writeEditedModel("accepted/torus_beside_the_line.osim",
                         {{"<WrapTorus name=\"c\"><xyz_body_rotation>1.5707963267948966 0 0</xyz_body_rotation>"
                           "<inner_radius>0.004</inner_radius><outer_radius>0.01</outer_radius></WrapTorus>",
                           makeSphere("c", "0.018") + makeSphere("d", "-0.018")},
                          {"<PathWrap name=\"w\"><wrap_object>c</wrap_object></PathWrap>",
                           "<PathWrap name=\"w\"><wrap_object>c</wrap_object></PathWrap>"
                           "<PathWrap name=\"v\"><wrap_object>d</wrap_object></PathWrap>"},
                          {"<location>0.015 0.1 0</location>", "<location>0.03 0.2 0</location>"},
                          {"<location>0.015 -0.1 0</location>", "<location>-0.01 -0.2 0</location>"}});
    const std::string command = "run " + file + " --duration 0.05 --out " + makeFolder("degraded").string();
    const Outcome refused = runTautline(command);
    EXPECT_EQ(refused.exitCode, 3) << refused.text;
    EXPECT_NE(refused.text.find("steps without a verified minimum; first at "), std::string::npos) << refused.text;
    EXPECT_NE(refused.text.find("not_minimum"), std::string::npos) << refused.text;
    EXPECT_EQ(runTautline(command + " --allow-degraded").exitCode, 0);
}

/** The rising paraboloid swallows the string's origin: as in OpenSim it is switched off, and that is no fault. */
TEST(Program, AWrapThatAPointEntersIsSwitchedOffByAnEvent) {
    const std::string file =
        writeEditedModel("paraboloid.osim", {{"<location>-10 2.5 0</location>", "<location>-3 0.5 0</location>"}});
    const std::filesystem::path folder = makeFolder("swallowed");
    const Outcome outcome = runTautline("run " + file + " --duration 2.4 --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("note: string: a wrap object was switched off or on 1 time"), std::string::npos)
        << outcome.text;
    std::istringstream events(readAll(folder / "events.csv"));
    std::string header, made, off, more;
    std::getline(events, header), std::getline(events, made), std::getline(events, off), std::getline(events, more);
    EXPECT_NE(made.find(",touchdown,"), std::string::npos) << made;
    EXPECT_EQ(more, "");
    // The origin at x = -3, y = 0.5 is below the surface once its top is higher than 9/14 + 0.25/6.
    const double height = 9.0 / 14 + 0.25 / 6, time = 5 / (2 * SimTK::Pi) * std::acos(-(height + 0.5) / 3);
    double found = 0, change = 0;
    ASSERT_EQ(std::sscanf(off.c_str(), "%lf,/forceset/string,paraboloid,switched_off,%lf", &found, &change), 2) << off;
    EXPECT_NEAR(found, time, 1e-6);
    EXPECT_LT(change, -1e-4);
}

/** An ellipsoid that rises under a string, in its plane of symmetry, in place of the paraboloid. */
const Edits kRisingEllipsoid = {{"TautlineWrapParaboloid name=", "WrapEllipsoid name="},
                                {"<tautline_form>parametric</tautline_form>", ""},
                                {"<a>14</a>", "<dimensions>0.5 0.2 0.5</dimensions>"},
                                {"<b>6</b>", ""},
                                {"</TautlineWrapParaboloid>", "</WrapEllipsoid>"},
                                {"3.141592653589793 0 0", "0 0 0"},
                                {"<amplitude>3</amplitude>", "<amplitude>0.5</amplitude>"},
                                {"<omega>1.2566370614359172</omega>", "<omega>1</omega>"},
                                {"<phase>-1.5707963267948966</phase>", "<phase>0</phase>"},
                                {"<offset>-0.5</offset>", "<offset>-0.6</offset>"},
                                {"<location>-10 2.5 0</location>", "<location>-1 0 0</location>"},
                                {"<location>10 -1.5 1</location>", "<location>1 0 0</location>"}};

TEST(Program, ASlipIsARowOfTheEventsAndALineOfTheReport) {
    const std::string file = writeEditedModel("paraboloid.osim", kRisingEllipsoid);
    const std::filesystem::path folder = makeFolder("slip");
    const Outcome outcome = runTautline("run " + file + " --duration 1.5 --out " + folder.string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("note: string: 1 slip, shorter by"), std::string::npos) << outcome.text;
    std::istringstream events(readAll(folder / "events.csv"));
    std::string header, made, slipped;
    std::getline(events, header), std::getline(events, made), std::getline(events, slipped);
    EXPECT_NE(made.find(",touchdown"), std::string::npos) << made;
    ASSERT_NE(slipped.find(",slipped"), std::string::npos) << slipped;
    // The sideways field along the circle of radius 0.5, cos(s/c) from its top, comes to zero at the string's ends, m
    // from the arc: tan(s/c) = c/m.
    const double c = 0.2, y = 0.6 - 0.5 * std::sin(std::stod(slipped)), far = std::hypot(1, y);
    const double half = 0.5 * (std::atan2(1, y) - std::acos(0.5 / far)), m = std::sqrt(far * far - 0.25);
    EXPECT_NEAR(half / c, std::atan2(c, m), 1e-4);
}

TEST(DataProgram, SimulatesASecondOfTheRealArm) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const std::filesystem::path folder = makeFolder("arm26");
    const Outcome outcome = runTautline("run " + (shared / "data/opensim/models/arm26.osim").string() +
                                        " --duration 1 --out " + folder.string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("Thelen2003Muscle: the muscle model of Thelen (2003)"), std::string::npos);
    const StorageTable paths = readStorage(folder / "paths.sto");
    EXPECT_EQ(paths.rows.size(), 101u);
    for (const auto& row : paths.rows)
        for (double value : row) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace tautline
