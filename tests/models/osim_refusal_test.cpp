// SPDX-License-Identifier: Apache-2.0
/** Every refusal by its message: short edits of one good model, and the files of models/rejected. */
#include <filesystem>
#include <fstream>

#include "model_test_support.h"

namespace tautline::models::testing {
namespace {

const char* const goodText = R"(<OpenSimDocument Version="40000">
<Model name="m">
<gravity>0 -9.81 0</gravity>
<length_units>meters</length_units>
<BodySet><objects>
<Body name="one">
<mass>1</mass>
<mass_center>0 0 0</mass_center>
<inertia>1 1 1 0 0 0</inertia>
<WrapObjectSet><objects>
<WrapCylinder name="cyl">
<radius>0.1</radius>
<length>1</length>
<quadrant>x</quadrant>
</WrapCylinder>
</objects></WrapObjectSet>
</Body>
</objects></BodySet>
<JointSet><objects>
<PinJoint name="pin">
<socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>b</socket_child_frame>
<coordinates>
<Coordinate name="q">
<locked>false</locked>
</Coordinate>
</coordinates>
<frames>
<PhysicalOffsetFrame name="b">
<socket_parent>/bodyset/one</socket_parent>
</PhysicalOffsetFrame>
</frames>
</PinJoint>
</objects></JointSet>
<ForceSet><objects>
<Thelen2003Muscle name="mus">
<GeometryPath>
<PathPointSet><objects>
<PathPoint name="p1">
<socket_parent_frame>/ground</socket_parent_frame>
<location>0 1 0</location>
</PathPoint>
<PathPoint name="p2">
<socket_parent_frame>/bodyset/one</socket_parent_frame>
<location>0 2 0</location>
</PathPoint>
</objects></PathPointSet>
<PathWrapSet><objects>
<PathWrap name="w">
<wrap_object>cyl</wrap_object>
<method>hybrid</method>
<range>-1 -1</range>
</PathWrap>
</objects></PathWrapSet>
</GeometryPath>
<max_isometric_force>100</max_isometric_force>
<optimal_fiber_length>0.1</optimal_fiber_length>
<tendon_slack_length>0.2</tendon_slack_length>
</Thelen2003Muscle>
</objects></ForceSet>
</Model>
</OpenSimDocument>
)";

std::string replaceAll(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

std::string findRefusal(const std::string& text) {
    try {
        readOsimText(text, "m.osim");
    } catch (const ModelError& error) {
        return error.what();
    }
    return "(read)";
}

TEST(OsimRefusal, TheModelWithoutEditsIsRead) {
    EXPECT_EQ(findRefusal(goodText), "(read)");
}

TEST(OsimRefusal, EachEditHasItsMessage) {
    struct Edit {
        const char* from;
        const char* to;
        const char* message;
    };
    const Edit edits[] = {
        {"\"40000\"", "\"x\"", "m.osim:1: the document version 'x' is not a number"},
        {"\"40000\"", "\"50000\"", "m.osim:1: document version 50000 is newer than 40600, the newest that is known"},
        {"OpenSimDocument", "Document", "m.osim:1: the document is <Document>, not <OpenSimDocument>"},
        {">0 -9.81 0<", ">0 -9.81<", "m.osim:3: gravity of Model 'm' has 2 numbers instead of 3"},
        {">0 -9.81 0<", ">0 -9.8l 0<", "m.osim:3: '-9.8l' is not a number in gravity of Model 'm'"},
        {">0 -9.81 0<", ">0 NaN 0<", "m.osim:3: 'NaN' is not a finite number in gravity"},
        {">0 -9.81 0<", ">0 -Inf 0<", "m.osim:3: '-Inf' is not a finite number in gravity"},
        {"<Body name=\"one\">", "<Body>", "m.osim:6: Body without a name"},
        {"<mass>1</mass>", "", "m.osim:6: Body 'one' has no mass"},
        {"<mass>1</mass>", "<mass>-1</mass>", "m.osim:7: negative mass -1 of Body 'one'"},
        {"<mass>1</mass>", "<mass>1</mass>\n<mass>2</mass>",
         "m.osim:8: a second mass in Body "
         "'one'"},
        {"<mass>1</mass>", "<mass>1</mass><volume>1</volume>", "m.osim:7: unknown element volume in Body 'one'"},
        {"<inertia>1 1 1 ", "<inertia>1 1 ", "m.osim:9: inertia of Body 'one' has 5 numbers instead of 6"},
        {"WrapCylinder", "WrapCone", "m.osim:11: unknown wrap object WrapCone 'cyl'"},
        {"<radius>0.1", "<radius>-0.1",
         "m.osim:12: radius of WrapCylinder 'cyl' is -0.1, not "
         "positive"},
        {"<length>1</length>", "", "m.osim:11: WrapCylinder 'cyl' has no length"},
        {"<quadrant>x", "<quadrant>up", "m.osim:14: unknown quadrant 'up' of WrapCylinder 'cyl'"},
        {"PinJoint", "FooJoint", "m.osim:20: unknown joint FooJoint 'pin'"},
        {">b<", ">c<", "m.osim:22: there is no body or frame 'c', the socket_child_frame of PinJoint 'pin'"},
        {"<coordinates>\n<Coordinate name=\"q\">\n<locked>false</locked>\n</Coordinate>\n"
         "</coordinates>",
         "", "m.osim:20: PinJoint 'pin' has 0 coordinates instead of 1"},
        {"<locked>false", "<locked>maybe",
         "m.osim:25: 'maybe' is neither true nor false in "
         "locked of Coordinate 'q'"},
        {"<locked>false</locked>", "<prescribed>true</prescribed>",
         "m.osim:24: Coordinate 'q' is prescribed but has no prescribed_function"},
        {"<locked>false</locked>", "<range>1 0</range>", "m.osim:25: empty range of Coordinate 'q'"},
        {"/bodyset/one</socket_parent>", "/bodyset/two</socket_parent>",
         "m.osim:30: there is no body or frame '/bodyset/two'"},
        {"/bodyset/one</socket_parent>", "../b</socket_parent>", "m.osim:30: the frame '../b' is its own parent"},
        {"Thelen2003Muscle", "FooMuscle", "m.osim:36: unknown force FooMuscle 'mus'"},
        {"GeometryPath", "FooPath", "m.osim:36: Thelen2003Muscle 'mus' has no GeometryPath"},
        {"GeometryPath", "Scholz2015GeometryPath", "m.osim:37: Scholz2015GeometryPath has no path_elements"},
        {"<PathPoint name=\"p2\">", "<FooPoint/><PathPoint name=\"p2\">",
         "m.osim:43: unknown path point FooPoint in PathPointSet"},
        {"<location>0 2 0</location>", "", "m.osim:43: PathPoint 'p2' has no location"},
        {"<wrap_object>cyl", "<wrap_object>ball",
         "m.osim:50: there is no wrap object 'ball', the wrap_object of PathWrap 'w'"},
        {"<method>hybrid", "<method>best", "m.osim:51: unknown method 'best' of PathWrap 'w'"},
        {"<range>-1 -1", "<range>2 3", "m.osim:52: range 2 3 of PathWrap 'w' is no range of the path's 2 points"},
        {"<range>-1 -1", "<range>2 1", "m.osim:52: range 2 1 of PathWrap 'w' is no range of the path's 2 points"},
        {"<range>-1 -1", "<range>1 1.5", "m.osim:52: range 1 1.5 of PathWrap 'w' is no range of the path's 2 points"},
        {"<optimal_fiber_length>0.1<", "<optimal_fiber_length>-1<",
         "optimal_fiber_length of Thelen2003Muscle 'mus' is -1, not positive"},
        {"<tendon_slack_length>0.2<", "<tendon_slack_length>-0.2<",
         "tendon_slack_length of Thelen2003Muscle 'mus' is -0.2, negative"},
        {"</tendon_slack_length>", "</tendon_slack_length><Flen>1</Flen>",
         "m.osim:36: Thelen2003Muscle 'mus': lengtheningForce must be finite and above 1, but is 1"},
        {">100<", ">0<", "max_isometric_force of Thelen2003Muscle 'mus' is 0, not positive"},
        {">100<", ">1e999<", "'1e999' is not a number in max_isometric_force"},
        {"</Model>", "<ControllerSet><objects>\n<Foo name=\"f\"/></objects></ControllerSet></Model>",
         "m.osim:62: unknown controller Foo 'f'"},
        {"</Model>", "<ConstraintSet><objects>\n<Foo name=\"f\"/></objects></ConstraintSet></Model>",
         "m.osim:62: unknown constraint Foo 'f'"},
        {"</Model>", "<ComponentSet><objects>\n<Foo name=\"f\"/></objects></ComponentSet></Model>",
         "m.osim:62: unknown component Foo 'f'"},
        {"</Model>", "<WeatherSet/></Model>", "unknown element WeatherSet in Model 'm'"},
        {"</Model>", "</Modal>", "not well-formed XML"}};
    for (const Edit& edit : edits) {
        SCOPED_TRACE(edit.to);
        const std::string refusal = findRefusal(replaceAll(goodText, edit.from, edit.to));
        EXPECT_NE(refusal.find(edit.message), std::string::npos)
            << "expected " << edit.message << "\nfound    " << refusal;
    }
}

TEST(OsimRefusal, EveryTruncationIsRefused) {
    const std::string good = goodText;
    for (std::size_t length = 0; length < good.rfind('>'); length += 7)
        EXPECT_NE(findRefusal(good.substr(0, length)), "(read)") << length;
}

TEST(OsimRefusal, DeepNestingEndsWithAMessage) {
    std::string function = "<Constant><value>1</value></Constant>";
    for (int depth = 0; depth < 5000; ++depth)
        function = "<MultiplierFunction><function>" + function + "</function></MultiplierFunction>";
    const std::string refusal = findRefusal(
        replaceAll(goodText, "<locked>false</locked>",
                   "<prescribed>true</prescribed><prescribed_function>" + function + "</prescribed_function>"));
    EXPECT_NE(refusal.find("functions are nested too deeply"), std::string::npos) << refusal;
}

TEST(OsimRefusal, AFileThatIsNotThere) {
    EXPECT_THROW(readOsimFile("no/such/file.osim"), ModelError);
    EXPECT_THROW(readOsimFile(TAUTLINE_SOURCE_DIR), ModelError);
}

/** The first line is <!-- expect: message -->. */
std::string readExpectation(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    const std::string start = "<!-- expect: ", end = " -->";
    if (line.rfind(start, 0) != 0 || line.size() < start.size() + end.size()) return {};
    return line.substr(start.size(), line.size() - start.size() - end.size());
}

/** Reading or building must refuse, and say so beginning with the file's name. */
std::string findFileRefusal(const std::filesystem::path& file) {
    try {
        const ModelDescription model = readOsimFile(file);
        SimTK::MultibodySystem system;
        SimTK::SimbodyMatterSubsystem matter(system);
        try {
            buildMultibody(model, matter);
        } catch (const ModelError&) {
            EXPECT_EQ(matter.getNumBodies(), 1) << "half built: " << file;
            throw;
        }
    } catch (const ModelError& error) {
        return error.what();
    }
    return "(read and built)";
}

TEST(OsimRefusal, FilesInRejected) {
    const auto folder = std::filesystem::path(TAUTLINE_SOURCE_DIR) / "models" / "rejected";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path().filename().string());
        const std::string expected = readExpectation(entry.path());
        ASSERT_FALSE(expected.empty()) << "no first line <!-- expect: ... -->";
        const std::string refusal = findFileRefusal(entry.path());
        EXPECT_EQ(refusal, entry.path().parent_path().string() + "/" + expected);
        ++files;
    }
    EXPECT_GE(files, 12);
}

}  // namespace
}  // namespace tautline::models::testing
