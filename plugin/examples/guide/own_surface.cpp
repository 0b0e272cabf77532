// SPDX-License-Identifier: Apache-2.0
// A surface of one's own: a bean, f(p) = 0. Its laws are checked, and a string is laid over it.
#include <tautline/paths/path_explanation.h>
#include <tautline/paths/path_solver.h>
#include <tautline/surfaces/function_surface.h>
#include <tautline/surfaces/surface_laws.h>

#include <iostream>
using namespace tautline;

int main() {
    // One formula: the derivatives follow from it, exactly. f > 0 outside; the size is a length of the surface [m].
    const auto bean =
        std::make_shared<ImplicitFunctionSurface>(makeImplicitSurface("bean", 0.05, [](auto x, auto y, auto z) {
            return (x * x + (y + 4 * x * x) * (y + 4 * x * x) + z * z) * 400 - 1;
        }));

    // Points near it and directions along it, for the thirteen laws. What is broken comes as sentences.
    const std::vector<SurfaceLawSample> samples{{Vector3(0, 0.05, 0.01), Vector3::UnitX(), 0.03},
                                                {Vector3(0.03, -0.04, 0), Vector3::UnitZ(), 0.03}};
    for (const std::string& broken : checkSurfaceLaws(*bean, samples)) std::cout << broken << "\n";

    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("bean", bean, PassOnSide{Vector3::UnitY()});
    problem.addPoint("insertion");
    PathPose pose;
    pose.X_GE = {Pose(Vector3(-0.1, -0.01, 0)), Pose(), Pose(Vector3(0.1, 0.01, 0.02))};
    const PathSolution path = solvePath(problem, pose);
    std::cout << explainStatus(problem, pose, path) << ", " << path.length << " m\n";
    return path.status == PathStatus::Solved ? 0 : 1;
}
