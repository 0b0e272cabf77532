// SPDX-License-Identifier: Apache-2.0
/** The options of `tautline run` as a user gives them. */
#include <cmath>
#include <fstream>

#include "program_support.h"

namespace tautline::testing {
namespace {

const std::string kElbow = TAUTLINE_SOURCE_DIR "/models/elbow.osim";
/** A pendulum of moment of inertia 0.03 about its pin, its mass center 0.1 below at q = 0, with a string that stays
slack while q is small. */
const std::string kPendulum = TAUTLINE_SOURCE_DIR "/models/accepted/one_sided_cylinder.osim";
const std::string kAngle = "/jointset/pin/q/value", kSpeed = "/jointset/pin/q/speed";

StorageTable runAndRead(const std::string& arguments, const std::string& name, const char* file = "states.sto") {
    const std::filesystem::path folder = makeFolder(name);
    const Outcome outcome = runTautline("run " + arguments + " --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    return readStorage(folder / file);
}

TEST(RunCommand, BeginsWithThePoseAndSpeedThatAreGiven) {
    const StorageTable states =
        runAndRead(kElbow + " --pose elbow_flexion=90deg --speed shoulder_flexion=-0.5 --duration 0.01", "run_pose");
    EXPECT_NEAR(states.rows[0][findColumn(states, "/jointset/elbow/elbow_flexion/value")], std::acos(0.0), 1e-12);
    EXPECT_NEAR(states.rows[0][findColumn(states, "/jointset/shoulder/shoulder_flexion/speed")], -0.5, 1e-12);
}

// 2026-11-27: options that may be repeated took the model's name for one more of their values.
TEST(RunCommand, TakesOptionsBeforeTheModelToo) {
    for (const char* options : {"--pose elbow_flexion=0.4", "--ignore nothing", "--lock 'shoulder*'",
                                "--excitation 'biceps*=0.1'", "--speed elbow_flexion=0.1", "--gravity 0 -9.81 0"})
        EXPECT_EQ(runTautline(std::string("run ") + options + " " + kElbow + " --duration 0.01 --out " +
                              makeFolder("run_before").string())
                      .exitCode,
                  0)
            << options;
    EXPECT_EQ(runTautline("solve --muscles 'biceps*' --pose elbow_flexion=0.4 " + kElbow + " --out " +
                          makeFolder("solve_before").string())
                  .exitCode,
              0);
    EXPECT_EQ(runTautline("check --ignore nothing " + kElbow).exitCode, 0);
}

TEST(RunCommand, RunsFromOneTimeToAnother) {
    const StorageTable states = runAndRead(kElbow + " --from 2 --to 2.05 --interval 0.02", "run_times");
    ASSERT_EQ(states.rows.size(), 4u);
    const double times[] = {2, 2.02, 2.04, 2.05};
    for (int i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(states.rows[i][0], times[i]);
}

TEST(RunCommand, GoesOnFromStatesThatItHasWritten) {
    const std::filesystem::path whole = makeFolder("run_whole"), rest = makeFolder("run_rest");
    const std::string options = " --accuracy 1e-10 --excitation 'biceps*=0.3' ";
    ASSERT_EQ(runTautline("run " + kElbow + options + "--duration 0.2 --out " + whole.string()).exitCode, 0);
    ASSERT_EQ(runTautline("run " + kElbow + options + "--states " + (whole / "states.sto").string() +
                          " --from 0.1 --to 0.2 --out " + rest.string())
                  .exitCode,
              0);
    const StorageTable a = readStorage(whole / "states.sto"), b = readStorage(rest / "states.sto");
    ASSERT_EQ(a.labels, b.labels);
    ASSERT_EQ(b.rows.size(), 11u);
    for (std::size_t i = 0; i < b.rows.size(); ++i)
        for (std::size_t j = 0; j < b.labels.size(); ++j)
            EXPECT_NEAR(b.rows[i][j], a.rows[i + 10][j], 1e-7) << b.labels[j];
}

TEST(RunCommand, LocksCoordinatesWhereTheyBegin) {
    const StorageTable states =
        runAndRead(kElbow + " --lock 'shoulder*' --pose shoulder_flexion=0.4 --duration 0.2", "run_lock");
    const std::size_t shoulder = findColumn(states, "/jointset/shoulder/shoulder_flexion/value"),
                      elbow = findColumn(states, "/jointset/elbow/elbow_flexion/value");
    for (const auto& row : states.rows) EXPECT_NEAR(row[shoulder], 0.4, 1e-8);
    EXPECT_GT(std::abs(states.rows.back()[elbow] - states.rows.front()[elbow]), 1e-3);
}

TEST(RunCommand, TakesTheGravityThatIsGiven) {
    const StorageTable free = runAndRead(kPendulum + " --gravity 0 0 0 --speed q=0.3 --duration 0.1", "run_weightless");
    for (const auto& row : free.rows) EXPECT_NEAR(row[findColumn(free, kAngle)], 0.3 * row[0], 1e-9);
    const StorageTable sideways = runAndRead(kPendulum + " --gravity 3 0 0 --duration 0.01", "run_sideways");
    // Torque m g 0.1 about z at rest.
    EXPECT_NEAR(sideways.rows.back()[findColumn(sideways, kSpeed)], 3 * 0.1 / 0.03 * 0.01, 1e-6);
}

std::filesystem::path writeLoads(const std::string& force) {
    writeInput("loads.mot", "loads\nversion=1\nendheader\ntime fx fy fz\n0 " + force + " 0 0\n1 " + force + " 0 0\n");
    return writeInput("loads.xml",
                      "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"loads\"><objects><ExternalForce "
                      "name=\"pull\"><applied_to_body>arm</applied_to_body><force_expressed_in_body>ground"
                      "</force_expressed_in_body><point_expressed_in_body>ground</point_expressed_in_body>"
                      "<force_identifier>f</force_identifier><point_identifier/><torque_identifier/></ExternalForce>"
                      "</objects><datafile>tautline_loads.mot</datafile></ExternalLoads></OpenSimDocument>");
}

TEST(RunCommand, AppliesExternalLoads) {
    const std::string loads = writeLoads("0.5").string();
    const Outcome outcome = runTautline("run " + kPendulum + " --external-loads " + loads + " --duration 0.01 --out " +
                                        makeFolder("run_loads").string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_TRUE(outcome.has("external loads: 1 of " + loads)) << outcome.text;
    EXPECT_EQ(runTautline("run " + kPendulum + " --external-loads no_such.xml").exitCode, 1);
}

TEST(RunCommand, EndsWithTheCoordinateWhereTheStateIsNoLongerFinite) {
    const std::filesystem::path folder = makeFolder("run_stuck");
    const Outcome outcome =
        runTautline("run " + kPendulum + " --gravity 1e200 0 0 --duration 1 --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 4) << outcome.text;
    EXPECT_TRUE(outcome.has("coordinate 'q' ")) << outcome.text;
    EXPECT_TRUE(outcome.has("the simulation ended at 0 of 1 s")) << outcome.text;
    for (const char* word : {"SimTK", "Exception", " nan", " inf"}) EXPECT_FALSE(outcome.has(word)) << outcome.text;
    EXPECT_EQ(readStorage(folder / "states.sto").rows.size(), 1u);
}

TEST(RunCommand, IsInterruptedWithEverythingWritten) {
    const std::filesystem::path folder = makeFolder("run_interrupted");
    Outcome outcome;
    outcome.exitCode = runProgram("timeout --preserve-status -s INT 1 " TAUTLINE_PROGRAM " run " + kElbow +
                                      " --duration 1e5 --interval 0.1 --out " + folder.string(),
                                  outcome.text);
    EXPECT_EQ(outcome.exitCode, 130) << outcome.text;
    EXPECT_TRUE(outcome.has("interrupted at ")) << outcome.text;
    const StorageTable states = readStorage(folder / "states.sto");
    EXPECT_GT(states.rows.size(), 2u);
    EXPECT_TRUE(outcome.has("interrupted at " + toText(states.rows.back()[0]) + " of 1e+05 s")) << outcome.text;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST(RunCommand, ResumesAnInterruptedRun) {
    const std::filesystem::path whole = makeFolder("run_unbroken"), parts = makeFolder("run_resumed");
    const std::string options = " --accuracy 1e-10 --excitation 'biceps*=0.3' --interval 0.02 --out ";
    ASSERT_EQ(runTautline("run " + kElbow + " --duration 0.2" + options + whole.string()).exitCode, 0);
    ASSERT_EQ(runTautline("run " + kElbow + " --duration 0.1" + options + parts.string()).exitCode, 0);
    const std::string resume = "run " + kElbow + " --duration 0.2 --resume" + options + parts.string();
    const Outcome resumed = runTautline(resume);
    ASSERT_EQ(resumed.exitCode, 0) << resumed.text;
    for (const char* file : {"states.sto", "paths.sto"}) {
        const StorageTable a = readStorage(whole / file), b = readStorage(parts / file);
        ASSERT_EQ(a.labels, b.labels);
        ASSERT_EQ(a.rows.size(), b.rows.size()) << file;
        for (std::size_t i = 0; i < a.rows.size(); ++i)
            for (std::size_t j = 0; j < a.labels.size(); ++j)
                EXPECT_NEAR(a.rows[i][j], b.rows[i][j], 1e-6 * (1 + std::abs(a.rows[i][j])))
                    << file << " " << a.labels[j];
    }
    for (const char* file : {"muscles.sto", "clearances.sto"})
        EXPECT_EQ(readStorage(whole / file).rows.size(), readStorage(parts / file).rows.size()) << file;
    const Outcome again = runTautline(resume);
    EXPECT_EQ(again.exitCode, 0);
    EXPECT_TRUE(again.has("nothing to resume: ")) << again.text;
    EXPECT_EQ(runTautline("run " + kElbow + " --resume --out " + makeFolder("run_nothing").string()).exitCode, 1);
    const Outcome other = runTautline("run " + kPendulum + " --duration 0.3 --resume --out " + parts.string());
    EXPECT_EQ(other.exitCode, 1) << other.text;
}

/** A string from (-0.5, 0.1, -0.2) once round a fixed cylinder of radius 0.1 about z to a body that slides along x from
(0.5, 0.1, 0.2): a search from the pose alone has it straight over the cylinder. */
const char* const kWoundModel = R"(<OpenSimDocument Version="40000"><Model name="wound"><gravity>0 0 0</gravity>
<Ground name="ground"><WrapObjectSet><objects><WrapCylinder name="post"><radius>0.1</radius><length>2</length>
</WrapCylinder></objects></WrapObjectSet></Ground>
<BodySet><objects><Body name="cart"><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet><objects><SliderJoint name="rail"><socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>/bodyset/cart</socket_child_frame><coordinates><Coordinate name="x"><range>-3 3</range></Coordinate>
</coordinates></SliderJoint></objects></JointSet>
<ForceSet><objects><PathSpring name="string"><GeometryPath><PathPointSet><objects>
<PathPoint name="a"><socket_parent_frame>/ground</socket_parent_frame><location>-0.5 0.1 -0.2</location></PathPoint>
<PathPoint name="b"><socket_parent_frame>/bodyset/cart</socket_parent_frame><location>0.5 0.1 0.2</location></PathPoint>
</objects></PathPointSet><PathWrapSet><objects><PathWrap name="w"><wrap_object>post</wrap_object><tautline_start>
<point>0 0.1 -0.08</point><direction>1 0 0.25</direction><length>0.65</length></tautline_start></PathWrap></objects>
</PathWrapSet></GeometryPath><resting_length>1.5</resting_length><stiffness>50</stiffness><dissipation>0</dissipation>
</PathSpring></objects></ForceSet></Model></OpenSimDocument>
)";

/** (2026-11-27: contacts were found anew, and turns lost.) */
TEST(RunCommand, ResumesWithThePathWoundUpAsItWas) {
    const std::string model = writeInput("wound.osim", kWoundModel).string();
    const std::filesystem::path whole = makeFolder("wound_whole"), parts = makeFolder("wound_parts");
    const std::string options = " --accuracy 1e-10 --interval 0.05 --speed x=0.4 --out ";
    ASSERT_EQ(runTautline("run " + model + " --duration 0.4" + options + whole.string()).exitCode, 0);
    ASSERT_EQ(runTautline("run " + model + " --duration 0.2" + options + parts.string()).exitCode, 0);
    // The start of the model no longer leads to the path where the cart has gone to: the record does.
    const std::string moved =
        std::string(kWoundModel).replace(std::string(kWoundModel).find("<length>0.65<"), 13, "<length>0.05<");
    const std::string resumedModel = writeInput("wound.osim", moved).string();
    const Outcome resumed = runTautline("run " + resumedModel + " --duration 0.4 --resume" + options + parts.string());
    ASSERT_EQ(resumed.exitCode, 0) << resumed.text;
    const StorageTable a = readStorage(whole / "paths.sto"), b = readStorage(parts / "paths.sto");
    const std::size_t length = findColumn(a, "/forceset/string|length");
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        EXPECT_NEAR(a.rows[i][length], b.rows[i][length], 1e-7);
        EXPECT_GT(a.rows[i][length], 1.2);
    }
    // Two straight lines along the top and a turn, unrolled.
    EXPECT_NEAR(a.rows[0][length], std::hypot(1 + 2 * std::acos(-1.0) * 0.1, 0.4), 1e-9);
    std::filesystem::remove(parts / "contacts.csv");
    const Outcome anew = runTautline("run " + model + " --duration 0.5 --resume" + options + parts.string());
    EXPECT_TRUE(anew.has("contacts.csv is missing: where paths touch obstacles is found anew")) << anew.text;
    std::ofstream(parts / "contacts.csv")
        << "path,obstacle,x,y,z,dx,dy,dz,length\n/forceset/string,post,0,one,0,1,0,0,1\n";
    const Outcome broken = runTautline("run " + model + " --duration 0.6 --resume" + options + parts.string());
    EXPECT_EQ(broken.exitCode, 1);
    EXPECT_TRUE(broken.has("contacts.csv:2: 'one' is not a finite number")) << broken.text;
}

TEST(RunCommand, WritesMomentArmsOfCrossedCoordinatesUnlessAllAreAskedFor) {
    const StorageTable few = runAndRead(kElbow + " --duration 0.01", "run_few", "paths.sto"),
                       all = runAndRead(kElbow + " --duration 0.01 --all", "run_all", "paths.sto");
    const std::string label = "/forceset/brachialis|moment_arm.shoulder_flexion";
    EXPECT_EQ(std::count(few.labels.begin(), few.labels.end(), label), 0);
    EXPECT_NEAR(all.rows[0][findColumn(all, label)], 0.0, 1e-12);
    EXPECT_EQ(few.rows[0][findColumn(few, "/forceset/brachialis|moment_arm.elbow_flexion")],
              all.rows[0][findColumn(all, "/forceset/brachialis|moment_arm.elbow_flexion")]);
}

// 2026-11-27: gnuplot failed on a path error of exactly 0, without a word.
TEST(RunCommand, DrawsPathsOfStraightLines) {
    const std::filesystem::path folder = makeFolder("run_plot");
    const Outcome outcome = runTautline("run " + kElbow + " --duration 0.05 --plot --out " + folder.string());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.text;
    EXPECT_FALSE(outcome.has("gnuplot")) << outcome.text;
    EXPECT_TRUE(std::filesystem::exists(folder / "curves_biceps_short.svg"));
}

TEST(RunCommand, PassesOnWhatGnuplotSays) {
    const std::filesystem::path folder = makeFolder("run_gnuplot"), programs = makeFolder("programs");
    std::filesystem::create_directories(programs);
    std::ofstream(programs / "gnuplot") << "#!/bin/sh\necho 'line 7: no such thing' >&2\nexit 1\n";
    std::filesystem::permissions(programs / "gnuplot", std::filesystem::perms::owner_all);
    Outcome outcome;
    outcome.exitCode = runProgram("PATH=" + programs.string() + ":$PATH " TAUTLINE_PROGRAM " run " + kElbow +
                                      " --duration 0.01 --plot --out " + folder.string(),
                                  outcome.text);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(outcome.has("it says: line 7: no such thing")) << outcome.text;
    EXPECT_TRUE(std::filesystem::exists(folder / "states.sto"));
}

TEST(RunCommand, RefusesOptionsByNameAndValue) {
    const auto early = writeInput("early.sto", "states\nendheader\ntime q/value\n0 0\n1 1\n");
    const auto none = writeInput("none.sto", "states\nendheader\ntime x\n0 0\n");
    const auto active = writeInput("active.sto", "states\nendheader\ntime brachialis/activation\n0 1.5\n");
    const std::pair<std::string, std::string> cases[] = {
        {kPendulum + " --to -1", "--to is -1, but must be after the start at 0 s"},
        {kPendulum + " --lock 'knee*'", "--lock 'knee*' matches none of q"},
        {kPendulum + " --speed knee=1", "--speed 'knee=1': the model has no coordinate 'knee'; it has q"},
        {kPendulum + " --gravity 0 nan 0", "--gravity is 0 nan 0, but must be finite"},
        {kPendulum + " --from 1e9", "the simulation would begin at 1e+09 s"},
        {kPendulum + " --states " + early.string() + " --from 3", "has no states at 3 s, but from 0 to 1 s"},
        {kPendulum + " --states " + none.string(), "no column is a state of the model"},
        {kElbow + " --states " + active.string(), "'brachialis/activation' is 1.5, but must be in [0, 1]"},
        {kElbow + " --excitation 'glut*=1'", "the model has no muscle 'glut*'"}};
    for (const auto& [arguments, message] : cases) {
        const auto folder = makeFolder("run_refused");
        const Outcome outcome = runTautline("run " + arguments + " --out " + folder.string());
        EXPECT_EQ(outcome.exitCode, 1) << arguments;
        EXPECT_TRUE(outcome.has(message)) << outcome.text;
        EXPECT_EQ(outcome.countLines(), 1) << outcome.text;
        EXPECT_FALSE(std::filesystem::exists(folder)) << arguments;
    }
}

}  // namespace
}  // namespace tautline::testing
