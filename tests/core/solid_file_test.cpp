// SPDX-License-Identifier: Apache-2.0
/** A solid's file gives back the same bits, and no damage to it goes unnoticed. */
#include "tautline/surfaces/solid_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "support/random.h"
#include "support/triangle_meshes.h"
#include "tautline/error.h"
#include "tautline/surfaces/solid_fit.h"

namespace tautline {
namespace {

constexpr unsigned kSeed = 20261127;

const BSplineSolid& getSolid() {
    static const BSplineSolid solid =
        fitSolid(testing::scaleMesh(testing::makeBallMesh(1), Vector3(0.03, 0.05, 0.04))).solid;
    return solid;
}

/** What reading the bytes is refused with; empty if it is not. */
std::string findRefusal(const std::string& bytes) {
    try {
        decodeSolid(bytes, "bone.solid");
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return {};
}

TEST(SolidFile, GivesBackTheSameBits) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "tautline_ball.solid";
    writeSolidFile(getSolid(), file);
    const BSplineSolid read = readSolidFile(file);
    EXPECT_EQ(encodeSolid(read), encodeSolid(getSolid()));
    EXPECT_EQ(read.getDescription(), getSolid().getDescription());
    testing::Random random(kSeed);
    for (int i = 0; i < 1000; ++i) {
        const Vector3 p = random.vector(0.1);
        const ImplicitValue before = getSolid().calcImplicit(p), after = read.calcImplicit(p);
        EXPECT_EQ(before.f, after.f);
        EXPECT_EQ(before.gradient, after.gradient);
        EXPECT_EQ(before.hessian, after.hessian);
    }
    std::filesystem::remove(file);
}

TEST(SolidFile, CutOffAnywhereIsRefused) {
    const std::string bytes = encodeSolid(getSolid());
    testing::Random random(kSeed);
    for (int i = 0; i < 300; ++i) {
        const int length = i < 200 ? i : random.integer(0, static_cast<int>(bytes.size()) - 1);
        EXPECT_NE(findRefusal(bytes.substr(0, static_cast<std::size_t>(length))), "") << length;
    }
    EXPECT_NE(findRefusal(bytes + '\0'), "");
}

TEST(SolidFile, AnyByteThatIsAnotherIsRefused) {
    const std::string bytes = encodeSolid(getSolid());
    testing::Random random(kSeed);
    for (int i = 0; i < 2000; ++i) {
        std::string damaged = bytes;
        const int at = i < 200 ? i : random.integer(0, static_cast<int>(bytes.size()) - 1);
        damaged[static_cast<std::size_t>(at)] ^= static_cast<char>(random.integer(1, 255));
        EXPECT_NE(findRefusal(damaged), "") << at;
    }
}

TEST(SolidFile, SaysWhatIsWrong) {
    const std::string bytes = encodeSolid(getSolid());
    EXPECT_EQ(findRefusal("solid ball\n"), "bone.solid: no file of a solid");
    std::string other = bytes;
    other[8] = 2;
    EXPECT_EQ(findRefusal(other), "bone.solid: of version 2, where this program reads version 1: fit the mesh again");
    other = bytes;
    std::swap(other[12], other[15]), std::swap(other[13], other[14]);
    EXPECT_EQ(findRefusal(other), "bone.solid: written on a machine of another byte order");
    other = bytes;
    other[100] ^= 1;
    EXPECT_EQ(findRefusal(other), "bone.solid: damaged: its checksum is wrong");
    EXPECT_EQ(findRefusal(bytes.substr(0, 1000)),
              "bone.solid: should be " + std::to_string(bytes.size()) + " bytes long, but is 1000");
    try {
        readSolidFile("no/such/file.solid");
        ADD_FAILURE() << "not refused";
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(), "no/such/file.solid: the file cannot be read");
    }
}

}  // namespace
}  // namespace tautline
