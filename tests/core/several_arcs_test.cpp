// SPDX-License-Identifier: Apache-2.0
/** Strings that lie on one surface in several arcs: found cold and without a hint, and carried along motions in which
arcs split, join, come and go. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "paths/contacts/touching_arcs.h"
#include "paths/local/path_newton.h"
#include "support/path_scene.h"
#include "support/planar_hull.h"
#include "support/seeded_random.h"
#include "support/taut_polyline.h"
#include "tautline/paths/contact_witness.h"
#include "tautline/paths/path_explanation.h"
#include "tautline/paths/path_sensitivity.h"
#include "tautline/paths/path_tracker.h"
#include "tautline/paths/path_verification.h"
#include "tautline/surfaces/function_surface.h"
#include "tautline/surfaces/geodesic_events.h"

namespace tautline::testing {
namespace {

const Surface& getSurface(const PathScene& scene) {
    return *scene.problem.getElement(1).surface;
}

PathScene makeScene(std::shared_ptr<const Surface> surface, const Vector3& A, const Vector3& B,
                    const Pose& X = Pose()) {
    PathScene scene;
    scene.point(X * A).obstacle(std::move(surface), X).point(X * B);
    return scene;
}

/** A solved path's lengths, forces and rates fit together, whatever the number of its arcs. */
void expectConsistent(const PathScene& scene, const PathSolution& path) {
    ASSERT_EQ(path.status, PathStatus::Solved) << explainStatus(scene.problem, scene.pose, path);
    EXPECT_TRUE(verifyPath(scene.problem, scene.pose, path).isMinimum());
    expectDrawable(scene, path);
    SpatialForce sum;
    std::vector<SpatialForce> F;
    calcUnitForces(path, scene.pose, F);
    for (std::size_t e = 0; e < F.size(); ++e) {
        sum.force += F[e].force;
        sum.moment += F[e].moment + scene.pose.X_GE[e].p.cross(F[e].force);
    }
    EXPECT_LT(sum.force.norm() + sum.moment.norm(), 1e-12 * (1 + path.length));
}

/** Against a polyline of so many springs, and of twice as many: its error falls as their square. */
void expectLengthOfPolyline(const PathScene& scene, const Surface& surface, const PathSolution& path, int springs,
                            double tolerance) {
    std::vector<Vector3> course;
    calcDrawingPoints(path, scene.problem, scene.pose, 0.1, course);
    double length[2];
    for (const int i : {0, 1}) {
        TautPolyline polyline({{&surface, scene.pose.X_GE[1]}}, course, (i + 1) * springs);
        ASSERT_TRUE(polyline.relax(1e-8, 20000));
        length[i] = polyline.calcLength();
    }
    EXPECT_NEAR(path.length, length[1] + (length[1] - length[0]) / 3, tolerance * path.length);
}

// In the plane through the ring's axis the string lies over two circles: tangents, arcs and the line from top to top.
TEST(SeveralArcs, OverTheHoleOfARingAreTwoCirclesInAPlane) {
    constexpr double R = 0.1, a = 0.03;
    const auto ring = std::make_shared<Torus>(R, a);
    const Pose X(Eigen::AngleAxisd(0.7, Vector3(1, 2, -2).normalized()).toRotationMatrix(), Vector3(0.3, -0.2, 0.1));
    for (const double z : {0.002, 0.01, 0.02, 0.028}) {
        SCOPED_TRACE(z);
        const Vector3 A(-0.3, 0, z), B(0.35, 0, 0.7 * z);
        const PathScene scene = makeScene(ring, A, B, X);
        const PathSolution path = scene.solve();
        expectConsistent(scene, path);
        ASSERT_EQ(path.contacts[1].getNumArcs(), 2);
        // From a point at distance d from the center: tangent sqrt(d^2 - a^2), arc up to the top.
        const auto calcSide = [&](double along, double height) {
            const double d = std::hypot(along, height), tangent = std::sqrt(d * d - a * a);
            return tangent + a * (kPi / 2 - std::atan2(height, along) - std::acos(a / d));
        };
        const double expected = calcSide(0.3 - R, A.z()) + 2 * R + calcSide(0.35 - R, B.z());
        EXPECT_NEAR(path.length, expected, 1e-10 * expected);
    }
}

TEST(SeveralArcs, OverTheHoleOfARingHaveTheLengthOfAPolyline) {
    constexpr unsigned kSeed = 20261127;
    SCOPED_TRACE(kSeed);
    SeededRandom random(kSeed);
    int numTwice = 0;
    for (int i = 0; i < 5; ++i) {
        SCOPED_TRACE(i);
        const auto ring = std::make_shared<Torus>(0.1, random.uniform(0.01, 0.05));
        const double tube = ring->getTubeRadius();
        const Vector3 A(-0.3, random.uniform(-0.05, 0.05), random.uniform(-0.5, 0.9) * tube);
        const Vector3 B(0.3, random.uniform(-0.05, 0.05), random.uniform(-0.5, 0.9) * tube);
        const PathScene scene = makeScene(ring, A, B);
        const PathSolution path = scene.solve();
        expectConsistent(scene, path);
        if (path.contacts[1].getNumArcs() == 2) ++numTwice;
        expectLengthOfPolyline(scene, getSurface(scene), path, 700, 1e-7);
    }
    EXPECT_GT(numTwice, 2);
}

/** z = -c x^2 + b cos k x: hollows between ridges, the whole bent down. */
SheetCurve makeRidges(double b, double k, double c) {
    return {[=](double x) { return b * std::cos(k * x) - c * x * x; },
            [=](double x) { return -b * k * std::sin(k * x) - 2 * c * x; },
            [=](double x) { return -b * k * k * std::cos(k * x) - 2 * c; }};
}

std::shared_ptr<const Surface> makeSheet(bool isParametric, double b, double k, double c) {
    if (!isParametric)
        return std::make_shared<ImplicitFunctionSurface>(makeImplicitSurface(
            "ridges", 0.2, [=](auto x, auto /*y*/, auto z) { return z + c * x * x - b * cos(k * x); }));
    using std::cos;
    return std::make_shared<ParametricFunctionSurface>(
        makeParametricSurface("ridges", 0.2, ParameterDomain{{-3, -2}, {3, 2}}, [=](auto u, auto v) {
            return std::array<decltype(u), 3>{u, v, b * cos(k * u) - c * u * u};
        }));
}

// A corrugated sheet unrolls into a plane: Pythagoras over the hull of its section, cold and without a hint.
TEST(SeveralArcs, OverACorrugatedSheetAreTheHullOfItsSection) {
    constexpr double b = 0.05, k = 2 * kPi;
    for (const bool isParametric : {false, true})
        for (const double c : {0.004, 0.02, 0.06})
            for (const double across : {0.0, 0.6}) {
                SCOPED_TRACE(::testing::Message() << isParametric << " " << c << " " << across);
                const SheetCurve curve = makeRidges(b, k, c);
                const Vector2 A(-2.45, 0.02 - 6 * c), B(1.55, 0.01 - 2.4 * c);
                const PlanarHull hull(curve, A, B);
                const PathScene scene =
                    makeScene(makeSheet(isParametric, b, k, c), Vector3(A[0], 0, A[1]), Vector3(B[0], across, B[1]));
                const PathSolution path = scene.solve();
                expectConsistent(scene, path);
                ASSERT_EQ(path.contacts[1].getNumArcs(), static_cast<int>(hull.getArcs().size()));
                EXPECT_GE(path.contacts[1].getNumArcs(), 3);
                EXPECT_NEAR(path.length, hull.calcLength(across), 1e-10 * path.length);
                if (across != 0) continue;
                for (int i = 0; i < path.contacts[1].getNumArcs(); ++i) {
                    EXPECT_NEAR(path.contacts[1].getArc(i).geodesic.P.x.x(), hull.getArcs()[i].from, 1e-7);
                    EXPECT_NEAR(path.contacts[1].getArc(i).geodesic.Q.x.x(), hull.getArcs()[i].to, 1e-7);
                }
            }
}

// Over bodies with thin walls the lowest height of a line may be in a hollow, where no string rests: it begins on the
// hull.
TEST(SeveralArcs, BeginOnTheHullWhereALineIsWatchedInAHollow) {
    constexpr double b = 0.05, k = 2 * kPi, c = 0.02;
    const SheetCurve curve = makeRidges(b, k, c);
    const Vector2 A(-2.45, -0.15), B(1.55, -0.08);
    const PlanarHull hull(curve, A, B);
    const auto sheet = makeSheet(false, b, k, c);
    LineClearance clearance;
    clearance.C = sheet->findSurfacePoint(Vector3(-0.5, 0, curve.g(-0.5)));
    clearance.N = sheet->calcFrame(clearance.C, Vector3::UnitX()).N;
    clearance.distance = -0.05;
    const Vector3 A_S(A[0], 0, A[1]), B_S(B[0], 0, B[1]);
    std::vector<GeodesicStart> further;
    std::vector<GeodesicStart> arcs{calcTouchingArcs(*sheet, A_S, B_S, clearance, further)};
    arcs.insert(arcs.end(), further.begin(), further.end());
    ASSERT_EQ(arcs.size(), hull.getArcs().size());
    for (std::size_t i = 0; i < arcs.size(); ++i) {
        const double spacing = 4.0 / 96;
        EXPECT_NEAR(arcs[i].point.p.x(), hull.getArcs()[i].from, spacing);
        EXPECT_NEAR(arcs[i].point.p.x() + arcs[i].length, hull.getArcs()[i].to, 2 * spacing);
        EXPECT_GT(arcs[i].tangent.x(), 0.8);
    }
}

/** z = b cos kx cos ky - c x^2. */
std::shared_ptr<const Surface> makeEggCrate(bool isParametric, double b, double k, double c) {
    if (!isParametric)
        return std::make_shared<ImplicitFunctionSurface>(makeImplicitSurface(
            "egg crate", 0.2, [=](auto x, auto y, auto z) { return z + c * x * x - b * cos(k * x) * cos(k * y); }));
    using std::cos;
    return std::make_shared<ParametricFunctionSurface>(
        makeParametricSurface("egg crate", 0.2, ParameterDomain{{-4, -2}, {4, 2}}, [=](auto u, auto v) {
            return std::array<decltype(u), 3>{u, v, b * cos(k * u) * cos(k * v) - c * u * u};
        }));
}

TEST(SeveralArcs, OverAnEggCrateHaveTheLengthOfAPolyline) {
    constexpr double b = 0.05, k = 2 * kPi;
    constexpr double c = 0.02;
    const int ridges[][2] = {{0, 1}, {-1, 1}, {-1, 2}, {-2, 2}, {-2, 3}};  // between two hollows
    for (const auto& [first, last] : ridges) {
        SCOPED_TRACE(::testing::Message() << first << " " << last);
        const double from = first - 0.48, to = last + 0.53;
        double length[2];
        for (const bool isParametric : {false, true}) {
            const PathScene scene =
                makeScene(makeEggCrate(isParametric, b, k, c), Vector3(from, 0.01, 0.02 - c * from * from),
                          Vector3(to, 0.02, 0.015 - c * to * to));
            const PathSolution path = scene.solve();
            expectConsistent(scene, path);
            EXPECT_EQ(path.contacts[1].getNumArcs(), last - first + 1);
            length[isParametric] = path.length;
            if (!isParametric && last - first < 2) expectLengthOfPolyline(scene, getSurface(scene), path, 400, 1e-7);
        }
        EXPECT_NEAR(length[0], length[1], 1e-11 * length[0]);
    }
}

/** Two spheres of radius r about (+-d, 0, 0), blended: -s log(sum exp(-distance / s)). */
std::shared_ptr<const Surface> makePeanut(double r, double d, double s) {
    return std::make_shared<ImplicitFunctionSurface>(makeImplicitSurface("peanut", r, [=](auto x, auto y, auto z) {
        const auto across = y * y + z * z;
        const auto left = sqrt((x + d) * (x + d) + across) - r, right = sqrt((x - d) * (x - d) + across) - r;
        return -s * log(exp(-1 / s * left) + exp(-1 / s * right));
    }));
}

TEST(SeveralArcs, OverAPeanutHaveTheLengthOfAPolyline) {
    const auto peanut = makePeanut(0.1, 0.12, 0.02);
    for (const double z : {0.03, 0.08}) {
        SCOPED_TRACE(z);
        const PathScene scene = makeScene(peanut, Vector3(-0.4, 0.01, z - 0.02), Vector3(0.45, -0.02, z));
        const PathSolution path = scene.solve();
        expectConsistent(scene, path);
        EXPECT_EQ(path.contacts[1].getNumArcs(), 2);
        expectLengthOfPolyline(scene, getSurface(scene), path, 400, 1e-7);
    }
}

/** r = 1 + sum of Gaussians about random directions. */
struct BumpySphere {
    std::vector<Vector3> bumps;
    std::vector<double> heights, widths;

    explicit BumpySphere(SeededRandom& random) {
        constexpr int kBumps = 10;
        for (int i = 0; i < kBumps; ++i) {
            bumps.push_back((Vector3(0, 0, 1) + random.vector(0.9)).normalized());
            heights.push_back(random.uniform(0.03, 0.1));
            widths.push_back(random.uniform(0.12, 0.25));
        }
    }
    std::shared_ptr<const Surface> makeSurface() const {
        return std::make_shared<ImplicitFunctionSurface>(
            makeImplicitSurface("bumpy sphere", 1.0, [copy = *this](auto x, auto y, auto z) {
                const auto rho = sqrt(x * x + y * y + z * z);
                auto f = rho - 1;
                for (std::size_t i = 0; i < copy.bumps.size(); ++i) {
                    const Vector3& bump = copy.bumps[i];
                    const auto dx = x / rho - bump.x(), dy = y / rho - bump.y(), dz = z / rho - bump.z();
                    const double width = copy.widths[i];
                    f = f - copy.heights[i] * exp(-1 / (width * width) * (dx * dx + dy * dy + dz * dz));
                }
                return f;
            }));
    }
    /** By value and gradient alone, for the polyline: a tenth of the time. */
    ImplicitFunctionSurface makeCheapSurface() const {
        const auto calc = [copy = *this](const Vector3& p, Vector3& gradient) {
            const double rho = p.norm();
            const Vector3 direction = p / rho;
            double f = rho - 1;
            gradient = direction;
            for (std::size_t i = 0; i < copy.bumps.size(); ++i) {
                const Vector3& bump = copy.bumps[i];
                const double w2 = copy.widths[i] * copy.widths[i];
                const double rise = copy.heights[i] * std::exp(-(direction - bump).squaredNorm() / w2);
                f -= rise;
                gradient -= 2 * rise / (w2 * rho) * (bump - bump.dot(direction) * direction);
            }
            return f;
        };
        return {"bumpy sphere", 1.0,
                [calc](const Vector3& p) {
                    Vector3 gradient;
                    return calc(p, gradient);
                },
                [calc](const Vector3& p) {
                    Vector3 gradient;
                    calc(p, gradient);
                    return gradient;
                }};
    }
};

/** @return the largest number of arcs */
int solveOverBumpySpheres(unsigned seed, int count, int springs) {
    SCOPED_TRACE(seed);
    SeededRandom random(seed);
    int most = 0, solved = 0;
    for (int i = 0; i < count; ++i) {
        SCOPED_TRACE(i);
        const BumpySphere sphere(random);
        const double z = random.uniform(0.3, 0.9);
        const PathScene scene = makeScene(sphere.makeSurface(), Vector3(-1.6, random.uniform(-0.5, 0.5), z),
                                          Vector3(1.6, random.uniform(-0.5, 0.5), random.uniform(0.3, 0.9)));
        const PathSolution path = scene.solve();
        expectConsistent(scene, path);
        expectLengthOfPolyline(scene, sphere.makeCheapSurface(), path, springs, 1e-7);
        most = std::max(most, path.contacts[1].getNumArcs());
        solved += path.status == PathStatus::Solved;
    }
    std::printf("[measured] %d of %d solved, at most %d arcs\n", solved, count, most);
    return most;
}

TEST(SeveralArcs, OverABumpySphereHaveTheLengthOfAPolyline) {
    EXPECT_GE(solveOverBumpySpheres(20261127, 1, 300), 2);
}

TEST(LongSeveralArcs, OverBumpySpheresHaveTheLengthOfAPolyline) {
    EXPECT_GE(solveOverBumpySpheres(1, 40, 400), 3);
}

/** A string over a peanut that turns below it, about the vertical through its neck. */
struct StringOverTurningPeanut {
    PathProblem problem;
    PathTracker tracker;
    TrackedPath path;

    explicit StringOverTurningPeanut(double angle) {
        problem.addPoint("origin");
        problem.addObstacle("peanut", makePeanut(0.1, 0.06, 0.02));
        problem.addPoint("insertion");
        path = at(angle);
        tracker.solve(problem, path);
    }
    static TrackedPath at(double angle) {
        TrackedPath moved;
        moved.time = angle;
        moved.pose.X_GE = {Pose(Vector3(-0.3, 0.004, 0.085)),
                           Pose(Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix(), Vector3::Zero()),
                           Pose(Vector3(0.33, -0.003, 0.08))};
        return moved;
    }
    TrackedPath track(double angle) {
        TrackedPath moved = at(angle);
        tracker.track(problem, path, {}, moved);
        return moved;
    }
    double calcWitness(const TrackedPath& moved) const {
        return std::min(calcContactWitness(problem, moved.pose, moved.solution, 1),
                        calcSplitWitness(problem, path.solution, moved.solution, 1));
    }
    /** Between the angle of `path` and another one, if there is an event. */
    double bisect(double to) {
        double before = path.time, after = to;
        while (std::abs(after - before) > 1e-11) {
            const double middle = 0.5 * (before + after);
            (calcWitness(track(middle)) < 0 ? after : before) = middle;
        }
        return after;
    }
};

/** The largest normal curvature along the one arc that Newton's method leads to, over 1/size. */
double calcPressureOfOneArc(const StringOverTurningPeanut& string, double angle, const GeodesicStart& start) {
    const TrackedPath at = StringOverTurningPeanut::at(angle);
    PathSolution one;
    one.contacts.resize(3);
    one.contacts[1].isTouched = true;
    one.contacts[1].start = start;
    EXPECT_TRUE(PathNewton(PathSolverOptions()).iterate(string.problem, at.pose, one));
    const Surface& surface = *string.problem.getElement(1).surface;
    return calcLargestNormalCurvature(surface, one.contacts[1].start, one.contacts[1].geodesic) * surface.getSize();
}

/** What a string met on its way from across the neck to along it and back, so many times. */
struct TurningRun {
    std::vector<double> splits, joins;  ///< angles [rad]
    GeodesicStart lastOne;              ///< of the last path in one arc
};

void run(StringOverTurningPeanut& string, int times, int steps, TurningRun& run) {
    for (int i = 1; i <= times * steps; ++i) {
        const double angle = kPi / 2 * (1 - std::abs(std::sin(kPi * i / steps)));
        TrackedPath next = string.track(angle);
        for (int guard = 0; string.calcWitness(next) < 0 && guard < 5; ++guard) {
            TrackedPath atEvent = string.track(string.bisect(angle));
            const double length = atEvent.solution.length;
            const std::vector<PathEvent> events = string.tracker.resolveEvent(string.problem, string.path, atEvent);
            EXPECT_NEAR(atEvent.solution.length, length, 1e-14);
            // None where it is so near that rounding takes it back: it comes at once.
            ASSERT_LE(events.size(), 1u) << angle;
            for (const PathEvent& event : events) {
                if (event.kind == PathEvent::Kind::Split) run.splits.push_back(atEvent.time);
                if (event.kind == PathEvent::Kind::Joined) run.joins.push_back(atEvent.time);
            }
            string.path = atEvent;
            next = string.track(angle);
        }
        string.path = next;
        ASSERT_EQ(PathTracker::calcStatus(string.problem, next), PathStatus::Solved)
            << angle << " " << PathTracker::explainStatus(string.problem, next);
        TrackedPath cold = StringOverTurningPeanut::at(angle);
        PathTracker().solve(string.problem, cold);
        EXPECT_NEAR(cold.solution.length, next.solution.length, 1e-11) << angle;
        EXPECT_EQ(cold.solution.contacts[1].getNumArcs(), next.solution.contacts[1].getNumArcs()) << angle;
        if (next.solution.contacts[1].getNumArcs() == 1) run.lastOne = next.solution.contacts[1].start;
    }
}

/** By bisection between two angles a little apart about `near`. */
double findAngleWithoutPressure(const StringOverTurningPeanut& string, double near, const GeodesicStart& start) {
    double low = near - 1e-3, high = near + 1e-3;
    EXPECT_GT(calcPressureOfOneArc(string, low, start), 0);
    EXPECT_LT(calcPressureOfOneArc(string, high, start), 0);
    while (high - low > 1e-12) {
        const double middle = 0.5 * (low + high);
        (calcPressureOfOneArc(string, middle, start) < 0 ? high : low) = middle;
    }
    return high;
}

// Across the neck the string presses all along; turned by a quarter it bridges the neck. At the angle between, found by
// the tracker's events, the one arc's pressure vanishes; and it does on the way back.
TEST(SeveralArcs, SplitAndJoinWhereThePressureOfOneArcVanishes) {
    StringOverTurningPeanut string(kPi / 2);
    ASSERT_EQ(string.path.solution.contacts[1].getNumArcs(), 1);
    TurningRun turns;
    run(string, 1, 150, turns);
    ASSERT_EQ(turns.splits.size(), 1u);
    ASSERT_EQ(turns.joins.size(), 1u);
    const double angle = findAngleWithoutPressure(string, turns.splits[0], turns.lastOne);
    EXPECT_NEAR(turns.splits[0], angle, 1e-8);
    EXPECT_NEAR(turns.joins[0], angle, 1e-8);
}

TEST(LongSeveralArcs, SplitAndJoinTwoHundredTimesAtOneAngle) {
    StringOverTurningPeanut string(kPi / 2);
    TurningRun turns;
    run(string, 100, 37, turns);
    ASSERT_EQ(turns.splits.size(), 100u);
    ASSERT_EQ(turns.joins.size(), 100u);
    const double angle = findAngleWithoutPressure(string, turns.splits[0], turns.lastOne);
    for (const std::vector<double>& events : {turns.splits, turns.joins})
        for (const double event : events) EXPECT_NEAR(event, angle, 1e-8);
}

// With p the pressure's excess a bridge is as wide as sqrt(p), and saves p^3.5 of the length (arc_changes.h): three
// derivatives of the length go through.
TEST(SeveralArcs, ShortenThePathOfOneArcByThePowerSevenHalves) {
    StringOverTurningPeanut string(kPi / 2);
    TurningRun turns;
    run(string, 1, 150, turns);
    ASSERT_EQ(turns.splits.size(), 1u);
    const auto calcGain = [&](double beyond) {
        TrackedPath two = StringOverTurningPeanut::at(turns.splits[0] - beyond);
        string.tracker.solve(string.problem, two);
        EXPECT_EQ(two.solution.contacts[1].getNumArcs(), 2);
        PathSolution one;
        one.contacts.resize(3);
        one.contacts[1].isTouched = true;
        one.contacts[1].start = turns.lastOne;
        PathNewton newton{PathSolverOptions()};
        constexpr int kSteps = 20;
        for (int i = 0; i <= kSteps; ++i) {
            const TrackedPath at = StringOverTurningPeanut::at(turns.splits[0] - beyond * i / kSteps);
            EXPECT_TRUE(newton.iterate(string.problem, at.pose, one));
        }
        return one.length - two.solution.length;
    };
    const double coarse = calcGain(0.1), fine = calcGain(0.05), finest = calcGain(0.025);
    const double power = std::log2(fine / finest);
    EXPECT_NEAR(power, 3.5, 0.15);
    EXPECT_LT(std::abs(power - 3.5), std::abs(std::log2(coarse / fine) - 3.5));  // nearer the nearer it is
}

TEST(SeveralArcs, HaveTheRatesOfTheirDifferences) {
    const PathScene scene =
        makeScene(makePeanut(0.1, 0.12, 0.02), Vector3(-0.4, 0.01, 0.05), Vector3(0.45, -0.02, 0.07));
    PathSolution path = scene.solve();
    ASSERT_EQ(path.contacts[1].getNumArcs(), 2);
    constexpr unsigned kSeed = 9;
    SCOPED_TRACE(kSeed);
    SeededRandom random(kSeed);
    for (int i = 0; i < 10; ++i) {
        std::vector<SpatialVelocity> V(3);
        for (SpatialVelocity& v : V) v.v = random.vector(1), v.w = random.vector(1);
        PathSensitivity sensitivity;
        PathVariation variation;
        sensitivity.setPath(scene.problem, scene.pose, path);
        ASSERT_TRUE(sensitivity.calcVariation(V, variation));
        constexpr double h = 1e-6;
        PathSolution at[2];
        std::vector<SpatialForce> F[2];
        for (const int side : {0, 1}) {
            PathPose moved = scene.pose;
            const double dt = side == 0 ? -h : h;
            for (std::size_t e = 0; e < moved.X_GE.size(); ++e) {
                const double angle = V[e].w.norm() * dt;
                moved.X_GE[e].R = Eigen::AngleAxisd(angle, V[e].w.normalized()).toRotationMatrix() * moved.X_GE[e].R;
                moved.X_GE[e].p += dt * V[e].v;
            }
            at[side] = path;
            PathSolver().solveKeepingContacts(scene.problem, moved, at[side]);
            ASSERT_EQ(at[side].contacts[1].getNumArcs(), 2);
            calcUnitForces(at[side], moved, F[side]);
        }
        EXPECT_NEAR(variation.lengthRate, (at[1].length - at[0].length) / (2 * h), 1e-8);
        EXPECT_NEAR(calcLengthRate(path, scene.pose, V), variation.lengthRate, 1e-12);
        for (std::size_t e = 0; e < 3; ++e) {
            EXPECT_LT((variation.forceRate[e].force - (F[1][e].force - F[0][e].force) / (2 * h)).norm(), 1e-6);
            EXPECT_LT((variation.forceRate[e].moment - (F[1][e].moment - F[0][e].moment) / (2 * h)).norm(), 1e-6);
        }
        // Predicted ahead, a step begins with an error of second order.
        PathSolution ahead = path;
        ASSERT_TRUE(sensitivity.predictStarts(V, h, ahead));
        for (int arc = 0; arc < 2; ++arc)
            EXPECT_LT(
                (ahead.contacts[1].getArc(arc).start.point.p - at[1].contacts[1].getArc(arc).start.point.p).norm(),
                1e-9);
    }
}

}  // namespace
}  // namespace tautline::testing
