// SPDX-License-Identifier: Apache-2.0
/** What the tests and examples of Simbody's CableSpan and of OpenSim's Scholz2015GeometryPath have in them, built anew
from their dimensions: each answer by a closed form, by statics, or by differences. The chain of quarter circles is in
quarter_circles_test.cpp, the examples that move in peer_motions_test.cpp. */
#include <algorithm>
#include <cstdio>
#include <functional>

#include "adapter_scenes.h"
#include "support/seeded_random.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {
namespace {

using SimTK::SpatialVec;
using SimTK::Vec3;
using Geometry = SimTK::ContactGeometry;

const Real kQuarterTurn = SimTK::Pi / 2;

template <class Shape, class... Dimensions>
std::shared_ptr<const Geometry> makeShape(Dimensions... dimensions) {
    return std::make_shared<const Shape>(dimensions...);
}

Transform turnedAboutY(const Vec3& center) {
    return {SimTK::Rotation(kQuarterTurn, SimTK::YAxis), center};
}

// Of CableSpan's three files.

MobilizedBody::Translation addTranslating(BareScene& scene, const Vec3& place) {
    return {scene.matter.Ground(), Transform(place), makeBody(), Transform()};
}

TEST(PeerCases, ViaPointsBreakTheLine) {
    BareScene scene;
    const Vec3 places[] = {{0, 0, 0}, {-4, 0, 0}, {0, 1, 0}, {0, 1, 2}, {-4, 1, 2}};
    std::vector<MobilizedBody::Translation> bodies;
    for (const Vec3& place : places) bodies.push_back(addTranslating(scene, place));
    Cable cable(scene.cables, bodies[0], Vec3(0), bodies[1], Vec3(0));
    for (int i : {2, 3, 4}) cable.addViaPoint(bodies[i], Vec3(0));
    const State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    EXPECT_EQ(cable.getNumObstacles(), 0);
    EXPECT_EQ(cable.getNumViaPoints(), 3);
    EXPECT_NEAR(cable.getLength(state), 7 + std::sqrt(5.0), 1e-14);
    const Vec3 last = Vec3(0, -1, -2) / std::sqrt(5.0);
    const Vec3 forces[] = {{0, 0, 0}, {0, 1, 0}, -last, {0, -1, 1}, {-1, 0, -1}, Vec3(1, 0, 0) + last};
    SimTK::Vector_<SpatialVec> unitForces;
    cable.calcUnitBodyForces(state, unitForces);
    for (int b = 0; b < 6; ++b)
        EXPECT_LT((unitForces[b] - SpatialVec(Vec3(0), forces[b])).norm(), 1e-14) << "body " << b;
}

/** Forces of unit tension and the rate of the length, with one free body that moves. */
struct SlingScene : BareScene {
    explicit SlingScene(const Vec3& place) : free(matter.Ground(), Transform(place), makeBody(), Transform()) {}

    void realize(const SimTK::Vec6& speeds = SimTK::Vec6(0)) {
        state = system.realizeTopology();
        free.setU(state, speeds);
        system.realize(state, Stage::Velocity);
    }
    void expectForces(const SpatialVec& onGround, const SpatialVec& onBody) {
        realize();
        SimTK::Vector_<SpatialVec> unitForces;
        cable.calcUnitBodyForces(state, unitForces);
        EXPECT_EQ(cable.getStatus(state), PathStatus::Solved);
        EXPECT_LT((unitForces[0] - onGround).norm(), 1e-12) << unitForces[0];
        EXPECT_LT((unitForces[1] - onBody).norm(), 1e-12) << unitForces[1];
    }
    void expectRate(const SimTK::Vec6& speeds, Real rate) {
        realize(speeds);
        EXPECT_NEAR(cable.getLengthRate(state), rate, 1e-13);
    }

    MobilizedBody::Free free;
    Cable cable;
    State state;
};

const SimTK::Vec6 kMoving(1, 2, 3, 4, 5, 6);

TEST(PeerCases, ACableOnOneBodyPullsAtNothingAndKeepsItsLength) {
    SlingScene bare(Vec3(0));
    bare.cable = Cable(bare.cables, bare.free, Vec3(-1, 0, 0), bare.free, Vec3(0, 1, 0));
    bare.expectForces(SpatialVec(Vec3(0)), SpatialVec(Vec3(0)));
    bare.expectRate(kMoving, 0);

    SlingScene wrapped(Vec3(0));
    wrapped.cable = Cable(wrapped.cables, wrapped.free, Vec3(2, 0, 0), wrapped.free, Vec3(-2, 0, 0));
    wrapped.cable.addObstacle(wrapped.free, Transform(Vec3(1, 1, 0)), makeShape<Geometry::Sphere>(1), Vec3(1, 1, 0));
    wrapped.cable.addObstacle(wrapped.free, Transform(Vec3(-1, 1, 0)),
                              makeShape<Geometry::Ellipsoid>(Vec3(0.5, 0.75, 1)), Vec3(-1, 1, 0));
    wrapped.expectForces(SpatialVec(Vec3(0)), SpatialVec(Vec3(0)));
    wrapped.expectRate(kMoving, 0);
    // The peer's test has both touched, over their tops: a saddle. The straight line below them is free.
    EXPECT_NEAR(wrapped.cable.getLength(wrapped.state), 4, 1e-14);
}

TEST(PeerCases, AStraightCablePullsWithItsLeverArm) {
    SlingScene centered(Vec3(1, 0, 0));
    centered.cable = Cable(centered.cables, SimTK::GroundIndex, Vec3(0), centered.free, Vec3(0));
    centered.expectForces(SpatialVec(Vec3(0), Vec3(1, 0, 0)), SpatialVec(Vec3(0), Vec3(-1, 0, 0)));

    SlingScene offset(Vec3(1, -2, 0));
    offset.cable = Cable(offset.cables, SimTK::GroundIndex, Vec3(0), offset.free, Vec3(0, 2, 0));
    offset.expectForces(SpatialVec(Vec3(0), Vec3(1, 0, 0)), SpatialVec(Vec3(0, 0, 2), Vec3(-1, 0, 0)));
    // Along x, by translation and by w_z times the arm.
    offset.expectRate(SimTK::Vec6(0, 0, 0, 4, 5, 6), 4);
    offset.expectRate(SimTK::Vec6(0, 1, 2, 0, 0, 0), -4);
    offset.expectRate(SimTK::Vec6(0, 1, 2, 4, 5, 6), 0);
}

/** A string from above to below, pulled out along x by a body so that both its legs make an angle of 45 degrees. */
TEST(PeerCases, ASlingPullsBackWhatStretchesIt) {
    const Real angle = SimTK::Pi / 4, legs = std::sqrt(2.0);
    for (const Real offset : {0.0, 1.0}) {
        SCOPED_TRACE(offset);
        const SpatialVec onGround(Vec3(0), Vec3(legs, 0, 0)), onBody(Vec3(0, 0, offset * legs), Vec3(-legs, 0, 0));
        SlingScene sphere(Vec3(0, -offset, 0));
        const Real x = std::tan(angle / 2);
        sphere.cable = Cable(sphere.cables, SimTK::GroundIndex, Vec3(x, 1, 0), SimTK::GroundIndex, Vec3(x, -1, 0));
        sphere.cable.addObstacle(sphere.free, Transform(Vec3(0, offset, 0)), makeShape<Geometry::Sphere>(1),
                                 Vec3(1, 0, 0));
        sphere.expectForces(onGround, onBody);
        sphere.expectRate(kMoving, legs * (4 - 3 * offset));

        SlingScene point(Vec3(0, -offset, 0));
        point.cable = Cable(point.cables, SimTK::GroundIndex, Vec3(0, 1, 0), SimTK::GroundIndex, Vec3(0, -1, 0));
        point.cable.addViaPoint(point.free, Vec3(std::tan(angle), offset, 0));
        point.expectForces(onGround, onBody);
    }
}

/** The hint stands where the string would take the longest way round the sphere, a saddle on which a method that only
makes the path smooth stays. */
TEST(PeerCases, TheShortestWayRoundASphereIsFoundFromTheLongest) {
    SlingScene scene(Vec3(0));
    const Real x = std::tan(SimTK::Pi / 8), c = std::sqrt(0.5);
    scene.cable = Cable(scene.cables, SimTK::GroundIndex, Vec3(x, 1, 0), SimTK::GroundIndex, Vec3(x, -1, 0));
    const CableElementIndex sphere =
        scene.cable.addObstacle(scene.free, Transform(), makeShape<Geometry::Sphere>(1), Vec3(-1, 0, 0.1));
    scene.realize();
    EXPECT_EQ(scene.cable.getStatus(scene.state), PathStatus::Solved);
    const ShotGeodesic& arc = scene.cable.getSolution(scene.state).contacts[sphere].geodesic;
    EXPECT_LT((arc.P.x - tautline::Vector3(c, c, 0)).norm(), 1e-11);
    EXPECT_LT((arc.Q.x - tautline::Vector3(c, -c, 0)).norm(), 1e-11);
}

/** Ends close together far below a ring, through whose hole the string is asked to go: about the tube's lowest circle,
two tangents and the arc between them. */
TEST(PeerCases, AStringIsHungOnARingFromAFarHint) {
    BareScene scene;
    Cable cable(scene.cables, SimTK::GroundIndex, Vec3(-0.1, 0, 0), SimTK::GroundIndex, Vec3(0.1, 0, 0));
    cable.addObstacle(SimTK::GroundIndex, turnedAboutY(Vec3(0, 4, 0)), makeShape<Geometry::Torus>(2, 0.5),
                      Vec3(0, -0.1, 0));
    const State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    const Real distance = std::hypot(0.1, 2.0), tangent = std::sqrt(distance * distance - 0.25);
    const Real arc = 2 * SimTK::Pi - 2 * std::acos(0.5 / distance) - 2 * std::atan(0.05);
    EXPECT_EQ(cable.getStatus(state), PathStatus::Solved);
    EXPECT_NEAR(cable.getLength(state), 2 * tangent + 0.5 * arc, 1e-9);
    EXPECT_NEAR(cable.getLength(state), 5.6513, 5e-5);
}

/** Four strings over the tops of four shapes; their ends go up and down through the height of the tops. */
TEST(PeerCases, TouchesWhileTheEndsAreBelowTheTop) {
    BareScene scene;
    struct Case {
        std::shared_ptr<const Geometry> shape;
        Transform X_GS;
    };
    const Case cases[] = {{makeShape<Geometry::Torus>(2, 0.25), turnedAboutY(Vec3(0, 1.75, 0))},
                          {makeShape<Geometry::Ellipsoid>(Vec3(1, 0.5, 0.75)), Transform(Vec3(0, -0.5, 0))},
                          {makeShape<Geometry::Sphere>(1.5), Transform(Vec3(0, -1.5, 0))},
                          {makeShape<Geometry::Cylinder>(2), Transform(Vec3(0, -2, 0))}};
    const MobilizedBody::Translation left = addTranslating(scene, Vec3(-2, 0, 0)),
                                     right = addTranslating(scene, Vec3(2, 0, 0));
    std::vector<Cable> cables;
    for (const Case& c : cases) {
        cables.emplace_back(scene.cables, left, Vec3(0), right, Vec3(0));
        cables.back().addObstacle(SimTK::GroundIndex, c.X_GS, c.shape);
    }
    State state = scene.system.realizeTopology();
    for (Real angle = 0.01; angle < 4 * SimTK::Pi; angle += 0.02) {
        const Vec3 up(0, 0.1 * std::sin(angle), 0);
        left.setTranslation(state, up);
        right.setTranslation(state, up);
        scene.system.realize(state, Stage::Position);
        for (const Cable& cable : cables) {
            EXPECT_EQ(cable.isTouched(state, cable.getObstacle(0)), up[1] < 0) << cable.getName() << ", " << angle;
            EXPECT_EQ(cable.getStatus(state), PathStatus::Solved) << cable.getName() << ", " << angle;
        }
    }
}

/** A ring, an ellipsoid, an eyelet, a sphere, a cylinder, a bicubic map and another ring in a row, between ends that
swing far. */
struct RowOfAllShapes : BareScene {
    RowOfAllShapes()
        : origin(addTranslating(*this, Vec3(-8, 0.1, 0))),
          eyelet(addTranslating(*this, Vec3(0, 0.9, 0.5))),
          end(addTranslating(*this, Vec3(20, 1, -1))) {
        cable = Cable(cables, origin, Vec3(0), end, Vec3(0));
        add(turnedAboutY(Vec3(-4, 0, 0)), makeShape<Geometry::Torus>(1, 0.2), Vec3(0.1, 0.2, 0));
        add(Vec3(-2, 0, 0), makeShape<Geometry::Ellipsoid>(Vec3(1.5, 2.6, 1)), Vec3(0, 0, 1.1));
        cable.addViaPoint(eyelet, Vec3(0));
        add(Vec3(2, 0, 0), makeShape<Geometry::Sphere>(1), Vec3(0.1, 1.1, 0));
        add({SimTK::Rotation(kQuarterTurn, SimTK::XAxis), Vec3(5, 0, 0)}, makeShape<Geometry::Cylinder>(1),
            Vec3(0, -1, 0));
        const Real at[] = {-4, -2, 2, 4}, heights[] = {2, 3, 3, 1, 0, 1.5, 1.5, 0, 0, 1.5, 1.5, 0, 2, 3, 3, 1};
        const SimTK::BicubicSurface map(SimTK::Vector(4, at), SimTK::Vector(4, at),
                                        0.75 * SimTK::Matrix(4, 4, heights));
        add({SimTK::Rotation(kQuarterTurn, SimTK::ZAxis), Vec3(10, 0, -1)}, makeShape<Geometry::SmoothHeightMap>(map),
            Vec3(0, 0, 1));
        add(turnedAboutY(Vec3(14, 0, 0)), makeShape<Geometry::Torus>(1, 0.2), Vec3(0.1, 0.2, 0));
        state = system.realizeTopology();
    }
    void add(const Transform& X_GS, const std::shared_ptr<const Geometry>& shape, const Vec3& hint_S) {
        cable.addObstacle(SimTK::GroundIndex, X_GS, shape, hint_S);
        shapes.push_back(shape);
    }

    void moveTo(Real angle) {
        const auto s = [&](Real frequency) { return std::sin(angle * frequency); };
        const auto c = [&](Real frequency) { return frequency * std::cos(angle * frequency); };
        const auto move = [&](const MobilizedBody::Translation& moved, const Vec3& q, const Vec3& u) {
            moved.setQ(state, q);
            moved.setU(state, u);
        };
        move(origin, Vec3(1.1 * s(1), 5 * s(1.5), 5 * s(2)), Vec3(1.1 * c(1), 5 * c(1.5), 5 * c(2)));
        move(end, Vec3(0.1 * s(1), 4 * s(0.7), 10 * s(1.3)), Vec3(0.1 * c(1), 4 * c(0.7), 10 * c(1.3)));
        move(eyelet, Vec3(0, 0.5 * std::cos(angle), 0), Vec3(0, -0.5 * s(1), 0));
        system.realize(state, Stage::Velocity);
    }
    Real calcDistance() const {
        return (end.getBodyOriginLocation(state) - origin.getBodyOriginLocation(state)).norm();
    }

    MobilizedBody::Translation origin, eyelet, end;
    Cable cable;
    State state;
    std::vector<std::shared_ptr<const Geometry>> shapes;  ///< of the obstacles, in order
};

/** A point that slides freely over Simbody's own surface, in the surface's frame: what it does is a geodesic. */
class FreeSlide {
public:
    FreeSlide(const Geometry& shape, const Vec3& point, const Vec3& tangent)
        : m_shape(shape), m_x(point), m_t(tangent) {}

    /** By the classic method of fourth order. */
    void advance(Real length) {
        constexpr int kSteps = 400;
        const Real h = length / kSteps;
        for (int i = 0; i < kSteps; ++i) {
            const Vec3 a1 = calcAcceleration(m_x, m_t);
            const Vec3 t2 = m_t + h / 2 * a1, a2 = calcAcceleration(m_x + h / 2 * m_t, t2);
            const Vec3 t3 = m_t + h / 2 * a2, a3 = calcAcceleration(m_x + h / 2 * t2, t3);
            const Vec3 t4 = m_t + h * a3, a4 = calcAcceleration(m_x + h * t3, t4);
            m_x += h / 6 * (m_t + 2 * t2 + 2 * t3 + t4);
            m_t += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
    }
    const Vec3& getPoint() const { return m_x; }
    const Vec3& getTangent() const { return m_t; }
    /** Outward: the shape's function is positive inside. */
    Vec3 calcNormal() const { return -m_shape.calcSurfaceGradient(m_x).normalize(); }

private:
    /** That which keeps the function of the surface at zero: across it, f'' = t . H t + g . a = 0. */
    Vec3 calcAcceleration(const Vec3& x, const Vec3& t) const {
        const Vec3 g = m_shape.calcSurfaceGradient(x);
        return -(~t * m_shape.calcSurfaceHessian(x) * t) / (~g * g) * g;
    }

    const Geometry& m_shape;
    Vec3 m_x, m_t;
};

TEST(PeerCases, FramesAlongArcsAreThoseOfFreeSlides) {
    RowOfAllShapes row;
    constexpr int kPoints = 6;
    std::vector<int> compared(row.shapes.size());
    Real worst = 0;
    for (const Real angle : {0.0, 0.4, 1.2, 2.5, 4.1, 5.6}) {
        row.moveTo(angle);
        for (int o = 0; o < row.cable.getNumObstacles(); ++o) {
            const CableElementIndex obstacle = row.cable.getObstacle(o);
            if (!row.cable.isTouched(row.state, obstacle)) continue;
            SCOPED_TRACE(std::to_string(angle) + ", " + row.cable.getElementName(obstacle));
            const Transform X_GS = row.cable.getElementFrame(obstacle);  // on ground
            const std::vector<Transform> frames = row.cable.calcResampledArcFrames(row.state, obstacle, kPoints);
            const Real length = row.cable.getSolution(row.state).contacts[obstacle].geodesic.length;
            FreeSlide slide(*row.shapes[o], ~X_GS * frames[0].p(), ~X_GS.R() * frames[0].x());
            for (const Transform& frame : frames) {
                if (&frame != &frames.front()) slide.advance(length / (kPoints - 1));
                const Vec3 tangent = X_GS.R() * slide.getTangent(), normal = X_GS.R() * slide.calcNormal();
                worst = std::max({worst, (frame.p() - X_GS * slide.getPoint()).norm(), (frame.x() - tangent).norm(),
                                  (frame.y() - normal).norm(), (frame.z() - tangent % normal).norm()});
            }
            ++compared[o];
        }
    }
    std::printf("[measured] frames against free slides %.1e\n", worst);
    EXPECT_LT(worst, 1e-7);
    EXPECT_TRUE(std::all_of(compared.begin(), compared.end(), [](int count) { return count > 0; }));
}

TEST(PeerCases, ARowOfAllShapesIsPassedAtEveryAngle) {
    RowOfAllShapes row;
    int solved = 0, beyondMap = 0, count = 0;
    Real worstRate = 0;
    for (Real angle = 0; angle < 2 * SimTK::Pi; angle += 0.05, ++count) {
        row.moveTo(angle);
        const PathStatus status = row.cable.getStatus(row.state);
        solved += status == PathStatus::Solved;
        beyondMap += status == PathStatus::LeftDomain;
        if (status != PathStatus::Solved) std::printf("%g: %s\n", angle, row.cable.explainStatus(row.state).c_str());
        EXPECT_GT(row.cable.getLength(row.state), row.calcDistance()) << angle;
        EXPECT_LT(row.cable.getPathError(row.state), 1e-9) << angle;
        const Real rate = row.cable.getLengthRate(row.state), h = 1e-5;
        row.cable.fixContacts(row.state);
        const auto calcLength = [&](Real at) {
            row.moveTo(at);
            return row.cable.getLength(row.state);
        };
        const Real difference = (calcLength(angle + h) - calcLength(angle - h)) / (2 * h);
        worstRate = std::max(worstRate, std::abs(rate - difference));
        row.cable.releaseContacts(row.state);
    }
    std::printf("[measured] %d of %d solved, %d beyond the map; rate against differences %.1e m/s\n", solved, count,
                beyondMap, worstRate);
    EXPECT_EQ(solved + beyondMap, count);
    EXPECT_LT(worstRate, 1e-6);
}

/** Two bodies on arms, a sphere and an ellipsoid, in random poses: a path found from the pose before is the one that
a search finds, and its forces are the slope of the length. */
TEST(PeerCases, ASphereAndAnEllipsoidOnArmsInRandomPoses) {
    BareScene scene;
    const Vec3 arm(0.25, 0, 0);
    MobilizedBody::Ball first(scene.matter.Ground(), Transform(Vec3(-1, 0, 0) + arm), makeBody(),
                              Transform(Vec3(-1, 0, 0) - arm));
    MobilizedBody::Ball second(scene.matter.Ground(), Transform(Vec3(5, 0, 0) + arm), makeBody(), Transform(-arm));
    Cable cable(scene.cables, SimTK::GroundIndex, Vec3(-5, 0.1, 0), SimTK::GroundIndex, Vec3(10, 0, 0.1));
    cable.addObstacle(first, SimTK::Rotation(1.5, SimTK::YAxis), makeShape<Geometry::Sphere>(1.5), Vec3(0.1, 1, 0.1));
    cable.addObstacle(second, Transform(), makeShape<Geometry::Ellipsoid>(Vec3(1.5, 3, 1.35)), Vec3(0, 1, 0));
    State state = scene.system.realizeTopology();
    scene.matter.setUseEulerAngles(state, true);
    scene.system.realizeModel(state);
    SeededRandom random(20261127);
    Real worst = 0;
    int touched = 0;
    for (int i = 0; i < 100; ++i) {
        SimTK::Vector q(state.getNQ());
        for (int k = 0; k < q.size(); ++k) q[k] = random.uniform(-1, 1);
        const auto calcLength = [&](const SimTK::Vector& at) {
            state.updQ() = at;
            scene.system.realize(state, Stage::Velocity);
            return cable.getLength(state);
        };
        cable.releaseContacts(state);
        calcLength(q);
        EXPECT_EQ(cable.getStatus(state), PathStatus::Solved) << "pose " << i << ": " << cable.explainStatus(state);
        for (int o = 0; o < 2; ++o) touched += cable.isTouched(state, cable.getObstacle(o));
        // Over a step that is small against everything, contacts kept.
        SimTK::Vector direction(state.getNU()), forces(state.getNU());
        for (int k = 0; k < direction.size(); ++k) direction[k] = random.uniform(-1, 1);
        state.updU() = direction;
        scene.system.realize(state, Stage::Velocity);
        const Real rate = cable.getLengthRate(state), h = 1e-5;
        const SimTK::Vector qDot = state.getQDot();
        cable.fixContacts(state);
        const Real difference = (calcLength(q + h * qDot) - calcLength(q - h * qDot)) / (2 * h);
        worst = std::max(worst, std::abs(rate - difference));
    }
    std::printf("[measured] %d contacts in 100 poses, rate against differences %.1e m/s\n", touched, worst);
    EXPECT_GT(touched, 100);
    EXPECT_LT(worst, 1e-7);
}

// Of OpenSim's tests.

/** A mass of 1 kg on an arm of 1 m about the origin, held by a string of no length at rest over a round obstacle. */
struct SuspendedPendulum : BareScene {
    SuspendedPendulum(const std::shared_ptr<const Geometry>& shape, const Transform& X_GS, const Vec3& hint_S)
        : pendulum(matter.Ground(), Transform(), makeBody(), Transform(Vec3(-1, 0, 0))) {
        SimTK::Force::Gravity(forces, matter, -SimTK::YAxis, kGravity);
        cable = Cable(cables, SimTK::GroundIndex, Vec3(-0.1, 0, 0), pendulum, Vec3(-0.5, 0.1, 0));
        cable.addObstacle(SimTK::GroundIndex, X_GS, shape, hint_S);
        spring = ElasticStringForce(forces, cable, kStiffness, 0, 5);
    }

    /** By bisection of the slope of the energy; the string by two tangents and the arc between. */
    static Real findLengthAtRest() {
        const auto calcLength = [](Real angle) {
            const Real radius = 0.1, x = 0.5 * std::cos(angle) - 0.1 * std::sin(angle) - 0.25,
                       y = 0.5 * std::sin(angle) + 0.1 * std::cos(angle);
            const Real a = 0.35, b = std::hypot(x, y);
            const Real arc =
                (SimTK::Pi - std::atan2(y, x)) - std::acos(radius / a) - std::acos(radius / b);  // over the top
            return std::sqrt(a * a - radius * radius) + std::sqrt(b * b - radius * radius) + radius * arc;
        };
        const auto calcSlope = [&](Real angle) {
            const auto calcEnergy = [&](Real at) {
                return 0.5 * kStiffness * SimTK::square(calcLength(at)) + kGravity * std::sin(at);
            };
            return calcEnergy(angle + 1e-5) - calcEnergy(angle - 1e-5);
        };
        Real low = -1.3, high = 0;
        EXPECT_LT(calcSlope(low) * calcSlope(high), 0);
        for (int i = 0; i < 60; ++i) (calcSlope(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
        return calcLength(low);
    }

    static constexpr Real kStiffness = 25, kGravity = 9.80665;
    MobilizedBody::Pin pendulum;
    Cable cable;
    ElasticStringForce spring;
};

TEST(PeerCases, ASuspendedPendulumComesToRestWhereStaticsSay) {
    const Real expected = SuspendedPendulum::findLengthAtRest();
    EXPECT_NEAR(expected, 0.81268778, 1e-5);
    struct Case {
        std::shared_ptr<const Geometry> shape;
        Transform X_GS;
        Vec3 hint_S;
    };
    const Vec3 center(0.25, 0, 0), top(0, 0.1, 0);
    const Case cases[] = {
        {makeShape<Geometry::Cylinder>(0.1), center, top},
        {makeShape<Geometry::Ellipsoid>(Vec3(0.1, 0.1, 0.3)), center, top},
        {makeShape<Geometry::Torus>(0.4, 0.1), turnedAboutY(center + Vec3(0, 0.4, 0)), Vec3(0, -0.3, 0)}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.shape->getTypeId());
        SuspendedPendulum scene(c.shape, c.X_GS, c.hint_S);
        SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
        integrator.setAccuracy(1e-7);
        SimTK::TimeStepper stepper(scene.system, integrator);
        stepper.initialize(scene.system.realizeTopology());
        stepper.stepTo(20);
        const State& state = stepper.getState();
        scene.system.realize(state, Stage::Velocity);
        EXPECT_NEAR(scene.cable.getLength(state), expected, 1e-6);
        EXPECT_NEAR(scene.cable.getLengthRate(state), 0, 1e-6);
        EXPECT_NEAR(scene.spring.getTension(state), SuspendedPendulum::kStiffness * expected, 1e-4);
        EXPECT_EQ(scene.cable.calcStatus(state), PathStatus::Solved);
    }
}

/** OpenSim's test has it at rest over a sphere too, where the ends are more than half a turn apart: a saddle. The
string slips off sideways as soon as the center stands on the line between the ends. */
TEST(PeerCases, ASuspendedPendulumLosesASphere) {
    SuspendedPendulum scene(makeShape<Geometry::Sphere>(0.1), Transform(Vec3(0.25, 0, 0)), Vec3(0, 0.1, 0));
    std::vector<ContactEvent> events;
    scene.cable.setContactListener([&](const ContactEvent& event) { events.push_back(event); });
    const auto simulate = [&](Real time) {
        SimTK::RungeKuttaMersonIntegrator integrator(scene.system);
        integrator.setAccuracy(1e-7);
        SimTK::TimeStepper stepper(scene.system, integrator);
        stepper.initialize(scene.system.realizeTopology());
        stepper.stepTo(time);
        return integrator.getState();
    };
    const State late = simulate(2);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events[0].kind, ContactEvent::Kind::Slipped);
    EXPECT_NEAR(simulate(events[0].time).getQ()[0], -std::atan(0.2), 1e-3);
    scene.system.realize(late, Stage::Position);
    EXPECT_EQ(scene.cable.calcStatus(late), PathStatus::Solved);
}

/** Two links from the ground on, each turning about one end, with its center a meter from there. */
struct TwoLinks : BareScene {
    TwoLinks()
        : first(matter.Ground(), Transform(), makeBody(), Transform(Vec3(-1, 0, 0))),
          second(first, Transform(), makeBody(), Transform(Vec3(-1, 0, 0))) {}
    MobilizedBody::Pin first, second;
};

/** What a tension puts on the bodies of its path, and on no other. OpenSim lets a negative one pull
at nothing; here it is an error. */
TEST(PeerCases, ATensionActsOnTheBodiesOfItsPathAlone) {
    TwoLinks links;
    Cable cable(links.cables, SimTK::GroundIndex, Vec3(0.05, 0.05, 0), links.first, Vec3(-0.75, 0.1, 0), "c");
    const State state = links.system.realizeTopology();
    links.system.realize(state, Stage::Position);
    const auto calcForces = [&](Real tension) {
        SimTK::Vector_<SpatialVec> forces(3, SpatialVec(Vec3(0)));
        SimTK::Vector mobilityForces(state.getNU(), Real(0));
        cable.applyBodyForces(state, tension, forces);
        cable.applyMobilityForces(state, tension, mobilityForces);
        EXPECT_EQ(mobilityForces.norm(), 0) << "nothing moves on its body";
        return forces;
    };
    const Vec3 from(0.05, 0.05, 0), to(0.25, 0.1, 0), e = (to - from).normalize();
    const SimTK::Vector_<SpatialVec> unit = calcForces(1), none = calcForces(0), unknown = calcForces(SimTK::NaN);
    EXPECT_LT((unit[0] - SpatialVec(from % e, e)).norm(), 1e-15);
    EXPECT_LT((unit[1] - SpatialVec(-((to - Vec3(1, 0, 0)) % e), -e)).norm(), 1e-15);
    for (int b = 0; b < 3; ++b) {
        EXPECT_EQ(none[b].norm(), 0) << b;
        EXPECT_EQ(SimTK::isNaN(unknown[b].norm()), b < 2) << b;
    }
    EXPECT_EQ(unit[2].norm(), 0);
    EXPECT_MESSAGE(calcForces(-1), "cable 'c': a string cannot push, but the tension is -1");
}

/** A path over a drum on one link to the next, with a point on the way: its elements, by their numbers. */
TEST(PeerCases, APathGivesAccessToWhatItIsMadeOf) {
    TwoLinks links;
    Cable cable(links.cables, SimTK::GroundIndex, Vec3(0.05, 0.05, 0), links.second, Vec3(-0.25, 0.1, 0), "c");
    const CableElementIndex point = cable.addViaPoint(links.first, Vec3(-0.75, 0.1, 0));
    const CableElementIndex drum =
        cable.addObstacle(links.first, Vec3(-0.5, 0.1, 0), makeShape<Geometry::Cylinder>(0.1), Vec3(0, 0.1, 0));
    EXPECT_EQ(cable.getNumElements(), 4);
    EXPECT_EQ(cable.getNumObstacles(), 1);
    EXPECT_EQ(cable.getNumViaPoints(), 1);
    EXPECT_EQ(cable.getViaPoint(0), point);
    EXPECT_EQ(cable.getObstacle(0), drum);
    EXPECT_EQ(cable.getElementBody(drum), links.first.getMobilizedBodyIndex());
    EXPECT_EQ(cable.getElementFrame(drum).p(), Vec3(-0.5, 0.1, 0));
    EXPECT_EQ(cable.getSurface(drum)->getDescription(), "cylinder(radius=0.1)");
    EXPECT_EQ(cable.getSurface(point), nullptr);
    EXPECT_MESSAGE(cable.getViaPoint(1), "cable 'c': no via point 1 of 1");
    EXPECT_MESSAGE(cable.getObstacle(1), "cable 'c': no obstacle 1 of 1");
    const State state = links.system.realizeTopology();
    EXPECT_NO_THROW(links.system.realize(state, Stage::Acceleration));
    EXPECT_EQ(cable.getStatus(state), PathStatus::Solved);
}

/** Two paths over one drum of radius r whose axis is as high as the ends beside it: when it grows, both get longer, by
what two tangents and an arc say. */
TEST(PeerCases, AGreaterDrumLengthensAllPathsOverIt) {
    TwoLinks links;
    std::vector<Cable> cables;
    for (int i = 0; i < 2; ++i) {
        cables.emplace_back(links.cables, SimTK::GroundIndex, Vec3(0.05, 0.05, 0), links.second, Vec3(-0.25, 0.1, 0));
        cables.back().addViaPoint(links.first, Vec3(-0.75, 0.1, 0));
        cables.back().addObstacle(links.first, Vec3(-0.5, 0.1, 0), makeShape<Geometry::Cylinder>(0.1), Vec3(0, 0.1, 0));
    }
    // In ground: the point at (0.25, 0.1), the drum at (0.5, 0.1), the end at (1.75, 0.1).
    const Real a = 0.25, b = 1.25, first = std::hypot(0.2, 0.05);
    for (const Real r : {0.1, 0.2}) {
        SCOPED_TRACE(r);
        for (Cable& cable : cables) cable.setSurface(cable.getObstacle(0), makeShape<Geometry::Cylinder>(r));
        const State state = links.system.realizeTopology();
        links.system.realize(state, Stage::Position);
        const Real arc = SimTK::Pi - std::acos(r / a) - std::acos(r / b);
        const Real over = std::sqrt(a * a - r * r) + std::sqrt(b * b - r * r) + r * arc;
        for (const Cable& cable : cables) EXPECT_NEAR(cable.getLength(state), first + over, 1e-12);
        EXPECT_EQ(cables[0].getLength(state), cables[1].getLength(state));
    }
}

/** A cylinder about the joint between two links, the ends half a meter from it on either side. */
TEST(PeerCases, TheMomentArmAboutAJointIsTheRadiusUntilTheStringLifts) {
    BareScene scene;
    const Real offset = 0.5, radius = 0.2;
    MobilizedBody::Pin joint(scene.matter.Ground(), Transform(), makeBody(), Transform(Vec3(-1, 0, 0)));
    Cable cable(scene.cables, SimTK::GroundIndex, Vec3(-offset, 0, 0), joint, Vec3(-offset, 0, 0));
    const CableElementIndex cylinder =
        cable.addObstacle(SimTK::GroundIndex, Transform(), makeShape<Geometry::Cylinder>(radius), Vec3(0, radius, 0));
    State state = scene.system.realizeTopology();
    const auto calcMomentArm = [&](Real angle) {
        joint.setAngle(state, angle);
        scene.system.realize(state, Stage::Position);
        return cable.calcMomentArm(state, joint, SimTK::MobilizerUIndex(0));
    };
    EXPECT_NEAR(calcMomentArm(0), radius, 1e-12);
    EXPECT_TRUE(cable.isTouched(state, cylinder));
    const Real length = std::sqrt(2.0) * offset;
    EXPECT_NEAR(calcMomentArm(kQuarterTurn), std::sqrt(offset * offset - 0.25 * length * length), 1e-12);
    EXPECT_NEAR(cable.getLength(state), length, 1e-14);
    EXPECT_FALSE(cable.isTouched(state, cylinder));
    // Where the links fold together the string is a point, which pulls nowhere; the arm is the offset just before.
    EXPECT_NEAR(calcMomentArm(SimTK::Pi - 1e-7), offset, 1e-12);
    calcMomentArm(SimTK::Pi);
    EXPECT_NEAR(cable.getLength(state), 0, 1e-15);
}

}  // namespace
}  // namespace tautline::testing
