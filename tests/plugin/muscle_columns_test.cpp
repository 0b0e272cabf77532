// SPDX-License-Identifier: Apache-2.0
/** What the program writes and says of muscles. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "storage_file.h"
#include "support/run_program.h"

namespace tautline {
namespace {

const std::string kMuscles = std::string(TAUTLINE_SOURCE_DIR) + "/models/muscles.osim";

std::filesystem::path makeFolder(const std::string& name) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / ("tautline_muscles_" + name);
    std::filesystem::remove_all(folder);
    return folder;
}

struct ProgramRun {
    explicit ProgramRun(const std::string& model, const std::string& name) : folder(makeFolder(name)) {
        exitCode = testing::runProgram(std::string(TAUTLINE_PROGRAM) + " run " + model +
                                           " --duration 0.05 --excitation millard_exact=0.5 --out " + folder.string(),
                                       text);
    }
    std::filesystem::path folder;
    std::string text;
    int exitCode = 0;
};

std::vector<double> getColumn(const StorageTable& table, const std::string& label) {
    const auto at = std::find(table.labels.begin(), table.labels.end(), label);
    EXPECT_NE(at, table.labels.end()) << label;
    if (at == table.labels.end()) return {};
    std::vector<double> column;
    for (const std::vector<double>& row : table.rows)
        column.push_back(row[static_cast<std::size_t>(at - table.labels.begin())]);
    return column;
}

TEST(MuscleColumns, AreThereForEachMuscleAndAgree) {
    const ProgramRun run(kMuscles, "columns");
    ASSERT_EQ(run.exitCode, 0) << run.text;
    const StorageTable muscles = readStorage(run.folder / "muscles.sto"), paths = readStorage(run.folder / "paths.sto");
    const StorageTable states = readStorage(run.folder / "states.sto");
    ASSERT_EQ(muscles.rows.size(), paths.rows.size());
    for (const char* name : {"thelen_exact", "tendonless_exact", "thelen_deprecated", "millard_exact",
                             "millard_classic_exact", "millard_rigid_exact", "de_groote", "schutte", "delp", "rigid"}) {
        const std::string muscle = "/forceset/" + std::string(name);
        const auto get = [&](const std::string& column) { return getColumn(muscles, muscle + column); };
        const auto tension = getColumn(paths, muscle + "|tension"), rate = getColumn(paths, muscle + "|rate");
        const auto tendon = get("|tendon_force"), power = get("|muscle_power"), active = get("|fiber_active_power");
        const auto passive = get("|fiber_passive_power"), damping = get("|fiber_damping_power");
        const auto inTendon = get("|tendon_power"), fiber = get("|fiber_length"), slack = get("|tendon_length");
        const auto length = getColumn(paths, muscle + "|length");
        for (std::size_t k = 0; k < tension.size(); ++k) {
            EXPECT_EQ(tendon[k], tension[k]) << name;
            EXPECT_NEAR(power[k], -tension[k] * rate[k], 1e-9) << name;
            EXPECT_NEAR(active[k] + passive[k] + damping[k] + inTendon[k], power[k], 1e-8) << name;
            EXPECT_NEAR(fiber[k] + slack[k], length[k], 1e-12) << name;  // not pennated
        }
    }
    EXPECT_EQ(getColumn(states, "/forceset/millard_exact/activation").front(), 0.05);
    EXPECT_GT(getColumn(states, "/forceset/millard_exact/activation").back(), 0.4);
    EXPECT_EQ(getColumn(states, "/forceset/de_groote/activation").front(), 0.5);
    EXPECT_EQ(getColumn(states, "/forceset/millard_exact/fiber_length"),
              getColumn(muscles, "/forceset/millard_exact|fiber_length"));
    EXPECT_EQ(std::count(states.labels.begin(), states.labels.end(), "/forceset/millard_rigid_exact/fiber_length"), 0);
}

TEST(MuscleColumns, TheReportNamesTypesAndNotes) {
    const ProgramRun run(kMuscles, "notes");
    for (const char* line : {"2 Thelen2003Muscle: the muscle model of Thelen (2003), with the file's parameters\n",
                             "3 Millard2012EquilibriumMuscle: the muscle model of Millard et al. (2013)",
                             "1 Schutte1993Muscle_Deprecated: the muscle model of Schutte (1993)",
                             "note: tendonless_exact: has no tendon: the fiber is as long as the path\n"})
        EXPECT_NE(run.text.find(line), std::string::npos) << line << "\n" << run.text;
    EXPECT_EQ(run.text.find("optimal lengths"), std::string::npos) << run.text;
}

TEST(MuscleColumns, LongFibersAreNamed) {
    std::ifstream file(kMuscles);
    std::ostringstream text;
    text << file.rdbuf();
    std::string model = text.str();
    const std::string start = "<default_value>0.3<";
    model.replace(model.find(start), start.size(), "<default_value>0.365<");
    const auto stretched = std::filesystem::path(::testing::TempDir()) / "tautline_stretched.osim";
    std::ofstream(stretched) << model;
    const ProgramRun run(stretched.string(), "stretched");
    ASSERT_EQ(run.exitCode, 0) << run.text;
    EXPECT_NE(
        run.text.find("note: millard_rigid_exact: the fiber reaches 1.65 optimal lengths (at 0.000 s); beyond 1.6 its "
                      "curves are only continued\n"),
        std::string::npos)
        << run.text;
}

}  // namespace
}  // namespace tautline
