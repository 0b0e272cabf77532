// SPDX-License-Identifier: Apache-2.0
/** Files of controls: their values by hand, and what is refused. */
#include "tautline/models/control_set.h"

#include <gtest/gtest.h>

#include <fstream>

namespace tautline::models::testing {
namespace {

std::vector<Control> readControls(const std::string& text) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "tautline_control_set_test.xml";
    std::ofstream(file) << text;
    return readControlSet(file);
}

std::string wrapControls(const std::string& objects, const std::string& before = "") {
    return "<OpenSimDocument Version=\"20302\">\n<ControlSet name=\"controls\">" + before + "<objects>\n" + objects +
           "</objects></ControlSet></OpenSimDocument>\n";
}

std::string makeNode(const std::string& t, const std::string& value) {
    return "<ControlLinearNode><t>" + t + "</t><value>" + value + "</value></ControlLinearNode>\n";
}

std::string makeLinear(const std::string& fields, const std::string& nodes) {
    return "<ControlLinear name=\"soleus\"><is_model_control>true</is_model_control>" + fields +
           "<default_min>0.02</default_min><default_max>1</default_max><filter_on>false</filter_on><x_nodes>\n" +
           nodes + "</x_nodes><min_nodes/><max_nodes/><kp>100</kp><kv>20</kv></ControlLinear>\n";
}

const std::string kNodes = makeNode("1", "0.2") + makeNode("2", "0.6") + makeNode("4", "0.4");

struct Sample {
    double time, value;
};

void expectValues(const std::string& fields, const std::vector<Sample>& samples, const std::string& before = "") {
    SCOPED_TRACE(fields);
    const std::vector<Control> controls = readControls(wrapControls(makeLinear(fields, kNodes), before));
    ASSERT_EQ(controls.size(), 1u);
    EXPECT_EQ(controls[0].name, "soleus");
    for (const Sample& sample : samples)
        EXPECT_NEAR(controls[0].calcValue(sample.time), sample.value, 1e-15) << sample.time;
}

TEST(ControlSet, LinesGoOnBeyondTheNodesUnlessTheySayNot) {
    expectValues("", {{0, -0.2}, {1, 0.2}, {1.5, 0.4}, {2, 0.6}, {3, 0.5}, {4, 0.4}, {6, 0.2}});
    expectValues("<extrapolate>false</extrapolate>", {{0, 0.2}, {1, 0.2}, {1.5, 0.4}, {3, 0.5}, {4, 0.4}, {6, 0.4}});
}

/** The value of a node holds from just after the node before it, which is how CMC has computed it. */
TEST(ControlSet, StepsHaveTheValueOfTheNodeToCome) {
    const std::vector<Sample> samples = {{0, 0.2}, {1, 0.2}, {1.001, 0.6}, {2, 0.6}, {2.5, 0.4}, {4, 0.4}, {6, 0.4}};
    expectValues("<use_steps>true</use_steps>", samples);
    expectValues("", samples,
                 "<defaults><ControlLinear name=\"default\"><use_steps>true</use_steps></ControlLinear></defaults>");
}

TEST(ControlSet, OneNodeAndAConstantHoldAtAllTimes) {
    const std::vector<Control> controls =
        readControls(wrapControls(makeLinear("", makeNode("1", "0.3")) +
                                  "<ControlConstant name=\"tibialis\"><value>0.7</value></ControlConstant>"));
    ASSERT_EQ(controls.size(), 2u);
    for (const double time : {-5.0, 1.0, 5.0}) {
        EXPECT_EQ(controls[0].calcValue(time), 0.3);
        EXPECT_EQ(controls[1].calcValue(time), 0.7);
    }
}

TEST(ControlSet, RefusesByFileAndLine) {
    struct Case {
        std::string text, message;
    };
    const Case cases[] = {
        {wrapControls(makeLinear("", "")), ":3: ControlLinear 'soleus' has no nodes"},
        {wrapControls(makeLinear("", makeNode("1", "0") + makeNode("1", "1"))),
         ":5: the nodes of ControlLinear 'soleus' do not increase in time: 1.000000 s comes after 1.000000 s"},
        {wrapControls(makeLinear("", makeNode("1", "high"))),
         ":4: 'high' is not a number in value of ControlLinearNode"},
        {wrapControls("<ControlSpline name=\"s\"/>"), ":3: unknown control ControlSpline 's' in ControlSet"},
        {"<OpenSimDocument><Model/></OpenSimDocument>", ":1: "},
        {"<ControlSet>", "not well-formed XML"},
    };
    for (const Case& refused : cases) {
        try {
            readControls(refused.text);
            FAIL() << refused.message;
        } catch (const ModelError& error) {
            EXPECT_NE(std::string(error.what()).find(refused.message), std::string::npos)
                << error.what() << "\nexpected " << refused.message;
        }
    }
    EXPECT_THROW(readControlSet("no_such_controls.xml"), ModelError);
}

}  // namespace
}  // namespace tautline::models::testing
