// SPDX-License-Identifier: Apache-2.0
/** `tautline fit` as a user runs it, and a model with what it printed. */
#include "program_support.h"
#include "support/shared_data.h"
#include "support/triangle_meshes.h"
#include "tautline/surfaces/solid_file.h"

namespace tautline::testing {
namespace {

constexpr double kApart = 0.032;  ///< of the axes of bones side by side [m]

/** Some of the benchmarks' bones side by side along y, in millimeters. */
std::filesystem::path writeBones(int count) {
    std::ostringstream text;
    text.precision(9);
    const TriangleMesh mesh = makeBoneMesh();
    for (int i = 0; i < count; ++i)
        for (const Vector3& p : mesh.points)
            text << "v " << 1000 * p.x() << ' ' << 1000 * (p.y() + i * kApart) << ' ' << 1000 * p.z() << '\n';
    const int step = static_cast<int>(mesh.points.size());
    for (int i = 0; i < count; ++i)
        for (const auto& [a, b, c] : mesh.triangles)
            text << "f " << a + 1 + i * step << ' ' << b + 1 + i * step << ' ' << c + 1 + i * step << '\n';
    return writeInput(count == 1 ? "bone.obj" : "bones.obj", text.str());
}

std::filesystem::path writeBone() {
    return writeBones(1);
}

/** A spring from ground over the bone, which lies in ground, to a body that turns about z. */
std::string makeModel(const std::string& element, const std::string& hint = "0.03 0 0") {
    return R"(<OpenSimDocument Version="40000"><Model name="over_a_bone"><gravity>0 -9.81 0</gravity>
<Ground name="ground"><WrapObjectSet><objects>
)" + element +
           R"(</objects></WrapObjectSet></Ground>
<BodySet><objects><Body name="rod"><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet><objects><PinJoint name="pin"><socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>/bodyset/rod</socket_child_frame>
<coordinates><Coordinate name="angle" /></coordinates></PinJoint></objects></JointSet>
<ForceSet><objects><PathSpring name="spring"><GeometryPath><PathPointSet><objects>
<PathPoint name="origin"><socket_parent_frame>/ground</socket_parent_frame><location>-0.01 -0.06 -0.03</location></PathPoint>
<PathPoint name="insertion"><socket_parent_frame>/bodyset/rod</socket_parent_frame><location>-0.02 0.07 0.01</location></PathPoint>
</objects></PathPointSet>
<PathWrapSet><objects><PathWrap name="wrap"><wrap_object>tautline_bone</wrap_object>
<tautline_hint>)" +
           hint + R"(</tautline_hint></PathWrap></objects></PathWrapSet>
</GeometryPath>
<resting_length>0.1</resting_length><stiffness>100</stiffness><dissipation>0</dissipation></PathSpring></objects></ForceSet>
</Model></OpenSimDocument>)";
}

TEST(FitCommand, WritesASolidAndTheElementThatAModelNeeds) {
    const std::filesystem::path bone = writeBone(), solid = bone.parent_path() / "tautline_bone.solid";
    std::filesystem::remove(solid);
    const Outcome fit =
        runTautline("fit " + bone.string() + " --bone --unit 0.001 --width 0.003 --out " + solid.string());
    ASSERT_EQ(fit.exitCode, 0) << fit.text;
    for (const char* part : {"2562 points, 5120 triangles", "put in order: nothing; 1 part\n",
                             "width 3 mm, grid 4.5 mm", "off the mesh: ", "written: "})
        EXPECT_TRUE(fit.has(part)) << part << "\n" << fit.text;
    EXPECT_NEAR(readSolidFile(solid).getSize(), 0.019, 0.001);
    const std::string element = fit.text.substr(fit.text.find("<TautlineWrapMesh"));
    const auto model = writeInput("over_a_bone.osim", makeModel(element));
    const Outcome check = runTautline("check " + model.string());
    EXPECT_EQ(check.exitCode, 0) << check.text;
    const std::filesystem::path folder = makeFolder("over_a_bone");
    const Outcome run = runTautline("run " + model.string() + " --duration 0.05 --out " + folder.string());
    EXPECT_EQ(run.exitCode, 0) << run.text;
    const StorageTable paths = readStorage(folder / "paths.sto");
    const std::vector<double>& first = paths.rows.front();
    EXPECT_EQ(first[findColumn(paths, "/forceset/spring|contact.tautline_bone")], 1);
    const double straight = Vector3(0.01, 0.13, 0.04).norm(),
                 length = first[findColumn(paths, "/forceset/spring|length")];
    EXPECT_GT(length, straight + 1e-4);
    EXPECT_LT(length, straight + 0.02);
}

TEST(FitCommand, WritesAPageWithTheMeshInTheColorsOfItsDistances) {
    const std::filesystem::path bone = writeBone(), folder = makeFolder("fit_page"), page = folder / "fit.html";
    const Outcome fit = runTautline("fit " + bone.string() + " --bone --unit 0.001 --width 0.003 --out " +
                                    (folder / "bone.solid").string() + " --report " + page.string());
    ASSERT_EQ(fit.exitCode, 0) << fit.text;
    EXPECT_TRUE(fit.has("page: " + page.string())) << fit.text;
    const std::string html = readAll(page);
    EXPECT_NE(html.find("\"valueName\":\"mm out of the solid\""), std::string::npos);
    // Two bytes for each of 2562 points, in base 64.
    const std::size_t begin = html.find("\"values\":\"") + 10, end = html.find('"', begin);
    EXPECT_EQ(end - begin, 4u * ((2 * 2562 + 2) / 3));
    // What the page's table has is what the command prints, with more digits.
    const std::size_t rms = html.find("[\"rms\",\"") + 8;
    std::ostringstream printed;
    printed.precision(3);
    printed << std::stod(html.substr(rms));
    EXPECT_TRUE(fit.has("off the mesh: " + printed.str())) << fit.text << html.substr(rms, 8);
    EXPECT_NE(html.find("(the needle)"), std::string::npos);
}

TEST(FitCommand, ClosesGapsBetweenBonesSideBySide) {
    const std::filesystem::path bones = writeBones(2), solid = bones.parent_path() / "tautline_closed.solid";
    const std::string command = "fit " + bones.string() + " --bone --unit 0.001 --width 0.003 --out " + solid.string();
    ASSERT_EQ(runTautline(command).exitCode, 0);
    const Vector3 between(0, kApart / 2, 0);
    EXPECT_GT(readSolidFile(solid).calcHeight(between), 2e-3);
    const Outcome closed = runTautline(command + " --close 0.04");
    ASSERT_EQ(closed.exitCode, 0) << closed.text;
    EXPECT_TRUE(closed.has("gaps closed: narrower than 40 mm")) << closed.text;
    EXPECT_LT(readSolidFile(solid).calcHeight(between), -2e-3);
    EXPECT_TRUE(runTautline(command + " --close -1").has("--close is the width of gaps in m, but is -1"));
}

TEST(FitCommand, RefusesWhatItCannotFit) {
    const std::filesystem::path bone = writeBone();
    const std::string out = " --bone --out " + (bone.parent_path() / "tautline_none.solid").string();
    const auto expectRefused = [&](const std::string& arguments, const std::string& message) {
        const Outcome outcome = runTautline("fit " + arguments);
        EXPECT_NE(outcome.exitCode, 0);
        EXPECT_TRUE(outcome.has(message)) << outcome.text;
    };
    expectRefused("no_such.obj" + out, "no_such.obj: the file cannot be read");
    expectRefused(writeInput("odd.xyz", "x").string() + out, "meshes are read from .vtp, .obj, .stl and .ply files");
    expectRefused(bone.string() + out + " --width -1", "solid fit: width must be positive and finite, but is -1");
    expectRefused(bone.string() + out + " --unit 0", "the unit of a mesh must be positive, but is 0");
    expectRefused(bone.string() + " --bone --unit 0.001 --out " + ::testing::TempDir(), "the file cannot be written");
    expectRefused(bone.string() + " --out x.solid", "fit: --bone or --patch KIND says what to fit");
    expectRefused(bone.string() + " --bone", "fit: --bone needs --out FILE for the solid");
    expectRefused(bone.string() + " --bone --patch 5", "excludes");
    expectRefused(bone.string() + " --patch 5by6", "such as 8x6, but is '5by6'");
    expectRefused(bone.string() + " --patch 21", "orders must be in [1, 20], but are 21 and 21");
    expectRefused(bone.string() + " --patch 5 --toward 0 0 0", "the direction that it faces must not be zero");
    expectRefused(bone.string() + " --patch 5 --box 5 6 5 6 5 6", "no triangle of the mesh lies in the box");
}

/** The side of the bone that faces +x, with either kind of patch, in a model. */
TEST(FitCommand, PrintsAPatchThatAModelWrapsOver) {
    const std::filesystem::path bone = writeBone();
    for (const char* kind : {"6", "6x12"}) {
        const Outcome fit = runTautline("fit " + bone.string() + " --unit 0.001 --patch " + kind +
                                        " --toward 1 0 0 --box 0 0.1 -0.1 0.1 -0.08 0.08");
        ASSERT_EQ(fit.exitCode, 0) << fit.text;
        EXPECT_TRUE(fit.has("fitted to: ") && fit.has("outliers left out")) << fit.text;
        double rms = 0;
        const std::size_t at = fit.text.find("off the points: ");
        ASSERT_EQ(std::sscanf(fit.text.c_str() + at, "off the points: %lf mm rms", &rms), 1) << fit.text;
        EXPECT_LT(rms, 0.2) << fit.text;
        std::string element = fit.text.substr(fit.text.find("<TautlineWrapPatch"));
        EXPECT_NE(element.find("name=\"tautline_bone\""), std::string::npos);
        const auto model = writeInput("over_a_patch.osim", makeModel(element, "0 0 0.03"));  // above it
        const std::filesystem::path folder = makeFolder("over_a_patch");
        const Outcome run = runTautline("run " + model.string() + " --duration 0.05 --out " + folder.string());
        EXPECT_EQ(run.exitCode, 0) << run.text;
        const StorageTable paths = readStorage(folder / "paths.sto");
        const std::vector<double>& first = paths.rows.front();
        EXPECT_EQ(first[findColumn(paths, "/forceset/spring|contact.tautline_bone")], 1) << kind;
    }
}

TEST(FitCommand, ModelsNameWhatIsWrongWithAPatch) {
    const auto expectRefused = [&](const std::string& content, const std::string& message) {
        const std::string element = "<TautlineWrapPatch name=\"tautline_bone\">" + content + "</TautlineWrapPatch>\n";
        const Outcome outcome = runTautline("check " + writeInput("bad_patch.osim", makeModel(element)).string());
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_TRUE(outcome.has("bad_patch.osim:3: ") && outcome.has(message)) << outcome.text;
    };
    const std::string domain = "<domain>0 1 0 1</domain>";
    expectRefused(domain, "heights");
    expectRefused(domain + "<heights>0 0 0 0</heights>", "has either orders or control_points");
    expectRefused(domain + "<heights>0 0 0 0</heights><orders>1 1.5</orders>", "not whole numbers from 1 to 1000");
    expectRefused(domain + "<heights>0 0 0</heights><orders>1 1</orders>", "heights");
    expectRefused("<domain>0 0 0 1</domain><heights>0 0 0 0</heights><orders>1 1</orders>",
                  "domain of u must be finite and not empty");
    expectRefused(domain + "<heights>0 0 0 0</heights><control_points>2 2</control_points>",
                  "needs at least 4 control points");
}

/** As the thesis has it in Sec. 8.4, Fig. 8.6: of fifth order. Points of the ribs are that far off any smooth sheet. */
TEST(DataFitCommand, FitsAPatchToTheRightSideOfTheBack) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const Outcome fit = runTautline("fit " + (shared / "data/opensim/geometry/ribs.vtp").string() +
                                    " --patch 5 --toward -1 0 0.5 --box -0.3 -0.03 -0.35 -0.05 0.01 1");
    ASSERT_EQ(fit.exitCode, 0) << fit.text;
    double rms = 0;
    ASSERT_EQ(std::sscanf(fit.text.c_str() + fit.text.find("off the points: "), "off the points: %lf mm rms", &rms), 1);
    EXPECT_NEAR(rms, 2.8, 0.05) << fit.text;
    // The example is what the command prints, to seven digits.
    const auto findHeights = [](const std::string& text) {
        std::istringstream words(text.substr(text.find("<heights>") + 9));
        std::vector<double> heights;
        for (double height; words >> height;) heights.push_back(height);
        return heights;
    };
    const std::vector<double> printed = findHeights(fit.text),
                              shown = findHeights(readAll(TAUTLINE_SOURCE_DIR "/models/latissimus.osim"));
    ASSERT_EQ(printed.size(), 36u);
    ASSERT_EQ(shown.size(), 36u);
    for (std::size_t i = 0; i < printed.size(); ++i) EXPECT_NEAR(printed[i], shown[i], 1e-8);
}

TEST(FitCommand, ModelsNameWhatIsWrongWithASolid) {
    const auto expectRefused = [&](const std::string& element, const std::string& message) {
        const Outcome outcome = runTautline("check " + writeInput("bad_bone.osim", makeModel(element)).string());
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_TRUE(outcome.has(message)) << outcome.text;
    };
    const std::string begin = "<TautlineWrapMesh name=\"tautline_bone\">", end = "</TautlineWrapMesh>\n";
    expectRefused(begin + end, "solid_file");
    expectRefused(begin + "<solid_file>none.solid</solid_file>" + end, "none.solid: the file cannot be read");
    writeInput("text.solid", "a bone\n");
    expectRefused(begin + "<solid_file>tautline_text.solid</solid_file>" + end,
                  "bad_bone.osim:3: " + (std::filesystem::path(::testing::TempDir()) / "tautline_text.solid").string() +
                      ": no file of a solid");
    expectRefused(begin + "<solid_file>tautline_text.solid</solid_file>\n<scale_factors>1 0 1</scale_factors>" + end,
                  "bad_bone.osim:4: scale_factors of TautlineWrapMesh 'tautline_bone' must be positive");
}

}  // namespace
}  // namespace tautline::testing
