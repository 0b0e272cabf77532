// SPDX-License-Identifier: Apache-2.0
#include "excitations.h"

#include <gtest/gtest.h>

#include <fstream>

namespace tautline {
namespace {

const std::vector<std::string> kMuscles = {"biceps", "triceps"};

void expectRefused(const ExcitationOptions& options, const std::string& message) {
    int numDefault;
    std::vector<std::string> notes;
    try {
        makeExcitations(options, kMuscles, numDefault, notes);
        FAIL() << "not refused: " << message;
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
}

std::filesystem::path makeFile(const std::string& rows) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "tautline_excitations_test.sto";
    std::ofstream(file) << "controls\nendheader\n" << rows;
    return file;
}

TEST(Excitations, AreTheDefaultUnlessGiven) {
    int numDefault;
    std::vector<std::string> notes;
    const auto excitations = makeExcitations({{"triceps=0.5"}, {}}, kMuscles, numDefault, notes);
    EXPECT_EQ(numDefault, 1);
    EXPECT_EQ(excitations.at("biceps")(0.3), kDefaultExcitation);
    EXPECT_EQ(excitations.at("triceps")(0.3), 0.5);
}

TEST(Excitations, FromAFileAreLinearAndConstantOutside) {
    int numDefault;
    std::vector<std::string> notes;
    const auto excitations =
        makeExcitations({{}, makeFile("time\t/forceset/biceps\n1\t0.2\n2\t0.6\n")}, kMuscles, numDefault, notes);
    EXPECT_EQ(numDefault, 1);
    EXPECT_EQ(excitations.at("biceps")(0), 0.2);
    EXPECT_DOUBLE_EQ(excitations.at("biceps")(1.25), 0.3);
    EXPECT_EQ(excitations.at("biceps")(9), 0.6);
}

TEST(Excitations, OfTheCommandLineWinOverTheFile) {
    int numDefault;
    std::vector<std::string> notes;
    const auto excitations =
        makeExcitations({{"biceps=1"}, makeFile("time biceps\n0 0.2\n")}, kMuscles, numDefault, notes);
    EXPECT_EQ(excitations.at("biceps")(0), 1);
}

TEST(Excitations, PatternsComeBeforeNamesAndTheLastPatternWins) {
    int numDefault;
    std::vector<std::string> notes;
    const auto excitations = makeExcitations({{"biceps=0.9", "*=0.1", "?riceps=0.2"}, {}}, kMuscles, numDefault, notes);
    EXPECT_EQ(numDefault, 0);
    EXPECT_EQ(excitations.at("biceps")(0), 0.9);
    EXPECT_EQ(excitations.at("triceps")(0), 0.2);
}

TEST(Excitations, OfAFileAreClippedWithANoteAndOtherColumnsNotUsedWithAnother) {
    int numDefault;
    std::vector<std::string> notes;
    const auto file = makeFile("time FX /forceset/biceps triceps.excitation\n0 7 -0.1 0.5\n1 7 1.5 0.5\n2 7 nan 0.5\n");
    const auto excitations = makeExcitations({{}, file}, kMuscles, numDefault, notes);
    EXPECT_EQ(numDefault, 0);
    EXPECT_EQ(excitations.at("biceps")(0), 0.0);
    EXPECT_EQ(excitations.at("biceps")(0.5), 0.5);
    EXPECT_EQ(excitations.at("biceps")(1), 1.0);
    EXPECT_EQ(excitations.at("biceps")(2), 0.0);
    EXPECT_EQ(excitations.at("triceps")(1.5), 0.5);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0], file.string() + ": of no muscle and not used: FX");
    EXPECT_EQ(notes[1], file.string() + ": excitations outside [0, 1] are clipped: biceps (3 of 3)");
}

TEST(Excitations, FromAControlSetAreStepsOrLinesKeptInTheUnitInterval) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "tautline_controls_test.xml";
    const auto makeNode = [](const char* t, const char* value) {
        return std::string("<ControlLinearNode><t>") + t + "</t><value>" + value + "</value></ControlLinearNode>";
    };
    std::ofstream(file) << "<OpenSimDocument Version=\"30000\"><ControlSet name=\"c\"><objects>"
                        << "<ControlLinear name=\"biceps.excitation\"><use_steps>true</use_steps><x_nodes>"
                        << makeNode("0", "0.1") << makeNode("1", "0.6") << makeNode("2", "1.3")
                        << "</x_nodes></ControlLinear><ControlLinear name=\"triceps\"><x_nodes>" << makeNode("0", "0.2")
                        << makeNode("1", "0.4") << "</x_nodes></ControlLinear>"
                        << "<ControlConstant name=\"hand\"><value>1</value></ControlConstant></objects></ControlSet>"
                        << "</OpenSimDocument>";
    int numDefault;
    std::vector<std::string> notes;
    const auto excitations = makeExcitations({{}, file}, kMuscles, numDefault, notes);
    EXPECT_EQ(numDefault, 0);
    EXPECT_EQ(excitations.at("biceps")(0.5), 0.6);
    EXPECT_EQ(excitations.at("biceps")(1.5), 1.0);
    EXPECT_NEAR(excitations.at("triceps")(2), 0.6, 1e-15);
    EXPECT_EQ(excitations.at("triceps")(9), 1.0) << "the line goes on to 2";
    EXPECT_EQ(excitations.at("triceps")(-9), 0.0);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0], file.string() + ": of no muscle and not used: hand");
    EXPECT_EQ(notes[1], file.string() + ": excitations outside [0, 1] are clipped: biceps (1 of 3)");
}

TEST(Excitations, BadOnesAreRefusedByName) {
    expectRefused({{"biceps"}, {}}, "'biceps' is not of the form NAME=VALUE");
    expectRefused({{"=1"}, {}}, "NAME=VALUE");
    expectRefused({{"biceps="}, {}}, "'' is not a number");
    expectRefused({{"biceps=high"}, {}}, "'high' is not a number");
    expectRefused({{"biceps=1.5"}, {}}, "an excitation lies in [0, 1]");
    expectRefused({{"biceps=nan"}, {}}, "an excitation lies in [0, 1]");
    expectRefused({{"soleus=0.1"}, {}}, "no muscle 'soleus'; it has biceps, triceps");
    expectRefused({{"biceps=0.1", "biceps=0.2"}, {}}, "given twice");
    expectRefused({{}, "controls.xml"}, "controls.xml: the file cannot be read");
    expectRefused({{"sol*=0.1"}, {}}, "no muscle 'sol*'; it has biceps, triceps");
    expectRefused({{}, makeFile("time soleus\n0 0.1\n")},
                  "nothing in it is a muscle of the model; it has biceps, triceps");
}

}  // namespace
}  // namespace tautline
