// SPDX-License-Identifier: Apache-2.0
/** The planar chain of four quarter circles over two tori, an ellipsoid and a cylinder, whose answer is
known in closed form: length 15 + pi/2 (1 + 1 + 1.5 + 2). */
#include "adapter_scenes.h"

namespace tautline::testing {
namespace {

struct QuarterCircles : BareScene {
    QuarterCircles() {
        const Real c = std::sqrt(0.5);
        const Real turned = SimTK::Pi / 2;
        MobilizedBody ground = matter.Ground();
        MobilizedBody::Weld start(ground, Transform(), makeBody(), Transform());
        MobilizedBody::Weld end(ground, Transform(SimTK::Vec3(-4, 0, 0)), makeBody(), Transform());
        cable = Cable(cables, start, SimTK::Vec3(0), end, SimTK::Vec3(0), "quarters");
        add(turned, {1, 11, 0}, std::make_shared<Torus>(10, 1), {1 - c, 1 + c, 0});
        add(0, {4.5, 1, 0}, std::make_shared<Ellipsoid>(Vector3(1, 1, 6)), {4.5 + c, 1 + c, 0});
        add(turned, {4, -12, 0}, std::make_shared<Torus>(10, 1.5), {4 + 1.5 * c, -2 - 1.5 * c, 0});
        add(0, {-2, -1.5, 0}, std::make_shared<Cylinder>(2), {-2 - 2 * c, -1.5 - 2 * c, 0});
        state = system.realizeTopology();
        system.realize(state, Stage::Velocity);
    }

    /** Each obstacle stands on a body of its own, whose origin is the obstacle's center. */
    void add(Real angleAboutY, const SimTK::Vec3& center_G, std::shared_ptr<const Surface> surface,
             const SimTK::Vec3& hint_G) {
        const SimTK::Rotation R_GS(angleAboutY, SimTK::YAxis);
        MobilizedBody::Weld body(matter.Ground(), Transform(center_G), makeBody(), Transform());
        cable.addObstacle(body, Transform(R_GS), surface, ~R_GS * (hint_G - center_G));
    }

    Cable cable;
    State state;
};

TEST(QuarterCirclesTest, LengthArcsAndStatus) {
    QuarterCircles scene;
    EXPECT_EQ(scene.cable.getStatus(scene.state), PathStatus::Solved);
    EXPECT_NEAR(scene.cable.getLength(scene.state), 15 + SimTK::Pi / 2 * 5.5, 1e-10);
    const Real radii[] = {1, 1, 1.5, 2};
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(scene.cable.getArcLength(scene.state, CableElementIndex(i + 1)), SimTK::Pi / 2 * radii[i], 1e-9);
    EXPECT_NEAR(scene.cable.getLengthRate(scene.state), 0, 1e-15);
}

/** The direction of the path and the outward normal where it meets and leaves each obstacle, and on the way between. */
TEST(QuarterCirclesTest, FramesAlongTheArcs) {
    QuarterCircles scene;
    struct Arc {
        SimTK::Vec3 center, tangent, normal;
        Real radius;
    };
    const Arc arcs[] = {{{1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, 1},
                        {{4.5, 1, 0}, {1, 0, 0}, {0, 1, 0}, 1},
                        {{4, -2, 0}, {0, -1, 0}, {1, 0, 0}, 1.5},
                        {{-2, -1.5, 0}, {-1, 0, 0}, {0, -1, 0}, 2}};
    const int count = 7;
    for (int i = 0; i < 4; ++i) {
        SCOPED_TRACE(i);
        const Arc& arc = arcs[i];
        const CableElementIndex obstacle(i + 1);
        const std::vector<Transform> frames = scene.cable.calcResampledArcFrames(scene.state, obstacle, count);
        const std::vector<SimTK::Vec3> points = scene.cable.calcResampledArc(scene.state, obstacle, count);
        ASSERT_EQ(frames.size(), static_cast<std::size_t>(count));
        for (int k = 0; k < count; ++k) {
            const Real angle = k * SimTK::Pi / 2 / (count - 1);  // turned clockwise
            const SimTK::Vec3 normal = std::cos(angle) * arc.normal + std::sin(angle) * arc.tangent;
            const SimTK::Vec3 tangent = std::cos(angle) * arc.tangent - std::sin(angle) * arc.normal;
            EXPECT_LT((frames[k].p() - (arc.center + arc.radius * normal)).norm(), 1e-9) << k;
            EXPECT_LT((frames[k].x() - tangent).norm(), 1e-9) << k;
            EXPECT_LT((frames[k].y() - normal).norm(), 1e-9) << k;
            EXPECT_LT((frames[k].z() - SimTK::Vec3(0, 0, 1)).norm(), 1e-9) << k;
            EXPECT_EQ(frames[k].p(), points[k]);
        }
        Transform X_GP, X_GQ;
        ASSERT_TRUE(scene.cable.getContactFrames(scene.state, obstacle, X_GP, X_GQ));
        for (const auto& [frame, end] : {std::pair(frames.front(), X_GP), std::pair(frames.back(), X_GQ)}) {
            EXPECT_LT((frame.p() - end.p()).norm(), 1e-12);
            EXPECT_LT((frame.R().asMat33() - end.R().asMat33()).norm(), 1e-12);
        }
    }
}

TEST(QuarterCirclesTest, WrenchesAboutBodyOrigins) {
    QuarterCircles scene;
    // In the order of the bodies: ground, start, end, and the obstacles along the path.
    const SimTK::Vec3 forces[] = {{0, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
    const Real momentsAboutGround[] = {0, 0, 4, -2, -3.5, 2, -0.5};
    SimTK::Vector_<SimTK::SpatialVec> F_G;
    scene.cable.calcUnitBodyForces(scene.state, F_G);
    ASSERT_EQ(F_G.size(), 7);
    for (SimTK::MobilizedBodyIndex b(0); b < 7; ++b) {
        const SimTK::Vec3 p_GB = scene.matter.getMobilizedBody(b).getBodyOriginLocation(scene.state);
        const SimTK::Vec3 moment = F_G[b][0] + p_GB % F_G[b][1];
        EXPECT_LT((F_G[b][1] - forces[b]).norm(), 1e-9) << b << ": " << F_G[b];
        EXPECT_LT((moment - SimTK::Vec3(0, 0, momentsAboutGround[b])).norm(), 1e-8) << b << ": " << moment;
    }
}

}  // namespace
}  // namespace tautline::testing
