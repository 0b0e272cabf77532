// SPDX-License-Identifier: Apache-2.0
/** What the README shows is what the project does. */
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace {

using tautline::testing::runProgram;

const std::string kRoot = TAUTLINE_SOURCE_DIR;

std::string readAll(const std::string& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/** A source without the line that names its license. */
std::string readSource(const std::string& file) {
    const std::string text = readAll(file), license = "// SPDX-License-Identifier: Apache-2.0\n";
    EXPECT_EQ(text.rfind(license, 0), 0u) << file;
    return text.substr(license.size());
}

/** Contents of the fenced blocks of a language. */
std::vector<std::string> findBlocks(const std::string& text, const std::string& language) {
    std::vector<std::string> blocks;
    const std::string fence = "```" + language + "\n";
    for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
        const std::size_t begin = at + fence.size(), end = text.find("```", begin);
        blocks.push_back(text.substr(begin, end - begin));
        at = end + 3;
    }
    return blocks;
}

TEST(Readme, ShowsTheExamplesThatAreCompiled) {
    const auto blocks = findBlocks(readAll(kRoot + "/README.md"), "cpp");
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_EQ(blocks[0], readSource(kRoot + "/simbody_adapter/examples/wrapped_muscle.cpp"));
    EXPECT_EQ(blocks[1], readSource(kRoot + "/wrapping_core/examples/over_a_cylinder.cpp"));
}

TEST(Readme, ExampleHoldsTheForearmUp) {
    std::string output;
    ASSERT_EQ(runProgram(TAUTLINE_EXAMPLE, output), 0) << output;
    double angle = 0, length = 0, tension = 0;
    ASSERT_EQ(std::sscanf(output.c_str(), "elbow %lf rad, muscle %lf m, %lf N", &angle, &length, &tension), 3)
        << output;
    EXPECT_GT(tension, 1);
    EXPECT_GT(length, 0.15);
}

TEST(Readme, SaysWhatTheCoreExamplePrints) {
    std::string output;
    ASSERT_EQ(runProgram(TAUTLINE_CORE_EXAMPLE, output), 0) << output;
    EXPECT_NE(readAll(kRoot + "/README.md").find("```\n" + output + "```\n"), std::string::npos) << output;
}

TEST(Readme, CommandsOfTheProgramWork) {
    for (const std::string& block : findBlocks(readAll(kRoot + "/README.md"), "sh")) {
        std::istringstream lines(block);
        for (std::string line; std::getline(lines, line);) {
            const std::string program = "build/bin/tautline";
            if (line.rfind(program, 0) != 0) continue;
            std::string output, arguments = line.substr(program.size());
            // Results of one command may be what another one reads.
            const std::string shown = " results/", ours = " " + ::testing::TempDir() + "tautline_readme/";
            for (std::size_t at = 0; (at = arguments.find(shown, at)) != std::string::npos; at += ours.size())
                arguments.replace(at, shown.size(), ours);
            const std::string runnable = "cd " + kRoot + " && " TAUTLINE_PROGRAM + arguments;
            EXPECT_EQ(runProgram(runnable, output), 0) << runnable << "\n" << output;
        }
    }
}

TEST(Readme, NamesFilesThatExist) {
    for (const char* file :
         {"/models/run", "/tests/run", "/models/figures/path.svg", "/plugin/report/four_surfaces.png",
          "/plugin/guide/README.md", "/models/elbow.osim", "/models/paraboloid.osim",
          "/models/four_surfaces_implicit.osim", "/models/four_surfaces_parametric.osim",
          "/models/figures/paraboloid_curves.svg", "/models/figures/four_surfaces_curves.svg",
          "/models/figures/four_surfaces_start.svg", "/models/README.md", "/bench/README.md",
          "/wrapping_core/NOTATION.md", "/tests/support/weave_scene.h", "/tests/core/weave_test.cpp"})
        EXPECT_TRUE(std::ifstream(kRoot + file).good()) << file;
}

}  // namespace
