// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Systems of the kind of Simbody's ExampleCablePath and CableOverBicubicSurfaces, from their dimensions, each for
Simbody's CablePath and for our Cable: shared by the tests, which keep their energy books, and the benchmarks. */
#include <Simbody.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "tautline/simbody/cable.h"
#include "tautline/simbody/cable_forces.h"

namespace tautline::testing {

/** Spring cables of Tautline beside the bodies of a scene. */
struct TautlineCables {
    using Spring = ElasticStringForce;
    explicit TautlineCables(SimTK::MultibodySystem& system) : subsystem(system) {}

    class Path {
    public:
        Path(TautlineCables& cables, const SimTK::MobilizedBody& originBody, const SimTK::Vec3& origin,
             const SimTK::MobilizedBody& endBody, const SimTK::Vec3& end)
            : cable(cables.subsystem, originBody, origin, endBody, end) {}
        void addPoint(const SimTK::MobilizedBody& body, const SimTK::Vec3& station) {
            cable.addViaPoint(body, station);
        }
        /** @param P, Q   near which the arc may begin and end */
        template <class Shape>
        void addSurface(const SimTK::MobilizedBody& body, const SimTK::Transform& X_BS, const Shape& shape,
                        const SimTK::Vec3& P, const SimTK::Vec3& Q) {
            cable.addObstacle(body, X_BS, std::make_shared<const Shape>(shape), (P + Q) / 2);
        }
        void addSpring(SimTK::GeneralForceSubsystem& forces, SimTK::Real stiffness, SimTK::Real slackLength,
                       SimTK::Real damping) {
            spring = ElasticStringForce(forces, cable, stiffness, slackLength, damping);
        }
        SimTK::Real getDissipatedEnergy(const SimTK::State& state) const { return spring.getDissipatedEnergy(state); }
        SimTK::Real getLength(const SimTK::State& state) const { return cable.getLength(state); }
        void prepare(SimTK::State&) const {}

        Cable cable;
        ElasticStringForce spring;
    };

    CablePathSubsystem subsystem;
};

/** The same with Simbody's own. */
struct SimbodyCables {
    explicit SimbodyCables(SimTK::MultibodySystem& system) : subsystem(system) {}

    class Path {
    public:
        Path(SimbodyCables& cables, const SimTK::MobilizedBody& originBody, const SimTK::Vec3& origin,
             const SimTK::MobilizedBody& endBody, const SimTK::Vec3& end)
            : path(cables.subsystem, originBody, origin, endBody, end) {}
        void addPoint(const SimTK::MobilizedBody& body, const SimTK::Vec3& station) {
            SimTK::CableObstacle::ViaPoint(path, body, station);
        }
        template <class Shape>
        void addSurface(const SimTK::MobilizedBody& body, const SimTK::Transform& X_BS, const Shape& shape,
                        const SimTK::Vec3& P, const SimTK::Vec3& Q) {
            SimTK::CableObstacle::Surface(path, body, X_BS, shape).setContactPointHints(P, Q);
        }
        void addSpring(SimTK::GeneralForceSubsystem& forces, SimTK::Real stiffness, SimTK::Real slackLength,
                       SimTK::Real damping) {
            spring.emplace(forces, path, stiffness, slackLength, damping);
        }
        SimTK::Real getDissipatedEnergy(const SimTK::State& state) const { return spring->getDissipatedEnergy(state); }
        SimTK::Real getLength(const SimTK::State& state) const { return path.getCableLength(state); }
        /** Simbody integrates the length's rate as a check, from zero unless told. */
        void prepare(SimTK::State& state) const { path.setIntegratedCableLengthDot(state, 0); }

        SimTK::CablePath path;
        std::optional<SimTK::CableSpring> spring;
    };

    SimTK::CableTrackerSubsystem subsystem;
};

template <class Cables>
struct PeerScene {
    using Path = typename Cables::Path;

    SimTK::Real calcBookedEnergy(const SimTK::State& state) const {
        SimTK::Real energy = system.calcEnergy(state);
        for (const Path& path : paths) energy += path.getDissipatedEnergy(state);
        return energy;
    }

    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    Cables cables{system};
    SimTK::GeneralForceSubsystem forces{system};
    std::vector<Path> paths;
};

/** Five links hang from ball joints, tangled. One spring cable goes from the first link over an eyelet, a sphere and a
bigger sphere on the next ones to the last; another one from ground over an eyelet on the third back to ground. */
template <class Cables>
struct BallChainScene : PeerScene<Cables> {
    BallChainScene() {
        using SimTK::Vec3;
        using Sphere = SimTK::ContactGeometry::Sphere;
        SimTK::Force::UniformGravity(this->forces, this->matter, Vec3(0, -9.8, 0));
        const SimTK::Body::Rigid link(SimTK::MassProperties(1, Vec3(0), SimTK::Inertia(1)));
        const SimTK::MobilizedBody ground = this->matter.Ground();
        std::vector<SimTK::MobilizedBody> bodies{ground};
        for (int i = 0; i < 5; ++i)
            bodies.push_back(SimTK::MobilizedBody::Ball(bodies.back(), SimTK::Transform(), link, Vec3(0, 1, 0)));
        const SimTK::Real radius = 0.25;
        const auto on = [&](SimTK::Real x, SimTK::Real y, SimTK::Real z) { return radius * SimTK::UnitVec3(x, y, z); };
        this->paths.reserve(2);
        auto& first =
            this->paths.emplace_back(this->cables, bodies[1], Vec3(radius, 0, 0), bodies[5], Vec3(0, 0, radius));
        first.addPoint(bodies[2], on(1, 1, 0));
        first.addSurface(bodies[3], SimTK::Transform(), Sphere(radius), on(-.25, .04, .08), on(-.05, -.25, -.04));
        first.addSurface(bodies[4], SimTK::Transform(), Sphere(0.5), on(.1, .125, -.2), on(.1, -.1, -.2));
        first.addSpring(this->forces, 100, 3.5, 0.1);
        auto& second = this->paths.emplace_back(this->cables, ground, Vec3(-3, 0, 0), ground, Vec3(-2, 1, 0));
        second.addPoint(bodies[3], 2 * on(1, 1, 1));
        second.addPoint(ground, Vec3(-2.5, 1, 0));
        second.addSpring(this->forces, 100, 2, 0.1);
    }

    SimTK::State makeStart() {
        SimTK::State state = this->system.realizeTopology();
        SimTK::Random::Gaussian random;
        random.setSeed(20261127);
        for (int i = 0; i < state.getNQ(); ++i) state.updQ()[i] = random.getValue();
        for (int i = 0; i < state.getNU(); ++i) state.updU()[i] = 0.1 * random.getValue();
        this->system.realize(state, SimTK::Stage::Time);
        this->matter.normalizeQuaternions(state);
        for (const auto& path : this->paths) path.prepare(state);
        return state;
    }
};

/** A heavy body hangs on a spring cable that goes over two bicubic maps, and swings. They are saddles, since a string
slips off the side of a dome. Gravity pulls across them and down, so that the string leaves the second one where it is
steep, and stays within both rectangles. */
template <class Cables>
struct SaddlesScene : PeerScene<Cables> {
    SaddlesScene() {
        using SimTK::Vec3;
        SimTK::Force::UniformGravity(this->forces, this->matter, 9.81 * SimTK::UnitVec3(1, 0, -1));
        const SimTK::Body::Rigid heavy(SimTK::MassProperties(
            2, Vec3(0, -1, 0), SimTK::UnitInertia::cylinderAlongY(0.25, 1).shiftFromCentroid(Vec3(0, 1, 0))));
        SimTK::MobilizedBody ground = this->matter.Ground();
        body = SimTK::MobilizedBody::Free(ground, SimTK::Transform(), heavy, SimTK::Transform());
        const SimTK::ContactGeometry::SmoothHeightMap saddle(makeSaddle());
        this->paths.reserve(1);
        auto& path = this->paths.emplace_back(this->cables, ground, Vec3(-6, 0.2, 0), body, Vec3(0));
        path.addSurface(ground, Vec3(-2.5, 0, -0.4), saddle, Vec3(-0.2, 0.1, 1), Vec3(0.6, 0.05, 0.9));
        path.addSurface(ground, SimTK::Transform(SimTK::Rotation(0.4, SimTK::ZAxis), Vec3(1.5, 0.1, -1.0)), saddle,
                        Vec3(-0.1, 0, 1), Vec3(1.2, 0, 0.5));
        path.addSpring(this->forces, 50, 12, 0.1);
    }

    /** Over 5 m x 5 m, without a plane of symmetry. */
    static SimTK::BicubicSurface makeSaddle() {
        const int n = 6;
        SimTK::Vector at(n);
        SimTK::Matrix heights(n, n);
        for (int i = 0; i < n; ++i) at[i] = -2.5 + i;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                heights(i, j) = 1 - 0.4 * at[i] * at[i] + 0.2 * at[j] * at[j] + 0.02 * std::sin(2.0 * i + 3.0 * j);
        return SimTK::BicubicSurface(at, at, heights);
    }

    SimTK::State makeStart() {
        SimTK::State state = this->system.realizeTopology();
        body.setQToFitTranslation(state, SimTK::Vec3(5.4, 0.4, -3.3));
        body.setQToFitRotation(
            state, SimTK::Rotation(SimTK::Pi / 4, SimTK::YAxis) * SimTK::Rotation(SimTK::Pi / 2, SimTK::ZAxis));
        for (const auto& path : this->paths) path.prepare(state);
        return state;
    }

    SimTK::MobilizedBody::Free body;
};

/** A long body turned upside down hangs on a spring cable that goes over one bumpy map, and swings: the dimensions of
CableOverBicubicSurfaces itself. */
template <class Cables>
struct BumpScene : PeerScene<Cables> {
    BumpScene() {
        using SimTK::Vec3;
        SimTK::Force::Gravity(this->forces, this->matter, -SimTK::YAxis, 9.81);
        const SimTK::Body::Rigid heavy(SimTK::MassProperties(
            2, Vec3(0, -4, 0), SimTK::UnitInertia::cylinderAlongY(1, 4).shiftFromCentroid(Vec3(0, 4, 0))));
        SimTK::MobilizedBody ground = this->matter.Ground();
        body = SimTK::MobilizedBody::Free(ground, SimTK::Transform(), heavy, SimTK::Transform());
        this->paths.reserve(1);
        auto& path = this->paths.emplace_back(this->cables, ground, Vec3(0.5, -0.5, 0), body, Vec3(0));
        path.addSurface(ground, Vec3(-3, -3, -3), SimTK::ContactGeometry::SmoothHeightMap(makeBumps()),
                        Vec3(1.5, 1, 3.75), Vec3(1.5, -1, 3.75));
        path.addSpring(this->forces, 50, 8, 0.1);
    }

    /** Smoothed, with a peak at (2, 0). */
    static SimTK::BicubicSurface makeBumps() {
        const SimTK::Real x[] = {0.1, 1, 2, 4}, y[] = {-3, -2, 0, 1, 3},
                          z[] = {1, 2, 3, 3, 2, 1.1, 2.1, 3.1, 3.1, 2.1, 1, 2, 7, 3, 2, 1.2, 2.2, 3.2, 3.2, 2.2};
        return SimTK::BicubicSurface(SimTK::Vector(4, x), SimTK::Vector(5, y), SimTK::Matrix(4, 5, z), 1);
    }

    SimTK::State makeStart() {
        SimTK::State state = this->system.realizeTopology();
        body.setQToFitTranslation(state, SimTK::Vec3(4, -10, -3));
        body.setQToFitRotation(state, SimTK::Rotation(-SimTK::Pi, SimTK::ZAxis));
        for (const auto& path : this->paths) path.prepare(state);
        return state;
    }

    SimTK::MobilizedBody::Free body;
};

}  // namespace tautline::testing
