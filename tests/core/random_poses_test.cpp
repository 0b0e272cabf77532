/** Random scenes (support/random_scene.h): every solve ends with a status, finite numbers
and within a fixed count of shots, and what is no solution is explained. */
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>

#include "paths/obstacle_walk.h"
#include "support/random_scene.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/paths/path_verification.h"

namespace tautline {
namespace {

using testing::RandomScene;

/** Shots are geodesics: after 20,000 per element of the path no search begins anew, but one that has begun ends. */
constexpr int kMaxShotsPerElement = 25000;

bool isFinite(const PathSolution& path, const std::vector<Vec3>& points) {
    bool finite = std::isfinite(path.length);
    for (const StraightSegment& s : path.segments)
        finite = finite && s.A.allFinite() && s.B.allFinite() && s.e.allFinite();
    for (const Vec3& p : points) finite = finite && p.allFinite();
    return finite;
}

/** Lowest of many heights of the straight segments over the obstacles that they pass, in sizes: found without the
solver's own search for low places. */
double calcLowestHeight(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    constexpr int kSamples = 300;
    double lowest = kInfinity;
    visitObstaclesOnSegments(problem, pose, path, [&](int e, int in, int out) {
        if (path.contacts[e].isSwitchedOff) return;
        const Surface& surface = *problem.getElement(e).surface;
        Vec3 N;
        for (int segment = in; segment <= out; ++segment)
            for (int i = 0; i <= kSamples; ++i) {
                const StraightSegment& line = path.segments[segment];
                const Vec3 D = line.A + i * (line.B - line.A) / kSamples;
                lowest = std::min(lowest, surface.calcHeight(pose.X_GE[e].shiftBack(D), N) / surface.getSize());
            }
    });
    return lowest;
}

/** True if the string comes to rest when the scene is moved a little, so that nothing symmetric is left. */
bool hasMinimumNearby(const PathProblem& problem, const PathPose& pose) {
    PathPose moved = pose;
    for (std::size_t e = 0; e < moved.X_GE.size(); ++e) {
        const double phase = 1.0 + static_cast<double>(e);
        moved.X_GE[e].p += 1e-9 * Vec3(std::sin(phase), std::sin(2 * phase), std::sin(3 * phase));
    }
    return solvePath(problem, moved).status == PathStatus::Solved;
}

/** What a solve came to, in few words; for what is no solution, why there is none. */
std::string classify(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    const std::string why = explainStatus(problem, pose, path);
    std::string key = getName(path.status);
    const auto has = [&why](const char* words) { return why.find(words) != std::string::npos; };
    if (path.status == PathStatus::Solved) return key;
    for (const char* reason :
         {"is inside", "in the groove", "in two places", "against the order", "still slides", "would lift inside",
          "pressure vanishes", "leaves the domain", "too short for the rounding"})
        if (has(reason) && !(has("still slides") && hasMinimumNearby(problem, pose))) return key + ", " + reason;
    return key + ", unexplained: " + why;
}

/** One scene in eight is made of all kinds and forms of surfaces, some of which are slow. */
RandomScene::Kinds chooseKinds(unsigned seed) {
    if (seed % 8 == 0) return RandomScene::Kinds::All;
    return seed % 128 == 4 ? RandomScene::Kinds::Aligned : RandomScene::Kinds::Basic;
}

struct Slowest {
    double seconds = 0;
    unsigned seed = 0;
};

void runScenes(int count, unsigned firstSeed) {
    std::map<std::string, int> outcomes;
    PathSolver solver;
    std::vector<Vec3> points;
    Slowest slowest;
    int mostShots = 0, worstSeed = 0;
    for (int i = 0; i < count; ++i) {
        const unsigned seed = firstSeed + static_cast<unsigned>(i);
        PathProblem problem;
        PathPose pose;
        RandomScene(seed, chooseKinds(seed)).make(problem, pose);
        PathSolution path;
        const auto start = std::chrono::steady_clock::now();
        EXPECT_NO_THROW(solver.solve(problem, pose, path)) << "seed " << seed;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        if (elapsed.count() > slowest.seconds) slowest = {elapsed.count(), seed};
        calcDrawingPoints(path, problem, pose, 0.3, points);
        EXPECT_TRUE(isFinite(path, points)) << "seed " << seed << ", " << getName(path.status);
        EXPECT_LE(path.shots, kMaxShotsPerElement * problem.getNumElements()) << "seed " << seed;
        if (path.shots > mostShots) mostShots = path.shots, worstSeed = static_cast<int>(seed);
        if (path.status == PathStatus::Solved) {
            EXPECT_TRUE(verifyPath(problem, pose, path).isMinimum()) << "seed " << seed;
            EXPECT_GT(calcLowestHeight(problem, pose, path), -1e-7) << "seed " << seed;
        }
        const std::string outcome = classify(problem, pose, path);
        EXPECT_EQ(outcome.find("unexplained"), std::string::npos) << "seed " << seed << ": " << outcome;
        ++outcomes[outcome];
    }
    std::cout << count << " scenes from seed " << firstSeed << ", most shots " << mostShots << " (seed " << worstSeed
              << "), slowest solve " << slowest.seconds << " s (seed " << slowest.seed << ")\n";
    for (const auto& [outcome, number] : outcomes) std::cout << "  " << outcome << ": " << number << "\n";
}

/** Twenty thousand scenes, in parts that can run side by side. */
class RandomPoses : public ::testing::TestWithParam<int> {
protected:
    static constexpr int kScenesPerPart = 5000;
};

TEST_P(RandomPoses, EndWithAnExplainedStatusAndFiniteNumbers) {
    runScenes(kScenesPerPart, 1 + static_cast<unsigned>(kScenesPerPart * GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Parts, RandomPoses, ::testing::Range(0, 4));

// Symptoms until 2026-11-25: tiny bodies on the straight line under whose touch the search strayed, lines along the
// axis of a capsule, the apex of a cone, arcs beyond their conjugate points that no search among geodesics left, cusps
// where surfaces overlap, 276,105 shots.
TEST(RandomScenes, ScenesThatOnceHadNoExplanationAreSolvedOrHaveOne) {
    struct Scene {
        unsigned seed;
        RandomScene::Kinds kinds;
        bool hasMinimum;
    };
    constexpr auto kBasic = RandomScene::Kinds::Basic, kAll = RandomScene::Kinds::All;
    for (const Scene& scene :
         {Scene{12573, kBasic, true},    Scene{1026259, kBasic, true},  Scene{1031247, kBasic, true},
          Scene{1056053, kBasic, true},  Scene{1069570, kBasic, true},  Scene{1846297, kBasic, true},
          Scene{1076056, kBasic, false}, Scene{1820249, kBasic, false}, Scene{1016328, kAll, true},
          Scene{1016512, kAll, true},    Scene{1069064, kAll, true},    Scene{1070768, kAll, true},
          Scene{1085768, kAll, false},   Scene{1584688, kAll, false},   Scene{1667733, kBasic, false},
          Scene{1787872, kAll, false},   Scene{1806640, kAll, true},    Scene{1821152, kAll, false},
          Scene{1472824, kAll, false},   Scene{1649520, kAll, true},    Scene{1282183, kBasic, false}}) {
        SCOPED_TRACE(scene.seed);
        PathProblem problem;
        PathPose pose;
        RandomScene(scene.seed, scene.kinds).make(problem, pose);
        const PathSolution path = solvePath(problem, pose);
        const std::string outcome = classify(problem, pose, path);
        EXPECT_EQ(outcome.find("unexplained"), std::string::npos) << outcome;
        EXPECT_LE(path.shots, kMaxShotsPerElement * problem.getNumElements());
        // With an end inside, what is left of the obstacles still has a path.
        const bool isFound = path.status == PathStatus::Solved || path.status == PathStatus::EndInside;
        EXPECT_TRUE(isFound || !scene.hasMinimum) << outcome;
        EXPECT_TRUE(path.pathError < 1e-11 || !scene.hasMinimum);
    }
}

/** A million scenes, in parts that can run side by side. */
class LongRandomPoses : public ::testing::TestWithParam<int> {
protected:
    static constexpr int kScenesPerPart = 50000;
};

TEST_P(LongRandomPoses, EndWithAnExplainedStatusAndFiniteNumbers) {
    runScenes(kScenesPerPart, 1000001 + static_cast<unsigned>(kScenesPerPart * GetParam()));
}

INSTANTIATE_TEST_SUITE_P(LongParts, LongRandomPoses, ::testing::Range(0, 20));

}  // namespace
}  // namespace tautline
