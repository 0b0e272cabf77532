// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Scenes of the adapter's tests. */
#include <gtest/gtest.h>

#include "tautline/error.h"
#include "tautline/simbody/cable.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline::testing {

using SimTK::MobilizedBody;
using SimTK::Real;
using SimTK::Stage;
using SimTK::State;
using SimTK::Transform;

inline SimTK::Body::Rigid makeBody() {
    return SimTK::Body::Rigid(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(0.1)));
}

/** A system with cables and nothing else. */
struct BareScene {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    CablePathSubsystem cables{system};
};

/** A cable of everything: a sphere on a pinned body, a via point on a free one, a cylinder on ground, an
ellipsoid on a ball-jointed body; all touched near the default pose, nothing aligned with an axis. */
struct MechanismScene : BareScene {
    MechanismScene() {
        MobilizedBody ground = matter.Ground();
        MobilizedBody::Pin pinned(ground, Transform(SimTK::Vec3(-1.2, -0.4, 0.1)), makeBody(),
                                  Transform(SimTK::Vec3(0.05, -0.1, 0)));
        MobilizedBody::Free free(ground, Transform(), makeBody(), Transform());
        MobilizedBody::Ball ball(ground, Transform(SimTK::Vec3(2.0, -0.25, 0)), makeBody(),
                                 Transform(SimTK::Vec3(0, 0.05, 0.02)));
        MobilizedBody::Slider slider(ball, Transform(SimTK::Vec3(1, 0.3, 0)), makeBody(), Transform());
        cable = Cable(cables, ground, SimTK::Vec3(-2, 0, 0), slider, SimTK::Vec3(0, -0.2, 0.1), "mechanism");
        sphere = cable.addObstacle(pinned, Transform(SimTK::Vec3(0.02, 0.03, 0)), std::make_shared<Sphere>(0.5),
                                   SimTK::Vec3(0, 0.5, 0));
        point = cable.addViaPoint(free, SimTK::Vec3(0.1, -0.05, 0.02));
        cylinder = cable.addObstacle(ground, Transform(SimTK::Rotation(0.3, SimTK::YAxis), SimTK::Vec3(1, -0.25, 0)),
                                     std::make_shared<Cylinder>(0.4), SimTK::Vec3(0, 0.4, 0));
        ellipsoid = cable.addObstacle(ball, Transform(SimTK::Rotation(0.2, SimTK::XAxis), SimTK::Vec3(0)),
                                      std::make_shared<Ellipsoid>(Vector3(0.5, 0.45, 0.6)), SimTK::Vec3(0, 0.45, 0));
        system.realizeTopology();
    }

    /** A pose and speeds that depend on a number. */
    State makeState(Real number) const {
        State state = system.getDefaultState();
        for (int i = 0; i < state.getNQ(); ++i) state.updQ()[i] += 0.04 * std::sin(number + 1.7 * i);
        for (int i = 0; i < state.getNU(); ++i) state.updU()[i] = 0.6 * std::cos(2 * number + i);
        // Integrators keep quaternions unit, and so must a test that moves them by hand.
        system.realize(state, Stage::Time);
        matter.normalizeQuaternions(state);
        state.invalidateAllCacheAtOrAbove(Stage::Position);  // which that has realized in part
        return state;
    }

    Cable cable;
    CableElementIndex sphere, point, cylinder, ellipsoid;
};

/** Runs f and returns the message of what it throws. */
template <class Exception = std::exception, class F>
std::string catchMessage(F&& f) {
    try {
        f();
    } catch (const Exception& e) {
        return e.what();
    }
    return "nothing was thrown";
}

#define EXPECT_MESSAGE(statement, part)                                                          \
    EXPECT_NE(tautline::testing::catchMessage([&] { statement; }).find(part), std::string::npos) \
        << tautline::testing::catchMessage([&] { statement; })

}  // namespace tautline::testing
