// SPDX-License-Identifier: Apache-2.0
/** models/over_bones.py as a user runs it on OpenSim's files: it ends with a message where a path is not solved. */
#include <cmath>
#include <sstream>

#include "program_support.h"
#include "support/shared_data.h"

namespace tautline::testing {
namespace {

Outcome runStudy(const std::filesystem::path& shared, const std::string& study) {
    const std::filesystem::path data = shared / "data/opensim", out = makeFolder("over_bones_" + study);
    Outcome outcome;
    outcome.exitCode = runProgram("python3 " TAUTLINE_SOURCE_DIR "/models/over_bones.py " + (data / "models").string() +
                                      " " + (data / "geometry").string() + " --study " + study +
                                      " --program " TAUTLINE_PROGRAM " --out " + out.string(),
                                  outcome.text);
    return outcome;
}

/** The numbers of the rows of a printed table, below the line that begins with `heading`. */
std::vector<std::vector<double>> readRows(const std::string& text, const std::string& heading) {
    std::istringstream lines(text.substr(text.find("\n" + heading) + 1));
    std::string line;
    std::getline(lines, line);
    std::vector<std::vector<double>> rows;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        std::vector<double> row;
        for (std::string word; words >> word;)
            if (word != "s") row.push_back(std::stod(word));
        rows.push_back(row);
    }
    return rows;
}

// Where neither is touched both models say the same; over the bone the muscle comes nearer to the axis.
TEST(DataOverBones, TricepsComesNearerToTheElbowOverTheHumerusThanOverItsCylinder) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const Outcome outcome = runStudy(shared, "triceps");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    const auto rows = readRows(outcome.text, "flexion");
    ASSERT_EQ(rows.size(), 7u) << outcome.text;
    for (const std::vector<double>& row : rows) {  // degrees; lengths and moment arms [mm]; contacts
        ASSERT_EQ(row.size(), 7u);
        if (row[5] == 0 && row[6] == 0) {
            EXPECT_EQ(row[1], row[2]) << row[0];
            EXPECT_EQ(row[3], row[4]) << row[0];
        } else {
            EXPECT_LT(row[2], row[1]) << row[0];
            EXPECT_LT(std::abs(row[4]), std::abs(row[3])) << row[0];
        }
    }
    EXPECT_EQ(rows.back()[5], 1) << outcome.text;
}

TEST(LongDataOverBones, LatissimusOverTheWholeChestIsAsLongAsOverThePatchAndDoesNotJump) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const Outcome outcome = runStudy(shared, "latissimus");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.text;
    for (const std::string model : {"latissimus_patch", "latissimus_chest"}) {
        const std::string words = model + ": the rate explains each step of each length to ";
        const std::size_t at = outcome.text.find(words);
        ASSERT_NE(at, std::string::npos) << outcome.text;
        EXPECT_LT(std::stod(outcome.text.substr(at + words.size())), 1e-6);
    }
    const auto rows = readRows(outcome.text, "time");
    ASSERT_EQ(rows.size(), 6u) << outcome.text;
    for (const std::vector<double>& row : rows) {  // s; mean lengths [mm], mean rates [mm/s]
        EXPECT_NEAR(row[1], row[2], 0.3) << row[0];
        EXPECT_NEAR(row[3], row[4], 0.1) << row[0];
    }
}

}  // namespace
}  // namespace tautline::testing
