// SPDX-License-Identifier: Apache-2.0
/** Rows of poses on several threads: answers that depend on their block alone, to the last bit, and what is said of
poses that cannot be solved. */
#include "tautline/paths/solve_many.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <iterator>
#include <set>
#include <thread>

#include "support/weave_scene.h"
#include "tautline/error.h"
#include "tautline/paths/path_solver.h"
#include "tautline/surfaces/ellipsoid.h"

namespace tautline {
namespace {

using testing::WeaveScene;

constexpr int kThreadCounts[] = {1, 2, 3, 7};

/** A string that touches a swinging ellipsoid at some times and passes it at others. */
struct TouchAndGo {
    PathProblem problem;
    std::vector<PathPose> poses;

    explicit TouchAndGo(int count) {
        problem.addPoint("origin");
        problem.addObstacle("first", std::make_shared<Ellipsoid>(Vector3(0.2, 0.3, 0.4)));
        problem.addObstacle("second", std::make_shared<Cylinder>(0.2), PassOnSide{Vector3::UnitY()});
        problem.addPoint("insertion");
        for (int i = 0; i < count; ++i) {
            const double t = 0.05 * i;
            const Matrix3 R = Eigen::AngleAxisd(0.5 * std::sin(t), Vector3(1, 2, 3).normalized()).toRotationMatrix();
            PathPose pose;
            pose.X_GE = {Pose(Vector3(-1, 0.1, 0)), Pose(R, Vector3(0, 0.3 * std::sin(t) - 0.15, 0.02)),
                         Pose(Vector3(1, 0.2 * std::cos(1.7 * t) - 0.1, 0)), Pose(Vector3(2, -0.05, 0.1))};
            poses.push_back(pose);
        }
    }
};

std::vector<PathPose> makeWeavePoses(const WeaveScene& scene, int count) {
    std::vector<PathPose> poses(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) scene.calcPose(WeaveScene::kTimeStep * i, poses[static_cast<std::size_t>(i)]);
    return poses;
}

/** Adds the bits of numbers, so that NaN equals NaN and 0 differs from -0. */
void addBits(std::vector<std::uint64_t>& bits, const double* numbers, Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i) {
        std::uint64_t pattern = 0;
        std::memcpy(&pattern, numbers + i, sizeof pattern);
        bits.push_back(pattern);
    }
}

std::vector<std::uint64_t> listBits(const PathSolution& path) {
    std::vector<std::uint64_t> bits;
    addBits(bits, &path.length, 1);
    addBits(bits, &path.pathError, 1);
    for (const int number : {static_cast<int>(path.status), path.iterations, path.shots, static_cast<int>(path.wasCold),
                             path.report.failedSteps, static_cast<int>(path.deviation.kind)})
        bits.push_back(static_cast<std::uint64_t>(number));
    for (const ObstacleContact& contact : path.contacts) {
        bits.push_back(contact.isTouched + 2 * contact.isSwitchedOff);
        if (!contact.isTouched) continue;
        addBits(bits, contact.geodesic.P.x.data(), 3);
        addBits(bits, contact.geodesic.Q.x.data(), 3);
        addBits(bits, &contact.geodesic.length, 1);
    }
    for (const StraightSegment& line : path.segments) {
        addBits(bits, line.A.data(), 3);
        addBits(bits, line.B.data(), 3);
    }
    addBits(bits, path.errorHistory.data(), static_cast<Eigen::Index>(path.errorHistory.size()));
    return bits;
}

void expectSameBits(const std::vector<PathSolution>& a, const std::vector<PathSolution>& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(listBits(a[i]), listBits(b[i])) << what << ", pose " << i;
}

void expectSameForAllThreads(const PathProblem& problem, const std::vector<PathPose>& poses) {
    std::vector<PathSolution> one;
    solveMany(problem, poses, one, {}, {1, {}});
    for (const int count : kThreadCounts) {
        std::vector<PathSolution> out;
        solveMany(problem, poses, out, {}, {count, {}});
        expectSameBits(out, one, std::to_string(count) + " threads");
    }
}

TEST(SolveMany, AnswersAreTheSameBitsForAllNumbersOfThreads) {
    const TouchAndGo scene(10 * kPosesPerBlock + 17);
    expectSameForAllThreads(scene.problem, scene.poses);
    const WeaveScene weave(WeaveScene::Kind::Cylinders, 4);
    expectSameForAllThreads(weave.getProblem(), makeWeavePoses(weave, 5 * kPosesPerBlock + 1));
}

/** Of a row that was solved before, nothing is left in memory that is used again. */
TEST(SolveMany, AnswersDoNotDependOnWhatOutHeld) {
    const TouchAndGo scene(3 * kPosesPerBlock);
    std::vector<PathSolution> fresh, used;
    solveMany(scene.problem, scene.poses, fresh, {}, {2, {}});
    const WeaveScene weave(WeaveScene::Kind::Spheres, 3);
    solveMany(weave.getProblem(), makeWeavePoses(weave, 4 * kPosesPerBlock), used, {}, {2, {}});
    solveMany(scene.problem, scene.poses, used, {}, {2, {}});
    expectSameBits(used, fresh, "memory used again");
    std::vector<PathPose> reversed(scene.poses.rbegin(), scene.poses.rend());
    solveMany(scene.problem, reversed, used, {}, {2, {}});
    solveMany(scene.problem, scene.poses, used, {}, {2, {}});
    expectSameBits(used, fresh, "memory used again after the row backwards");
}

/** Continued or not, the path is that of its pose alone. */
TEST(SolveMany, AnswersAreThoseOfColdSolves) {
    const TouchAndGo scene(4 * kPosesPerBlock);
    std::vector<PathSolution> out;
    solveMany(scene.problem, scene.poses, out);
    int touched = 0, passed = 0, continued = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const PathSolution cold = solvePath(scene.problem, scene.poses[i]);
        EXPECT_EQ(out[i].status, cold.status) << i;
        EXPECT_NEAR(out[i].length, cold.length, 1e-12) << i;
        for (const int e : {1, 2}) ++(out[i].contacts[static_cast<std::size_t>(e)].isTouched ? touched : passed);
        continued += !out[i].wasCold;
        EXPECT_TRUE(out[i].wasCold || i % kPosesPerBlock != 0) << i;
    }
    EXPECT_GT(touched, 50);
    EXPECT_GT(passed, 50);
    EXPECT_GT(continued, 150);
}

TEST(SolveMany, NoPosesHaveNoPaths) {
    const TouchAndGo scene(0);
    std::vector<PathSolution> out(5);
    for (const int count : kThreadCounts) {
        solveMany(scene.problem, scene.poses, out, {}, {count, {}});
        EXPECT_TRUE(out.empty());
    }
}

TEST(SolveMany, OnePoseIsAColdSolve) {
    const TouchAndGo scene(1);
    for (const int count : kThreadCounts) {
        std::vector<PathSolution> out;
        solveMany(scene.problem, scene.poses, out, {}, {count, {}});
        expectSameBits(out, {solvePath(scene.problem, scene.poses.front())}, std::to_string(count) + " threads");
    }
}

/** It has no path, and those after it are found anew. */
TEST(SolveMany, APoseThatIsNotFiniteStandsAlone) {
    TouchAndGo scene(2 * kPosesPerBlock);
    std::vector<PathSolution> whole, out;
    solveMany(scene.problem, scene.poses, whole);
    const std::size_t broken[] = {0, 5, kPosesPerBlock - 1};
    for (const std::size_t i : broken) scene.poses[i].X_GE[1].p.y() = i == 5 ? kInfinity : kNaN;
    solveMany(scene.problem, scene.poses, out);
    for (const std::size_t i : broken) {
        EXPECT_EQ(out[i].status, PathStatus::NotConverged) << i;
        EXPECT_TRUE(std::isnan(out[i].length)) << i;
        EXPECT_TRUE(out[i].segments.empty()) << i;
    }
    EXPECT_TRUE(out[1].wasCold);
    EXPECT_TRUE(out[6].wasCold);
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (std::find(std::begin(broken), std::end(broken), i) != std::end(broken)) continue;
        EXPECT_NEAR(out[i].length, whole[i].length, 1e-12) << i;
    }
    expectSameForAllThreads(scene.problem, scene.poses);
}

template <class Call>
std::string catchRefusal(Call call) {
    try {
        call();
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

TEST(SolveMany, RefusesAPoseOfAnotherSizeByItsNumber) {
    TouchAndGo scene(200);
    std::vector<PathSolution> out(3);
    scene.poses[150].X_GE.pop_back();
    scene.poses[170].X_GE.clear();
    for (const int count : kThreadCounts)
        EXPECT_EQ(catchRefusal([&] {
                      solveMany(scene.problem, scene.poses, out, {}, {count, {}});
                  }),
                  "pose 150 of 200: path pose: has 3 poses for 4 elements");
    EXPECT_EQ(out.size(), 3u);
    EXPECT_EQ(catchRefusal([&] {
                  solveMany(scene.problem, {}, out, {}, {-2, {}});
              }),
              "threads must not be negative, but is -2");
}

/** Of a surface of a user's, say: with any number of threads it is the error of the first pose that has one. */
TEST(RunBlocks, ThrowTheFirstOfAllErrors) {
    constexpr int kItems = 1000, kBlock = 7, kFirst = 423;
    for (const int count : kThreadCounts) {
        std::atomic<int> before{0};
        const auto work = [&](int, int item) {
            if (item >= kFirst && item % 2 == 1) throw std::runtime_error("item " + std::to_string(item));
            before += item < kFirst;
        };
        try {
            runBlocks(kItems, kBlock, {count, {}}, work);
            ADD_FAILURE() << "no error";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "item 423") << count << " threads";
        }
        EXPECT_EQ(before, kFirst) << count << " threads";
    }
}

TEST(RunBlocks, WorkOnEachItemOnceAndOnBlocksInOrder) {
    constexpr int kItems = 500, kBlock = 9;
    for (const int count : kThreadCounts) {
        std::vector<std::vector<int>> items(static_cast<std::size_t>(count));
        EXPECT_TRUE(runBlocks(kItems, kBlock, {count, {}}, [&](int worker, int item) {
            items.at(static_cast<std::size_t>(worker)).push_back(item);
        }));
        std::set<int> all;
        for (const std::vector<int>& ofOne : items)
            for (std::size_t k = 0; k < ofOne.size(); ++k) {
                EXPECT_TRUE(all.insert(ofOne[k]).second);
                EXPECT_TRUE(ofOne[k] % kBlock == 0 || (k > 0 && ofOne[k - 1] == ofOne[k] - 1));
            }
        EXPECT_EQ(all.size(), static_cast<std::size_t>(kItems));
    }
}

TEST(RunBlocks, AnInterruptionEndsThem) {
    for (const int count : kThreadCounts) {
        std::atomic<bool> isAsked{false};
        std::atomic<int> done{0};
        const Threads threads{count, [&] { return isAsked = true; }};
        // Each item waits for the interruption, so that it comes in the midst of the work.
        EXPECT_FALSE(runBlocks(1000, 4, threads, [&](int, int) {
            while (!isAsked) std::this_thread::yield();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            ++done;
        }));
        EXPECT_LT(done, 1000);
        EXPECT_TRUE(runBlocks(3, 4, {count, [] { return false; }}, [](int, int) {}));
    }
}

}  // namespace
}  // namespace tautline
