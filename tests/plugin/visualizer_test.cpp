// SPDX-License-Identifier: Apache-2.0
/** The window of Simbody's visualizer, or a clear line where there is none. */
#include <unistd.h>

#include "program_support.h"

namespace tautline::testing {
namespace {

/** What is said goes into a file: a window that stays open would keep a pipe open, too. */
Outcome runWith(const std::string& environment, const std::filesystem::path& folder, double duration = 0.2) {
    const std::filesystem::path said = folder.string() + ".txt";
    Outcome outcome;
    outcome.exitCode = runProgram(
        "env " + environment +
            " timeout 100 " TAUTLINE_PROGRAM " run " TAUTLINE_SOURCE_DIR "/models/elbow.osim --visualize --duration " +
            std::to_string(duration) + " --out " + folder.string() + " >" + said.string() + " 2>&1",
        outcome.text);
    outcome.text = readAll(said);
    return outcome;
}

TEST(Visualizer, IsMissedInALineBeforeAnythingIsRun) {
    const std::filesystem::path folder = makeFolder("no_visualizer");
    const Outcome outcome = runWith("SIMBODY_VISUALIZER_NAME=no-such-program SIMBODY_HOME=/no/where", folder);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.countLines(), 1) << outcome.text;
    EXPECT_TRUE(outcome.has("--visualize: there is no no-such-program in ")) << outcome.text;
    EXPECT_TRUE(outcome.has("/no/where/libexec/simbody")) << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(Visualizer, NeedsADisplay) {
    const std::filesystem::path folder = makeFolder("no_display");
    const Outcome outcome = runWith("-u DISPLAY", folder);
    if (outcome.has("there is no simbody-visualizer")) GTEST_SKIP() << outcome.text;
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.text, "tautline: --visualize: there is no display to show a window on (DISPLAY is not set)\n");
    EXPECT_FALSE(std::filesystem::exists(folder));
}

/** A display without a screen, as long as it lives: one of its own for each process, since tests run side by side. */
class Display {
public:
    Display() : m_name(":" + std::to_string(100 + getpid() % 900)) {
        const std::string socket = "/tmp/.X11-unix/X" + m_name.substr(1);
        runProgram("Xvfb " + m_name + " -screen 0 640x480x24 >/dev/null 2>&1 & echo $!; for i in $(seq 100); do [ -e " +
                       socket + " ] && break; sleep 0.1; done",
                   m_process);
    }
    Display(const Display&) = delete;
    ~Display() {
        std::string ignored;
        runProgram("kill " + std::to_string(std::stoi(m_process)), ignored);
    }
    std::string getVariable() const { return "DISPLAY=" + m_name; }

private:
    std::string m_name, m_process;
};

class VisualizerWindow : public ::testing::Test {
protected:
    void SetUp() override {
        std::string output;
        if (runProgram("command -v Xvfb", output) != 0) GTEST_SKIP() << "Xvfb is not installed";
    }
};

TEST_F(VisualizerWindow, FollowsARunWithoutChangingIt) {
    const Display display;
    const std::filesystem::path plain = makeFolder("not_visualized"), shown = makeFolder("visualized");
    runTautline("run " TAUTLINE_SOURCE_DIR "/models/elbow.osim --duration 0.2 --out " + plain.string());
    const Outcome outcome = runWith(display.getVariable(), shown);
    if (outcome.has("there is no simbody-visualizer")) GTEST_SKIP() << outcome.text;
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_EQ(readAll(shown / "states.sto"), readAll(plain / "states.sto"));
    EXPECT_FALSE(outcome.has("was closed before the end")) << outcome.text;
}

TEST_F(VisualizerWindow, MayBeClosedBeforeTheRunEnds) {
    const Display display;
    const std::filesystem::path folder = makeFolder("closed"), said = folder.string() + ".txt";
    std::string output;
    const int exitCode = runProgram(display.getVariable() +
                                        " " TAUTLINE_PROGRAM " run " TAUTLINE_SOURCE_DIR
                                        "/models/elbow.osim --visualize --duration 6 --out " +
                                        folder.string() + " >" + said.string() +
                                        " 2>&1 & run=$!; for i in $(seq 60); do sleep 0.25; window=$(pgrep -P $run "
                                        "simbody) && break; kill -0 $run || break; done; "
                                        "sleep 1; kill $window; (sleep 60; kill $run) >/dev/null 2>&1 & wait $run",
                                    output);
    if (readAll(said).find("there is no simbody-visualizer") != std::string::npos) GTEST_SKIP() << readAll(said);
    EXPECT_EQ(exitCode, 0) << readAll(said);
    EXPECT_NE(readAll(said).find("note: the window of the visualizer was closed before the end"), std::string::npos)
        << readAll(said);
    EXPECT_TRUE(std::filesystem::exists(folder / "states.sto"));
}

}  // namespace
}  // namespace tautline::testing
