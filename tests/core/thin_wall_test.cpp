// SPDX-License-Identifier: Apache-2.0
/** Walls that are thinner than the edges of an elastic band are long: a bowl of a sheet, over whose rim the string goes
from the inside to the outside. */
#include <gtest/gtest.h>

#include <cmath>

#include "paths/search/clear_course.h"
#include "support/path_scene.h"
#include "support/random.h"
#include "tautline/surfaces/function_surface.h"

namespace tautline::testing {
namespace {

constexpr unsigned kSeed = 20261128;

/** All points that are no farther than `half` from the part of the unit sphere that lies more than `opening` from the z
axis: a shell with a round rim. */
struct Bowl {
    double half, opening;

    Vector2 getRim() const { return {std::sin(opening), std::cos(opening)}; }  ///< from the axis, and along it

    std::shared_ptr<const Surface> makeSurface() const {
        return std::make_shared<ImplicitFunctionSurface>(
            "bowl", 1.0, ImplicitFunctionSurface::FullFunction([bowl = *this](const Vector3& p) {
                return std::atan2(p.head<2>().norm(), p.z()) > bowl.opening ? bowl.calcShell(p) : bowl.calcRim(p);
            }));
    }

    ImplicitValue calcShell(const Vector3& p) const {
        const double r = p.norm(), side = r < 1 ? -1 : 1;
        const Vector3 n = p / r;
        return {side * (r - 1) - half, side * n, side / r * (Matrix3::Identity() - n * n.transpose())};
    }

    ImplicitValue calcRim(const Vector3& p) const {
        const double radius = p.head<2>().norm();
        const Vector3 outward = radius > 0 ? Vector3(p.x() / radius, p.y() / radius, 0) : Vector3(Vector3::UnitX());
        const Vector3 around = Vector3::UnitZ().cross(outward);
        const Vector3 from = (radius - getRim()[0]) * outward + (p.z() - getRim()[1]) * Vector3::UnitZ();
        const double distance = from.norm();
        const Vector3 n = from / distance, across = around.cross(n);
        return {distance - half, n,
                across * across.transpose() / distance +
                    n.dot(outward) / std::max(radius, 1e-9) * around * around.transpose()};
    }
};

constexpr Bowl kBowl{0.03, kPi / 3};

PathScene makeScene(const Vector3& A, const Vector3& B) {
    PathScene scene;
    scene.point(A).obstacle(kBowl.makeSurface(), Pose()).point(B);
    return scene;
}

// In a plane through the axis: a tangent to the rim's circle, an arc on that to where the shell begins, an arc on the
// outer sphere, a tangent to that.
TEST(ThinWall, IsGoneRoundByTheLengthOfTwoCirclesAndTheirTangents) {
    const Vector2 A(0.6, -0.2), B(1.3, -0.5), rim = kBowl.getRim(), toA = A - rim;
    const double h = kBowl.half, outer = 1 + h, begin = kPi / 2 - kBowl.opening;
    const double tangentA = std::atan2(toA[1], toA[0]) + 2 * kPi - std::acos(h / toA.norm());
    const double tangentB = std::atan2(B[1], B[0]) + std::acos(outer / B.norm());
    const double length = std::sqrt(toA.squaredNorm() - h * h) + h * (tangentA - begin) + outer * (begin - tangentB) +
                          std::sqrt(B.squaredNorm() - outer * outer);
    const PathSolution path = makeScene({A[0], 0, A[1]}, {B[0], 0, B[1]}).solve();
    ASSERT_EQ(path.status, PathStatus::Solved);
    EXPECT_NEAR(path.length, length, 1e-9);
    EXPECT_EQ(path.contacts[1].getNumArcs(), 1);
}

TEST(ThinWall, IsGoneRoundFromAnywhereWithinToAnywhereOutside) {
    Random random(kSeed);
    for (int i = 0; i < 100; ++i) {
        const Vector3 A = 0.8 * std::cbrt(random.uniform(0, 1)) * random.unitVector();
        const Vector3 B = random.uniform(1.1, 1.6) * random.unitVector();
        const PathScene scene = makeScene(A, B);
        const PathSolution path = scene.solve();
        EXPECT_EQ(path.status, PathStatus::Solved)
            << "string " << i << " from " << A.transpose() << " to " << B.transpose();
        const Surface& bowl = *scene.problem.getElement(1).surface;
        for (const StraightSegment& line : path.segments)
            for (int k = 0; k <= 1000; ++k)
                ASSERT_GT(bowl.calcHeight(line.A + k / 1000.0 * (line.B - line.A)), -1e-9) << "string " << i;
    }
}

TEST(ThinWall, CourseOverALatticeIsClearOfIt) {
    Random random(kSeed);
    const auto bowl = kBowl.makeSurface();
    for (int i = 0; i < 20; ++i) {
        const Vector3 A = 0.8 * std::cbrt(random.uniform(0, 1)) * random.unitVector();
        const Vector3 B = random.uniform(1.1, 1.6) * random.unitVector();
        std::vector<Vector3> course;
        long numHeights = 0;
        ASSERT_TRUE(findClearCourse(*bowl, A, B, course, numHeights)) << "course " << i;
        course.insert(course.begin(), A);
        course.push_back(B);
        for (std::size_t k = 0; k + 1 < course.size(); ++k)
            for (int part = 0; part <= 100; ++part)
                EXPECT_GT(bowl->calcHeight(course[k] + part / 100.0 * (course[k + 1] - course[k])), -2e-3)
                    << "course " << i;
        EXPECT_LT(numHeights, 200000) << "course " << i;
    }
}

// A closed shell has no way out, which the search finds out in the end.
TEST(ThinWall, NoCourseIsFoundOutOfAClosedShell) {
    const Bowl closed{0.03, -1};
    std::vector<Vector3> course;
    long numHeights = 0;
    EXPECT_FALSE(findClearCourse(*closed.makeSurface(), Vector3(0.1, 0, 0), Vector3(2, 0, 0), course, numHeights));
    EXPECT_TRUE(course.empty());
}

}  // namespace
}  // namespace tautline::testing
