// SPDX-License-Identifier: Apache-2.0
// A string over a cylinder that moves: its length, the rate of that, and what it does to the cylinder.
#include <tautline/paths/path_explanation.h>
#include <tautline/paths/path_kinematics.h>
#include <tautline/paths/path_solver.h>
#include <tautline/surfaces/cylinder.h>

#include <iostream>
using namespace tautline;

int main() {
    PathProblem problem;
    problem.addPoint("origin");
    const int cylinder = problem.addObstacle("cylinder", std::make_shared<Cylinder>(0.03));  // about its z axis [m]
    problem.addPoint("insertion");

    PathPose pose;  // of each element in ground; a point is where its origin is
    pose.X_GE = {Pose(Vector3(-0.1, 0, 0)), Pose(Vector3(0, -0.01, 0)), Pose(Vector3(0.1, 0, 0.05))};
    const PathSolution path = solvePath(problem, pose);
    std::cout << explainStatus(problem, pose, path) << "\n";

    std::vector<SpatialVelocity> V_GE(3);
    V_GE[cylinder].v = Vector3(0, 0.2, 0);
    std::vector<SpatialForce> F_GE;
    calcUnitForces(path, pose, F_GE);
    std::cout << "length " << path.length << " m, rate " << calcLengthRate(path, pose, V_GE) << " m/s, at 100 N of "
              << "tension the cylinder is pushed by " << 100 * F_GE[cylinder].force.norm() << " N\n";
}
