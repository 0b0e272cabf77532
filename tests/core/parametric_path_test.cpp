// SPDX-License-Identifier: Apache-2.0
/** Paths over implicit and parametric forms of the same obstacles, mixed too, are the same paths. */
#include <gtest/gtest.h>

#include <cstdio>

#include "support/surface_cases.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/paths/path_verification.h"

namespace tautline {
namespace {

constexpr double kAgreement = 1e-10;

/** Weaves over and under a row of obstacles that sway in time. */
class TwinScene {
public:
    enum class Forms { Implicit, Parametric, Mixed };

    explicit TwinScene(Forms forms) {
        const Vector3 egg(0.35, 0.25, 0.45);
        add(forms, std::make_shared<Cylinder>(0.3), std::make_shared<ParametricCylinder>(0.3));
        add(forms, std::make_shared<Ellipsoid>(egg), std::make_shared<ParametricEllipsoid>(egg));
        add(forms, std::make_shared<Torus>(0.3, 0.12), std::make_shared<ParametricTorus>(0.3, 0.12));
        add(forms, std::make_shared<EllipticTorus>(0.3, 0.1, 0.15),
            std::make_shared<ParametricEllipticTorus>(0.3, 0.1, 0.15));
        add(forms, std::make_shared<Sphere>(0.3), std::make_shared<ParametricSphere>(0.3));
        add(forms, std::make_shared<EllipticCylinder>(0.35, 0.2),
            std::make_shared<ParametricEllipticCylinder>(0.35, 0.2));
        add(forms, std::make_shared<Paraboloid>(0.5, 0.7), std::make_shared<ParametricParaboloid>(0.5, 0.7));
        add(forms, std::make_shared<Capsule>(0.25, 0.3, 0.2), std::make_shared<ParametricCapsule>(0.25, 0.3, 0.2));
        add(forms, std::make_shared<Cone>(0.3, 0.3), std::make_shared<ParametricCone>(0.3, 0.3));
        m_problem.addPoint("origin");
        for (std::size_t i = 0; i < m_surfaces.size(); ++i)
            m_problem.addObstacle("obstacle " + std::to_string(i), m_surfaces[i], calcHint(i));
        m_problem.addPoint("insertion");
    }

    const PathProblem& getProblem() const { return m_problem; }

    /** Poses at a time, and velocities by exact derivatives: shifts along y, turns about z. */
    void calcPose(double t, PathPose& pose, std::vector<SpatialVelocity>& V_GE) const {
        const std::size_t n = m_surfaces.size();
        pose.X_GE.assign(n + 2, Pose());
        V_GE.assign(n + 2, SpatialVelocity());
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 0.1 * std::sin(t + i), rate = 0.1 * std::cos(t + i);
            pose.X_GE[i + 1].R = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
            pose.X_GE[i + 1].p = Vector3(1.2 * (i + 1), 0.05 * std::cos(2 * t + i), 0.02 * i);
            const Pose placing = calcPlacing(i);
            pose.X_GE[i + 1].R *= placing.R, pose.X_GE[i + 1].p += placing.p;
            V_GE[i + 1].w = rate * Vector3::UnitZ();
            V_GE[i + 1].v = Vector3(0, -0.1 * std::sin(2 * t + i), 0);
        }
        pose.X_GE[n + 1].p = Vector3(1.2 * (n + 1), 0.1 * std::sin(t), 0.05);
        V_GE[n + 1].v = Vector3(0, 0.1 * std::cos(t), 0);
    }

private:
    static constexpr std::size_t kParaboloid = 6, kCapsule = 7, kCone = 8;
    static double getSide(std::size_t i) { return i % 2 ? -1 : 1; }
    static Vector3 calcHint(std::size_t i) {
        if (i == kParaboloid) return {0, 0, -0.2};  // beyond the vertex
        return {0, getSide(i) * 0.5, i == kCapsule ? 0.17 : i == kCone ? 0.9 : 0.02};
    }
    /** The paraboloid's vertex looks up, the string crosses the capsule where its cap begins, the cone far from its
     * apex. */
    static Pose calcPlacing(std::size_t i) {
        if (i == kParaboloid)
            return {Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()).toRotationMatrix(), Vector3(0, 0.3, 0)};
        return Pose(Vector3(0, 0, i == kCapsule ? -0.1 : i == kCone ? -0.9 : 0));
    }
    void add(Forms forms, std::shared_ptr<const Surface> implicitForm, std::shared_ptr<const Surface> parametricForm) {
        const bool isImplicit = forms == Forms::Implicit || (forms == Forms::Mixed && m_surfaces.size() % 2);
        m_surfaces.push_back(isImplicit ? implicitForm : parametricForm);
    }

    std::vector<std::shared_ptr<const Surface>> m_surfaces;
    PathProblem m_problem;
};

TEST(ParametricPaths, HaveTheLengthsAndRatesOfImplicitOnes) {
    using Forms = TwinScene::Forms;
    const TwinScene scenes[] = {TwinScene(Forms::Implicit), TwinScene(Forms::Parametric), TwinScene(Forms::Mixed)};
    PathSolver solvers[3];
    PathSolution paths[3];
    PathPose pose;
    std::vector<SpatialVelocity> V_GE;
    double lengths = 0, rates = 0;
    int iterations[3] = {0, 0, 0};
    for (int k = 0; k <= 60; ++k) {
        scenes[0].calcPose(0.05 * k, pose, V_GE);
        double rate[3];
        for (int form = 0; form < 3; ++form) {
            solvers[form].solve(scenes[form].getProblem(), pose, paths[form]);
            ASSERT_EQ(paths[form].status, PathStatus::Solved)
                << "form " << form << ", step " << k << ": "
                << describe(verifyPath(scenes[form].getProblem(), pose, paths[form]), scenes[form].getProblem());
            rate[form] = calcLengthRate(paths[form], pose, V_GE);
            iterations[form] += paths[form].iterations;
        }
        for (int form = 1; form < 3; ++form) {
            lengths = std::max(lengths, std::abs(paths[form].length - paths[0].length));
            rates = std::max(rates, std::abs(rate[form] - rate[0]));
        }
    }
    int touched = 0;
    for (const ObstacleContact& contact : paths[0].contacts) touched += contact.isTouched;
    std::printf("lengths differ by %.1e, rates by %.1e; iterations %d implicit, %d parametric, %d mixed; %d touched\n",
                lengths, rates, iterations[0], iterations[1], iterations[2], touched);
    EXPECT_LT(lengths, kAgreement);
    EXPECT_LT(rates, kAgreement);
    EXPECT_GE(touched, 4);
}

/** A muscle over a fitted patch of bone: solved inside the domain and beside it, and said so where it runs off. */
TEST(PatchPaths, AreSolvedInsideAndReportedOutside) {
    Eigen::MatrixXd dome(7, 7);
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 7; ++j)
            dome(i, j) = 0.3 - 0.4 * std::pow(-1 + i / 3.0, 2) - 0.2 * std::pow(-1 + j / 3.0, 2);
    const auto patch =
        std::make_shared<BSplinePatch>(BSplinePatch::interpolateHeights({Vector2(-1, -1), Vector2(1, 1)}, dome));
    const auto solve = [&](double x, double y, double z) {
        PathProblem problem;
        problem.addPoint("origin");
        problem.addObstacle("bone", patch);
        problem.addPoint("insertion");
        PathPose pose;
        pose.X_GE = {Pose(Vector3(-x, y, z)), Pose(), Pose(Vector3(x, y + 0.1, z + 0.05))};
        return solvePath(problem, pose);
    };
    const PathSolution inside = solve(0.9, 0.1, 0.1), outside = solve(1.5, 0.1, -0.56), beside = solve(0.9, 1.1, -0.1);
    EXPECT_EQ(inside.status, PathStatus::Solved);
    EXPECT_TRUE(inside.contacts[1].isTouched);
    EXPECT_EQ(outside.status, PathStatus::LeftDomain) << outside.length;
    EXPECT_EQ(beside.status, PathStatus::Solved);
    EXPECT_FALSE(beside.contacts[1].isTouched);
}

/** A capsule and a layered ellipsoid as obstacles. */
TEST(CapsulePaths, WrapTheCapAndAnOffset) {
    PathProblem problem;
    problem.addPoint("origin");
    problem.addObstacle("capsule", std::make_shared<Capsule>(0.1, 0.3, 0.12));
    problem.addObstacle(
        "layer", std::make_shared<OffsetSurface>(std::make_shared<ParametricEllipsoid>(Vector3(0.1, 0.15, 0.1)), 0.02));
    problem.addPoint("insertion");
    PathPose pose;
    pose.X_GE = {Pose(Vector3(-0.5, 0, 0)), Pose(Vector3(0, 0, -0.1)), Pose(Vector3(0.5, 0.01, 0.02)),
                 Pose(Vector3(1, 0, 0))};
    const PathSolution path = solvePath(problem, pose);
    EXPECT_EQ(path.status, PathStatus::Solved) << getName(path.status);
    EXPECT_TRUE(path.contacts[1].isTouched);
    EXPECT_TRUE(path.contacts[2].isTouched);
}

}  // namespace
}  // namespace tautline
