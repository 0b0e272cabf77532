// SPDX-License-Identifier: Apache-2.0
/** Scenes with verified answers of others, read in place: static ones cold, moving ones with warm starts. */
#include <gtest/gtest.h>

#include "support/scene_runner.h"
#include "support/shared_data.h"

namespace tautline::testing {
namespace {

TEST(DataScenes, StaticScenesAreSolvedFromTheirHints) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const std::vector<Scene> scenes = readScenes(shared / "scenes" / "static.json");
    ASSERT_FALSE(scenes.empty());
    std::size_t same = 0;
    for (const Scene& scene : scenes) {
        SceneRunner runner(scene, true);
        const SceneResult result = runner.run();
        PathPose pose;
        calcPose(scene, scene.start, pose);
        const Verdict verdict = judge(scene, runner.getProblem(), pose, result.steps.front().path, 0, true);
        EXPECT_NE(verdict, Verdict::Wrong) << scene.id;
        EXPECT_NE(verdict, Verdict::NotConverged) << scene.id;
        same += verdict == Verdict::Solved;
    }
    // Where several minima exist, the string's is meant: missing it is allowed in 3 of 100.
    EXPECT_GE(100 * same, 97 * scenes.size());
}

TEST(DataScenes, MovingScenesAreFollowedThroughTheirEvents) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    const std::vector<Scene> scenes = readScenes(shared / "scenes" / "motion.json");
    ASSERT_FALSE(scenes.empty());
    for (const Scene& scene : scenes) {
        SCOPED_TRACE(scene.id);
        SceneRunner runner(scene, true);
        const SceneResult result = runner.run();
        ASSERT_EQ(result.steps.size(), scene.length.size());
        PathPose pose;
        for (std::size_t k = 0; k < result.steps.size(); ++k) {
            calcPose(scene, result.steps[k].t, pose);
            EXPECT_EQ(judge(scene, runner.getProblem(), pose, result.steps[k].path, static_cast<int>(k), k == 0),
                      Verdict::Solved)
                << "step " << k;
            EXPECT_NEAR(result.steps[k].rate, scene.rate[k], 1e-7) << "step " << k;
        }
        ASSERT_EQ(result.events.size(), scene.events.size());
        for (std::size_t i = 0; i < scene.events.size(); ++i) {
            EXPECT_EQ(result.events[i].obstacle, scene.events[i].obstacle);
            EXPECT_EQ(result.events[i].kind.substr(0, 4), scene.events[i].kind.substr(0, 4));
            EXPECT_NEAR(result.events[i].time, scene.events[i].time, 1e-6);
        }
    }
}

/** How often a path turns about the axis of the cylinder that its one obstacle is, from end to end. */
double countTurns(const PathPose& pose, const PathSolution& path) {
    const ShotGeodesic& arc = path.contacts[1].geodesic;
    const Pose& X_GS = pose.X_GE[1];
    const auto sweep = [](const Vector3& from, const Vector3& to) {
        return std::atan2(from.x() * to.y() - from.y() * to.x(), from.head<2>().dot(to.head<2>()));
    };
    const double sideways = Vector3::UnitZ().cross(arc.P.N).dot(arc.P.t), radius = arc.P.x.head<2>().norm();
    return (sweep(X_GS.shiftBack(pose.X_GE[0].p), arc.P.x) + sideways * arc.length / radius +
            sweep(arc.Q.x, X_GS.shiftBack(pose.X_GE[2].p))) /
           (2 * kPi);
}

/** The scene's problem and pose without the obstacles that `path` does not touch. */
void removeLifted(const PathProblem& problem, const PathPose& pose, const PathSolution& path, PathProblem& reduced,
                  PathPose& reducedPose) {
    reducedPose = PathPose();
    for (int e = 0; e < problem.getNumElements(); ++e) {
        const PathElement& element = problem.getElement(e);
        if (!element.isPoint() && !path.contacts[e].isTouched) continue;
        if (element.isPoint())
            reduced.addPoint(element.name);
        else
            reduced.addObstacle(element.name, element.surface, element.hint);
        reducedPose.X_GE.push_back(pose.X_GE[e]);
    }
}

TEST(DataScenes, EachMovingStepEqualsASolveWithoutItsLiftedObstacles) {
    TAUTLINE_SKIP_WITHOUT_SHARED(shared);
    int compared = 0;
    for (const Scene& scene : readScenes(shared / "scenes" / "motion.json")) {
        // A point hint does not tell how often the string has wound itself around a cylinder in the meantime, and a
        // cold start takes the shortest way past it: what counts the turns is the path itself.
        const bool isWinding = scene.family == "winding";
        SceneRunner runner(scene, true);
        const SceneResult result = runner.run();
        PathPose pose, reducedPose;
        for (std::size_t k = 0; k < result.steps.size(); ++k) {
            calcPose(scene, result.steps[k].t, pose);
            PathProblem reduced;
            removeLifted(runner.getProblem(), pose, result.steps[k].path, reduced, reducedPose);
            if (isWinding && result.steps[k].path.contacts[1].isTouched)
                reduced.setHint(1, WindAround{countTurns(pose, result.steps[k].path)});
            const PathSolution alone = solvePath(reduced, reducedPose);
            EXPECT_EQ(alone.status, PathStatus::Solved) << scene.id << " step " << k;
            EXPECT_NEAR(alone.length, result.steps[k].path.length, 1e-9 * alone.length) << scene.id << " step " << k;
            ++compared;
        }
    }
    EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace tautline::testing
