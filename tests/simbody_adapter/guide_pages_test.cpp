// SPDX-License-Identifier: Apache-2.0
/** The code of the pages is that of the programs which are compiled and run. */
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace tautline::testing {
namespace {

std::string readFile(const std::string& file) {
    std::ifstream in(TAUTLINE_SOURCE_DIR "/simbody_adapter/" + file);
    EXPECT_TRUE(in.good()) << file;
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(GuidePages, ShowWhatTheProgramsDo) {
    for (const std::string name : {"coming_from_cable_path", "coming_from_cable_span"}) {
        const std::string page = readFile("guide/" + name + ".md"), program = readFile("examples/" + name + ".cpp");
        const std::string begin = "```cpp\n", end = "```";
        int blocks = 0;
        for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1), ++blocks) {
            const std::size_t first = at + begin.size();
            const std::string block = page.substr(first, page.find(end, first) - first);
            EXPECT_NE(program.find(block), std::string::npos) << name << ":\n" << block;
        }
        EXPECT_EQ(blocks, 2);
    }
}

}  // namespace
}  // namespace tautline::testing
