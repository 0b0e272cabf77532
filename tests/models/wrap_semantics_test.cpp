// SPDX-License-Identifier: Apache-2.0
/** What a model file means by its wraps, each meaning against a closed form. */
#include <cmath>

#include "model_test_support.h"
#include "tautline/models/model_system.h"

namespace tautline::models::testing {
namespace {

struct Point {
    double x, y;
};

std::string makePoint(const std::string& name, const Point& p, double z = 0.0) {
    return "<PathPoint name=\"" + name + "\"><socket_parent_frame>/ground</socket_parent_frame><location>" +
           std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(z) + "</location></PathPoint>";
}

/** Wrap objects on ground and a string over them, in the plane z = 0 or through points at `z`. */
std::string makeString(const std::string& objects, const std::vector<Point>& points, const std::string& wraps,
                       const std::vector<double>& z = {}) {
    std::string list;
    for (std::size_t i = 0; i < points.size(); ++i)
        list += makePoint("p" + std::to_string(i), points[i], z.empty() ? 0.0 : z[i]);
    return "<Ground name=\"ground\"><WrapObjectSet><objects>" + objects + "</objects></WrapObjectSet></Ground>" +
           makePinModel("<ForceSet><objects><PathSpring name=\"s\"><GeometryPath><PathPointSet><objects>" + list +
                        "</objects></PathPointSet><PathWrapSet><objects>" + wraps +
                        "</objects></PathWrapSet></GeometryPath><resting_length>1</resting_length><stiffness>1"
                        "</stiffness><dissipation>0</dissipation></PathSpring></objects></ForceSet>");
}

std::string makeCylinder(const std::string& name, const Point& at, double radius, const std::string& quadrant) {
    return "<WrapCylinder name=\"" + name + "\"><translation>" + std::to_string(at.x) + " " + std::to_string(at.y) +
           " 0</translation><radius>" + std::to_string(radius) + "</radius><length>1</length><quadrant>" + quadrant +
           "</quadrant></WrapCylinder>";
}

std::string makeWrap(const std::string& object, const std::string& range = "-1 -1") {
    return "<PathWrap name=\"w\"><wrap_object>" + object + "</wrap_object><range>" + range + "</range></PathWrap>";
}

/** The string of a model in its default pose. */
struct StringModel {
    explicit StringModel(const std::string& content) : model(readNew(content)), state(model.makeDefaultState()) {
        model.getSystem().realize(state, SimTK::Stage::Position);
    }
    const Cable& getCable() const { return model.getSprings().at(0).cable; }
    double getLength() const { return getCable().getLength(state); }
    PathStatus getStatus() const { return getCable().getStatus(state); }

    ModelSystem model;
    SimTK::State state;
};

/** The shorter way round a circle at the origin. */
double calcRound(const Point& a, const Point& b, double r) {
    const double A = std::hypot(a.x, a.y), B = std::hypot(b.x, b.y);
    double angle = std::abs(std::atan2(a.y, a.x) - std::atan2(b.y, b.x));
    angle = std::min(angle, 2 * SimTK::Pi - angle);
    return std::sqrt(A * A - r * r) + std::sqrt(B * B - r * r) + r * (angle - std::acos(r / A) - std::acos(r / B));
}

double calcDistance(const Point& a, const Point& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/** A ring about the y axis, ring radius 0.5, tube 0.1: in the plane a circle at x = 0.5 and one at -0.5, between which
the string passes. */
TEST(WrapSemantics, ATorusHoldsItsPathInsideTheRing) {
    const std::string ring =
        "<WrapTorus name=\"ring\"><xyz_body_rotation>1.5707963267948966 0 0</xyz_body_rotation><inner_radius>0.1"
        "</inner_radius><outer_radius>0.5</outer_radius></WrapTorus>";
    for (const double x : {0.0, 0.3, 0.45, 0.55, 0.7, -0.6}) {
        for (const double direction : {1.0, -1.0}) {
            SCOPED_TRACE(x * direction);
            const Point a{x, 2 * direction}, b{x, -2 * direction};
            const StringModel string(makeString(ring, {a, b}, makeWrap("ring")));
            // Seen from the center of the nearer circle, passed on the side of the hole.
            const double u = std::abs(x) - 0.5, d = std::hypot(u, 2);
            const double angle = 2 * (SimTK::Pi - std::atan2(2, u)) - 2 * std::acos(0.1 / d);
            const double expected = std::abs(x) < 0.4 ? 4.0 : 2 * std::sqrt(d * d - 0.01) + 0.1 * angle;
            EXPECT_EQ(string.getStatus(), PathStatus::Solved) << string.getCable().explainStatus(string.state);
            EXPECT_NEAR(string.getLength(), expected, 1e-10);
        }
    }
}

TEST(WrapSemantics, AnObjectInTheWayOfTwoSegmentsIsPassedOnBoth) {
    const Point a{-1, -0.2}, b{0, 0.9}, c{1, -0.2};
    const StringModel string(makeString(makeCylinder("c", {0, 0}, 0.65, "all"), {a, b, c}, makeWrap("c")));
    EXPECT_EQ(string.getCable().getNumElements(), 5);
    EXPECT_EQ(string.getStatus(), PathStatus::Solved);
    EXPECT_NEAR(string.getLength(), calcRound(a, b, 0.65) + calcRound(b, c, 0.65), 1e-12);
}

TEST(WrapSemantics, ARangeKeepsAnObjectFromOtherSegments) {
    const Point a{-1, -0.2}, b{0, 0.9}, c{1, -0.2};
    const StringModel string(makeString(makeCylinder("c", {0, 0}, 0.65, "all"), {a, b, c}, makeWrap("c", "2 3")));
    EXPECT_EQ(string.getCable().getNumElements(), 4);
    EXPECT_NEAR(string.getLength(), calcDistance(a, b) + calcRound(b, c, 0.65), 1e-12);
}

TEST(WrapSemantics, WrapsNeedNotBeListedInTheOrderOfThePath) {
    const std::string objects = makeCylinder("second", {0.5, 0}, 0.3, "y") + makeCylinder("first", {-0.5, 0}, 0.3, "y");
    const double expected = 2 * (std::sqrt(1.5 * 1.5 - 0.09) + 0.3 * std::asin(0.3 / 1.5)) + 1.0;
    for (const std::string& wraps : {makeWrap("second") + makeWrap("first"), makeWrap("first") + makeWrap("second")}) {
        const StringModel string(makeString(objects, {{-2, 0}, {2, 0}}, wraps));
        EXPECT_EQ(string.getCable().getElementName(CableElementIndex(1)), "first");
        EXPECT_NEAR(string.getLength(), expected, 1e-11);
    }
}

TEST(WrapSemantics, AnObjectAroundAnEndOfItsSegmentIsSwitchedOff) {
    const StringModel string(makeString(makeCylinder("c", {0, 0}, 0.7, "all"), {{-1, 0.1}, {0.2, 0.3}}, makeWrap("c")));
    EXPECT_NEAR(string.getLength(), std::hypot(1.2, 0.2), 1e-12);
}

/** The side that a quadrant names holds also where it is the longer way round. */
TEST(WrapSemantics, AQuadrantDecidesTheSideOfALineThroughTheObject) {
    for (const auto& [quadrant, sign] : {std::pair("y", 1.0), std::pair("-y", -1.0)}) {
        SCOPED_TRACE(quadrant);
        const Point a{-1, 0.05}, b{1, 0.05};
        const StringModel string(makeString(makeCylinder("c", {0, 0}, 0.3, quadrant), {a, b}, makeWrap("c")));
        const double d = std::hypot(1, 0.05), swept = SimTK::Pi - sign * 2 * std::atan2(0.05, 1);
        EXPECT_NEAR(string.getLength(), 2 * std::sqrt(d * d - 0.09) + 0.3 * (swept - 2 * std::acos(0.3 / d)), 1e-11);
    }
}

/** Over the top of a circle at the origin, from the left to the right, from wherever the points are outside it. */
double calcOverTop(const Point& a, const Point& b, double r) {
    const double A = std::hypot(a.x, a.y), B = std::hypot(b.x, b.y);
    const double to = std::atan2(b.y, b.x);
    double from = std::atan2(a.y, a.x);
    if (from < to) from += 2 * SimTK::Pi;
    return std::sqrt(A * A - r * r) + std::sqrt(B * B - r * r) + r * (from - to - std::acos(r / A) - std::acos(r / B));
}

TEST(WrapSemantics, AOneSidedObjectEngagesOnTheFirstSegmentThatMeetsIt) {
    const Point a{-1, -0.2}, b{0, 0.9}, c{1, -0.2};
    const StringModel string(makeString(makeCylinder("c", {0, 0}, 0.65, "y"), {a, b, c}, makeWrap("c")));
    EXPECT_EQ(string.getCable().getNumElements(), 5);
    EXPECT_EQ(string.getStatus(), PathStatus::Solved);
    EXPECT_NEAR(string.getLength(), calcOverTop(a, b, 0.65) + calcDistance(b, c), 1e-11);
}

/** No segment meets the cylinder, and all points are on its inactive side: OpenSim leads one of the segments over the
top, the one that this lengthens least. */
TEST(WrapSemantics, AOneSidedCylinderEngagesOnTheSegmentThatItLengthensLeast) {
    for (const double x : {-0.3, -0.05, 0.2}) {
        SCOPED_TRACE(x);
        const Point a{-1, -0.2}, b{x, -0.8}, c{1, -0.2};
        const StringModel string(makeString(makeCylinder("c", {0, 0}, 0.3, "y"), {a, b, c}, makeWrap("c")));
        const double first = calcOverTop(a, b, 0.3) + calcDistance(b, c),
                     second = calcDistance(a, b) + calcOverTop(b, c, 0.3);
        EXPECT_EQ(string.getStatus(), PathStatus::Solved);
        EXPECT_NEAR(string.getLength(), std::min(first, second), 1e-11);
    }
}

/** The cylinder reaches from z = -0.5 to 0.5. OpenSim lets go of it where both ends of the arc would lie beyond. */
TEST(WrapSemantics, ACylinderHoldsAStringWithinItsLengthOnly) {
    const Point a{-1, 0.1}, b{1, 0.1};
    const double round = calcRound(a, b, 0.3), straight = calcDistance(a, b);
    const double toArc = std::sqrt(1.01 - 0.09) / round;  // the straight part before or after the arc, of the whole
    struct Case {
        double zA, zB;
        bool isHeld;
    };
    const double arcBeyond = 1.0 / (1 - 2 * toArc);  // dz over the string that makes the arc alone 1 long
    const Case cases[] = {{0.4, 0.4, true},
                          {0.6, 0.6, false},
                          {-0.6, -0.6, false},
                          {0.2, 0.6, true},
                          {0.7, 0.2, true},
                          // The first tangent point just within and just beyond the end, the last farther out.
                          {0.499 - toArc * 0.8, 0.499 - toArc * 0.8 + 0.8, true},
                          {0.501 - toArc * 0.8, 0.501 - toArc * 0.8 + 0.8, false},
                          // Over both ends at once.
                          {-0.51 * arcBeyond, 0.51 * arcBeyond, false},
                          {-0.49 * arcBeyond, 0.49 * arcBeyond, true}};
    for (const char* quadrant : {"all", "y"})
        for (const Case& test : cases) {
            SCOPED_TRACE(std::string(quadrant) + " " + std::to_string(test.zA) + " " + std::to_string(test.zB));
            const StringModel string(
                makeString(makeCylinder("c", {0, 0}, 0.3, quadrant), {a, b}, makeWrap("c"), {test.zA, test.zB}));
            EXPECT_EQ(string.getStatus(), PathStatus::Solved);
            EXPECT_NEAR(string.getLength(), std::hypot(test.isHeld ? round : straight, test.zB - test.zA), 1e-6);
        }
}

}  // namespace
}  // namespace tautline::models::testing
