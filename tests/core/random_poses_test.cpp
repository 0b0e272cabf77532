// SPDX-License-Identifier: Apache-2.0
/** Random scenes (support/random_scene.h): every solve ends with a status, finite numbers
and within a fixed count of shots, and what is no solution is explained. */
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <utility>

#include "paths/problem/posed_problem.h"
#include "support/random.h"
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

bool isFinite(const PathSolution& path, const std::vector<Vector3>& points) {
    bool finite = std::isfinite(path.length);
    for (const StraightSegment& s : path.segments)
        finite = finite && s.A.allFinite() && s.B.allFinite() && s.e.allFinite();
    for (const Vector3& p : points) finite = finite && p.allFinite();
    return finite;
}

/** Lowest of many heights of the straight segments over the obstacles that they pass, in sizes: found without the
solver's own search for low places. */
double calcLowestHeight(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    constexpr int kSamples = 300;
    double lowest = kInfinity;
    PosedProblem{problem, pose}.forEachObstacleOnSegments(path, [&](int e, int in, int out) {
        if (path.contacts[e].isSwitchedOff) return;
        const Surface& surface = *problem.getElement(e).surface;
        for (int segment = in; segment <= out; ++segment)
            for (int i = 0; i <= kSamples; ++i) {
                const StraightSegment& line = path.segments[segment];
                const Vector3 D = line.A + i * (line.B - line.A) / kSamples;
                lowest = std::min(lowest, surface.calcHeight(pose.X_GE[e].shiftBack(D)) / surface.getSize());
            }
    });
    return lowest;
}

/** True if the string comes to rest when the scene is moved a little, so that nothing symmetric is left. */
bool hasMinimumNearby(const PathProblem& problem, const PathPose& pose) {
    PathPose moved = pose;
    for (std::size_t e = 0; e < moved.X_GE.size(); ++e) {
        const double phase = 1.0 + static_cast<double>(e);
        moved.X_GE[e].p += 1e-9 * Vector3(std::sin(phase), std::sin(2 * phase), std::sin(3 * phase));
    }
    return solvePath(problem, moved).status == PathStatus::Solved;
}

/** What a solve came to, in few words; for what is no solution, why there is none. */
std::string classify(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    const std::string why = explainStatus(problem, pose, path);
    std::string key = getName(path.status);
    const auto has = [&why](const char* words) { return why.find(words) != std::string::npos; };
    if (path.status == PathStatus::Solved) return key;
    for (const char* reason : {"is inside", "in the groove", "against the order", "still slides", "would lift inside",
                               "pressure vanishes", "leaves the domain", "too short for the rounding"})
        if (has(reason) && !(has("still slides") && hasMinimumNearby(problem, pose))) return key + ", " + reason;
    return key + ", unexplained: " + why;
}

/** One scene in eight is made of all kinds and forms of surfaces, some of which are slow. */
RandomScene::Kinds chooseKinds(unsigned seed) {
    if (seed % 8 == 0) return RandomScene::Kinds::All;
    return seed % 128 == 4 ? RandomScene::Kinds::Aligned : RandomScene::Kinds::Basic;
}

/** Solves scene after scene and counts what they came to. */
class SceneTally {
public:
    /** @param name   of the scene, where it fails */
    void solve(const PathProblem& problem, const PathPose& pose, const std::string& name) {
        SCOPED_TRACE(name);
        PathSolution path;
        const auto start = std::chrono::steady_clock::now();
        EXPECT_NO_THROW(m_solver.solve(problem, pose, path));
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        m_slowest = std::max(m_slowest, {elapsed.count(), name});
        m_mostShots = std::max(m_mostShots, {path.shots, name});
        calcDrawingPoints(path, problem, pose, 0.3, m_points);
        EXPECT_TRUE(isFinite(path, m_points)) << getName(path.status);
        EXPECT_LE(path.shots, kMaxShotsPerElement * problem.getNumElements());
        if (path.status == PathStatus::Solved) {
            EXPECT_TRUE(verifyPath(problem, pose, path).isMinimum());
            EXPECT_GT(calcLowestHeight(problem, pose, path), -1e-7);
        }
        const std::string outcome = classify(problem, pose, path);
        EXPECT_EQ(outcome.find("unexplained"), std::string::npos) << outcome;
        ++m_outcomes[outcome];
        const SolveReport& report = path.report;
        ++m_shares[std::string("from ") + getName(report.strategy) +
                   (report.bandLevel > 0 ? " " + std::to_string(report.bandLevel) : "")];
        if (report.usedMinimizer) ++m_shares["with the minimizer"];
        if (report.leftSaddle) ++m_shares["off a saddle"];
        if (report.turnedTangents) ++m_shares["with tangents reversed"];
        if (path.status == PathStatus::Solved && !path.followsHints()) ++m_shares["solved elsewhere than asked"];
    }
    int count(const std::string& outcome) const {
        const auto at = m_outcomes.find(outcome);
        return at == m_outcomes.end() ? 0 : at->second;
    }
    void print() const {
        std::cout << "most shots " << m_mostShots.first << " (" << m_mostShots.second << "), slowest solve "
                  << m_slowest.first << " s (" << m_slowest.second << ")\n";
        for (const auto& [outcome, number] : m_outcomes) std::cout << "  " << outcome << ": " << number << "\n";
        for (const auto& [share, number] : m_shares) std::cout << "  " << share << ": " << number << "\n";
    }

private:
    PathSolver m_solver;
    std::vector<Vector3> m_points;
    std::map<std::string, int> m_outcomes;
    std::map<std::string, int> m_shares;  ///< of strategies, and of what the local solver had to do
    std::pair<double, std::string> m_slowest;
    std::pair<int, std::string> m_mostShots;
};

void runScenes(int count, unsigned firstSeed) {
    SceneTally tally;
    for (int i = 0; i < count; ++i) {
        const unsigned seed = firstSeed + static_cast<unsigned>(i);
        PathProblem problem;
        PathPose pose;
        RandomScene(seed, chooseKinds(seed)).make(problem, pose);
        tally.solve(problem, pose, "seed " + std::to_string(seed));
    }
    std::cout << count << " scenes from seed " << firstSeed << ", ";
    tally.print();
}

// Every surface of the tests, those of users and those under layers and maps among them, alone and before another one.
TEST(RandomScenes, OfEverySurfaceEndWithAnExplainedStatusAndFiniteNumbers) {
    const std::vector<testing::SurfaceCase> cases = testing::makeSurfaceCases();
    testing::Random random(78);
    SceneTally tally;
    for (const testing::SurfaceCase& c : cases)
        for (int i = 0; i < 12; ++i) {
            const double reach = c.surface->getSize() * random.logUniform(2, 40);
            PathProblem problem;
            PathPose pose;
            problem.addPoint("origin");
            pose.X_GE.emplace_back(Vector3(-reach, 0, 0) + 0.3 * random.vector(reach));
            const auto add = [&](const testing::SurfaceCase& added, const Vector3& p) {
                problem.addObstacle(added.name, added.surface);
                const Matrix3 R = random.rotation();
                pose.X_GE.emplace_back(R, p - R * added.center + 0.5 * random.vector(added.surface->getSize()));
            };
            add(c, Vector3::Zero());
            if (i % 3 == 0)
                add(cases[random.integer(0, static_cast<int>(cases.size()) - 1)], Vector3(0.5 * reach, 0, 0));
            problem.addPoint("insertion");
            pose.X_GE.emplace_back(Vector3(reach, 0, 0) + 0.3 * random.vector(reach));
            tally.solve(problem, pose, c.name + " " + std::to_string(i));
        }
    tally.print();
    EXPECT_GT(tally.count("solved"), 300);
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
          Scene{1472824, kAll, false},   Scene{1649520, kAll, true},    Scene{1282183, kBasic, false},
          Scene{1013608, kAll, true},    Scene{1019344, kAll, false},   Scene{2096, kAll, false}}) {
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
