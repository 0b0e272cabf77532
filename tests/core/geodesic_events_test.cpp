// SPDX-License-Identifier: Apache-2.0
/** Conjugate points, changes of pressure and exits from the domain along geodesics, against closed forms. */
#include "tautline/surfaces/geodesic_events.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/surface_cases.h"

namespace tautline {
namespace {

constexpr double kClose = 1e-11;  // in sizes: geodesics of accuracy 1e-12 and the rounding of a root

GeodesicStart makeStart(const Surface& surface, const Vector3& p, const Vector3& direction, double length) {
    const SurfacePoint point = surface.findSurfacePoint(p);
    return {point, surface.calcFrame(point, direction).t, length};
}

/** Arc length of the first conjugate point, infinite if there is none. */
double calcConjugate(const Surface& surface, const Vector3& p, const Vector3& direction, double length) {
    const auto place = findConjugatePoint(surface, makeStart(surface, p, direction, length));
    return place ? place->s : kInfinity;
}

TEST(ConjugatePoint, OfASphereIsHalfWayRoundInEitherDirectionAndForm) {
    for (const double radius : {0.7, 700.0}) {
        const Sphere sphere(radius);
        const ParametricSphere parametric(radius);
        for (const Surface* surface :
             {static_cast<const Surface*>(&sphere), static_cast<const Surface*>(&parametric)}) {
            const Vector3 p(radius, 0, 0), t(0, 0.6, 0.8);
            EXPECT_NEAR(calcConjugate(*surface, p, t, 10 * radius), kPi * radius, kClose * radius);
            EXPECT_NEAR(calcConjugate(*surface, p, t, -10 * radius), -kPi * radius, kClose * radius);
            EXPECT_EQ(calcConjugate(*surface, p, t, 3.14 * radius), kInfinity);
            const auto place = findConjugatePoint(*surface, makeStart(*surface, p, t, 4 * radius));
            EXPECT_LT((place->point.p + p).norm(), kClose * radius);  // the antipode
        }
    }
}

TEST(ConjugatePoint, IsWhereTheConstantCurvatureOfAnEquatorPutsIt) {
    // y'' + K y = 0 with K constant along the circle: pi/sqrt(K).
    const double a = 1.3, c = 0.4;  // spheroid: K = 1/c^2 on the equator
    EXPECT_NEAR(calcConjugate(Ellipsoid(Vector3(a, a, c)), Vector3(a, 0, 0), Vector3(0, 1, 0), 5), kPi * c, kClose * a);
    EXPECT_NEAR(calcConjugate(ParametricEllipsoid(Vector3(a, a, c)), Vector3(a, 0, 0), Vector3(0, 1, 0), 5), kPi * c,
                kClose * a);
    const double R = 3, r = 1;  // torus: K = 1/(r (R + r)) on the outer equator, negative on the inner one
    EXPECT_NEAR(calcConjugate(Torus(R, r), Vector3(R + r, 0, 0), Vector3(0, 1, 0), 20), kPi * std::sqrt(r * (R + r)),
                kClose);
    EXPECT_EQ(calcConjugate(Torus(R, r), Vector3(R - r, 0, 0), Vector3(0, 1, 0), 8), kInfinity);
}

TEST(ConjugatePoint, DoesNotExistOnDevelopableSurfaces) {
    EXPECT_EQ(calcConjugate(Cylinder(0.3), Vector3(0.3, 0, 0), Vector3(0, 1, 0.1), 30), kInfinity);
    EXPECT_EQ(calcConjugate(HalfSpace(1), Vector3(0.3, 0, 0), Vector3(0, 1, 0), 30), kInfinity);
    EXPECT_EQ(calcConjugate(Cone(0.4, 0.3), Vector3(0.3, 0, 1), Vector3(0, 1, 0), 3), kInfinity);
    EXPECT_EQ(calcConjugate(EllipticCylinder(0.3, 0.1), Vector3(0.3, 0, 0), Vector3(0, 1, 0.2), 10), kInfinity);
}

TEST(ConjugatePoint, AgreesWithTheFlagAndWithTheFieldOnEverySurface) {
    int found = 0;
    for (const testing::SurfaceCase& c : testing::makeSurfaceCases()) {
        SCOPED_TRACE(c.name);
        const Surface& surface = *c.surface;
        for (const SurfaceLawSample& sample : testing::makeSamples(surface, c.extent, c.center, c.length, {}, 6, 7)) {
            const GeodesicStart start = makeStart(surface, sample.p_S, sample.direction_S, 3 * sample.length);
            ShotGeodesic arc;
            surface.shootGeodesic(start, {}, arc);
            const auto place = findConjugatePoint(surface, start);
            EXPECT_EQ(place.has_value(), arc.hasConjugatePoint);
            if (!place) continue;
            ++found;
            surface.shootGeodesic({start.point, start.tangent, place->s}, {}, arc);
            const double growth = 1 + std::abs(arc.a) + std::abs(arc.rDot) + std::abs(arc.aDot) * surface.getSize();
            EXPECT_LT(std::abs(arc.r), 1e-9 * growth * surface.getSize());
            EXPECT_LT((arc.Q.x - place->point.p).norm(), 1e-9 * growth * surface.getSize());
        }
    }
    EXPECT_GE(found, 20);
}

/** On a torus with Clairaut's constant c = rho^2 u' kappaN = -(1 - R c^2/rho^3)/r: it vanishes where rho^3 = R c^2. */
TEST(PressureChanges, OnATorusAreWhereClairautPutsThem) {
    for (const double scale : {1.0, 1000.0}) {
        const double R = 3 * scale, r = scale;
        const Torus torus(R, r);
        const ParametricTorus parametric(R, r);
        const Vector3 p(R + r, 0, 0), t = Vector3(0, 0.7, std::sqrt(1 - 0.49));  // over the top and back where rho = c
        const double c = 0.7 * (R + r), rho = std::cbrt(R * c * c);
        ASSERT_GT(rho, R - r);
        for (const Surface* surface : {static_cast<const Surface*>(&torus), static_cast<const Surface*>(&parametric)}) {
            for (const double length : {6 * scale, -6 * scale}) {
                const auto places = findPressureChanges(*surface, makeStart(*surface, p, t, length));
                ASSERT_EQ(places.size(), 2u);  // to the inner side and back
                double before = 0;
                for (const GeodesicPlace& place : places) {
                    EXPECT_NEAR(place.point.p.head<2>().norm(), rho, kClose * scale);
                    EXPECT_GT(place.s / length, before);
                    before = place.s / length;
                    ShotGeodesic arc;
                    surface->shootGeodesic({makeStart(*surface, p, t, 0).point, t, place.s}, {}, arc);
                    EXPECT_NEAR(arc.Q.kappaN * scale, 0, kClose);
                }
            }
        }
    }
}

/** The same where kappaN hardly rises above 0 at the innermost point: two changes closer than the walk's pieces. */
TEST(PressureChanges, AreFoundInPairsCloserThanTheSamples) {
    const double R = 3, r = 1;
    const Torus torus(R, r);
    // The geodesic turns back where rho = c: with c > R - r, kappaN there is -(1 - R/c)/r > 0 unless c > R. It passes
    // the inner equator if c < R - r, with kappaN = -(1 - R c^2/(R - r)^3)/r: zero for c0^2 = (R - r)^3/R.
    const double c0 = std::sqrt(std::pow(R - r, 3) / R);
    for (const double excess : {1e-3, 1e-5, 1e-7}) {
        const double c = c0 * (1 + excess), sine = c / (R + r);
        const auto start = makeStart(torus, Vector3(R + r, 0, 0), Vector3(0, sine, std::sqrt(1 - sine * sine)), 6);
        const auto places = findPressureChanges(torus, start);
        ASSERT_EQ(places.size(), 2u) << excess;
        const double rho = std::cbrt(R * c * c);
        for (const GeodesicPlace& place : places) EXPECT_NEAR(place.point.p.head<2>().norm(), rho, 1e-10) << excess;
        EXPECT_LT(places[1].s - places[0].s, 10 * std::sqrt(excess));
    }
    const double c = c0 * (1 - 1e-5), sine = c / (R + r);  // not quite: presses all along
    EXPECT_TRUE(findPressureChanges(
                    torus, makeStart(torus, Vector3(R + r, 0, 0), Vector3(0, sine, std::sqrt(1 - sine * sine)), 6))
                    .empty());
}

/** Largest of many normal curvatures along an arc. */
double calcLargestOfMany(const Surface& surface, GeodesicStart start) {
    constexpr int kPieces = 20000;
    double largest = -kInfinity;
    start.length /= kPieces;
    ShotGeodesic piece;
    for (int i = 0; i < kPieces; ++i) {
        surface.shootGeodesic(start, {}, piece);
        largest = std::max({largest, piece.P.kappaN, piece.Q.kappaN});
        start.point = piece.endPoint, start.tangent = piece.Q.t;
    }
    return largest;
}

// 2026-11-25: kappaN was looked at from place to place, and paths were called minima whose pressure changed in between.
TEST(LargestNormalCurvature, IsThatOfManyPlacesAlongAnArcOverTheInnerEquator) {
    const double r = 1;
    for (const double R : {3.0, 2.0, 1.5})
        for (const double excess : {1e-6, 1e-4, 1e-3, 1e-2})
            for (const double length : {2.0, 2.5, 3.1})
                for (const double offset : {-0.3, -0.11, 0.0, 0.07}) {
                    const Torus torus(R, r);
                    const double sine = std::sqrt(std::pow(R - r, 3) / R) * (1 + excess) / (R - r);
                    ShotGeodesic arc;
                    torus.shootGeodesic(makeStart(torus, Vector3(R - r, 0, 0),
                                                  Vector3(0, sine, std::sqrt(1 - sine * sine)), -(length / 2 + offset)),
                                        {}, arc);
                    const GeodesicStart start{arc.endPoint, arc.Q.t, length};
                    torus.shootGeodesic(start, {}, arc);
                    const double found = calcLargestNormalCurvature(torus, start, arc);
                    EXPECT_NEAR(found, calcLargestOfMany(torus, start), 2e-8) << R << " " << excess;
                    EXPECT_GT(found, 0);
                }
}

// Short arcs are looked at along a curve through their ends: exact where pressure nearly vanishes, an estimate
// elsewhere.
TEST(LargestNormalCurvature, OfShortArcsIsThatOfManyPlacesOrAnEstimateWhereTheyPress) {
    testing::Random random(20261128);
    const Torus implicit(2, 1);
    const ParametricTorus parametric(2, 1);
    int numNearZero = 0;
    for (int i = 0; i < 30; ++i)
        for (const Surface* torus :
             {static_cast<const Surface*>(&implicit), static_cast<const Surface*>(&parametric)}) {
            const double u = random.uniform(-kPi, kPi), v = random.uniform(-kPi, kPi);
            const double rho = 2 + std::cos(v);
            const Vector3 p(rho * std::cos(u), rho * std::sin(u), std::sin(v));
            const GeodesicStart start = makeStart(*torus, p, random.unitVector(), random.uniform(0.05, 0.95));
            ShotGeodesic arc;
            torus->shootGeodesic(start, {}, arc);
            const double found = calcLargestNormalCurvature(*torus, start, arc);
            const double many = calcLargestOfMany(*torus, start);
            EXPECT_NEAR(found, many, many > -0.04 ? 2e-8 : 0.02) << "arc " << i;
            numNearZero += many > -0.04;
        }
    EXPECT_GT(numNearZero, 10);
}

TEST(PressureChanges, DoNotExistWhereCurvatureKeepsItsSign) {
    EXPECT_TRUE(
        findPressureChanges(Ellipsoid(Vector3(1, 0.5, 2)), makeStart(Sphere(1), Vector3(1, 0, 0), Vector3(0, 1, 1), 9))
            .empty());
    const Torus torus(3, 1);  // round the inner equator it lifts, over the tube it presses, all along
    EXPECT_TRUE(findPressureChanges(torus, makeStart(torus, Vector3(2, 0, 0), Vector3(0, 1, 0), 4)).empty());
    EXPECT_TRUE(findPressureChanges(torus, makeStart(torus, Vector3(4, 0, 0), Vector3(0, 0, 1), 9)).empty());
    // An asymptotic direction at the start is no change inside: on z = x^2 - y^2 a straight line runs along the
    // diagonal.
    const auto saddle = makeImplicitSurface("saddle", 1, [](auto x, auto y, auto z) { return z - x * x + y * y; });
    EXPECT_TRUE(findPressureChanges(saddle, makeStart(saddle, Vector3::Zero(), Vector3(1, 0, 0), 0.5)).empty());
}

ParametricFunctionSurface makeFlatSquare() {
    return makeParametricSurface("square", 0.5, {Vector2(-1, -1), Vector2(1, 1)}, [](auto u, auto v) {
        using Number = decltype(u);
        return std::array<Number, 3>{u, v, Number(0.0)};
    });
}

TEST(DomainExit, OfAFlatPatchIsWhereTheStraightLineCrossesTheEdge) {
    const ParametricFunctionSurface square = makeFlatSquare();
    const Vector3 p(0.2, 0.1, 0), t(0.8, 0.6, 0);
    const auto exit = findDomainExit(square, makeStart(square, p, t, 3));
    ASSERT_TRUE(exit);
    EXPECT_NEAR(exit->s, 1, kClose);
    EXPECT_LT((exit->point.uv - Vector2(1, 0.7)).norm(), kClose);
    const auto back = findDomainExit(square, makeStart(square, p, t, -3));
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->s, -1.5, kClose);
    EXPECT_FALSE(findDomainExit(square, makeStart(square, p, t, 0.999)));
    EXPECT_FALSE(findDomainExit(square, makeStart(square, p, t, -1.499)));
    EXPECT_EQ(findDomainExit(square, makeStart(square, Vector3(1.1, 0, 0), t, 1))->s, 0);
    EXPECT_EQ(findDomainExit(square, makeStart(square, Vector3(1.1, 0, 0), t, 0))->s, 0);
}

/** Ends inside, middle outside: only a look inside the arc finds it. Great circles climb towards the pole
between two points of the same latitude. */
TEST(DomainExit, IsFoundInsideAnArcWhoseEndsAreInside) {
    const double edge = 0.8;  // latitude at which the patch ends
    const auto cap = makeParametricSurface("zone", 1, {Vector2(-2, -1), Vector2(2, edge)}, [](auto u, auto v) {
        using Number = decltype(u);
        return std::array<Number, 3>{cos(v) * cos(u), cos(v) * sin(u), sin(v)};
    });
    // Great circle that climbs to latitude `top` at u = 0.
    const auto shoot = [&](double top, double half) {
        const Vector3 peak(std::cos(top), 0, std::sin(top)), east(0, 1, 0);
        const Vector3 p = std::cos(half) * peak - std::sin(half) * east,
                      t = std::cos(half) * east + std::sin(half) * peak;
        return makeStart(cap, p, t, 2 * half);
    };
    for (const double top : {edge + 0.1, edge + 1e-3, edge + 1e-5}) {
        const GeodesicStart start = shoot(top, 0.7);
        ShotGeodesic arc;
        cap.shootGeodesic(start, {}, arc);
        EXPECT_TRUE(cap.isInDomain(arc.endPoint) && cap.isInDomain(start.point));
        const auto exit = findDomainExit(cap, start);
        ASSERT_TRUE(exit) << top;
        // sin(latitude) = sin(top) cos(s - half)
        EXPECT_NEAR(exit->s, 0.7 - std::acos(std::sin(edge) / std::sin(top)), 1e-9) << top;
        EXPECT_NEAR(exit->point.uv[1], edge, kClose);
    }
    EXPECT_FALSE(findDomainExit(cap, shoot(edge - 1e-5, 0.7)));
}

TEST(DomainExit, OfAConeIsItsEdgeAndOfALayerThatOfItsBase) {
    const auto cone = std::make_shared<Cone>(0.4, 0.3, 0.1);
    const Vector3 p(0.3, 0, 0.3 / std::tan(0.4)), towardsApex = -p.normalized();
    const auto exit = findDomainExit(*cone, makeStart(*cone, p, towardsApex, 0.7));
    ASSERT_TRUE(exit);
    EXPECT_NEAR(exit->s, 0.2 / std::sin(0.4), kClose);
    EXPECT_FALSE(findDomainExit(*cone, makeStart(*cone, p, towardsApex, 0.5)));
    const OffsetSurface layer(std::make_shared<ParametricFunctionSurface>(makeFlatSquare()), 0.1);
    const auto above = findDomainExit(layer, makeStart(layer, Vector3(0.2, 0.1, 0.1), Vector3(0.8, 0.6, 0), 3));
    ASSERT_TRUE(above);
    EXPECT_NEAR(above->s, 1, 1e-9);
    EXPECT_FALSE(findDomainExit(Sphere(1), makeStart(Sphere(1), Vector3(1, 0, 0), Vector3(0, 1, 0), 9)));
}

}  // namespace
}  // namespace tautline
