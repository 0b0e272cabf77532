// SPDX-License-Identifier: Apache-2.0
/** First and second derivatives of a path's length by the poses of all elements, over every surface of the project,
against differences of paths that are solved anew. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "support/random.h"
#include "support/surface_cases.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_sensitivity.h"
#include "tautline/paths/path_solver.h"

namespace tautline::testing {
namespace {

constexpr int kPoses = 3;  // origin, obstacle, insertion
using Motion = std::vector<SpatialVelocity>;

/** A path that touches one surface, made backwards: a geodesic that presses all along, and straight lines on from its
ends. Stationary by construction, whatever else may be in its way. */
class TouchingPath {
public:
    /** Of twenty geodesics that press, the one that does so most firmly: a path that hardly presses moves far for
    little, and differences tell nothing. @return false if there are none near the samples of the case */
    bool make(const SurfaceCase& surfaceCase, Random& random) {
        constexpr int kCandidates = 20, kAttempts = 1000;
        const Surface& surface = *surfaceCase.surface;
        m_surface = surfaceCase.surface;
        GeodesicStart best;
        ShotGeodesic bestArc;
        double firmest = 0;
        for (int attempt = 0, candidates = 0; attempt < kAttempts && candidates < kCandidates; ++attempt) {
            const Vector3 near = surfaceCase.center + random.vector(surfaceCase.extent);
            GeodesicStart start{surface.findSurfacePoint(near), random.unitVector(), 0};
            const DarbouxFrame frame = surface.calcFrame(start.point, start.tangent);
            start.tangent = frame.t;
            const double radius = 1 / std::max({1 / surface.getSize(), std::abs(frame.kappaN), std::abs(frame.kappaB)});
            start.length = random.uniform(0.3, 1.0) * radius;
            ShotGeodesic arc;
            surface.shootGeodesic(start, kFine, arc);
            if (!arc.converged || !(arc.maxKappaN < 0) || arc.hasConjugatePoint) continue;
            ++candidates;
            if (!(-arc.maxKappaN * radius > firmest)) continue;
            firmest = -arc.maxKappaN * radius;
            best = start, bestArc = arc, m_radius = radius;
        }
        if (firmest > 0) lay(best, bestArc, random);
        return firmest > 0;
    }

    const PathProblem& getProblem() const { return m_problem; }
    const PathPose& getPose() const { return m_pose; }
    const PathSolution& getPath() const { return m_path; }
    double getRadius() const { return m_radius; }  ///< of the sharpest curvature at the start [m]
    double getSize() const { return m_size; }

    /** A random motion that moves points by about `m_radius` and turns by m_radius/size per unit of time. */
    Motion makeMotion(Random& random) const {
        Motion V(kPoses);
        for (SpatialVelocity& v : V) v = {random.vector(m_radius / m_size), random.vector(m_radius)};
        return V;
    }
    PathPose calcMovedPose(const Motion& V, double h) const {
        PathPose moved = m_pose;
        for (int e = 0; e < kPoses; ++e) {
            const double rate = V[e].w.norm();
            if (rate > 0)
                moved.X_GE[e].R = Eigen::AngleAxisd(h * rate, V[e].w / rate).toRotationMatrix() * m_pose.X_GE[e].R;
            moved.X_GE[e].p += h * V[e].v;
        }
        return moved;
    }
    PathSolution solveMoved(const Motion& V, double h) {
        PathSolution moved = m_path;
        m_solver.solveKeepingContacts(m_problem, calcMovedPose(V, h), moved);
        EXPECT_EQ(moved.status, PathStatus::Solved) << "path error " << moved.pathError;
        return moved;
    }

private:
    static constexpr ShootingOptions kFine{1e-13, 5000};

    void lay(const GeodesicStart& start, const ShotGeodesic& arc, Random& random) {
        m_size = arc.length + 4 * m_radius;  // of the scene
        m_problem.addPoint("origin");
        m_problem.addObstacle("obstacle", m_surface);
        m_problem.addPoint("insertion");
        const Pose X = random.pose(m_size);
        const Vector3 A = arc.P.x - random.uniform(1, 2) * m_radius * arc.P.t;
        const Vector3 B = arc.Q.x + random.uniform(1, 2) * m_radius * arc.Q.t;
        m_pose.X_GE = {Pose(random.rotation(), X * A), X, Pose(random.rotation(), X * B)};
        m_path.contacts.resize(kPoses);
        m_path.contacts[1].isTouched = true;
        m_path.contacts[1].start = start;
        m_path = solveMoved(Motion(kPoses), 0);
    }

    std::shared_ptr<const Surface> m_surface;
    PathProblem m_problem;
    PathPose m_pose;
    PathSolution m_path;
    PathSolver m_solver{[] {
        PathSolverOptions options;
        options.geodesics = kFine;
        return options;
    }()};
    double m_radius = 0, m_size = 0;
};

/** Length, then unit force and moment of each element, and contact points, in ground. */
Eigen::VectorXd collect(const PathSolution& path, const PathPose& pose) {
    std::vector<SpatialForce> F;
    calcUnitForces(path, pose, F);
    Eigen::VectorXd all(1 + 6 * kPoses + 6);
    all[0] = path.length;
    for (int e = 0; e < kPoses; ++e) all.segment<6>(1 + 6 * e) << F[e].force, F[e].moment;
    all.tail<6>() << pose.X_GE[1] * path.contacts[1].geodesic.P.x, pose.X_GE[1] * path.contacts[1].geodesic.Q.x;
    return all;
}

/** Central difference of order six: with motions that move by the least radius of curvature per unit of time,
truncation is of the order of h^6, rounding that of the geodesics over h, some 1e-10. On splines, whose third
derivatives jump, a stencil across a knot leaves h times the jump. */
template <class Function>
Eigen::VectorXd calcDifference(const Function& f) {
    constexpr double h = 5e-4;
    return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h);
}

class SurfaceSensitivity : public ::testing::TestWithParam<SurfaceCase> {};

TEST_P(SurfaceSensitivity, FirstAndSecondDerivativesAreDifferencesOfSolvedPaths) {
    Random random(101);
    double worstFirst = 0, worstSecond = 0;
    for (int k = 0; k < 2; ++k) {
        TouchingPath scene;
        ASSERT_TRUE(scene.make(GetParam(), random));
        std::vector<SpatialForce> F;
        calcUnitForces(scene.getPath(), scene.getPose(), F);
        PathSensitivity sensitivity;
        PathVariation variation;
        sensitivity.setPath(scene.getProblem(), scene.getPose(), scene.getPath());
        for (int motion = 0; motion < 3; ++motion) {
            const Motion V = scene.makeMotion(random);
            const Eigen::VectorXd difference =
                calcDifference([&](double h) { return collect(scene.solveMoved(V, h), scene.calcMovedPose(V, h)); });
            double rate = 0;
            for (int e = 0; e < kPoses; ++e) rate -= F[e].force.dot(V[e].v) + F[e].moment.dot(V[e].w);
            worstFirst = std::max(worstFirst, std::abs(rate - difference[0]) / scene.getRadius());
            ASSERT_TRUE(sensitivity.calcVariation(V, variation));
            // Per unit of the motion: forces are of order one, moments and places of the scene's size and the radius.
            Eigen::VectorXd expected(difference.size()), unit(difference.size());
            expected[0] = variation.lengthRate;
            unit[0] = scene.getRadius();
            for (int e = 0; e < kPoses; ++e) {
                expected.segment<6>(1 + 6 * e) << variation.forceRate[e].force, variation.forceRate[e].moment;
                unit.segment<6>(1 + 6 * e) << Vector3::Ones(), Vector3::Constant(scene.getSize());
            }
            expected.tail<6>() << variation.PRate[1], variation.QRate[1];
            unit.tail<6>().setConstant(scene.getRadius());
            const Eigen::VectorXd error =
                (expected - difference).cwiseAbs().cwiseQuotient(unit.cwiseMax(expected.cwiseAbs()));
            worstSecond = std::max(worstSecond, error.maxCoeff());
        }
    }
    std::printf("%-26s first derivatives %.1e, second %.1e\n", GetParam().name.c_str(), worstFirst, worstSecond);
    EXPECT_LT(worstFirst, 1e-8);
    // Arcs on a solid cross knots in every few millimeters, so that every stencil has one: see calcDifference().
    EXPECT_LT(worstSecond, GetParam().name == "BSplineSolid" ? 1e-5 : 1e-6);
}

/** Translations commute, so their second derivatives are symmetric; rotations of one body do not: with dL = -M . w for
a turn w in ground, the derivative along a of that along b, less the other way round, is M . (a x b). */
TEST_P(SurfaceSensitivity, SecondDerivativesAreSymmetricButForTheCommutatorOfRotations) {
    Random random(102);
    TouchingPath scene;
    ASSERT_TRUE(scene.make(GetParam(), random));
    PathSensitivity sensitivity;
    PathVariation variation;
    sensitivity.setPath(scene.getProblem(), scene.getPose(), scene.getPath());
    Eigen::Matrix<double, 6 * kPoses, 6 * kPoses> hessian, commutator;
    commutator.setZero();
    std::vector<SpatialForce> F;
    calcUnitForces(scene.getPath(), scene.getPose(), F);
    const double turn = 1 / scene.getSize();  // unit of rotations, that of translations being one meter
    for (int column = 0; column < 6 * kPoses; ++column) {
        Motion V(kPoses);
        SpatialVelocity& v = V[column / 6];
        (column % 6 < 3 ? v.v : v.w)[column % 3] = column % 6 < 3 ? 1 : turn;
        ASSERT_TRUE(sensitivity.calcVariation(V, variation));
        for (int e = 0; e < kPoses; ++e)
            hessian.block<6, 1>(6 * e, column) << -variation.forceRate[e].force, -turn * variation.forceRate[e].moment;
    }
    for (int e = 0; e < kPoses; ++e)  // row b, column a: the derivative along a of that along b
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                commutator(6 * e + 3 + b, 6 * e + 3 + a) =
                    turn * turn * F[e].moment.dot(Vector3::Unit(a).cross(Vector3::Unit(b)));
    EXPECT_LT((hessian - hessian.transpose() - commutator).norm(), 1e-10 * hessian.norm());
    EXPECT_GT(hessian.norm(), 0.01 / scene.getSize());
}

std::vector<SurfaceCase> makeWrappableCases() {
    std::vector<SurfaceCase> cases = makeSurfaceCases();
    const auto isHalfSpace = [](const SurfaceCase& c) {
        return c.name == "HalfSpace" || c.name == "ParametricHalfSpace";
    };
    cases.erase(std::remove_if(cases.begin(), cases.end(), isHalfSpace), cases.end());
    return cases;
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceSensitivity, ::testing::ValuesIn(makeWrappableCases()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace tautline::testing
