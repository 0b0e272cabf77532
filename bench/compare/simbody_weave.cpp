// SPDX-License-Identifier: Apache-2.0
#include "simbody_weave.h"

#include <iostream>

#include "tautline/simbody/conversions.h"

namespace tautline::compare {
namespace {

using SimTK::Transform;

/** Has nothing printed to std::cout while it lives, not even formatted, so that printing is not timed. */
class Silence {
public:
    Silence() : m_saved(std::cout.rdbuf(nullptr)) {}
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;
    ~Silence() { std::cout.rdbuf(m_saved); }

private:
    std::streambuf* m_saved;
};

/** Bodies with a cable over them, and the same bodies without. */
struct TautlineWeave {
    TautlineWeave(const WeaveRow& row, double tolerance) : with(row), without(row), cables(with.system) {
        const SimTK::MobilizedBody& ground = with.matter.Ground();
        cable = Cable(cables, ground, with.getEnd(false), ground, with.getEnd(true));
        cable.setOptions(makeOptions(tolerance));
        with.forEachElement(
            [&](int i) {
                cable.addObstacle(with.bodies[static_cast<std::size_t>(i)], Transform(),
                                  row.problem.getElement(row.hasPointsBetween ? 2 * i + 1 : i + 1).surface,
                                  with.getHint(i));
            },
            [&](const Vector3& point) { cable.addViaPoint(ground, toSimTK(point)); });
        with.begin();
        without.begin();
        cable.setContactMode(with.state, ContactMode::Tracked);  // as CableSpan decides about contacts
        cable.continueFrom(with.state, row.start);
    }

    double step(int k) {
        with.moveTo(k);
        const double length = cable.getLength(with.state);
        with.state.autoUpdateDiscreteVariables();  // as an integrator does when it accepts a step
        return length;
    }

    WeaveBodies with, without;
    CablePathSubsystem cables;
    Cable cable;
};

struct CablePathWeave {
    explicit CablePathWeave(const WeaveRow& row) : with(row), without(row), cables(with.system) {
        const Silence silence;
        const SimTK::MobilizedBody& ground = with.matter.Ground();
        SimTK::CablePath path(cables, ground, with.getEnd(false), ground, with.getEnd(true));
        with.forEachElement(
            [&](int i) {
                SimTK::CableObstacle::Surface surface(path, with.bodies[static_cast<std::size_t>(i)], Transform(),
                                                      with.makeGeometry());
                const GeodesicStart& start = row.start.contacts[static_cast<std::size_t>(i) + 1].start;
                const SimTK::Vec3 P = toSimTK(start.point.p);
                surface.setNearPoint(with.getHint(i));
                surface.setContactPointHints(P, SimTK::Vec3(-P[0], P[1], P[2]));
            },
            [&](const Vector3& point) { SimTK::CableObstacle::ViaPoint(path, ground, toSimTK(point)); });
        with.begin();
        without.begin();
    }

    double step(int k) {
        const Silence silence;
        with.moveTo(k);
        // It goes on from what its cache holds: there is nothing to update.
        return cables.getCablePath(SimTK::CablePathIndex(0)).getCableLength(with.state);
    }

    WeaveBodies with, without;
    SimTK::CableTrackerSubsystem cables;
};

#if TAUTLINE_SIMBODY_HAS_CABLE_SPAN
struct CableSpanWeave {
    CableSpanWeave(const WeaveRow& row, double tolerance, bool isRootFinder)
        : with(row), without(row), cables(with.system) {
        const SimTK::MobilizedBody& ground = with.matter.Ground();
        cable = SimTK::CableSpan(cables, ground, with.getEnd(false), ground, with.getEnd(true));
        cable.setCurveSegmentAccuracy(tolerance);
        cable.setSmoothnessTolerance(tolerance);
        cable.setAlgorithm(isRootFinder ? SimTK::CableSpanAlgorithm::Scholz2015
                                        : SimTK::CableSpanAlgorithm::MinimumLength);
        with.forEachElement(
            [&](int i) {
                cable.addObstacle(with.bodies[static_cast<std::size_t>(i)], Transform(),
                                  std::make_shared<SimTK::ContactGeometry>(with.makeGeometry()), with.getHint(i));
            },
            [&](const Vector3& point) { cable.addViaPoint(ground, toSimTK(point)); });
        with.begin();
        without.begin();
    }

    double step(int k) {
        with.moveTo(k);
        const double length = cable.calcLength(with.state);
        with.state.autoUpdateDiscreteVariables();
        return length;
    }

    WeaveBodies with, without;
    SimTK::CablePathSubsystem cables;
    SimTK::CableSpan cable;
};
#endif

template <class Weave>
Contestant makeContestant(const char* way, const char* rival, const std::shared_ptr<Weave>& weave) {
    return {way, [weave](int k) { return weave->step(k); }, [weave](int k) { weave->without.moveTo(k); }, rival};
}

}  // namespace

WeaveBodies::WeaveBodies(const WeaveRow& row_) : row(row_) {
    const SimTK::Body::Rigid body(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(0.1)));
    for (int i = 0; i < row.count; ++i)
        bodies.push_back(SimTK::MobilizedBody::Free(matter.Ground(), Transform(), body, Transform()));
}

void WeaveBodies::begin() {
    state = system.realizeTopology();
    matter.setUseEulerAngles(state, true);
    system.realizeModel(state);
    for (const PathPose& pose : row.poses) {
        for (int e = 0; e < row.problem.getNumElements(); ++e)
            if (const int i = row.getObstacle(e); i >= 0)
                bodies[static_cast<std::size_t>(i)].setQToFitTransform(
                    state, toTransform(pose.X_GE[static_cast<std::size_t>(e)]));
        m_q.push_back(state.getQ());
    }
    state.updQ() = m_q.front();
}

void WeaveBodies::moveTo(int pose) {
    state.updQ() = m_q[static_cast<std::size_t>(pose)];
    system.realize(state, SimTK::Stage::Position);
}

SimTK::Vec3 WeaveBodies::getEnd(bool isInsertion) const {
    const std::vector<Pose>& X_GE = row.poses.front().X_GE;
    return toSimTK(isInsertion ? X_GE.back().p : X_GE.front().p);
}

SimTK::ContactGeometry WeaveBodies::makeGeometry() const {
    if (row.kind == Kind::Cylinders) return SimTK::ContactGeometry::Cylinder(0.4);
    if (row.kind == Kind::Spheres) return SimTK::ContactGeometry::Sphere(0.4);
    return SimTK::ContactGeometry::Ellipsoid(SimTK::Vec3(0.45, 0.4, 0.9));
}

Contestant makeThroughSimbody(const WeaveRow& row, double tolerance) {
    return makeContestant(kThroughSimbody, kCore, std::make_shared<TautlineWeave>(row, tolerance));
}

Contestant makeCablePath(const WeaveRow& row) {
    return makeContestant("SimTK::CablePath", kThroughSimbody, std::make_shared<CablePathWeave>(row));
}

#if TAUTLINE_SIMBODY_HAS_CABLE_SPAN
Contestant makeCableSpan(const WeaveRow& row, double tolerance, bool isRootFinder) {
    const char* way = isRootFinder ? "SimTK::CableSpan, root finder" : "SimTK::CableSpan, minimum length";
    return makeContestant(way, kThroughSimbody, std::make_shared<CableSpanWeave>(row, tolerance, isRootFinder));
}
#endif

}  // namespace tautline::compare
