// SPDX-License-Identifier: Apache-2.0
#include "storage_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace tautline {
namespace {

std::filesystem::path makeFile(const std::string& text) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "tautline_storage_test.sto";
    std::ofstream(file) << text;
    return file;
}

void expectRefused(const std::string& text, const std::string& message) {
    try {
        readStorage(makeFile(text));
        FAIL() << "not refused: " << message;
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
}

TEST(StorageFile, ReadsBackTheSameDoubles) {
    StorageTable table;
    table.name = "numbers", table.labels = {"time", "a", "b"};
    table.rows = {{0, 1.0 / 3, -0.0}, {1e-300, std::nextafter(1.0, 2.0), 6.02214076e23}};
    const std::filesystem::path file = makeFile("");
    writeStorage(table, file);
    const StorageTable read = readStorage(file);
    EXPECT_EQ(read.labels, table.labels);
    EXPECT_EQ(read.rows, table.rows);
    EXPECT_FALSE(read.isInDegrees);
}

TEST(StorageFile, BlankLinesAfterTheHeaderAndDegreesAreUnderstood) {
    const StorageTable table =
        readStorage(makeFile("pose\nversion=1\ninDegrees=yes\nendheader\n\n\ntime\tq\n0\t1\n1 2\n"));
    EXPECT_TRUE(table.isInDegrees);
    EXPECT_EQ(table.rows, (std::vector<std::vector<double>>{{0, 1}, {1, 2}}));
}

TEST(StorageFile, BadFilesAreRefusedWithTheLine) {
    expectRefused("a\nendheader\ntime b\n0 x\n", ":4: 'x' is not a number");
    expectRefused("a\nendheader\ntime b\n0 1\n1\n", ":5: 1 numbers for 2 columns");
    expectRefused("a\nendheader\ntime b\n1 1\n1 2\n", ":5: time does not increase");
    expectRefused("a\nendheader\nq b\n", ":3: the first column is 'q', not 'time'");
    expectRefused("a\ntime b\n0 1\n", "no line 'endheader'");
    expectRefused("a\nendheader\ntime b\n", "no rows of numbers");
    EXPECT_THROW(readStorage("no/such/file.sto"), std::runtime_error);
}

TEST(StorageFile, AFailedWriteLeavesNothingBehind) {
    EXPECT_THROW(writeWhole("text", "/no/such/folder/file.txt"), std::runtime_error);
}

}  // namespace
}  // namespace tautline
