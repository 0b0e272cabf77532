// SPDX-License-Identifier: Apache-2.0
/** Sweeps over each coordinate of the field's models: lengths jump only where something says why. */
#include <gtest/gtest.h>

#include "support/model_sweep.h"
#include "support/shared_data.h"
#include "tautline/models/osim_reader.h"

namespace tautline::testing {
namespace {

class DataSweeps : public ::testing::TestWithParam<const char*> {};

TEST_P(DataSweeps, LengthsJumpOnlyWhereARuleOrTheStringHasThem) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const models::ModelDescription model =
        models::readOsimFile(shared / "data" / "opensim" / "models" / (std::string(GetParam()) + ".osim"), {{}, true});
    const SweepReport report = ModelSweep(model).run(40);
    EXPECT_GT(report.numPoses, 40);
    for (const LengthJump& jump : report.jumps)
        EXPECT_TRUE(isExplained(jump.cause)) << jump.path << " jumps by " << jump.after - jump.before << " m at "
                                             << jump.coordinate << " = " << jump.value << ": " << jump.detail;
    for (const WalkMiss& miss : report.misses)
        ADD_FAILURE() << miss.path << " at " << miss.coordinate << " = " << miss.value << ": walked " << miss.walked
                      << " m, alone " << miss.alone << " m";
}

INSTANTIATE_TEST_SUITE_P(, DataSweeps,
                         ::testing::Values("arm26", "gait2392_thelen2003muscle", "walk_gait1018_subject01",
                                           "Rajagopal2016", "RajagopalLaiUhlrich2023", "subject_walk_scaled",
                                           "ThoracoscapularShoulderModel", "Scholz2015GeometryPathExample"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace tautline::testing
