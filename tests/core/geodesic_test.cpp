// SPDX-License-Identifier: Apache-2.0
/** Geodesics: closed forms against the integrator, laws that hold on any surface, reference tables. */
#include <gtest/gtest.h>

#include <fstream>

#include "support/shapes.h"
#include "tautline/error.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/torus.h"

namespace tautline::testing {
namespace {

/** Largest difference of two geodesics' ends, lengths in units of `size`. */
double calcDifference(const ShotGeodesic& a, const ShotGeodesic& b, double size) {
    return std::max({(a.Q.x - b.Q.x).norm() / size, (a.Q.t - b.Q.t).norm(), (a.Q.N - b.Q.N).norm(),
                     (a.Q.B - b.Q.B).norm(), std::abs(a.a - b.a), std::abs(a.aDot - b.aDot) * size,
                     std::abs(a.r - b.r) / size, std::abs(a.rDot - b.rDot)});
}

/** How much an error at the start can have grown at the end: the size of the Jacobi fields. */
double calcGrowth(const ShotGeodesic& g, double size) {
    return 1 + std::abs(g.a) + std::abs(g.aDot) * size + std::abs(g.r) / size + std::abs(g.rDot);
}

// Closed form against integrator. Six turns at 0.4 rad a step are about 100 steps of accuracy 1e-13, each
// of whose errors grows with the arc left: 1e-10 with room to spare.
template <class ClosedForm>
void compareWithIntegrator(const ClosedForm& shape, double extent) {
    Random random(31);
    const Shape named{"", std::make_shared<ClosedForm>(shape), extent};
    for (int i = 0; i < 20; ++i) {
        GeodesicStart start = makeRandomStart(named, random);
        for (double turns : {0.0, 1e-9, -1e-9, 0.1, -0.4, 1.0, 6.0, -6.0}) {
            start.length = 2 * kPi * turns * shape.getSize();
            SCOPED_TRACE(start.length);
            ShotGeodesic closed, integrated;
            shape.shootGeodesic(start, {}, closed);
            shape.shootByIntegration(start, {1e-13, 2000}, integrated);
            EXPECT_TRUE(integrated.converged);
            EXPECT_LT(calcDifference(closed, integrated, shape.getSize()), 1e-10);
            EXPECT_NEAR(closed.Q.kappaN, integrated.Q.kappaN, 1e-10 / shape.getSize());
            EXPECT_NEAR(closed.Q.tauG, integrated.Q.tauG, 1e-10 / shape.getSize());
            EXPECT_NEAR(closed.Q.kappaB, integrated.Q.kappaB, 1e-10 / shape.getSize());
            EXPECT_EQ(closed.hasConjugatePoint, integrated.hasConjugatePoint);
        }
    }
}

TEST(GeodesicClosedForm, SphereEqualsIntegrator) {
    compareWithIntegrator(Sphere(0.7), 0.8);
}
TEST(GeodesicClosedForm, CylinderEqualsIntegrator) {
    compareWithIntegrator(Cylinder(0.35), 0.5);
}

TEST(GeodesicClosedForm, HelixOfThesisFig3_7) {  // Eqn. 3.68 on Eqn. 3.67, radius 1
    const double u = -1.0, v = 0.5, du = 0.82, dv = 0.57, length = 2.5, speed = std::hypot(du, dv);
    EXPECT_NEAR(speed, 1, 2e-3);  // the two digits printed are of unit speed
    const GeodesicStart start{{{std::cos(u), std::sin(u), v}}, {-std::sin(u) * du, std::cos(u) * du, dv}, length};
    ShotGeodesic helix;
    Cylinder(1).shootGeodesic(start, {}, helix);
    const double uEnd = u + du / speed * length;
    EXPECT_LT((helix.Q.x - Vector3(std::cos(uEnd), std::sin(uEnd), v + dv / speed * length)).norm(), 1e-15);
    EXPECT_LT((helix.Q.N - Vector3(std::cos(uEnd), std::sin(uEnd), 0)).norm(), 1e-15);
    EXPECT_NEAR(helix.Q.kappaN, -du * du / (speed * speed), 1e-15);
    EXPECT_NEAR(helix.r, length, 1e-15);  // K = 0
}

TEST(GeodesicClosedForm, ConjugatePointOfSphereIsFlaggedBeyondHalfATurnAndNotBefore) {
    const double radius = 0.7;
    const Sphere sphere(radius);
    GeodesicStart start{{Vector3(0, 0, radius)}, Vector3(1, 0, 0), 0};
    for (double accuracy : {1e-3, 1e-9, 1e-12}) {
        // Wide enough for the error of r at the loosest accuracy, and two whole turns where r is positive again.
        for (double turns : {0.49, 0.51, -0.49, -0.51, 1.2, -1.2}) {
            SCOPED_TRACE(turns);
            start.length = 2 * kPi * radius * turns;
            ShotGeodesic closed, integrated;
            sphere.shootGeodesic(start, {}, closed);
            sphere.shootByIntegration(start, {accuracy, 2000}, integrated);
            EXPECT_EQ(closed.hasConjugatePoint, std::abs(turns) > 0.5);
            EXPECT_EQ(integrated.hasConjugatePoint, std::abs(turns) > 0.5);
        }
    }
}

class GeodesicLaws : public ::testing::TestWithParam<Shape> {
protected:
    const Surface& surface() const { return *GetParam().surface; }
    double size() const { return surface().getSize(); }

    /** Runs `check(start, length)` on random starts and on lengths from rounding to several turns. */
    template <class Check>
    void forRandomGeodesics(unsigned seed, const Check& check) {
        Random random(seed);
        for (int i = 0; i < 8; ++i) {
            const GeodesicStart start = makeRandomStart(GetParam(), random);
            for (double length : {0.0, 1e-12, -1e-8, 1e-3, 0.3, -0.7, 2.0, -4.0, 9.0}) {
                SCOPED_TRACE(length);
                check(start, length * size());
            }
        }
    }
};

// Accuracy 1e-12 per step and at most some dozens of steps; what a step leaves grows like the Jacobi fields.
constexpr double kLawTolerance = 1e-10;

TEST_P(GeodesicLaws, ReversalSwapsEnds) {
    forRandomGeodesics(1, [&](const GeodesicStart& start, double length) {
        const ShotGeodesic there = shoot(surface(), start, length);
        const ShotGeodesic back = shoot(surface(), {there.endPoint, -there.Q.t, 0}, length);
        const double tolerance = kLawTolerance * calcGrowth(there, size());
        EXPECT_LT((back.Q.x - there.P.x).norm() / size(), tolerance);
        EXPECT_LT((back.Q.t + there.P.t).norm(), tolerance);
        // The fields from Q are those of the inverse of [a r; a' r'], seen from the other end.
        EXPECT_NEAR(back.r / size(), there.r / size(), tolerance);
        EXPECT_NEAR(back.a, there.rDot, tolerance);
        EXPECT_NEAR(back.rDot, there.a, tolerance);
        EXPECT_NEAR(back.aDot * size(), there.aDot * size(), tolerance);
    });
}

TEST_P(GeodesicLaws, NegativeLengthIsTheOppositeDirection) {
    forRandomGeodesics(2, [&](const GeodesicStart& start, double length) {
        const ShotGeodesic forward = shoot(surface(), {start.point, -start.tangent, 0}, -length);
        const ShotGeodesic backward = shoot(surface(), start, length);
        EXPECT_LT((forward.Q.x - backward.Q.x).norm(), 1e-13 * size());  // same steps, same rounding but for signs
        EXPECT_LT((forward.Q.t + backward.Q.t).norm(), 1e-13);
        EXPECT_NEAR(forward.r, -backward.r, 1e-13 * size());
    });
}

TEST_P(GeodesicLaws, LengthIsAdditive) {
    forRandomGeodesics(3, [&](const GeodesicStart& start, double length) {
        const ShotGeodesic whole = shoot(surface(), start, length), first = shoot(surface(), start, 0.37 * length);
        const ShotGeodesic second = shoot(surface(), {first.endPoint, first.Q.t, 0}, 0.63 * length);
        const double tolerance = kLawTolerance * calcGrowth(whole, size());
        EXPECT_LT((second.Q.x - whole.Q.x).norm() / size(), tolerance);
        EXPECT_LT((second.Q.t - whole.Q.t).norm(), tolerance);
        // Fundamental matrices multiply.
        EXPECT_NEAR(second.a * first.a + second.r * first.aDot, whole.a, tolerance);
        EXPECT_NEAR((second.a * first.r + second.r * first.rDot) / size(), whole.r / size(), tolerance);
    });
}

TEST_P(GeodesicLaws, UnitSpeed) {
    forRandomGeodesics(4, [&](const GeodesicStart& start, double length) {
        const double h = 1e-5 * size();  // the chord of 2h is shorter than its arc by h^3 kappa^2/3 at most
        const ShotGeodesic before = shoot(surface(), start, length - h), after = shoot(surface(), start, length + h);
        const double kappa = std::abs(after.Q.kappaN) + 1 / size();
        // Two shots may take different steps: what these leave is divided by 2h.
        const double tolerance = h * h * kappa * kappa + 1e-11 * calcGrowth(after, size()) * size() / h;
        EXPECT_NEAR((after.Q.x - before.Q.x).norm() / (2 * h), 1, tolerance);
        EXPECT_LT(((after.Q.x - before.Q.x).normalized() - shoot(surface(), start, length).Q.t).norm(), 2 * tolerance);
    });
}

TEST_P(GeodesicLaws, EndsLieOnTheSurfaceWithOrthonormalFrames) {
    forRandomGeodesics(5, [&](const GeodesicStart& start, double length) {
        const ShotGeodesic g = shoot(surface(), start, length);
        for (const DarbouxFrame* frame : {&g.P, &g.Q}) {
            Vector3 N;
            EXPECT_LT(std::abs(surface().calcHeightAndNormal(frame->x, N)), 1e-14 * GetParam().extent);
            EXPECT_LT((frame->N - N).norm(), 1e-13);
            Matrix3 R;
            R << frame->t, frame->N, frame->B;
            EXPECT_LT((R.transpose() * R - Matrix3::Identity()).norm(), 1e-14);
            EXPECT_LT((frame->t.cross(frame->N) - frame->B).norm(), 1e-14);
        }
        EXPECT_TRUE(g.converged);
        EXPECT_EQ(g.length, length);
    });
}

TEST_P(GeodesicLaws, JacobiFieldsHaveUnitWronskian) {
    forRandomGeodesics(6, [&](const GeodesicStart& start, double length) {
        const ShotGeodesic g = shoot(surface(), start, length);
        const double growth = calcGrowth(g, size());  // a product of two fields is lost in part
        EXPECT_NEAR(g.a * g.rDot - g.aDot * g.r, 1, 1e-11 * growth * growth);
    });
}

/** Scaled by 1000 the numbers are the same but for rounding; by 1024, where nothing is rounded anew, step for step. */
TEST_P(GeodesicLaws, MillimetersGiveTheAnswerOfMeters) {
    for (const double scale : {1000.0, 1024.0}) {
        const std::vector<Shape> meters = makeShapes(), millimeters = makeShapes(scale);
        std::size_t k = 0;
        while (meters[k].name != GetParam().name) ++k;
        forRandomGeodesics(7, [&](const GeodesicStart& start, double length) {
            const ShotGeodesic small = shoot(surface(), start, length);
            const GeodesicStart scaled{{Vector3(scale * start.point.p)}, start.tangent, 0};
            const ShotGeodesic large = shoot(*millimeters[k].surface, scaled, scale * length);
            const double tolerance = scale == 1024 ? 1e-15 : 1e-12 * calcGrowth(small, size());
            EXPECT_LE((large.Q.x / scale - small.Q.x).norm() / size(), tolerance);
            EXPECT_LE((large.Q.t - small.Q.t).norm(), tolerance);
            EXPECT_NEAR(large.a, small.a, tolerance);
            EXPECT_NEAR(large.r / scale / size(), small.r / size(), tolerance);
            EXPECT_NEAR(large.Q.kappaN * scale * size(), small.Q.kappaN * size(), tolerance);
            if (scale == 1024) {
                EXPECT_EQ(large.steps, small.steps);
            }
        });
    }
}

TEST_P(GeodesicLaws, IntegrationWithoutConstraintsEndsAtTheSamePoint) {
    // Plain Runge-Kutta of order 4 on p'' = kappaN N (Eqn. 7.19), never projected. 4000 steps of size/1000
    // leave about 1e-12 in sizes, grown by the Jacobi fields.
    Random random(8);
    for (int i = 0; i < 4; ++i) {
        const GeodesicStart start = makeRandomStart(GetParam(), random);
        const double length = (i % 2 ? -4 : 4) * size();
        const auto slope = [&](const Eigen::Matrix<double, 6, 1>& y) {
            const DarbouxFrame frame = surface().calcFrame({Vector3(y.head<3>())}, y.tail<3>());
            Eigen::Matrix<double, 6, 1> dy;
            dy << y.tail<3>(), frame.kappaN * frame.N;
            return dy;
        };
        Eigen::Matrix<double, 6, 1> y;
        y << start.point.p, start.tangent;
        constexpr int kSteps = 4000;
        const double h = length / kSteps;
        for (int step = 0; step < kSteps; ++step) {
            const Eigen::Matrix<double, 6, 1> k1 = slope(y), k2 = slope(y + h / 2 * k1), k3 = slope(y + h / 2 * k2),
                                              k4 = slope(y + h * k3);
            y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        const ShotGeodesic g = shoot(surface(), start, length);
        const double tolerance = 1e-10 * calcGrowth(g, size());
        EXPECT_LT((g.Q.x - y.head<3>()).norm() / size(), tolerance);
        EXPECT_LT((g.Q.t - y.tail<3>()).norm(), tolerance);
    }
}

TEST_P(GeodesicLaws, SamplesLieOnTheGeodesicAtEqualArcs) {
    Random random(9);
    GeodesicStart start = makeRandomStart(GetParam(), random);
    start.length = 3 * size();
    std::vector<Vector3> points;
    sampleGeodesic(surface(), start, {}, 7, points);
    ASSERT_EQ(points.size(), 7u);
    for (int i = 0; i < 7; ++i) {
        const ShotGeodesic g = shoot(surface(), start, i * start.length / 6);
        EXPECT_LT((points[i] - g.Q.x).norm(), kLawTolerance * size() * calcGrowth(g, size())) << i;
    }
    EXPECT_THROW(sampleGeodesic(surface(), start, {}, 1, points), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(AllShapes, GeodesicLaws, ::testing::ValuesIn(makeShapes()), getShapeName);

/** One line of tests/data/geodesics.txt, which says who wrote it. */
struct Reference {
    std::string kind;
    Vector3 dimensions, P, t, Q, tQ;
    double length, a, aDot, r, rDot;

    std::shared_ptr<const Surface> makeSurface() const {
        if (kind == "torus") return std::make_shared<Torus>(dimensions[0], dimensions[1]);
        return std::make_shared<Ellipsoid>(dimensions);
    }
    std::shared_ptr<const Surface> makeParametricSurface() const {
        if (kind == "torus") return std::make_shared<ParametricTorus>(dimensions[0], dimensions[1]);
        return std::make_shared<ParametricEllipsoid>(dimensions);
    }
    /** Largest error of a geodesic shot from P, relative to its growth; lengths in units of the extent. */
    double calcError(const ShotGeodesic& g) const {
        const double extent = dimensions.maxCoeff();
        ShotGeodesic truth = g;
        truth.Q.x = Q, truth.Q.t = tQ, truth.a = a, truth.aDot = aDot, truth.r = r, truth.rDot = rDot;
        return calcDifference(g, truth, extent) / calcGrowth(truth, extent);
    }
};

std::istream& operator>>(std::istream& in, Vector3& v) {
    return in >> v[0] >> v[1] >> v[2];
}

std::vector<Reference> readReferences() {
    std::ifstream file(TAUTLINE_SOURCE_DIR "/tests/data/geodesics.txt");
    std::vector<Reference> references;
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        Reference ref;
        words >> ref.kind >> ref.dimensions >> ref.P >> ref.t >> ref.length >> ref.Q >> ref.tQ >> ref.a >> ref.aDot >>
            ref.r >> ref.rDot;
        if (!words) ADD_FAILURE() << "geodesics.txt: cannot read " << line;
        references.push_back(ref);
    }
    return references;
}

TEST(GeodesicReference, TableIsMetInBothDirections) {
    const std::vector<Reference> references = readReferences();
    ASSERT_GE(references.size(), 12u);
    for (const Reference& ref : references)
        for (const auto& surface : {ref.makeSurface(), ref.makeParametricSurface()}) {
            SCOPED_TRACE(surface->getDescription() + " length " + std::to_string(ref.length));
            // Local error 1e-15 per step: rounding rules, a few ulp for each of up to some hundred steps.
            const ShootingOptions finest{1e-15, 5000};
            const auto start = [&](const Vector3& p, const Vector3& t) {
                return GeodesicStart{surface->findSurfacePoint(p), t, 0};
            };
            const ShotGeodesic there = shoot(*surface, start(ref.P, ref.t), ref.length, finest);
            EXPECT_LT(ref.calcError(there), 1e-13);
            Reference reversed = ref;
            reversed.Q = ref.P, reversed.tQ = ref.t;
            reversed.a = ref.rDot, reversed.aDot = -ref.aDot, reversed.r = -ref.r, reversed.rDot = ref.a;
            const ShotGeodesic back = shoot(*surface, start(ref.Q, ref.tQ), -ref.length, finest);
            EXPECT_LT(reversed.calcError(back), 1e-13);
        }
}

TEST(GeodesicReference, AccuracyControlsTheError) {
    for (const Reference& ref : readReferences()) {
        const auto surface = ref.makeSurface();
        SCOPED_TRACE(surface->getDescription() + " length " + std::to_string(ref.length));
        double loosest = 0, tightest = 0;
        int steps = 0;
        for (double accuracy : {1e-3, 1e-6, 1e-9, 1e-12}) {
            const ShotGeodesic g = shoot(*surface, {{ref.P}, ref.t, 0}, ref.length, {accuracy, 5000});
            // Local errors add up over the steps; the growth of each is in calcError already.
            EXPECT_LT(ref.calcError(g), 10 * accuracy * g.steps);
            if (accuracy < 1e-3) {  // where it takes a pair of lower order, whose steps are more and cheaper
                EXPECT_GE(g.steps, steps);
                steps = g.steps;
            }
            (accuracy == 1e-3 ? loosest : tightest) = ref.calcError(g);
        }
        EXPECT_LT(tightest, 1e-3 * loosest);
    }
}

/** A unit sphere that counts its evaluations. */
class CountingSphere final : public ImplicitShape<CountingSphere> {
public:
    ImplicitValue calcImplicit(const Vector3& p) const {
        ++m_count;
        return {(p.squaredNorm() - 1) / 2, p, Matrix3::Identity()};
    }
    double getSize() const override { return 1; }
    std::string getDescription() const override { return "counting sphere"; }
    int getCount() const { return m_count; }

private:
    mutable int m_count = 0;
};

TEST(GeodesicDegenerate, NotANumberEndsWithinTheAllowedSteps) {
    const ShootingOptions options{1e-9, 100};
    const Vector3 nan = Vector3::Constant(kNaN), p(1, 0, 0), t(0, 1, 0);
    const GeodesicStart starts[] = {{{nan}, t, 1}, {{p}, nan, 1}, {{p}, t, kNaN}, {{p}, t, kInfinity}};
    for (const GeodesicStart& start : starts) {
        const CountingSphere sphere;
        ShotGeodesic g;
        sphere.shootGeodesic(start, options, g);
        EXPECT_FALSE(g.converged);
        EXPECT_LE(sphere.getCount(), 15 * options.maxSteps);  // 12 stages, the projection and the watch
    }
    for (const Shape& shape : makeShapes()) shoot(*shape.surface, starts[0], 1);  // ends
}

TEST(GeodesicDegenerate, TooFewStepsAreReported) {
    ShotGeodesic g;
    Ellipsoid(Vector3(1, 2, 3)).shootGeodesic({{Vector3(1, 0, 0)}, Vector3(0, 1, 1), 50}, {1e-12, 5}, g);
    EXPECT_FALSE(g.converged);
    EXPECT_TRUE(g.Q.x.allFinite());
}

TEST(GeodesicDegenerate, StartBesideTheSurfaceWithSkewTangentIsMadeUnit) {
    const Ellipsoid ellipsoid(Vector3(1, 2, 3));
    const ShotGeodesic g = shoot(ellipsoid, {{Vector3(1, 0, 0)}, Vector3(5, 3, 4), 0}, 0.5);
    EXPECT_LT((g.P.t - Vector3(0, 0.6, 0.8)).norm(), 1e-15);
    EXPECT_LT((g.Q.x - shoot(ellipsoid, {{Vector3(1, 0, 0)}, Vector3(0, 0.6, 0.8), 0}, 0.5).Q.x).norm(), 1e-15);
}

}  // namespace
}  // namespace tautline::testing
