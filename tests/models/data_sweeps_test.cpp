// SPDX-License-Identifier: Apache-2.0
/** Sweeps over each coordinate of the field's models: lengths jump only where something says why. */
#include <gtest/gtest.h>

#include "support/model_sweep.h"
#include "support/shared_data.h"
#include "tautline/models/osim_reader.h"

namespace tautline::testing {
namespace {

SweepReport sweepModel(const char* name, int steps) {
    return ModelSweep(
               models::readOsimFile(findSharedFolder() / "data" / "opensim" / "models" / (std::string(name) + ".osim"),
                                    {{}, true}))
        .run(steps);
}

void expectWalkedAsAlone(const SweepReport& report) {
    EXPECT_GT(report.numPoses, 40);
    for (const WalkMiss& miss : report.misses)
        ADD_FAILURE() << miss.path << " at " << miss.coordinate << " = " << miss.value << ": walked " << miss.walked
                      << " m, alone " << miss.alone << " m";
}

class DataSweeps : public ::testing::TestWithParam<const char*> {};

TEST_P(DataSweeps, LengthsJumpOnlyWhereARuleOrTheStringHasThem) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const SweepReport report = sweepModel(GetParam(), 24);
    expectWalkedAsAlone(report);
    for (const LengthJump& jump : report.jumps)
        EXPECT_TRUE(isExplained(jump.cause)) << jump.path << " jumps by " << jump.after - jump.before << " m at "
                                             << jump.coordinate << " = " << jump.value << ": " << jump.detail;
}

INSTANTIATE_TEST_SUITE_P(, DataSweeps,
                         ::testing::Values("arm26", "gait2392_thelen2003muscle", "walk_gait1018_subject01",
                                           "Rajagopal2016", "RajagopalLaiUhlrich2023", "subject_walk_scaled"),
                         [](const auto& tested) { return std::string(tested.param); });

/** The ranges of its coordinates lead bones far into its rib cage, an ellipsoid about whose three axes a string has as
many minima: which of them a search finds still changes from pose to pose there, but not with the pose before. */
TEST(DataSweepsOfTheShoulder, WalkedIsAsAlone) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    expectWalkedAsAlone(sweepModel("ThoracoscapularShoulderModel", 6));
}

}  // namespace
}  // namespace tautline::testing
