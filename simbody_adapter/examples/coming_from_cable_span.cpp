// SPDX-License-Identifier: Apache-2.0
/** One scene with Simbody's CableSpan (3.8 and later) and with Tautline's Cable: a path over a cylinder on a moving
body and through a via point. The page simbody_adapter/guide/coming_from_cable_span.md shows both. Ends with 0 if they
answer alike, or as in closed form where this Simbody has no CableSpan. */
#include <Simbody.h>
#include <tautline/simbody/cable.h>

#include <cmath>
#include <iostream>

/** What both are asked. */
struct Answer {
    double length, rate, arc;
    SimTK::SpatialVec forceOnBody;  ///< of the cylinder at unit tension, about its body's origin, in ground
};

#ifdef TAUTLINE_SIMBODY_HAS_CABLE_SPAN
namespace before {
using namespace SimTK;

Answer ask() {
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    CableSubsystem cables(system);
    const Body::Rigid body(MassProperties(1, Vec3(0), UnitInertia(1)));
    MobilizedBody::Slider slider(matter.Ground(), Transform(Rotation(Pi / 2, ZAxis), Vec3(0)), body,
                                 Transform(Rotation(Pi / 2, ZAxis)));

    CableSpan cable(cables, matter.Ground(), Vec3(-2, 0, 0), matter.Ground(), Vec3(2, 0, 1));
    CableSpanObstacleIndex cylinder = cable.addObstacle(
        slider, Transform(Vec3(0, -0.2, 0)), std::make_shared<ContactGeometry::Cylinder>(0.5), Vec3(0, 0.5, 0));
    cable.addViaPoint(matter.Ground(), Vec3(1.5, 0.1, 0.5));

    State state = system.realizeTopology();
    slider.setOneQ(state, 0, 0.1);
    slider.setOneU(state, 0, 1);
    system.realize(state, Stage::Velocity);
    Answer answer{
        cable.calcLength(state), cable.calcLengthDot(state), cable.calcCurveSegmentArcLength(state, cylinder), {}};
    cable.calcCurveSegmentUnitForce(state, cylinder, answer.forceOnBody);
    return answer;
}
}  // namespace before
#endif

namespace after {
using namespace SimTK;

Answer ask() {
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    tautline::CablePathSubsystem cables(system);
    const Body::Rigid body(MassProperties(1, Vec3(0), UnitInertia(1)));
    MobilizedBody::Slider slider(matter.Ground(), Transform(Rotation(Pi / 2, ZAxis), Vec3(0)), body,
                                 Transform(Rotation(Pi / 2, ZAxis)));

    tautline::Cable cable(cables, matter.Ground(), Vec3(-2, 0, 0), matter.Ground(), Vec3(2, 0, 1));
    tautline::CableElementIndex cylinder = cable.addObstacle(
        slider, Transform(Vec3(0, -0.2, 0)), std::make_shared<ContactGeometry::Cylinder>(0.5), Vec3(0, 0.5, 0));
    cable.addViaPoint(matter.Ground(), Vec3(1.5, 0.1, 0.5));

    State state = system.realizeTopology();
    slider.setOneQ(state, 0, 0.1);
    slider.setOneU(state, 0, 1);
    system.realize(state, Stage::Velocity);
    return {cable.getLength(state), cable.getLengthRate(state), cable.getArcLength(state, cylinder),
            cable.calcUnitForceAboutBodyOrigin(state, cylinder)};
}
}  // namespace after

/** A helix over the cylinder of radius r about z, which stands at (0, y), between tangents; then a straight line. */
Answer calcClosedForm() {
    const double r = 0.5, y = -0.1;
    const double a = std::hypot(2, y), b = std::hypot(1.5, 0.1 - y);
    const double from = std::atan2(-y, -2), to = std::atan2(0.1 - y, 1.5);
    const double turn = from - to - std::acos(r / a) - std::acos(r / b);
    const double across = std::sqrt(a * a - r * r) + std::sqrt(b * b - r * r) + r * turn;
    const double length = std::hypot(across, 0.5) + std::hypot(std::hypot(0.5, 0.1), 0.5);
    return {length, 0, r * turn * std::hypot(across, 0.5) / across, {}};
}

int main() {
    const Answer now = after::ask();
    std::cout << "Tautline:  length " << now.length << " m, rate " << now.rate << " m/s, arc " << now.arc
              << " m, force " << now.forceOnBody << "\n";
#ifdef TAUTLINE_SIMBODY_HAS_CABLE_SPAN
    const Answer expected = before::ask();
    std::cout << "CableSpan: length " << expected.length << " m, rate " << expected.rate << " m/s, arc " << expected.arc
              << " m, force " << expected.forceOnBody << "\n";
    const double forces = (now.forceOnBody - expected.forceOnBody).norm() + std::abs(now.rate - expected.rate);
#else
    const Answer expected = calcClosedForm();
    // The power of the forces is minus the rate.
    const double forces = std::abs(now.forceOnBody[1][1] + now.rate);
#endif
    const double worst = std::abs(now.length - expected.length) + std::abs(now.arc - expected.arc) + forces;
    if (worst < 1e-3) return 0;
    std::cout << "they differ by " << worst << "\n";
    return 1;
}
