// SPDX-License-Identifier: Apache-2.0
/** The program that compares Tautline with its peers, run as a user runs it: what is timed is the same path for all. */
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "support/run_program.h"
#include "support/shared_data.h"

namespace tautline::testing {
namespace {

/** Runs a few poses of each scene. */
std::string runCompare(const std::string& options) {
    std::string text;
    EXPECT_EQ(runProgram(TAUTLINE_COMPARE_PROGRAM " --poses 6 --rounds 1 " + options, text), 0) << text;
    return text;
}

/** The last number of each row of a way that is not the first of its scene. */
std::vector<double> listErrors(const std::string& text, const std::string& way) {
    std::istringstream lines(text);
    std::vector<double> errors;
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t at = line.find_first_not_of(' '); at != std::string::npos && line.rfind(way, at) == at)
            errors.push_back(std::stod(line.substr(line.rfind(' ') + 1)));
    return errors;
}

/** Of lengths of 2.5 to 100 m. Each way is measured at what it is: CablePath's own tolerance cannot be set, and leaves
1e-6 of each arc (CablePathRegression); MuJoCo's is a closed form. */
TEST(CompareProgram, AllWaysFindTheSameLengths) {
    const std::string text = runCompare("");
    const auto expectErrors = [&](const std::string& way, double limit, std::size_t count) {
        const std::vector<double> errors = listErrors(text, way);
        EXPECT_EQ(errors.size(), count) << way;
        for (const double error : errors) EXPECT_LT(error, limit) << way;
    };
    expectErrors("through Simbody", 1e-5, 6);
    expectErrors("SimTK::CablePath", 1e-4, 5);
#if TAUTLINE_HAS_MUJOCO
    expectErrors("MuJoCo's tendon", 1e-12, 5);
#endif
}

TEST(DataCompareProgram, FittedPolynomialsAreNearTheExactPaths) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const std::filesystem::path data = shared / "data" / "opensim";
    const std::string text = runCompare("--fitted " + (data / "models" / "subject_walk_scaled.osim").string() + " " +
                                        (data / "motions" / "example3DWalking_coordinates.sto").string() + " " +
                                        (data / "reference" / "subject_walk_scaled_FunctionBasedPathSet.xml").string());
    const std::size_t row = text.find("fitted polynomials");
    ASSERT_NE(row, std::string::npos) << text;
    EXPECT_NE(text.find("80 paths, 1350 frames"), std::string::npos) << text;
    std::istringstream numbers(text.substr(row + std::string("fitted polynomials").size()));
    double time = 0, ratio = 0, length = 0, most = 0, arm = 0;
    char comma = 0;
    ASSERT_TRUE(numbers >> time >> ratio >> length >> comma >> most >> arm) << text;
    EXPECT_LT(length, 0.2);  // median [mm]
    EXPECT_GT(most, length);
    EXPECT_LT(arm, 0.5);
}

TEST(CompareProgram, RefusesAFileThatIsNotThereByItsName) {
    std::string text;
    EXPECT_NE(runProgram(TAUTLINE_COMPARE_PROGRAM " --fitted no_such.osim a.sto b.xml", text), 0);
    EXPECT_NE(text.find("no_such.osim"), std::string::npos) << text;
}

}  // namespace
}  // namespace tautline::testing
