// SPDX-License-Identifier: Apache-2.0
// A string over a sphere, in poses in which all is well, its end is in the sphere, and it lies on the wrong side.
#include <tautline/paths/path_explanation.h>
#include <tautline/paths/path_solver.h>
#include <tautline/surfaces/sphere.h>

#include <iostream>
using namespace tautline;

int main() {
    PathProblem problem;
    problem.addPoint("origin");
    const int ball = problem.addObstacle("ball", std::make_shared<Sphere>(0.05), PassOnSide{Vector3::UnitY()});
    problem.addPoint("insertion");
    PathPose pose;
    pose.X_GE = {Pose(Vector3(-0.1, 0, 0)), Pose(), Pose(Vector3(0.1, 0, 0))};
    PathSolver solver;
    for (const Vector3& end : {Vector3(0.1, 0, 0), Vector3(0.03, 0, 0), Vector3(0.1, -0.2, 0)}) {
        pose.X_GE.back().p = end;
        PathSolution path;  // empty: a cold start
        solver.solve(problem, pose, path);
        std::cout << getName(path.status) << ": " << explainStatus(problem, pose, path) << "; "
                  << (path.contacts[ball].isTouched ? "touches the ball" : "clear of the ball") << ", " << path.length
                  << " m\n";
    }
}
