// SPDX-License-Identifier: Apache-2.0
/** What a user may say about the first course of a path: side, winding, threading; and what a ring keeps. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "paths/search/threading.h"
#include "support/random.h"
#include "support/seeded_random.h"
#include "tautline/error.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_solver.h"
#include "tautline/paths/segment_clearance.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/elliptic_cylinder.h"
#include "tautline/surfaces/scaled_surface.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline {
namespace {

/** A path from A over one obstacle in ground's frame to B. */
struct SingleObstacle {
    PathProblem problem;
    PathPose pose;
    PathSolution path;

    SingleObstacle(std::shared_ptr<const Surface> surface, const StartHint& hint, const Vector3& A, const Vector3& B) {
        problem.addPoint("origin");
        problem.addObstacle("obstacle", std::move(surface), hint);
        problem.addPoint("insertion");
        pose.X_GE = {Pose(A), Pose(), Pose(B)};
        solve();
    }
    void solve() { PathSolver().solve(problem, pose, path); }
    const ObstacleContact& contact() const { return path.contacts[1]; }
    HolePassage passage() const { return calcHolePassage({problem, pose}, path, 1, 0, contact().isTouched ? 1 : 0); }
};

TEST(StartSide, DecidesOnWhichSideAPathPasses) {
    const Vector3 A(-3, 0.2, 0.1), B(3, 0.2, -0.4);
    for (const double side : {1.0, -1.0}) {
        const SingleObstacle scene(std::make_shared<Cylinder>(1), PassOnSide{Vector3(0, side, 0)}, A, B);
        EXPECT_EQ(scene.path.status, PathStatus::Solved);
        ASSERT_TRUE(scene.contact().isTouched);
        EXPECT_GT(side * scene.contact().geodesic.P.x.y(), 0.5);
    }
}

// 2026-11-25: on the wrong side, and not following, where the direction had a part along the axis.
TEST(StartSide, IsTakenOnALongSurfaceAlsoAskew) {
    const Vector3 A(-3, 0.1, 0), B(3, -0.4, 0.2), center(1.9, 0.05, 0);
    for (const double alongAxis : {0.0, 0.1, 0.3, 0.45, 1.0, -0.5}) {
        const PassOnSide hint{Vector3(0, 1, alongAxis)};
        const SingleObstacle scene(std::make_shared<Cylinder>(0.25), hint, A - center, B - center);
        EXPECT_EQ(scene.path.status, PathStatus::Solved);
        EXPECT_TRUE(scene.path.followsHints()) << alongAxis;
        ASSERT_TRUE(scene.contact().isTouched) << alongAxis;
        EXPECT_GT(scene.contact().geodesic.P.x.y(), 0) << alongAxis;
    }
}

TEST(StartSide, LeavesALineAloneThatIsClearOnThatSide) {
    const Vector3 A(-3, 1.5, 0), B(3, 1.5, 0);
    const SingleObstacle above(std::make_shared<Sphere>(1), PassOnSide{Vector3(0, 1, 0)}, A, B);
    EXPECT_FALSE(above.contact().isTouched);
    EXPECT_DOUBLE_EQ(above.path.length, 6);
    const SingleObstacle below(std::make_shared<Cylinder>(1), PassOnSide{Vector3(0, -1, 0)}, A, B);
    EXPECT_EQ(below.path.status, PathStatus::Solved);
    EXPECT_TRUE(below.contact().isTouched);
}

// Unrolled, a helix and its tangents are one straight line: length^2 = (planar length)^2 + (rise)^2.
TEST(StartWinding, TakesTheTurnsThatAreAskedForInClosedForm) {
    const double radius = 0.5, rise = 0.8;
    const Vector3 A(-2, 0.3, 0), B(1.5, 0.4, rise);
    const double toA = std::hypot(A.x(), A.y()), toB = std::hypot(B.x(), B.y());
    const double direct = std::atan2(B.y(), B.x()) - std::atan2(A.y(), A.x());
    for (const double turns : {-3.0, -2.5, -1.5, -0.5, 0.5, 1.5, 2.5, 3.0}) {
        const double swept = std::abs(direct + 2 * kPi * std::round(turns - direct / (2 * kPi)));
        const double arc = swept - std::acos(radius / toA) - std::acos(radius / toB);
        const double planar =
            std::sqrt(toA * toA - radius * radius) + std::sqrt(toB * toB - radius * radius) + radius * arc;
        const SingleObstacle scene(std::make_shared<Cylinder>(radius), WindAround{turns}, A, B);
        EXPECT_EQ(scene.path.status, PathStatus::Solved) << turns;
        EXPECT_NEAR(scene.path.length, std::hypot(planar, rise), 1e-10) << turns;
        const DarbouxFrame& P = scene.contact().geodesic.P;
        EXPECT_GT(turns * P.t.dot(Vector3::UnitZ().cross(P.x)), 0) << "turns the other way, " << turns;
    }
}

// 2026-11-25: one turn in five was lost on scaled cylinders: guides from far away were led down askew.
TEST(StartWinding, TurnsAsOftenAboutAScaledCylinderAsAboutTheEllipticOne) {
    const Vector3 A(-3, 0.3, -0.3), B(2.5, 0.4, 0.6);
    for (const double factor : {0.7, 0.9, 1.4}) {
        const auto scaled =
            makeScaledSurface(std::make_shared<Cylinder>(1), Matrix3(Vector3(1, factor, 1).asDiagonal()));
        for (const double turns : {-8.0, -3.0, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0}) {
            const SingleObstacle scene(scaled, WindAround{turns}, A, B);
            const SingleObstacle same(std::make_shared<EllipticCylinder>(1, factor), WindAround{turns}, A, B);
            EXPECT_EQ(scene.path.status, PathStatus::Solved) << factor << " " << turns;
            EXPECT_TRUE(scene.path.followsHints()) << factor << " " << turns;
            EXPECT_NEAR(scene.path.length, same.path.length, 1e-9) << factor << " " << turns;
            EXPECT_GT(scene.path.length, 2 * (std::abs(turns) - 1) * kPi * std::min(1.0, factor));
        }
    }
}

// 2026-11-25: said to follow.
TEST(StartWinding, SaysWhereTheStringHasSlippedOff) {
    for (const double turns : {5.0, -3.0, 20.0}) {
        const SingleObstacle scene(std::make_shared<Sphere>(1), WindAround{turns}, Vector3(-3, 0.2, 0.1),
                                   Vector3(3, 0.3, 0));
        EXPECT_EQ(scene.path.status, PathStatus::Solved);
        EXPECT_LT(scene.path.length, 6.5);
        EXPECT_FALSE(scene.path.followsHints()) << turns;
        EXPECT_EQ(explainStatus(scene.problem, scene.pose, scene.path),
                  "a local minimum, but not with the turns about 'obstacle' that are asked for");
    }
}

TEST(StartSide, SaysWhereTheStringHasSlippedToTheOther) {
    int other = 0;
    testing::Random random(17);
    for (int i = 0; i < 40; ++i) {
        const Vector3 side = random.vector(1).normalized();
        const SingleObstacle scene(std::make_shared<Sphere>(1), PassOnSide{side}, Vector3(-3, 0.2, 0.1),
                                   Vector3(3, 0.3, 0));
        EXPECT_EQ(scene.path.status, PathStatus::Solved);
        ASSERT_TRUE(scene.contact().isTouched);
        // Half way along the arc; the two ends are alike.
        const Vector3 middle = scene.contact().geodesic.P.x + scene.contact().geodesic.Q.x;
        EXPECT_EQ(scene.path.followsHints(), side.dot(middle) >= 0) << i;
        if (!scene.path.followsHints()) ++other;
    }
    EXPECT_GT(other, 5);
}

TEST(StartThreading, LeadsThroughARingThatTheStraightLinePasses) {
    // The straight line is clear of the ring.
    const Vector3 A(2, 0.1, 1), B(2, -0.2, -1);
    const SingleObstacle free(std::make_shared<Torus>(1, 0.2), {}, A, B);
    EXPECT_FALSE(free.contact().isTouched);
    for (const auto& ring : {std::shared_ptr<const Surface>(std::make_shared<Torus>(1, 0.2)),
                             std::shared_ptr<const Surface>(std::make_shared<ParametricTorus>(1, 0.2))}) {
        const SingleObstacle threaded(ring, ThreadHole{-1}, A, B);
        EXPECT_EQ(threaded.path.status, PathStatus::Solved);
        EXPECT_TRUE(threaded.contact().isTouched);
        EXPECT_EQ(threaded.passage().count, -1);
        EXPECT_GT(threaded.path.length, free.path.length);
    }
}

TEST(StartThreading, KeepsThePathOutOfARingWherePassagesAreZero) {
    const Vector3 A(0.3, 0, 2), B(0.3, 0.1, -2);
    const SingleObstacle inside(std::make_shared<Torus>(1, 0.2), {}, A, B);
    EXPECT_EQ(inside.passage().count, -1);
    const SingleObstacle outside(std::make_shared<Torus>(1, 0.2), ThreadHole{0}, A, B);
    EXPECT_EQ(outside.path.status, PathStatus::Solved);
    EXPECT_EQ(outside.passage().count, 0);
    EXPECT_TRUE(outside.contact().isTouched);
}

TEST(StartThreading, GoesAroundTheTubeWhereARingIsThreadedTwice) {
    const SingleObstacle once(std::make_shared<Torus>(1, 0.2), ThreadHole{1}, Vector3(0.9, 0, -2),
                              Vector3(0.9, 0.1, 2));
    const SingleObstacle twice(std::make_shared<Torus>(1, 0.2), ThreadHole{2}, Vector3(0.9, 0, -2),
                               Vector3(0.9, 0.1, 2));
    EXPECT_EQ(once.passage().count, 1);
    EXPECT_EQ(twice.passage().count, 2);
    EXPECT_EQ(twice.path.status, PathStatus::Solved);
    EXPECT_NEAR(twice.path.length - once.path.length, 2 * kPi * 0.2, 0.05);  // once more around the tube
}

// Lines through the hole, some through the inner half of the tube, thread the ring; others do not.
TEST(StartThreading, FollowsTheStraightLineWhereNothingIsSaid) {
    for (const double rho : {0.0, 0.4, 0.75, 0.81, 0.9, 0.97, 1.03, 1.1, 1.25, 2.0})
        for (const double slant : {-0.8, 0.0, 0.8}) {
            const Vector3 through = rho * Vector3(std::cos(0.4), std::sin(0.4), 0), along(slant, 0.2, 1);
            const SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, through - 3 * along, through + 3 * along);
            EXPECT_EQ(scene.path.status, PathStatus::Solved) << rho << " " << slant;
            EXPECT_EQ(scene.passage().count, rho < 1 ? 1 : 0) << rho << " " << slant;
        }
}

// Symptom (2026-11-25): with both ends on one side the ring was passed outside, without a word.
TEST(StartThreading, LeadsAroundTheTubeWhereAnEndIsOnTheWrongSide) {
    const Vector3 inner(0.5, 0, 1), outer(1.5, 0.05, 1), mirror(1, 1, -1);
    for (const double side : {-1.0, 1.0})
        for (const int passages : {-1, 1})
            for (const bool beginsInside : {true, false}) {
                const Vector3 A = beginsInside ? inner : outer, B = beginsInside ? outer : inner;
                const Vector3 scale = side > 0 ? Vector3(1, 1, 1) : mirror;
                const SingleObstacle scene(std::make_shared<Torus>(1, 0.2), ThreadHole{passages}, A.cwiseProduct(scale),
                                           B.cwiseProduct(scale));
                EXPECT_EQ(scene.path.status, PathStatus::Solved) << side << passages << beginsInside;
                EXPECT_EQ(scene.passage().count, passages) << side << passages << beginsInside;
                EXPECT_TRUE(scene.path.followsHints());
                // Once around the bar from below or above; the mirrored scene has the same length.
                EXPECT_NEAR(scene.path.length, (passages * side < 0) == beginsInside ? 2.71518 : 3.08637, 1e-5);
            }
}

// A line clear of the tube threads a ring without a hint exactly if it passes the hole.
TEST(StartThreading, FollowsAnyLineThatIsClearOfTheTube) {
    testing::Random random(8);
    int threaded = 0, outside = 0;
    while (threaded < 100 || outside < 100) {
        const Torus torus(1, random.uniform(0.1, 0.7));
        const Vector3 A = random.vector(3), B = random.vector(3);
        const double length = (B - A).norm();
        const double s = torus.findLowestPoint(A, (B - A) / length, length);
        if (torus.calcHeight(A + s * (B - A) / length) < 0.01) continue;
        const SingleObstacle scene(std::make_shared<Torus>(torus), {}, A, B);
        const int crossings = torus.getHole()->countCrossings(A, B);
        ++(crossings ? threaded : outside);
        EXPECT_EQ(scene.path.status, PathStatus::Solved);
        EXPECT_EQ(scene.passage().count, crossings);
        EXPECT_TRUE(scene.path.followsHints());
        EXPECT_NEAR(scene.path.length, length, 1e-12);
    }
}

// Through the hole, and through the tube on both sides of it: the threaded string lies on the ring in two places.
TEST(StartThreading, ThreadsARingThatIsTouchedOnBothSidesOfItsHole) {
    const SingleObstacle scene(std::make_shared<Torus>(1, 0.4), {}, Vector3(-2, 0, -0.6), Vector3(2, 0, 0.6));
    EXPECT_EQ(scene.path.status, PathStatus::Solved);
    EXPECT_EQ(scene.path.contacts[1].getNumArcs(), 2);
    EXPECT_EQ(scene.passage().count, 1);
    EXPECT_TRUE(scene.path.followsHints());
}

/** How often a path goes through the disc rho < 1, z = 0, by points along it, along +z less against it. */
int countThroughUnitDisc(const PathProblem& problem, const PathPose& pose, const PathSolution& path) {
    constexpr int kPieces = 200;  // of the arc
    std::vector<Vector3> points;
    for (const StraightSegment& line : path.segments) {
        points.insert(points.end(), {line.A, line.B});
        const auto& surface = problem.getElement(line.toElement).surface;
        GeodesicStart part = path.contacts[line.toElement].start;
        const double length = part.length;
        for (int i = 1; surface && length > 0 && i < kPieces; ++i) {
            part.length = length * i / kPieces;
            ShotGeodesic arc;
            surface->shootGeodesic(part, ShootingOptions(), arc);
            points.push_back(pose.X_GE[line.toElement] * arc.Q.x);
        }
    }
    int count = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Vector3 &a = points[i - 1], &b = points[i];
        const bool isUp = b.z() >= 0;
        if ((a.z() >= 0) == isUp) continue;
        const Vector3 crossing = a + a.z() / (a.z() - b.z()) * (b - a);
        if (crossing.head<2>().norm() < 1) count += isUp ? 1 : -1;
    }
    return count;
}

/** From one side of the disc to the other through it: the straight line, or over its edge. */
double calcLengthThroughUnitDisc(const Vector3& A, const Vector3& B) {
    const Vector3 crossing = A + A.z() / (A.z() - B.z()) * (B - A);
    if (crossing.head<2>().norm() < 1) return (B - A).norm();
    constexpr int n = 20000;
    double least = kInfinity;
    for (int k = 0; k < n; ++k) {
        const Vector3 edge(std::cos(2 * kPi * k / n), std::sin(2 * kPi * k / n), 0);
        least = std::min(least, (edge - A).norm() + (B - edge).norm());
    }
    return least;
}

// 2026-11-26: of 120 chords past thin rings up to 41 lost a point in the hole, and were said to follow their hints.
TEST(StartThreading, APointInTheHoleOfAThinRingIsNotLostInSilence) {
    for (const double tube : {0.05, 0.02}) {
        SCOPED_TRACE(tube);
        testing::SeededRandom random(20261127);
        int numOpposite = 0, numThrough = 0;
        for (int i = 0; i < 120; ++i) {
            const Vector3 A = random.vector(2), B = random.vector(2);
            const double angle = random.uniform(-kPi, kPi), rho = random.uniform(0, 1 - 1.5 * tube);
            const Vector3 inHole(rho * std::cos(angle), rho * std::sin(angle), random.uniform(-2, 2) * tube);
            const SingleObstacle scene(std::make_shared<Torus>(1, tube), PassNear{inHole}, A, B);
            const PathSolution path = solvePath(scene.problem, scene.pose);
            ASSERT_EQ(path.status, PathStatus::Solved) << "chord " << i;
            const bool isThrough = countThroughUnitDisc(scene.problem, scene.pose, path) != 0;
            EXPECT_EQ(path.followsHints(), isThrough) << "chord " << i;
            // A string whose ends are on one side is drawn out of the hole again; of the others some searches fail.
            if ((A.z() > 0) == (B.z() > 0)) continue;
            ++numOpposite;
            if (!isThrough) continue;
            ++numThrough;
            const double thin = calcLengthThroughUnitDisc(A, B);
            EXPECT_GT(path.length, thin - 1e-7) << "chord " << i;
            EXPECT_LT(path.length, thin + kPi * tube) << "chord " << i;
        }
        std::printf("[measured] tube %g: %d of %d strings through the ring\n", tube, numThrough, numOpposite);
        EXPECT_GE(numThrough, 0.9 * numOpposite);
        EXPECT_GT(numOpposite, 40);
    }
}

TEST(HolePassage, KeepsAThreadedPathThroughARingThatJumps) {
    SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, Vector3(0, 0.1, -3), Vector3(0.1, 0, 3));
    ASSERT_EQ(scene.passage().count, 1);
    ASSERT_FALSE(scene.contact().isTouched);
    for (const double y : {2.0, 0.3, -1.8, 0.0}) {
        scene.pose.X_GE[1].p = Vector3(0, y, 0);
        scene.solve();
        EXPECT_EQ(scene.path.status, PathStatus::Solved) << y;
        EXPECT_EQ(scene.contact().passage.count, 1) << y;
        EXPECT_FALSE(scene.contact().hasLeftHole) << y;
        EXPECT_EQ(scene.contact().isTouched, std::abs(y) > 0.75) << y;
    }
}

TEST(HolePassage, ReportsAPathThatLeavesItsRing) {
    SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, Vector3(0, 0.1, -3), Vector3(0.1, 0, 3));
    scene.pose.X_GE[1].p = Vector3(0, 2, 0);
    PathSolverOptions options;
    options.allowsColdStart = false;  // nothing leads back through the ring
    PathSolver(options).solve(scene.problem, scene.pose, scene.path);
    EXPECT_TRUE(scene.contact().hasLeftHole);
    EXPECT_EQ(scene.passage().count, 0);
    // Until it is threaded again, as a solve that may lay it anew does.
    PathSolver(options).solve(scene.problem, scene.pose, scene.path);
    EXPECT_TRUE(scene.contact().hasLeftHole);
    scene.solve();
    EXPECT_FALSE(scene.contact().hasLeftHole);
    EXPECT_EQ(scene.path.status, PathStatus::Solved);
}

// 2026-11-25: nothing was said where the string touched, or left, the obstacle beside the ring in the same step.
TEST(HolePassage, IsMissedAlsoWhereTheNeighborIsTouchedOrLeftInTheSameStep) {
    for (const bool isTouchedFirst : {false, true}) {
        PathProblem problem;
        problem.addPoint("origin");
        problem.addObstacle("ring", std::make_shared<Torus>(1, 0.2));
        const int cylinder = problem.addObstacle("cylinder", std::make_shared<Cylinder>(0.2));
        problem.addPoint("insertion");
        const Matrix3 alongY = Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()).toRotationMatrix();
        const Pose near(alongY, Vector3(0.15, 0, 1.5)), far(alongY, Vector3(0.5, 0, 1.5));
        PathPose pose;
        pose.X_GE = {Pose(Vector3(0, 0.1, -3)), Pose(), isTouchedFirst ? near : far, Pose(Vector3(0.1, 0, 3))};
        PathSolution path = solvePath(problem, pose);
        ASSERT_EQ(path.contacts[1].passage.count, 1);
        ASSERT_EQ(path.contacts[cylinder].isTouched, isTouchedFirst);
        PathSolverOptions options;
        options.allowsColdStart = false;
        pose.X_GE[cylinder] = isTouchedFirst ? far : near;
        PathSolver(options).solve(problem, pose, path);
        EXPECT_FALSE(path.contacts[1].hasLeftHole);
        ASSERT_EQ(path.contacts[cylinder].isTouched, !isTouchedFirst);
        pose.X_GE[cylinder] = isTouchedFirst ? near : far;
        pose.X_GE[1].p = Vector3(0, 2, 0);  // and away
        PathSolver(options).solve(problem, pose, path);
        EXPECT_TRUE(path.contacts[1].hasLeftHole) << isTouchedFirst;
        EXPECT_EQ(path.contacts[cylinder].isTouched, isTouchedFirst);
        EXPECT_EQ(explainStatus(problem, pose, path), "the path has left the hole of 'ring'");
    }
}

/** The old arc leads nowhere there: the string is laid through the hole anew, and hangs on the tube's near side. */
TEST(HolePassage, IsFoundAgainHoweverFarARingJumps) {
    SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, Vector3(0, 0, -3), Vector3(0, 0, 3));
    scene.pose.X_GE[1].p = Vector3(300, 0, 0);
    scene.solve();
    EXPECT_EQ(scene.path.status, PathStatus::Solved);
    EXPECT_EQ(scene.passage().count, 1);
    const double distance = std::hypot(299, 3), tangent = std::sqrt(distance * distance - 0.04);
    const double arc = 2 * (kPi - std::atan2(3, 299)) - 2 * std::acos(0.2 / distance);
    EXPECT_NEAR(scene.path.length, 2 * tangent + 0.2 * arc, 1e-9);
}

// 2026-11-25: each later step looked for the way back in vain, for up to a second, and might end at no minimum at all.
TEST(HolePassage, IsGivenUpWhereNothingLeadsBack) {
    SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, Vector3(0, 0.1, -3), Vector3(0.1, 0, 3));
    ASSERT_EQ(scene.passage().count, 1);
    // So far aside that the string, which was 6 m long, is not found there.
    scene.pose.X_GE[1].p = Vector3(1000, 0, 0);
    scene.solve();
    EXPECT_EQ(scene.path.status, PathStatus::NotMinimum);
    EXPECT_TRUE(verifyPath(scene.problem, scene.pose, scene.path).isMinimum());
    EXPECT_TRUE(scene.contact().hasLeftHole);
    const double length = scene.path.length;
    scene.pose.X_GE[1].p.y() = 0.01;
    scene.solve();
    EXPECT_EQ(scene.path.status, PathStatus::NotMinimum);
    EXPECT_TRUE(verifyPath(scene.problem, scene.pose, scene.path).isMinimum());
    EXPECT_FALSE(scene.path.wasCold);
    EXPECT_TRUE(scene.contact().hasLeftHole);
    EXPECT_NEAR(scene.path.length, length, 0.01);
}

// 2026-11-27: given up, since the string lies on the ring in two places: on its way in and on its way out.
TEST(HolePassage, IsKeptWhereTheRingIsTouchedTwice) {
    SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, Vector3(0, 0.1, -3), Vector3(0.1, 0, 3));
    scene.pose.X_GE[1] =
        Pose(Eigen::AngleAxisd(1.5, Vector3::UnitX()).toRotationMatrix(), Vector3(1.3, 0, 0));  // edge on
    scene.solve();
    EXPECT_EQ(scene.path.status, PathStatus::Solved);
    EXPECT_EQ(scene.contact().getNumArcs(), 2);
    EXPECT_FALSE(scene.contact().hasLeftHole);
    EXPECT_EQ(scene.passage().count, 1);
}

// An end that moves around the ring takes the string out of it: nothing to report.
TEST(HolePassage, FollowsAnEndThatIsPulledThroughTheHole) {
    SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, Vector3(0, 0.1, -1), Vector3(0.1, 0, 3));
    ASSERT_EQ(scene.passage().count, 1);
    for (const double z : {-0.5, -0.1, 0.1, 0.5}) {
        scene.pose.X_GE[0].p.z() = z;
        scene.solve();
        EXPECT_EQ(scene.contact().passage.count, z < 0 ? 1 : 0) << z;
        EXPECT_FALSE(scene.contact().hasLeftHole) << z;
    }
}

// Symptom (2026-11-24): neither a start nor leave to look for one left a path without segments, of length NaN.
TEST(PathStart, IsTheStraightLineWhereNoneIsGivenAndNoneMayBeSought) {
    PathSolverOptions options;
    options.allowsColdStart = false;
    for (const double h : {0.5, 1.5}) {
        SingleObstacle scene(std::make_shared<Torus>(1, 0.2), {}, Vector3(-3, h, 0.3), Vector3(3, h, 0.25));
        PathSolution path;
        PathSolver(options).solve(scene.problem, scene.pose, path);
        EXPECT_TRUE(std::isfinite(path.length)) << h;
        EXPECT_FALSE(path.segments.empty()) << h;
    }
}

std::string getRefusal(std::shared_ptr<const Surface> surface, const StartHint& hint) {
    try {
        PathProblem problem;
        problem.addPoint("origin");
        problem.addObstacle("ring", std::move(surface), hint);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

TEST(StartHint, RefusesWhatItCannotFollow) {
    const auto sphere = std::make_shared<Sphere>(1);
    EXPECT_EQ(getRefusal(sphere, ThreadHole{1}), "path: obstacle 'ring', sphere(radius=1), has no hole to thread");
    EXPECT_EQ(getRefusal(sphere, PassOnSide{Vector3::Zero()}),
              "path: the side of obstacle 'ring' needs a finite direction that is not zero, got (0 0 0)");
    EXPECT_EQ(getRefusal(sphere, PassNear{Vector3(0, kNaN, 0)}),
              "path: the hint of obstacle 'ring' must be finite, but is (  0 nan   0)");
    EXPECT_EQ(getRefusal(sphere, WindAround{1e9}),
              "path: the turns about obstacle 'ring' must be within 100, but are 1000000000");
    EXPECT_EQ(getRefusal(sphere, WindAround{kNaN}),
              "path: the turns about obstacle 'ring' must be within 100, but are nan");
    EXPECT_EQ(getRefusal(std::make_shared<Torus>(1, 0.2), ThreadHole{-101}),
              "path: the passages through obstacle 'ring' must be within 100, but are -101");
}

// Symptom (2026-11-24): from afar the foot of steepest descent on a thin ellipsoid lay on its far side, and a line that
// passed clear of it was found below its surface.
TEST(SegmentClearance, OfAThinEllipsoidFarAwayIsTheDistance) {
    const Ellipsoid thin(Vector3(0.00903843, 0.0110219, 0.00363398));
    const Vector3 A(2.5, 0.9, -1.7), B(-2.2, -1.4, -1.5);
    LineClearance clearance;
    findSegmentClearance(thin, Pose(), A, B, clearance);
    const Vector3 e = (B - A).normalized();
    const double toCenter = (A - e.dot(A) * e).norm();
    EXPECT_GT(clearance.distance, toCenter - 0.0111);
    EXPECT_LT(clearance.distance, toCenter - 0.0036);
}

}  // namespace
}  // namespace tautline
