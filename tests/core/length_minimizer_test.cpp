// SPDX-License-Identifier: Apache-2.0
/** The length, its derivatives along natural corrections, and its minimization over one contact set. */
#include "paths/local/length_minimizer.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <iostream>

#include "paths/local/path_newton.h"
#include "support/random_chain.h"
#include "support/weave_scene.h"
#include "tautline/paths/path_verification.h"

namespace tautline::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd calcGradient(const Chain& chain) {
    std::vector<double> gradient;
    calcLengthGradient(chain, gradient);
    return Eigen::Map<VectorXd>(gradient.data(), gradient.size());
}

MatrixXd calcHessian(const Chain& chain) {
    std::vector<LengthHessianBlocks> blocks;
    calcLengthHessian(chain, blocks);
    const int n = kVariations;
    MatrixXd dense = MatrixXd::Zero(n * blocks.size(), n * blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        dense.block<4, 4>(n * i, n * i) = blocks[i].own;
        if (i + 1 == blocks.size()) {
            EXPECT_EQ(blocks[i].next.norm(), 0);
            continue;
        }
        dense.block<4, 4>(n * i, n * (i + 1)) = blocks[i].next;
        dense.block<4, 4>(n * (i + 1), n * i) = blocks[i].next.transpose();
    }
    return dense;
}

// S sphere, C cylinder, E ellipsoid, F flat ellipsoid, T torus, . via point
TEST(LengthGradient, EqualsCentralDifferencesAnywhere) {
    unsigned seed = 90;
    for (const char* plan : {"S", "C", "E", "F", "T", "SCEFT", "C.C", "S.TE..F"}) {
        SCOPED_TRACE(plan);
        const RandomChain chain(plan, ++seed);
        const VectorXd gradient = calcGradient(chain.getChain());
        for (int i = 0; i < gradient.size(); ++i) {
            const auto length = [](const Chain& varied) { return Eigen::Array<double, 1, 1>(calcLength(varied)); };
            EXPECT_NEAR(gradient[i], chain.calcDerivative(i, length)[0], 1e-6) << "unknown " << i;
        }
    }
}

TEST(LengthHessian, EqualsDifferencesOfTheGradientWhereThePathErrorVanishes) {
    int numContacts = 0;
    unsigned seed = 100;
    for (const char* plan : {"S", "C", "E", "F", "SCE", "ES.CE", "SCEFS"}) {
        SCOPED_TRACE(plan);
        RandomChain chain(plan, ++seed);
        chain.solve();
        const MatrixXd hessian = calcHessian(chain.getChain());
        numContacts += static_cast<int>(hessian.cols() / kVariations);
        for (int col = 0; col < hessian.cols(); ++col) {
            const VectorXd difference = chain.calcDerivative(col, calcGradient);
            EXPECT_LT((hessian.col(col) - difference).cwiseAbs().maxCoeff(), 1e-6 * (1 + hessian.col(col).norm()))
                << "unknown " << col;
        }
    }
    EXPECT_GT(numContacts, 6);  // or the scenes show nothing
}

/** A path over a sphere from a point before it to one behind it, laid `angle` away from the shortest way about the
line between them. */
class OverASphere {
public:
    explicit OverASphere(double angle) {
        m_problem.addPoint("origin");
        m_problem.addObstacle("sphere", std::make_shared<Sphere>(1));
        m_problem.addPoint("insertion");
        m_pose.X_GE = {Pose(Vector3(-2, 0, 0.2)), Pose(), Pose(Vector3(2, 0, 0.2))};
        m_start.contacts.resize(3);
        ObstacleContact& contact = m_start.contacts[1];
        contact.isTouched = true;
        const Vector3 up(0, std::sin(angle), std::cos(angle));
        contact.start.point.p = Vector3(-0.5, 0, 0) + std::sqrt(0.75) * up;
        contact.start.tangent = Vector3(std::sqrt(0.75), 0, 0) + 0.5 * up;
        contact.start.length = kPi / 3;
    }
    const PathProblem& getProblem() const { return m_problem; }
    const PathPose& getPose() const { return m_pose; }
    const PathSolution& getStart() const { return m_start; }
    /** The shortest path lies in the plane y = 0, with tangents from (-2, 0.2) to the unit circle. */
    static double calcShortest() {
        const double c = std::sqrt(4.04), tangent = std::sqrt(c * c - 1);
        const double turn = 2 * (std::acos(0.2 / c) - std::acos(1 / c));
        return 2 * tangent + turn;
    }

private:
    PathProblem m_problem;
    PathPose m_pose;
    PathSolution m_start;
};

TEST(LengthMinimizer, GoesDownWhereNewtonsMethodGoesToTheLongestPath) {
    // From 0.05 rad beside the way round the far side.
    const OverASphere scene(kPi - 0.05);
    PathSolution up = scene.getStart(), down = scene.getStart();
    ASSERT_TRUE(PathNewton({}).iterate(scene.getProblem(), scene.getPose(), up));
    ASSERT_TRUE(LengthMinimizer({}).minimize(scene.getProblem(), scene.getPose(), down));
    EXPECT_EQ(verifyPath(scene.getProblem(), scene.getPose(), up).condition, PathVerification::Condition::Unstable);
    EXPECT_TRUE(verifyPath(scene.getProblem(), scene.getPose(), down).isMinimum());
    EXPECT_NEAR(down.length, OverASphere::calcShortest(), 1e-12);
    EXPECT_GT(up.length, down.length + 0.1);
}

TEST(LengthMinimizer, ItsLastStepsAreQuadratic) {
    const OverASphere scene(1);
    PathSolution path = scene.getStart();
    ASSERT_TRUE(LengthMinimizer({}).minimize(scene.getProblem(), scene.getPose(), path));
    const std::vector<double>& errors = path.errorHistory;
    int quadratic = 0;
    for (std::size_t i = 1; i < errors.size(); ++i)
        if (errors[i - 1] < 0.05 && errors[i - 1] > 1e-7) {
            EXPECT_LT(errors[i], 10 * errors[i - 1] * errors[i - 1]) << "iteration " << i;
            ++quadratic;
        }
    EXPECT_GE(quadratic, 1);
}

TEST(LengthMinimizer, StartsThatAreFarAreFollowedToMinima) {
    // Weaves over ellipsoids and cylinders; every arc is moved by up to half its surface's size and turned by up to
    // half a radian.
    constexpr int kTrials = 200;
    Random random(110);
    int minima = 0, minimaOfNewton = 0;
    for (const auto kind : {WeaveScene::Kind::Cylinders, WeaveScene::Kind::Ellipsoids}) {
        const WeaveScene scene(kind, 4);
        PathPose pose;
        scene.calcPose(0, pose);
        const PathSolution solution = solvePath(scene.getProblem(), pose);
        ASSERT_EQ(solution.status, PathStatus::Solved);
        for (int trial = 0; trial < kTrials; ++trial) {
            PathSolution start = solution;
            for (std::size_t e = 0; e < start.contacts.size(); ++e) {
                ObstacleContact& contact = start.contacts[e];
                if (!contact.isTouched) continue;
                const Surface& surface = *scene.getProblem().getElement(static_cast<int>(e)).surface;
                const Vector3 move = random.vector(0.5);
                contact.start = calcCorrectedStart(
                    surface, contact.start, contact.geodesic.P,
                    Vector4(move.x() * surface.getSize(), move.y() * surface.getSize(), move.z(), 0));
            }
            PathSolution down = start, any = start;
            const bool isDown = LengthMinimizer({}).minimize(scene.getProblem(), pose, down);
            const bool isAny = PathNewton({}).iterate(scene.getProblem(), pose, any);
            minima += isDown && std::abs(down.length - solution.length) < 1e-9;
            minimaOfNewton += isAny && std::abs(any.length - solution.length) < 1e-9;
        }
    }
    std::cout << "of " << 2 * kTrials << " starts the minimizer leads " << minima << " to the minimum, Newton's method "
              << minimaOfNewton << "\n";
    EXPECT_GE(minima, 2 * kTrials * 95 / 100);
    EXPECT_GT(minima, minimaOfNewton);
}

TEST(LengthMinimizer, ReturnsADrawablePathFromAStartThatLeadsNowhere) {
    const OverASphere scene(0.3);
    PathSolverOptions options;
    options.maxIterations = 1;
    PathSolution path = scene.getStart();
    path.contacts[1].start.length = 5;
    EXPECT_FALSE(LengthMinimizer(options).minimize(scene.getProblem(), scene.getPose(), path));
    EXPECT_TRUE(std::isfinite(path.length));
    for (const StraightSegment& line : path.segments) EXPECT_TRUE(line.A.allFinite() && line.B.allFinite());
}

}  // namespace
}  // namespace tautline::testing
