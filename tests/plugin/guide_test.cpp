// SPDX-License-Identifier: Apache-2.0
/** Every block of code in the guide is a program that is compiled and run, every command of it works. */
#include <gtest/gtest.h>

#include <set>

#include "program_support.h"

namespace {

using namespace tautline::testing;
namespace fs = std::filesystem;

const fs::path kRoot = TAUTLINE_SOURCE_DIR;

/** A block between fences, without the language. */
struct Block {
    std::string page, language, text;
};

std::vector<Block> findBlocks() {
    std::vector<Block> blocks;
    for (const auto& entry : fs::directory_iterator(kRoot / "plugin/guide")) {
        if (entry.path().extension() != ".md") continue;
        const std::string page = readAll(entry.path()), fence = "```";
        for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
            const std::size_t line = page.find('\n', at), end = page.find(fence, line);
            blocks.push_back(
                {entry.path().filename(), page.substr(at + 3, line - at - 3), page.substr(line + 1, end - line - 1)});
            at = end + 3;
        }
    }
    return blocks;
}

/** Sources of all examples without their license. They are compiled and run by tests. */
std::set<std::string> readExamples() {
    std::set<std::string> examples;
    for (const char* folder : {"plugin/examples", "plugin/examples/guide", "simbody_adapter/examples"})
        for (const auto& entry : fs::directory_iterator(kRoot / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string text = readAll(entry.path());
            examples.insert(text.substr(text.find_first_not_of('\n', text.find('\n'))));
        }
    for (const auto& entry : fs::directory_iterator(kRoot / "models"))  // which a command of the same page runs
        if (entry.path().extension() == ".json") examples.insert(readAll(entry.path()));
    return examples;
}

TEST(Guide, ShowsProgramsThatAreTested) {
    const std::set<std::string> examples = readExamples();
    int numPrograms = 0;
    for (const Block& block : findBlocks()) {
        if (block.language == "sh") continue;
        EXPECT_TRUE(examples.count(block.text)) << block.page << ": a block that is no example:\n" << block.text;
        ++numPrograms;
    }
    EXPECT_GE(numPrograms, 7);
}

TEST(Guide, CommandsWork) {
    int numCommands = 0;
    for (const Block& block : findBlocks()) {
        if (block.language != "sh") continue;
        std::istringstream lines(block.text);
        for (std::string line; std::getline(lines, line); ++numCommands) {
            const std::string program = "build/bin/tautline";
            ASSERT_EQ(line.rfind(program, 0), 0u) << line;
            std::string output;
            const std::string folder = makeFolder("guide").string();
            std::string arguments = line.substr(program.size());
            const std::size_t results = arguments.find(" results/");  // not into the sources
            if (results != std::string::npos) arguments.replace(results, 9, " " + folder + "/");
            const std::string command = TAUTLINE_PROGRAM + arguments + " --out " + folder;
            EXPECT_EQ(runProgram("cd " + kRoot.string() + " && " + command, output), 0) << line << "\n" << output;
        }
    }
    EXPECT_GE(numCommands, 1);
}

TEST(Guide, PagesLinkToPagesThatExist) {
    int numLinks = 0;
    for (const auto& entry : fs::directory_iterator(kRoot / "plugin/guide")) {
        if (entry.path().extension() != ".md") continue;
        const std::string page = readAll(entry.path());
        for (std::size_t at = page.find("]("); at != std::string::npos; at = page.find("](", at + 1)) {
            const std::string link = page.substr(at + 2, page.find(')', at) - at - 2);
            if (link.size() < 3 || link.substr(link.size() - 3) != ".md") continue;
            EXPECT_TRUE(fs::exists(entry.path().parent_path() / link)) << entry.path() << ": " << link;
            ++numLinks;
        }
    }
    EXPECT_GE(numLinks, 7);
}

}  // namespace
