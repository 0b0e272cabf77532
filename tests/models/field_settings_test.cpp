// SPDX-License-Identifier: Apache-2.0
/** Fields of a model that get other values than the file gives them (ReadingOptions::settings). */
#include "model_test_support.h"

namespace tautline::models::testing {
namespace {

std::filesystem::path findModel() {
    return std::filesystem::path(TAUTLINE_SOURCE_DIR) / "models" / "elbow.osim";
}

ModelDescription readWith(const std::vector<std::string>& settings) {
    ReadingOptions options;
    options.settings = settings;
    return readOsimFile(findModel(), options);
}

/** The message with which a setting is refused. */
std::string refuse(const std::string& setting) {
    try {
        readWith({setting});
    } catch (const ModelError& error) {
        return error.what();
    }
    return "";
}

double getForce(const ModelDescription& model, const std::string& muscle) {
    return findMuscle(model, muscle)->model->getParameters().maxIsometricForce;
}

TEST(FieldSettings, SetANumberAndSayWhatTheFileHas) {
    const ModelDescription model = readWith({"triceps_long/max_isometric_force=123.25"});
    EXPECT_EQ(getForce(model, "triceps_long"), 123.25);
    EXPECT_EQ(getForce(model, "triceps_lateral"), getForce(readWith({}), "triceps_lateral"));
    ASSERT_FALSE(model.notes.empty());
    EXPECT_EQ(model.notes.front().text, "max_isometric_force of 'triceps_long' is set to 123.25 in place of 800");
    EXPECT_EQ(model.notes.front().line, 184);
}

TEST(FieldSettings, MultiplyEveryNumberOfAField) {
    const ModelDescription before = readWith({}), after = readWith({"forearm/inertia=*2.5", "humerus/mass=*0.5"});
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(findBody(after, "forearm")->inertia[i], 2.5 * findBody(before, "forearm")->inertia[i]);
    EXPECT_EQ(findBody(after, "humerus")->mass, 0.5 * 1.86);
}

TEST(FieldSettings, GoOnFromOneToTheNext) {
    const ModelDescription model =
        readWith({"triceps_long/max_isometric_force=100", "triceps_long/max_isometric_force=*1.5"});
    EXPECT_EQ(getForce(model, "triceps_long"), 150);
}

TEST(FieldSettings, TellElementsOfOneNameApartByWhatIsAroundThem) {
    const std::string twice = refuse("humerus_offset/translation=0 0 0");
    EXPECT_NE(twice.find("meets 2 fields (lines "), std::string::npos) << twice;
    const ModelDescription model = readWith({"shoulder/humerus_offset/translation=0.001 0 0"});
    EXPECT_EQ(model.notes.size(), readWith({}).notes.size() + 1);
    EXPECT_EQ(readWith({"jointset/shoulder/humerus_offset/translation=0.001 0 0"}).notes.front().text,
              model.notes.front().text);
}

TEST(FieldSettings, AreJudgedLikeValuesOfTheFile) {
    const std::string said = refuse("forearm/mass=heavy");
    EXPECT_NE(said.find("elbow.osim:62: "), std::string::npos) << said;
    EXPECT_NE(said.find("heavy"), std::string::npos) << said;
}

TEST(FieldSettings, ThatMeetNothingOrSayNothingAreRefusedByName) {
    for (const auto& [setting, words] : std::vector<std::pair<std::string, std::string>>{
             {"triceps_long", "must be ELEMENT/FIELD=VALUE"},
             {"triceps_long=3", "must be ELEMENT/FIELD=VALUE"},
             {"triceps_long/max_isometric_force=", "must be ELEMENT/FIELD=VALUE"},
             {"/max_isometric_force=3", "has an empty name in it"},
             {"triceps_long//max_isometric_force=3", "has an empty name in it"},
             {"tricep/max_isometric_force=3", "meets no element of that name"},
             {"shoulder/triceps_long/max_isometric_force=3", "meets no element of that name"},
             {"triceps_long/max_force=3", "meets no field <max_force> of 'triceps_long' (line 156 "},
             {"triceps_long/geometrypath=3", "meets no field <geometrypath>"},
             {"triceps_long/GeometryPath=3", "has elements in it and no value"},
             {"triceps_long/max_isometric_force=*", "has the factor ''"},
             {"triceps_long/max_isometric_force=*nan", "has the factor 'nan'"},
             {"triceps_long/max_isometric_force=*2x", "has the factor '2x'"},
             {"elbow_flexion/locked=*2", "has to multiply 'false'"}}) {
        const std::string said = refuse(setting);
        EXPECT_NE(said.find(words), std::string::npos) << setting << ": " << said;
        EXPECT_NE(said.find("'" + setting + "'"), std::string::npos) << said;
    }
}

}  // namespace
}  // namespace tautline::models::testing
