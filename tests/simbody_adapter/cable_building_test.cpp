// SPDX-License-Identifier: Apache-2.0
#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

TEST(CableBuilding, ElementsStandInOrderBeforeTheInsertion) {
    MechanismScene scene;
    ASSERT_EQ(scene.cable.getNumElements(), 6);
    EXPECT_EQ(scene.cable.getElementName(CableElementIndex(0)), "origin");
    EXPECT_EQ(scene.cable.getElementName(CableElementIndex(5)), "insertion");
    EXPECT_EQ(scene.cable.getElementName(scene.point), "point2");
    EXPECT_EQ(scene.cable.findElement("obstacle3"), scene.cylinder);
    EXPECT_FALSE(scene.cable.isObstacle(scene.point));
    EXPECT_TRUE(scene.cable.isObstacle(scene.ellipsoid));
    EXPECT_EQ(scene.cables.getNumCables(), 1);
    EXPECT_EQ(scene.cables.getCable(CableIndex(0)).getName(), "mechanism");
}

TEST(CableBuilding, RefusesBadInputByNameAndValue) {
    BareScene scene;
    MobilizedBody ground = scene.matter.Ground();
    const auto sphere = std::make_shared<Sphere>(1.0);
    EXPECT_MESSAGE(Cable(scene.cables, ground, SimTK::Vec3(SimTK::NaN), ground, SimTK::Vec3(0), "a"),
                   "cable 'a': an end is not finite");
    EXPECT_EQ(scene.cables.getNumCables(), 0);
    Cable cable(scene.cables, ground, SimTK::Vec3(0), ground, SimTK::Vec3(1), "b");
    EXPECT_MESSAGE(cable.addObstacle(ground, Transform(), std::shared_ptr<const Surface>(), std::nullopt, "o"),
                   "cable 'b': obstacle 'o' has no surface");
    EXPECT_MESSAGE(cable.addObstacle(ground, Transform(), sphere, SimTK::Vec3(SimTK::NaN), "o"),
                   "the hint of obstacle 'o' must be finite, but is (nan nan nan)");
    cable.addObstacle(ground, Transform(), sphere, std::nullopt, "o");
    EXPECT_MESSAGE(cable.addViaPoint(ground, SimTK::Vec3(0), "o"), "an element 'o' already");
    EXPECT_MESSAGE(cable.addViaPoint(ground, SimTK::Vec3(SimTK::Infinity), "p"), "'p' is not finite");
    EXPECT_MESSAGE(cable.setHint(CableElementIndex(0), std::nullopt), "'origin' is a point");
    EXPECT_MESSAGE(cable.findElement("x"), "cable 'b': no element 'x'");
    EXPECT_MESSAGE(scene.cables.getCable(CableIndex(7)), "no cable 7 of 1");
    EXPECT_MESSAGE(Cable().getName(), "empty handle");
    PathSolverOptions options;
    options.maxIterations = 0;
    EXPECT_MESSAGE(cable.setOptions(options), "maxIterations must be at least 1, but is 0");
}

TEST(CableBuilding, StartsBySideWindingAndHole) {
    BareScene scene;
    MobilizedBody ground = scene.matter.Ground();
    const auto addCable = [&](const SimTK::Vec3& A, const SimTK::Vec3& B, std::shared_ptr<const Surface> surface,
                              const StartHint& hint) {
        Cable cable(scene.cables, ground, A, ground, B);
        cable.addObstacle(ground, Transform(), std::move(surface), hint);
        return cable;
    };
    const auto cylinder = std::make_shared<Cylinder>(0.5);
    const SimTK::Vec3 A(-2, 0.1, 0), B(2, 0.1, 0);
    const Cable above = addCable(A, B, cylinder, PassOnSide{Vector3(0, 1, 0)});
    const Cable below = addCable(A, B, cylinder, PassOnSide{Vector3(0, -1, 0)});
    const Cable wound = addCable(A, B, cylinder, WindAround{1.5});
    const auto torus = std::make_shared<Torus>(1, 0.3);
    const SimTK::Vec3 C(1.5, 0, -2), D(1.5, 0, 2);
    const Cable beside = addCable(C, D, torus, ThreadHole{0});
    const Cable threaded = addCable(C, D, torus, ThreadHole{1});
    const State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    // Tangents and arc over a circle of radius 0.5 between points at the distance a on either side.
    const Real a = std::hypot(2, 0.1), tangents = 2 * std::sqrt(a * a - 0.25), off = 2 * std::acos(0.5 / a);
    const Real angle = SimTK::Pi - 2 * std::atan(0.05);
    EXPECT_NEAR(above.getLength(state), tangents + 0.5 * (angle - off), 1e-12);
    EXPECT_NEAR(below.getLength(state), tangents + 0.5 * (2 * SimTK::Pi - angle - off), 1e-12);
    // Counterclockwise, from x < 0 to x > 0, past the bottom and once round more.
    EXPECT_NEAR(wound.getLength(state), tangents + 0.5 * (4 * SimTK::Pi - angle - off), 1e-12);
    EXPECT_NEAR(beside.getLength(state), 4, 1e-12);
    // Inside the tube's circle at x = 1 from a point 0.5 outside of it.
    const Real c = std::hypot(0.5, 2);
    EXPECT_NEAR(threaded.getLength(state),
                2 * std::sqrt(c * c - 0.09) + 0.3 * (2 * (SimTK::Pi - std::atan(4)) - 2 * std::acos(0.3 / c)), 1e-10);
    EXPECT_MESSAGE(addCable(A, B, cylinder, ThreadHole{1}), "has no hole to thread");
    EXPECT_MESSAGE(addCable(A, B, cylinder, PassOnSide{Vector3::Zero()}), "needs a finite direction that is not zero");
}

TEST(CableBuilding, RefusesABodyOfAnotherSystem) {
    BareScene scene, other;
    MobilizedBody ground = scene.matter.Ground(), stranger = other.matter.Ground();
    EXPECT_MESSAGE(Cable(scene.cables, ground, SimTK::Vec3(0), stranger, SimTK::Vec3(1), "c"),
                   "does not belong to the cable's system");
}

TEST(CableBuilding, BodiesAreGivenByHandleOrIndex) {
    BareScene scene, other;
    MobilizedBody::Free body(scene.matter.Ground(), Transform(), makeBody(), Transform());
    Cable cable(scene.cables, SimTK::GroundIndex, SimTK::Vec3(0), body, SimTK::Vec3(1), "c");
    const CableElementIndex point = cable.addViaPoint(SimTK::MobilizedBodyIndex(1), SimTK::Vec3(0, 1, 0));
    const CableElementIndex sphere = cable.addObstacle(body, Transform(), std::make_shared<Sphere>(0.1));
    EXPECT_EQ(cable.getElementBody(point), body.getMobilizedBodyIndex());
    EXPECT_EQ(cable.getNumObstacles(), 1);
    EXPECT_EQ(cable.getNumViaPoints(), 1);
    EXPECT_EQ(cable.getObstacle(0), sphere);
    EXPECT_EQ(cable.getViaPoint(0), point);
    EXPECT_EQ(cable.getOrigin(), CableElementIndex(0));
    EXPECT_EQ(cable.getInsertion(), CableElementIndex(3));
    EXPECT_MESSAGE(cable.getObstacle(1), "cable 'c': no obstacle 1 of 1");
    EXPECT_MESSAGE(cable.addViaPoint(SimTK::MobilizedBodyIndex(5), SimTK::Vec3(0)), "cable 'c': no body 5 of 2");
    EXPECT_MESSAGE(cable.addViaPoint(other.matter.Ground(), SimTK::Vec3(0)), "does not belong to the cable's system");
}

/** A cable that is changed into another answers as one that was built so. */
TEST(CableBuilding, WhatIsSetLaterIsAsIfBuiltSo) {
    BareScene scene;
    MobilizedBody::Free body(scene.matter.Ground(), Transform(SimTK::Vec3(0, 0.1, 0)), makeBody(), Transform());
    const auto sphere = std::make_shared<Sphere>(0.4);
    const auto torus = std::make_shared<Torus>(1, 0.3);
    const Transform X_BS(SimTK::Rotation(0.05, SimTK::XAxis), SimTK::Vec3(0.1, -1.15, 0));
    const SimTK::Vec3 A(-2, 0, 0), B(2, 0.1, 0.1), via(1.5, 0.2, 0);
    Cable built(scene.cables, body, A, scene.matter.Ground(), B);
    built.addObstacle(body, X_BS, torus, passOnSide(SimTK::Vec3(0, 1, 0)));
    built.addViaPoint(scene.matter.Ground(), via);
    Cable changed(scene.cables, scene.matter.Ground(), SimTK::Vec3(0), scene.matter.Ground(), SimTK::Vec3(1));
    changed.addObstacle(scene.matter.Ground(), Transform(), sphere);
    changed.addViaPoint(body, SimTK::Vec3(3));
    scene.system.realizeTopology();
    changed.setBody(changed.getOrigin(), body);
    changed.setStation(changed.getOrigin(), A);
    changed.setStation(changed.getInsertion(), B);
    changed.setBody(changed.getObstacle(0), body);
    changed.setObstacleFrame(changed.getObstacle(0), X_BS);
    changed.setSurface(changed.getObstacle(0), torus);
    changed.setHint(changed.getObstacle(0), passOnSide(SimTK::Vec3(0, 1, 0)));
    changed.setBody(changed.getViaPoint(0), scene.matter.Ground());
    changed.setStation(changed.getViaPoint(0), via);
    EXPECT_FALSE(scene.system.systemTopologyHasBeenRealized());
    const State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Acceleration);
    EXPECT_EQ(changed.getLength(state), built.getLength(state));
    EXPECT_EQ(built.getStatus(state), PathStatus::Solved) << built.explainStatus(state);
    EXPECT_TRUE(built.isTouched(state, built.getObstacle(0)));
    EXPECT_EQ(state.getNEventTriggersByStage(Stage::Position), 2 * 2);  // of both cables
    EXPECT_MESSAGE(changed.setStation(changed.getObstacle(0), A), "is an obstacle and has no station");
    EXPECT_MESSAGE(changed.setStation(changed.getViaPoint(0), SimTK::Vec3(SimTK::NaN)), "is not finite");
}

/** Points at equal distances and tangents, over a cylinder across the string: in closed form. */
TEST(CableBuilding, PathsAreResampledAtEqualDistances) {
    BareScene scene;
    constexpr Real radius = 0.5;
    Cable cable(scene.cables, SimTK::GroundIndex, SimTK::Vec3(-2, 0, 0), SimTK::GroundIndex, SimTK::Vec3(0, -2, 0));
    cable.addObstacle(SimTK::GroundIndex, Transform(), std::make_shared<Cylinder>(radius),
                      SimTK::Vec3(radius, radius, 0));
    const State state = scene.system.realizeTopology();
    scene.system.realize(state, Stage::Position);
    const CableElementIndex cylinder = cable.getObstacle(0);
    SimTK::UnitVec3 atP, atQ;
    SimTK::Vec3 P, Q;
    ASSERT_TRUE(cable.getContactTangents(state, cylinder, atP, atQ));
    ASSERT_TRUE(cable.getContactPoints(state, cylinder, P, Q));
    EXPECT_NEAR(~atP * cable.calcOriginTangent(state), 1, 1e-12);
    EXPECT_NEAR(~atQ * cable.calcInsertionTangent(state), 1, 1e-12);
    EXPECT_NEAR(~(P - SimTK::Vec3(-2, 0, 0)) * atP, (P - SimTK::Vec3(-2, 0, 0)).norm(), 1e-12);
    for (const int count : {2, 3, 10, 101}) {
        const std::vector<SimTK::Vec3> points = cable.calcResampledPoints(state, count);
        ASSERT_EQ(static_cast<int>(points.size()), count);
        EXPECT_EQ(points.front(), SimTK::Vec3(-2, 0, 0));
        EXPECT_EQ(points.back(), SimTK::Vec3(0, -2, 0));
        // Distance along the path: on a tangent, then as an angle about the axis.
        const Real tangent = std::sqrt(4 - radius * radius), arc = cable.getArcLength(state, cylinder);
        for (int i = 0; i < count; ++i) {
            const Real s = cable.getLength(state) * i / (count - 1);
            const Real onArc = std::min(std::max(s - tangent, Real(0)), arc);
            const Real fromAxis = s < tangent         ? std::hypot(radius, tangent - s)
                                  : s < tangent + arc ? radius
                                                      : std::hypot(radius, s - tangent - arc);
            EXPECT_NEAR(points[i].norm(), fromAxis, 1e-10) << i;
            if (s >= tangent && s <= tangent + arc) {
                EXPECT_NEAR((points[i] - P).norm(), 2 * radius * std::sin(onArc / radius / 2), 1e-10) << i;
            }
        }
        const std::vector<SimTK::Vec3> onArc = cable.calcResampledArc(state, cylinder, count);
        EXPECT_LT((onArc.front() - P).norm() + (onArc.back() - Q).norm(), 1e-12);
    }
    EXPECT_MESSAGE(cable.calcResampledPoints(state, 1), "at least 2 points, not to 1");
}

}  // namespace
}  // namespace tautline::testing
