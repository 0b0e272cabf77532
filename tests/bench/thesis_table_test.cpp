// SPDX-License-Identifier: Apache-2.0
/** The program of the thesis's benchmark, run as a user runs it. */
#include <gtest/gtest.h>

#include <sstream>

#include "support/run_program.h"

namespace tautline::testing {
namespace {

TEST(ThesisTable, SolvesEveryStepWithinTheToleranceInAllForms) {
    std::string output;
    EXPECT_EQ(runProgram(TAUTLINE_THESIS_TABLE_PROGRAM " --duration 0.4 --most 100", output), 0) << output;
    std::istringstream lines(output);
    std::string line, word;
    std::getline(lines, line);
    int numRows = 0;
    for (; std::getline(lines, line); ++numRows) {
        std::istringstream words(line.substr(line.find("  ", 15)));  // after the form
        double factor = 0, pathError = 1, lengthError = 1, iterations = 0;
        words >> factor >> pathError >> lengthError >> iterations;
        EXPECT_TRUE(factor > 0 && iterations >= 1) << line;
        EXPECT_LT(pathError, 1e-3) << line;
        EXPECT_LT(lengthError, line.find("implicit, integrated") == std::string::npos ? 1e-8 : 0.05) << line;
    }
    EXPECT_EQ(numRows, 4) << output;
    EXPECT_NE(runProgram(TAUTLINE_THESIS_TABLE_PROGRAM " --most 50", output), 0);
}

}  // namespace
}  // namespace tautline::testing
