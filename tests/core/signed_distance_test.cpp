// SPDX-License-Identifier: Apache-2.0
/** Clearance of a straight line over a surface: the thesis's examples and the side that is kept. */
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/random.h"
#include "support/seeded_random.h"
#include "support/shapes.h"
#include "tautline/paths/segment_clearance.h"
#include "tautline/surfaces/capsule.h"
#include "tautline/surfaces/elliptic_cylinder.h"
#include "tautline/surfaces/offset_surface.h"

namespace tautline::testing {
namespace {

/** Newton's method of thesis Sec. 6.1 on x(u, v) = (u, v, u^2/14 + v^2/6), Eqn. 6.3 to 6.5 with the unknowns in the
order (s_0, u, v). Ends of the line and expected numbers: errata of Sec. 6.1.1 and Tab. 6.1. */
TEST(SignedDistance, ParaboloidOfThesisTab6_1) {
    const Vector3 A(-10, 10, -5), B(10, 5, -2), e = (B - A).normalized();
    const double norms[] = {11.347973868163587, 0.08996027934027645, 0.0020755024625711, 1.7055e-7, 1.3e-15};
    const double tolerances[] = {1e-13, 1e-14, 1e-14, 1e-11, 1e-14};  // digits printed
    // s_0, u_C, v_C and the column d, which is the distance of C and D: some are printed rounded, others cut off (the
    // last u_C is 2.56305828, the second v_C 2.622879), so to one unit of the last place.
    const double rows[5][4] = {{5.0000, 1.0000, 2.0000, 10.4813},
                               {14.5843, 2.3944, 2.6228, 6.1210},
                               {14.7876, 2.5635, 2.5943, 6.1193},
                               {14.7875, 2.5631, 2.5938, 6.1193},
                               {14.7875, 2.5630, 2.5938, 6.1193}};
    Vector3 w(5, 1, 2);
    double d = kNaN;
    for (int k = 0; k < 5; ++k) {
        const double u = w[1], v = w[2];
        const Vector3 xu(1, 0, u / 7), xv(0, 1, v / 3), xuu(0, 0, 1 / 7.0), xvv(0, 0, 1 / 3.0);
        const Vector3 r = A + w[0] * e - Vector3(u, v, u * u / 14 + v * v / 6);
        const Vector3 g(e.dot(r), xu.dot(r), xv.dot(r));
        EXPECT_NEAR(g.norm(), norms[k], tolerances[k]) << "row " << k + 1;
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(w[i], rows[k][i], 1e-4) << "row " << k + 1;
        EXPECT_NEAR(r.norm(), rows[k][3], 1e-4) << "row " << k + 1;
        d = r.dot(xv.cross(xu).normalized());  // outward on the convex side, below
        Matrix3 J;
        J << 1, -e.dot(xu), -e.dot(xv), e.dot(xu), -xu.dot(xu) + r.dot(xuu), -xu.dot(xv), e.dot(xv), -xu.dot(xv),
            -xv.dot(xv) + r.dot(xvv);
        w -= J.inverse() * g;
    }
    EXPECT_NEAR(w[0], 14.78753229, 5e-9);
    EXPECT_NEAR(w[1], 2.56305828, 5e-9);
    EXPECT_NEAR(w[2], 2.59381419, 5e-9);
    EXPECT_NEAR(d, 6.119329965720299, 1e-14);

    /** The paraboloid as f = u^2/14 + v^2/6 - z: outside below. */
    class Paraboloid final : public ImplicitSurface {
    public:
        ImplicitValue calcImplicit(const Vector3& p) const override {
            return {p.x() * p.x() / 14 + p.y() * p.y() / 6 - p.z(), Vector3(p.x() / 7, p.y() / 3, -1),
                    Vector3(1 / 7.0, 1 / 3.0, 0).asDiagonal()};
        }
        double getSize() const override { return 3; }
        std::string getDescription() const override { return "paraboloid"; }
    };
    LineClearance clearance;
    findSegmentClearance(Paraboloid(), Pose(), A, B, clearance);
    EXPECT_TRUE(clearance.found);
    EXPECT_NEAR(clearance.distance, d, 1e-12);
    EXPECT_NEAR(clearance.lineCoordinate, w[0], 1e-9);
    EXPECT_LT((clearance.C.p.head<2>() - w.tail<2>()).norm(), 1e-9);
}

/** What Tab. 7.1 prints in a row, and the signed distance. */
struct Tab7_1Row {
    double norm;
    Vector3 C, D;
    double distance, d;
};

/** Newton's method of thesis Sec. 7.6, Eqn. 7.28 to 7.34 with dw = -J^-1 g (errata), from the surface point near
`start` and D = A + s0 e. Curvatures and steps on the surface are the core's. */
std::vector<Tab7_1Row> iterateTab7_1(const Ellipsoid& ellipsoid, const Vector3& A, const Vector3& B,
                                     const Vector3& start, double s0) {
    const Vector3 e = (B - A).normalized();
    SurfacePoint C = ellipsoid.findSurfacePoint(start);
    std::vector<Tab7_1Row> rows;
    for (int k = 0; k < 6; ++k) {
        const DarbouxFrame frame = ellipsoid.calcFrame(C, e);
        const Vector3 e1 = frame.t, e2 = -frame.B, D = A + s0 * e, r = D - C.p;  // e1 x e2 = N
        const Vector3 g(e.dot(r), e1.dot(r), e2.dot(r));
        const double d = frame.N.dot(r);
        rows.push_back({g.norm(), C.p, D, r.norm(), d});
        Matrix3 J;
        J << 1, -e.dot(e1), -e.dot(e2), e.dot(e1), frame.kappaN * d - 1, frame.tauG * d, e.dot(e2), frame.tauG * d,
            frame.kappaB * d - 1;
        const Vector3 step = -J.inverse() * g;
        s0 += step[0];
        C = ellipsoid.calcDisplacedPoint(C, step[1] * e1 + step[2] * e2);
    }
    return rows;
}

/** Every printed digit of Tab. 7.1. Its starting points are printed to two decimals; D is at s_0 = 5, and C turned out
to be the point to which Newton steps along the gradient (Eqn. 7.24) bring (2.5, 1.5, 1): found from the first two
norms, confirmed by all the others. */
TEST(SignedDistance, EllipsoidOfThesisTab7_1) {
    const Ellipsoid ellipsoid(Vector3(5, 3, 4));
    const Vector3 A(-10, 10, 0), B(10, 5, 3);
    const struct {
        Vector3 C, D;
        double norm, distance;
    } printed[] = {{{2.95, 2.22, 1.28}, {-5.20, 8.80, 0.72}, 13.980143866214055, 10.49},
                   {{1.00, 2.86, 0.91}, {1.87, 7.03, 1.78}, 0.367150387900821, 4.35},
                   {{1.67, 2.72, 1.02}, {2.57, 6.86, 1.89}, 0.009824863697499, 4.32},
                   {{1.65, 2.73, 1.02}, {2.56, 6.86, 1.88}, 0.000011270733715, 4.32},
                   {{1.65, 2.73, 1.02}, {2.56, 6.86, 1.88}, 0.000000000014995, 4.32},
                   {{1.65, 2.73, 1.02}, {2.56, 6.86, 1.88}, 0.0000000000000000, 4.32}};
    const std::vector<Tab7_1Row> rows = iterateTab7_1(ellipsoid, A, B, Vector3(2.5, 1.5, 1), 5);
    for (int k = 0; k < 6; ++k) {
        SCOPED_TRACE("row " + std::to_string(k + 1));
        EXPECT_NEAR(rows[k].norm, printed[k].norm, k < 2 ? 2e-14 : 5e-15);  // rounding of A, B, C of order ten
        EXPECT_LT((rows[k].C - printed[k].C).lpNorm<Eigen::Infinity>(), 5.1e-3);
        EXPECT_LT((rows[k].D - printed[k].D).lpNorm<Eigen::Infinity>(), 5.1e-3);
        EXPECT_NEAR(rows[k].distance, printed[k].distance, 5.1e-3);
    }
    EXPECT_NEAR(rows.back().d, 4.31960858834678, 5e-14);
    LineClearance clearance;
    findSegmentClearance(ellipsoid, Pose(), A, B, clearance);
    EXPECT_NEAR(clearance.distance, rows.back().d, 1e-12);
    EXPECT_LT((A + clearance.lineCoordinate * (B - A).normalized() - rows.back().D).norm(), 1e-9);
}

/** The same from the starting points as they are printed; expected norms: errata. */
TEST(SignedDistance, EllipsoidOfThesisTab7_1FromRoundedStart) {
    const Vector3 A(-10, 10, 0), B(10, 5, 3);
    const double norms[] = {13.97, 0.3653, 0.009780, 1.118e-5, 1.5e-11, 3e-16};
    const double tolerances[] = {5e-3, 5e-5, 5e-7, 5e-9, 5e-13, 1e-14};  // digits printed; rounding in the last
    const double s0 = (Vector3(-5.20, 8.80, 0.72) - A).dot((B - A).normalized());
    const std::vector<Tab7_1Row> rows = iterateTab7_1(Ellipsoid(Vector3(5, 3, 4)), A, B, Vector3(2.95, 2.22, 1.28), s0);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(rows[k].norm, norms[k], tolerances[k]) << "row " << k + 1;
}

TEST(SignedDistance, ClosedForms) {
    Random random(81);
    for (int i = 0; i < 50; ++i) {
        const Pose X = random.pose(5);
        const double phi = random.uniform(-kPi, kPi);
        const Vector3 A(3 * std::cos(phi), 3 * std::sin(phi), random.uniform(-1, 1));
        const Vector3 e = (random.vector(0.8) - A).normalized();  // towards the middle
        const Vector3 B = A + 6 * e;
        LineClearance sphere, cylinder;
        findSegmentClearance(Sphere(0.5), X, X * A, X * B, sphere);
        EXPECT_NEAR(sphere.distance, (A - A.dot(e) * e).norm() - 0.5, 1e-13);
        EXPECT_NEAR(sphere.lineCoordinate, -A.dot(e), 1e-13);  // 0.5 from the center at most
        findSegmentClearance(Cylinder(0.5), X, X * A, X * B, cylinder);
        const Vector3 common = e.cross(Vector3::UnitZ());
        const double s = -A.head<2>().dot(e.head<2>()) / e.head<2>().squaredNorm();
        ASSERT_TRUE(s > 0 && s < 6);
        EXPECT_NEAR(cylinder.distance, std::abs(A.dot(common.normalized())) - 0.5, 1e-12);
    }
}

TEST(SignedDistance, TorusSeenAlongItsTube) {
    // Lines parallel to the axis, beside and through the tube whose center is at (2, 0, 0).
    for (double x : {2.5, 2.301, 2.3, 2.299, 2.1, 1.6}) {
        LineClearance clearance;
        findSegmentClearance(Torus(2, 0.3), Pose(), Vector3(x, 0, -3), Vector3(x, 0, 3), clearance);
        EXPECT_NEAR(clearance.distance, std::abs(x - 2) - 0.3, 1e-12) << x;
        EXPECT_NEAR(clearance.lineCoordinate, 3, 1e-6) << x;
    }
}

TEST(SignedDistance, CriticalPointBeyondAnEndLeavesTheHeightOfThatEnd) {
    LineClearance clearance;
    findSegmentClearance(Sphere(1), Pose(), Vector3(2, 0.5, 0), Vector3(5, 0.5, 0), clearance);
    EXPECT_NEAR(clearance.distance, std::hypot(2, 0.5) - 1, 1e-14);
    EXPECT_EQ(clearance.lineCoordinate, 0);
}

constexpr double kTop = 0.5;  // of each shape below, in y

struct Sunk {
    const char* name;
    std::shared_ptr<const Surface> surface;
    Pose X;
};
std::vector<Sunk> makeSunk() {
    return {{"sphere", std::make_shared<Sphere>(kTop), Pose()},
            {"cylinder", std::make_shared<Cylinder>(kTop), Pose()},
            {"ellipsoid", std::make_shared<Ellipsoid>(Vector3(0.6, kTop, 0.9)), Pose()},
            {"parametric ellipsoid", std::make_shared<ParametricEllipsoid>(Vector3(0.6, kTop, 0.9)), Pose()},
            {"layer", std::make_shared<OffsetSurface>(std::make_shared<Ellipsoid>(Vector3(0.5, kTop - 0.1, 0.8)), 0.1),
             Pose()},
            {"torus", std::make_shared<Torus>(2, kTop), Pose(Vector3(0, -2, 0))}};
}

/** Clearance of a line along x at height y, a little beside the middle. */
void calcClearanceAt(const Sunk& sunk, double y, LineClearance& clearance) {
    findSegmentClearance(*sunk.surface, sunk.X, Vector3(-3, y, 0.1), Vector3(3, y, 0.1), clearance);
}

TEST(SignedDistance, LinePassingCleanThroughInOneStepReadsNegativeOnTheKeptSide) {
    for (const Sunk& sunk : makeSunk()) {
        LineClearance accepted;
        calcClearanceAt(sunk, kTop + 0.1, accepted);
        EXPECT_GT(accepted.distance, 0) << sunk.name;
        for (int k = 1; k <= 1000; ++k) {  // to anywhere down to just below the bottom
            LineClearance trial = accepted;
            const double y = kTop + 0.1 - 1.2 * k / 1000;
            calcClearanceAt(sunk, y, trial);
            if (y < kTop - 0.02) {  // 0.1 beside the middle the top is 0.01 lower
                EXPECT_LT(trial.distance, 0) << sunk.name << " at y = " << y;
            }
        }
    }
}

/** Clearance after sinking by some depth in `steps`, each continued from the one before. */
double sinkThrough(const Sunk& sunk, double depth, int steps) {
    LineClearance clearance;
    for (int k = 0; k <= steps; ++k) calcClearanceAt(sunk, kTop + 0.1 - depth * k / steps, clearance);
    return clearance.distance;
}

// Symptom (2026-11-22): on the sphere the normal that is kept turned with the line about the center, step by step,
// and read +0.108 once the line was through. Symptom (2026-11-25): +1.9 on an ellipsoid, beyond its centers of
// curvature.
TEST(SignedDistance, LinePassingCleanThroughInManyStepsReadsNegativeOnTheKeptSide) {
    for (const Sunk& sunk : makeSunk())
        for (const double depth : {1.2, 3.0, 10.0})  // the first just below the bottom
            for (const int steps : {1, 2, 3, 10, 1000})
                EXPECT_LT(sinkThrough(sunk, depth, steps), 0) << sunk.name << " by " << depth << " in " << steps;
}

// Symptom until 2026-11-27: a critical point of the watched side that lay beyond an end left the height of that end,
// and a string straight through an ellipsoid was solved.
TEST(SignedDistance, NoLineThroughABodyIsClearFromWhateverSideItIsWatched) {
    constexpr unsigned kSeed = 27;
    testing::SeededRandom random(kSeed);
    int through = 0, clear = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto axis = [&] { return random.uniform(0.2, 1.0); };
        const double a = axis(), b = axis(), c = axis();
        std::shared_ptr<const Surface> surface = std::make_shared<Ellipsoid>(Vector3(a, b, c));
        if (i % 3 == 1) surface = std::make_shared<Capsule>(a, b, c);
        if (i % 3 == 2) surface = std::make_shared<EllipticCylinder>(a, b);
        const Vector3 A = random.vector(1.5), B = random.vector(1.5);
        double least = kInfinity;
        for (int k = 0; k <= 200; ++k) least = std::min(least, surface->calcHeight(A + 0.005 * k * (B - A)));
        if (std::min(surface->calcHeight(A), surface->calcHeight(B)) < 0) continue;
        LineClearance clearance;
        clearance.keptC = surface->findSurfacePoint(random.vector(2));
        clearance.keptN = surface->calcFrame(clearance.keptC, Vector3(1, 2, 3)).N;
        findSegmentClearance(*surface, Pose(), A, B, clearance);
        if (least < -1e-4) {
            ++through;
            EXPECT_LT(clearance.distance, 0) << "seed " << kSeed << ", line " << i << ", height " << least;
        } else if (least > 1e-4 && clearance.distance > 0) {
            ++clear;
        }
    }
    EXPECT_GT(through, 2000);
    EXPECT_GT(clear, 2000);
}

// Symptom until 2026-11-28: along the axis of a capsule, watched from its tip, the clearance was the height over the
// tangent plane there, which the line crosses: 0, and a string straight through was solved.
TEST(SignedDistance, LinesAlongTheAxesOfABodyAreSunkFromWhateverSideTheyAreWatched) {
    const Shape shapes[] = {{"capsule", std::make_shared<Capsule>(0.3, 0.4, 0.5)},
                            {"ellipsoid", std::make_shared<Ellipsoid>(Vector3(0.3, 0.4, 0.5))},
                            {"sphere", std::make_shared<Sphere>(0.4)}};
    for (const Shape& shape : shapes)
        for (const double rounding : {0.0, 1e-17, 1e-14})
            for (int along = 0; along < 3; ++along)
                for (int watched = 0; watched < 6; ++watched) {
                    const Vector3 off = rounding * Vector3(1, 2, 3);
                    const Vector3 A = off - 2 * Vector3::Unit(along), B = off + 2 * Vector3::Unit(along);
                    LineClearance clearance;
                    clearance.keptN = (watched < 3 ? 1 : -1) * Vector3::Unit(watched % 3);
                    clearance.keptC = shape.surface->findSurfacePoint(2 * clearance.keptN);
                    findSegmentClearance(*shape.surface, Pose(), A, B, clearance);
                    EXPECT_LT(clearance.distance, -0.1)
                        << shape.name << " along " << along << ", watched from " << clearance.keptN.transpose();
                    EXPECT_GT(clearance.distance, -10) << shape.name << " along " << along;
                }
}

TEST(SignedDistance, NoDepthIsBeyondAllBoundsWhereTheGradientVanishes) {
    const Capsule capsule(0.3, 0.4, 0.5);
    for (const double aside : {0.0, 1e-300, 1e-17, 1e-9})
        for (const double z : {0.0, 0.1, 0.3, 0.69}) {
            Vector3 N;
            const double height = capsule.calcHeightAndNormal(Vector3(aside, 0, z), N);
            EXPECT_LT(height, 0);
            EXPECT_GE(height, -10 * capsule.getSize()) << aside << " from the axis at " << z;
            EXPECT_NEAR(N.norm(), 1, 1e-15);
        }
}

TEST(SignedDistance, TouchingLinesReadZero) {
    LineClearance clearance;
    findSegmentClearance(Sphere(0.5), Pose(), Vector3(-1, 0.5, 0), Vector3(1, 0.5, 0), clearance);
    EXPECT_NEAR(clearance.distance, 0, 1e-16);
    clearance = LineClearance();
    findSegmentClearance(Ellipsoid(Vector3(1, 0.5, 2)), Pose(), Vector3(-1, 0.5, 0), Vector3(1, 0.5, 0), clearance);
    EXPECT_NEAR(clearance.distance, 0, 1e-15);
    clearance = LineClearance();
    findSegmentClearance(Cylinder(0.5), Pose(), Vector3(0.5, 0, -1), Vector3(0.5, 0, 1), clearance);  // along the axis
    EXPECT_NEAR(clearance.distance, 0, 1e-16);
}

TEST(SignedDistance, DegenerateLinesStayFinite) {
    for (const Shape& shape : makeShapes())
        for (const Vector3& B : {Vector3(0, 0, 0), Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(3, 0, 0)})
            for (const Vector3& A : {Vector3(0, 0, 0), Vector3(0, 0, -1), Vector3(-1, 0, 0), Vector3(0, 5, 0)}) {
                LineClearance clearance;
                findSegmentClearance(*shape.surface, Pose(), A, B, clearance);
                EXPECT_TRUE(std::isfinite(clearance.distance))
                    << shape.name << " " << A.transpose() << " to " << B.transpose();
                EXPECT_TRUE(clearance.C.p.allFinite() && clearance.N.allFinite()) << shape.name;
            }
}

}  // namespace
}  // namespace tautline::testing
