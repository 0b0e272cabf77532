// SPDX-License-Identifier: Apache-2.0
#pragma once
/** One scene built twice: through Simbody's own cable paths and through Tautline, each in a System of its own. */
#include <iostream>
#include <sstream>

#include "adapter_scenes.h"

namespace tautline::testing {

/** Catches what is printed to std::cout while it lives: CablePath reports on itself there. */
class CoutCapture {
public:
    CoutCapture() : m_saved(std::cout.rdbuf(m_text.rdbuf())) {}
    CoutCapture(const CoutCapture&) = delete;
    ~CoutCapture() { std::cout.rdbuf(m_saved); }
    std::string getText() const { return m_text.str(); }

private:
    std::ostringstream m_text;
    std::streambuf* m_saved;
};

/** An element between origin and insertion, on a free body of its own that stands at X_GB by default. */
struct TwinElement {
    Transform X_GB;
    Transform X_BS;
    std::shared_ptr<const Surface> surface;  ///< null: a via point at the origin of S
    SimTK::ContactGeometry geometry;
    SimTK::Vec3 hint_S{0};               ///< for Tautline: a point near which the path runs
    SimTK::Vec3 hintP_S{0}, hintQ_S{0};  ///< for CablePath: where the arc may begin and end
};

inline TwinElement makePoint(const SimTK::Vec3& point_G) {
    return {Transform(point_G), Transform(SimTK::Vec3(0.03, -0.02, 0.01)), nullptr, {}, {}, {}, {}};
}
inline TwinElement makeSphere(Real radius, const Transform& X_GB, const SimTK::Vec3& P_S, const SimTK::Vec3& Q_S) {
    return {X_GB,
            Transform(SimTK::Vec3(0.02, 0.01, -0.03)),
            std::make_shared<Sphere>(radius),
            SimTK::ContactGeometry::Sphere(radius),
            (P_S + Q_S) / 2,
            P_S,
            Q_S};
}
inline TwinElement makeCylinder(Real radius, const Transform& X_GB, const SimTK::Vec3& P_S, const SimTK::Vec3& Q_S) {
    return {X_GB,
            Transform(SimTK::Vec3(-0.01, 0.02, 0.03)),
            std::make_shared<Cylinder>(radius),
            SimTK::ContactGeometry::Cylinder(radius),
            (P_S + Q_S) / 2,
            P_S,
            Q_S};
}
inline TwinElement makeEllipsoid(const SimTK::Vec3& radii, const Transform& X_GB, const SimTK::Vec3& P_S,
                                 const SimTK::Vec3& Q_S) {
    return {X_GB,
            Transform(SimTK::Vec3(0.01, 0.01, 0.02)),
            std::make_shared<Ellipsoid>(Vector3(radii[0], radii[1], radii[2])),
            SimTK::ContactGeometry::Ellipsoid(radii),
            (P_S + Q_S) / 2,
            P_S,
            Q_S};
}
inline TwinElement makeTorus(Real ring, Real tube, const Transform& X_GB, const SimTK::Vec3& P_S,
                             const SimTK::Vec3& Q_S) {
    return {X_GB,
            Transform(SimTK::Vec3(0.01, -0.02, 0.02)),
            std::make_shared<Torus>(ring, tube),
            SimTK::ContactGeometry::Torus(ring, tube),
            (P_S + Q_S) / 2,
            P_S,
            Q_S};
}

struct TwinScene {
    const char* name;
    SimTK::Vec3 origin_G, insertion_G;
    std::vector<TwinElement> elements;
    Real poseScale = 0.05;  ///< how far poses stray from the default, in m and quaternion components
};

/** What a cable says at one pose. */
struct TwinAnswer {
    Real length = SimTK::NaN, rate = SimTK::NaN;
    SimTK::Vector_<SimTK::SpatialVec> unitForces;
};

/** Free bodies: of the origin, of each element, of the insertion; poses and speeds depend on a number. */
struct TwinBodies {
    explicit TwinBodies(const TwinScene& scene) : poseScale(scene.poseScale) {
        add(Transform(scene.origin_G));
        for (const TwinElement& element : scene.elements) add(element.X_GB);
        add(Transform(scene.insertion_G));
    }

    void add(const Transform& X_GB) {
        bodies.push_back(MobilizedBody::Free(matter.Ground(), X_GB, makeBody(), Transform()));
    }

    /** @param number   0: the default pose; speeds always */
    State makeState(Real number) {
        State state = system.realizeTopology();
        for (int i = 0; number != 0 && i < state.getNQ(); ++i)
            state.updQ()[i] += poseScale * std::sin(number + 1.7 * i);
        for (int i = 0; i < state.getNU(); ++i) state.updU()[i] = 0.7 * std::cos(2 * number + 1.3 * i);
        system.realize(state, Stage::Time);
        matter.normalizeQuaternions(state);
        state.invalidateAllCacheAtOrAbove(Stage::Position);
        return state;
    }

    Real poseScale;
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    std::vector<MobilizedBody> bodies;
};

/** Tautline's side. */
struct TautlineTwin : TwinBodies {
    explicit TautlineTwin(const TwinScene& scene) : TwinBodies(scene) {
        cable = Cable(cables, bodies.front(), SimTK::Vec3(0), bodies.back(), SimTK::Vec3(0));
        for (std::size_t e = 0; e < scene.elements.size(); ++e) {
            const TwinElement& element = scene.elements[e];
            if (element.surface)
                cable.addObstacle(bodies[e + 1], element.X_BS, element.surface, element.hint_S);
            else
                cable.addViaPoint(bodies[e + 1], element.X_BS.p());
        }
    }

    /** Leaves `state` realized. */
    TwinAnswer calcAnswer(Real number) {
        state = makeState(number);
        system.realize(state, Stage::Velocity);
        TwinAnswer answer{cable.getLength(state), cable.getLengthRate(state), {}};
        cable.calcUnitBodyForces(state, answer.unitForces);
        return answer;
    }

    bool isAllTouched() const {
        for (CableElementIndex e(0); e < cable.getNumElements(); ++e)
            if (cable.isObstacle(e) && !cable.isTouched(state, e)) return false;
        return true;
    }

    Real calcArcLength() const {
        Real sum = 0;
        for (CableElementIndex e(0); e < cable.getNumElements(); ++e)
            if (cable.isObstacle(e) && cable.isTouched(state, e)) sum += cable.getArcLength(state, e);
        return sum;
    }

    SimTK::Vec3 getOrigin_G() const { return bodies.front().getBodyOriginLocation(state); }
    SimTK::Vec3 getInsertion_G() const { return bodies.back().getBodyOriginLocation(state); }
    Transform calcFrame_G(int element) const {
        return bodies[element].getBodyTransform(state) * cable.getElementFrame(CableElementIndex(element));
    }

    CablePathSubsystem cables{system};
    Cable cable;
    State state;
};

/** Simbody 3.7's side. */
struct CablePathTwin : TwinBodies {
    explicit CablePathTwin(const TwinScene& scene) : TwinBodies(scene) {
        SimTK::CablePath path(cables, bodies.front(), SimTK::Vec3(0), bodies.back(), SimTK::Vec3(0));
        for (std::size_t e = 0; e < scene.elements.size(); ++e) {
            const TwinElement& element = scene.elements[e];
            if (!element.surface) {
                SimTK::CableObstacle::ViaPoint(path, bodies[e + 1], element.X_BS.p());
                continue;
            }
            SimTK::CableObstacle::Surface surface(path, bodies[e + 1], element.X_BS, element.geometry);
            surface.setNearPoint(element.hint_S);
            surface.setContactPointHints(element.hintP_S, element.hintQ_S);
        }
    }

    TwinAnswer calcAnswer(Real number) {
        const CoutCapture capture;
        const State state = makeState(number);
        const SimTK::CablePath& path = cables.getCablePath(SimTK::CablePathIndex(0));
        system.realize(state, Stage::Velocity);
        TwinAnswer answer{path.getCableLength(state), path.getCableLengthDot(state), {}};
        answer.unitForces.resize(matter.getNumBodies());
        answer.unitForces = SimTK::SpatialVec(SimTK::Vec3(0));
        path.applyBodyForces(state, 1, answer.unitForces);
        text = capture.getText();
        return answer;
    }

    /** CablePath does not say how its solve ended except in what it prints. */
    bool saysConverged() const { return text.find("PATH converged") != std::string::npos; }

    SimTK::CableTrackerSubsystem cables{system};
    std::string text;
};

#if TAUTLINE_SIMBODY_HAS_CABLE_SPAN
/** The side of a newer Simbody. */
struct CableSpanTwin : TwinBodies {
    explicit CableSpanTwin(const TwinScene& scene) : TwinBodies(scene) {
        cable = SimTK::CableSpan(cables, bodies.front(), SimTK::Vec3(0), bodies.back(), SimTK::Vec3(0));
        cable.setCurveSegmentAccuracy(1e-12);
        cable.setSmoothnessTolerance(1e-9);
        for (std::size_t e = 0; e < scene.elements.size(); ++e) {
            const TwinElement& element = scene.elements[e];
            cable.addObstacle(bodies[e + 1], element.X_BS, std::make_shared<SimTK::ContactGeometry>(element.geometry),
                              element.hint_S);
        }
    }

    TwinAnswer calcAnswer(Real number) {
        const State state = makeState(number);
        system.realize(state, Stage::Velocity);
        isSmooth = cable.getSmoothness(state) <= cable.getSmoothnessTolerance();
        TwinAnswer answer{cable.calcLength(state), cable.calcLengthDot(state), {}};
        answer.unitForces.resize(matter.getNumBodies());
        answer.unitForces = SimTK::SpatialVec(SimTK::Vec3(0));
        cable.applyBodyForces(state, 1, answer.unitForces);
        return answer;
    }

    SimTK::CablePathSubsystem cables{system};
    SimTK::CableSpan cable;
    bool isSmooth = false;  ///< whether the last answer met the tolerance
};
#endif

}  // namespace tautline::testing
