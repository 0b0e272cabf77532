/** Random scenes of 1 to 6 surfaces, degenerate ones crowded in: every solve ends with a status, finite numbers
and within a fixed count of shots, and what is no solution is explained. */
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <random>

#include "tautline/cylinder.h"
#include "tautline/ellipsoid.h"
#include "tautline/path_explanation.h"
#include "tautline/path_kinematics.h"
#include "tautline/path_solver.h"
#include "tautline/path_verification.h"
#include "tautline/sphere.h"
#include "tautline/torus.h"

namespace tautline {
namespace {

/** Shots are geodesics: about 40 iterations with up to 7 trials, for each contact set that is tried. */
constexpr int kMaxShots = 200000;

class RandomScene {
public:
    explicit RandomScene(unsigned seed) : m_random(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * (m_random() / static_cast<double>(std::mt19937::max()));
    }
    int pick(int count) { return static_cast<int>(m_random() % static_cast<unsigned>(count)); }
    Vec3 point(double extent) { return {uniform(-extent, extent), uniform(-extent, extent), uniform(-extent, extent)}; }

    void make(PathProblem& problem, PathPose& pose) {
        const int n = 1 + pick(6);
        problem.addPoint("origin");
        pose.X_GE.emplace_back(point(2));
        for (int i = 0; i < n; ++i) {
            const std::optional<Vec3> hint = pick(3) > 0 ? std::optional<Vec3>(point(1)) : std::nullopt;
            problem.addObstacle("s" + std::to_string(i), makeSurface(), hint);
            pose.X_GE.emplace_back(makeRotation(), point(2));
            if (pick(10) == 0) {
                problem.addPoint("via" + std::to_string(i));
                pose.X_GE.emplace_back(point(2));
            }
        }
        problem.addPoint("insertion");
        pose.X_GE.emplace_back(point(2));
        degenerate(pose);
    }

private:
    std::shared_ptr<const Surface> makeSurface() {
        // Sizes over three decades.
        const double size = std::pow(10, uniform(-2, 0.3));
        switch (pick(4)) {
            case 0:
                return std::make_shared<Sphere>(size);
            case 1:
                return std::make_shared<Cylinder>(size);
            case 2:
                return std::make_shared<Ellipsoid>(size * Vec3(uniform(0.2, 1), uniform(0.2, 1), uniform(0.2, 1)));
            default:
                return std::make_shared<Torus>(size, size * uniform(0.05, 0.95));
        }
    }
    Mat3 makeRotation() {
        if (pick(5) == 0) return Mat3::Identity();  // axes along ground's: exact zeros
        return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1) + 2)
            .normalized()
            .toRotationMatrix();
    }
    /** Half of the scenes get a coincidence: concentric surfaces, ends at centres, on axes, at each other. */
    void degenerate(PathPose& pose) {
        const int last = static_cast<int>(pose.X_GE.size()) - 1, e = 1 + pick(last - 1);
        switch (pick(10)) {
            case 0:
                pose.X_GE[last].p = pose.X_GE[0].p;
                break;
            case 1:
                pose.X_GE[0].p = pose.X_GE[e].p;
                break;
            case 2:
                pose.X_GE[e].p = 0.5 * (pose.X_GE[0].p + pose.X_GE[last].p);
                break;  // chord through the centre
            case 3:
                pose.X_GE[0].p = pose.X_GE[e] * Vec3(0, 0, 1), pose.X_GE[last].p = pose.X_GE[e] * Vec3(0, 0, -1);
                break;
            case 4:
                pose.X_GE[e] = pose.X_GE[1 + pick(last - 1)];
                break;
            default:
                break;
        }
    }

    std::mt19937 m_random;
};

bool isFinite(const PathSolution& path, const std::vector<Vec3>& points) {
    bool finite = std::isfinite(path.length);
    for (const StraightSegment& s : path.segments)
        finite = finite && s.A.allFinite() && s.B.allFinite() && s.e.allFinite();
    for (const Vec3& p : points) finite = finite && p.allFinite();
    return finite;
}

/** What a solve came to, in few words; for what is no solution, why there is none. */
std::string classify(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    const std::string why = explainStatus(problem, pose, path);
    std::string key = getName(path.status);
    const auto has = [&why](const char* words) { return why.find(words) != std::string::npos; };
    if (path.status == PathStatus::Solved) return key;
    for (const char* reason : {"is inside", "in the groove", "in two places", "against the order", "still slides",
                               "would lift inside", "pressure vanishes"})
        if (has(reason)) return key + ", " + reason;
    return key + ", unexplained: " + why;
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
        RandomScene(seed).make(problem, pose);
        PathSolution path;
        const auto start = std::chrono::steady_clock::now();
        EXPECT_NO_THROW(solver.solve(problem, pose, path)) << "seed " << seed;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        if (elapsed.count() > slowest.seconds) slowest = {elapsed.count(), seed};
        calcDrawingPoints(path, problem, pose, 0.3, points);
        EXPECT_TRUE(isFinite(path, points)) << "seed " << seed << ", " << getName(path.status);
        if (path.shots > mostShots) mostShots = path.shots, worstSeed = static_cast<int>(seed);
        if (path.status == PathStatus::Solved) {
            EXPECT_TRUE(verifyPath(problem, pose, path).isMinimum()) << "seed " << seed;
        }
        const std::string outcome = classify(problem, pose, path);
        EXPECT_EQ(outcome.find("unexplained"), std::string::npos) << "seed " << seed << ": " << outcome;
        ++outcomes[outcome];
    }
    EXPECT_LE(mostShots, kMaxShots) << "seed " << worstSeed;
    std::cout << count << " scenes from seed " << firstSeed << ", most shots " << mostShots << " (seed " << worstSeed
              << "), slowest solve " << slowest.seconds << " s (seed " << slowest.seed << ")\n";
    for (const auto& [outcome, number] : outcomes) std::cout << "  " << outcome << ": " << number << "\n";
}

TEST(RandomPoses, EndWithAnExplainedStatusAndFiniteNumbers) {
    runScenes(20000, 1);
}

TEST(LongRandomPoses, EndWithAnExplainedStatusAndFiniteNumbers) {
    runScenes(1000000, 1000001);
}

}  // namespace
}  // namespace tautline
