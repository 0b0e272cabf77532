// SPDX-License-Identifier: Apache-2.0
/** Surfaces and force laws that a user's shared library adds to model files: plugin/examples/egg_extension.cpp. */
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "program_support.h"
#include "tautline/version.h"

namespace {

using namespace tautline;
using namespace tautline::testing;

const std::string kModel = TAUTLINE_SOURCE_DIR "/plugin/examples/egg.osim";
const std::string kLoad = " --load " TAUTLINE_EXTENSION_FILE;

std::string replace(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

/** paths.sto of a run. */
StorageTable runModel(const std::filesystem::path& model, const std::string& name) {
    const std::filesystem::path folder = makeFolder(name);
    const Outcome outcome = runTautline("run " + model.string() + " --duration 0.3 --out " + folder.string() + kLoad);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    return readStorage(folder / "paths.sto");
}

TEST(Extension, ForceLawPullsAsItSays) {
    const StorageTable paths = runModel(kModel, "egg");
    ASSERT_GT(paths.rows.size(), 10u);
    const std::size_t length = findColumn(paths, "/forceset/ligament|length");
    const std::size_t tension = findColumn(paths, "/forceset/ligament|tension");
    const std::size_t contact = findColumn(paths, "/forceset/ligament|contact.egg");
    double most = 0;
    int numTouching = 0;
    for (const auto& row : paths.rows) {
        EXPECT_NEAR(row[tension], std::max(0.0, 40 * std::expm1(12 * (row[length] / 0.34 - 1))),
                    1e-9 * (1 + row[tension]));
        numTouching += row[contact] == 1;
        most = std::max(most, row[tension]);
    }
    EXPECT_GT(most, 5);
    EXPECT_GT(numTouching, 5);
}

TEST(Extension, EggWithoutTaperIsAnEllipsoid) {
    const std::string model = readAll(kModel);
    const auto egg = writeInput("round_egg.osim", replace(model, "<taper>0.3</taper>", "<taper>0</taper>"));
    std::string ellipsoid = replace(model, "<taper>0.3</taper>", "");
    ellipsoid = replace(ellipsoid, "<half_length>0.09</half_length>", "");
    ellipsoid = replace(ellipsoid, "<radius>0.06</radius>", "<dimensions>0.06 0.06 0.09</dimensions>");
    ellipsoid = replace(replace(ellipsoid, "<WrapEgg", "<WrapEllipsoid"), "</WrapEgg", "</WrapEllipsoid");
    const StorageTable a = runModel(egg, "round_egg"), b = runModel(writeInput("no_egg.osim", ellipsoid), "no_egg");
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (const char* label : {"length", "rate", "tension"}) {
        const std::size_t column = findColumn(a, std::string("/forceset/ligament|") + label);
        for (std::size_t i = 0; i < a.rows.size(); ++i)
            EXPECT_NEAR(a.rows[i][column], b.rows[i][column], 1e-6 * (1 + std::abs(b.rows[i][column]))) << label;
    }
}

TEST(Extension, ElementsAreUnknownWithoutIt) {
    const Outcome outcome = runTautline("run " + kModel);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(outcome.has("egg.osim:12: unknown wrap object WrapEgg 'egg'")) << outcome.text;
    EXPECT_TRUE(outcome.has("unknown force ExponentialLigament 'ligament'")) << outcome.text;
}

TEST(Extension, PropertiesAreRefusedByLine) {
    const std::string model = readAll(kModel);
    const auto refuse = [&](const std::string& what, const std::string& with) {
        const auto file = writeInput("bad_egg.osim", replace(model, what, with));
        const Outcome outcome = runTautline("solve " + file.string() + " --pose angle=0" + kLoad);
        EXPECT_EQ(outcome.exitCode, 1);
        return outcome.text;
    };
    EXPECT_NE(refuse("<taper>0.3</taper>", "<taper>0.7</taper>")
                  .find("bad_egg.osim:12: WrapEgg 'egg': its taper is 0.700000, beyond 0.5"),
              std::string::npos);
    EXPECT_NE(refuse("<radius>0.06</radius>", "").find("bad_egg.osim:12: WrapEgg 'egg' has no radius"),
              std::string::npos);
    EXPECT_NE(refuse("<taper>0.3</taper>", "<colour>0.3</colour>").find("unknown element colour in WrapEgg 'egg'"),
              std::string::npos);
    EXPECT_NE(
        refuse("<rise>12</rise>", "<rise>-1</rise>").find("rise of ExponentialLigament 'ligament' is -1, not positive"),
        std::string::npos);
}

TEST(Extension, IsRefusedIfItDoesNotFit) {
    const auto refuse = [&](const std::string& options) {
        const Outcome outcome = runTautline(options + " run " + kModel);
        EXPECT_EQ(outcome.exitCode, 1);
        return outcome.text;
    };
    EXPECT_NE(refuse("--load no_such.so").find("no_such.so: cannot open shared object file"), std::string::npos);
    EXPECT_NE(refuse("--load " TAUTLINE_MODULE).find("is no extension of Tautline: it has no TAUTLINE_EXTENSION"),
              std::string::npos);
    EXPECT_NE(refuse("--load " TAUTLINE_OLD_EXTENSION_FILE)
                  .find("was built for Tautline 0.0.1, Simbody with asserts, but this is Tautline " TAUTLINE_VERSION),
              std::string::npos);
    EXPECT_NE(refuse(kLoad + kLoad).find("adds the element 'WrapEgg', which is known already"), std::string::npos);
}

}  // namespace
