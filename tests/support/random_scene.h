// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Random scenes of 1 to 6 surfaces over three decades of size, overlapping, out of order, with via points, and with
degenerate ones crowded in. A seed gives the same scene on every machine. */
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "support/surface_cases.h"
#include "tautline/paths/path_problem.h"

namespace tautline::testing {

class RandomScene {
public:
    enum class Kinds {
        Basic,    ///< sphere, cylinder, ellipsoid and torus
        All,      ///< every kind and form there is
        Aligned,  ///< of these, along ground's axes and in places that are exact: lines through axes and centers; all
                  ///< hints
    };

    RandomScene(unsigned seed, Kinds kinds) : m_random(seed), m_kinds(kinds) {}

    /** @param problem, pose   empty; the scene when it returns */
    void make(PathProblem& problem, PathPose& pose) {
        const int n = 1 + pick(6);
        problem.addPoint("origin");
        pose.X_GE.emplace_back(makePlace());
        for (int i = 0; i < n; ++i) {
            const StartHint near = pick(3) > 0 ? StartHint(PassNear{point(1)}) : StartHint();
            const double size = std::pow(10, uniform(-2, 0.3));
            const SurfacePtr surface = m_kinds == Kinds::Basic ? makeBasic(size) : makeAny(size);
            problem.addObstacle("s" + std::to_string(i), surface,
                                m_kinds == Kinds::Aligned ? makeHint(*surface) : near);
            const Matrix3 R = makeRotation();
            pose.X_GE.emplace_back(R, makePlace());
            if (pick(10) == 0) {
                problem.addPoint("via" + std::to_string(i));
                pose.X_GE.emplace_back(makePlace());
            }
        }
        problem.addPoint("insertion");
        pose.X_GE.emplace_back(makePlace());
        degenerate(pose);
    }

private:
    using SurfacePtr = std::shared_ptr<const Surface>;

    double uniform(double low, double high) {
        return low + (high - low) * (m_random() / static_cast<double>(std::mt19937::max()));
    }
    int pick(int count) { return static_cast<int>(m_random() % static_cast<unsigned>(count)); }
    Vector3 point(double extent) {
        return {uniform(-extent, extent), uniform(-extent, extent), uniform(-extent, extent)};
    }
    /** Aligned: in a coarse lattice, so that centers lie on lines and in planes of others. */
    Vector3 makePlace() {
        const Vector3 place = point(2);
        return m_kinds == Kinds::Aligned ? Vector3((2 * place).array().round() / 2) : place;
    }
    StartHint makeHint(const Surface& surface) {
        switch (pick(6)) {
            case 0:
                return PassNear{point(1)};
            case 1:
                return PassOnSide{point(1)};
            case 2:
                return WindAround{uniform(-2, 2)};
            case 3:
                if (surface.getHole()) return ThreadHole{pick(5) - 2};
                return {};
            default:
                return {};
        }
    }
    Vector3 makeFactors() { return {uniform(0.2, 1), uniform(0.2, 1), uniform(0.2, 1)}; }

    SurfacePtr makeBasic(double size) {
        switch (pick(4)) {
            case 0:
                return std::make_shared<Sphere>(size);
            case 1:
                return std::make_shared<Cylinder>(size);
            case 2:
                return std::make_shared<Ellipsoid>(size * makeFactors());
            default:
                return std::make_shared<Torus>(size, size * uniform(0.05, 0.95));
        }
    }

    SurfacePtr makeAny(double size) {
        const bool isParametric = pick(2) == 0;
        switch (pick(m_kinds == Kinds::Aligned ? 17 : 16)) {
            case 0:
                return makeForm<Sphere, ParametricSphere>(isParametric, size);
            case 1:
                return makeForm<Cylinder, ParametricCylinder>(isParametric, size);
            case 2:
                return makeForm<Ellipsoid, ParametricEllipsoid>(isParametric, Vector3(size * makeFactors()));
            case 3:
                return makeForm<Torus, ParametricTorus>(isParametric, size, size * uniform(0.05, 0.95));
            case 4:
                return makeForm<EllipticTorus, ParametricEllipticTorus>(isParametric, size, size * uniform(0.05, 0.95),
                                                                        size * uniform(0.05, 1.5));
            case 5:
                return makeForm<Paraboloid, ParametricParaboloid>(isParametric, size * uniform(0.3, 3),
                                                                  size * uniform(0.3, 3));
            case 6:
                return makeForm<EllipticCylinder, ParametricEllipticCylinder>(isParametric, size,
                                                                              size * uniform(0.2, 1));
            case 7:
                return makeForm<Capsule, ParametricCapsule>(isParametric, size, size * uniform(0, 5),
                                                            size * uniform(0.3, 2));
            case 8:
                return makeForm<Cone, ParametricCone>(isParametric, uniform(0.1, 1.2), size);
            case 9:
                return makeForm<HalfSpace, ParametricHalfSpace>(isParametric, size);
            case 10:
                return makeScaled(isParametric, Torus(size, size * uniform(0.05, 0.95)), makeFactors());
            case 11:
                return std::make_shared<OffsetSurface>(makeBasic(size), size * uniform(0, 0.5));
            case 12:
                return std::make_shared<OffsetSurface>(std::make_shared<ParametricEllipsoid>(size * makeFactors()),
                                                       size * uniform(0, 0.5));
            case 13:
                return makeScaledPatch(makePolynomialPatch(4, isParametric ? 1 : -1), 0.3 + size);
            case 14:
                return makeScaledPatch(makeBumpPatch(7, isParametric ? 1 : -1), 0.3 + size);
            case 15:
                return std::make_shared<ImplicitFunctionSurface>(makePear());
            default:
                return makeSheet();
        }
    }

    template <class Implicit, class Parametric, class... Arguments>
    static SurfacePtr makeForm(bool isParametric, const Arguments&... arguments) {
        if (isParametric) return std::make_shared<Parametric>(arguments...);
        return std::make_shared<Implicit>(arguments...);
    }

    static SurfacePtr makeScaled(bool isParametric, const Torus& torus, const Vector3& factors) {
        if (!isParametric) return std::make_shared<ScaledImplicitSurface<Torus>>(torus, factors);
        const ParametricTorus base(torus.getRingRadius(), torus.getTubeRadius());
        return std::make_shared<ScaledParametricSurface<ParametricTorus>>(base, factors);
    }

    template <class Patch>
    static SurfacePtr makeScaledPatch(const Patch& patch, double size) {
        return std::make_shared<ScaledParametricSurface<Patch>>(patch, Vector3::Constant(size));
    }

    static SurfacePtr makeSheet() {
        const auto sheet = [](auto u, auto v) {
            return std::array<decltype(u), 3>{u + 0.1 * v, v - 0.1 * u * u, 0.3 * sin(u) * cos(v)};
        };
        const ParameterDomain square{Vector2(-1.2, -1.2), Vector2(1.2, 1.2)};
        return std::make_shared<ParametricFunctionSurface>(makeParametricSurface("sheet", 0.5, square, sheet));
    }

    Matrix3 makeRotation() {
        if (pick(5) == 0 || m_kinds == Kinds::Aligned) return Matrix3::Identity();  // axes along ground's: exact zeros
        return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1) + 2)
            .normalized()
            .toRotationMatrix();
    }
    /** Half of the scenes get a coincidence: concentric surfaces, ends at centers, on axes, at each other. */
    void degenerate(PathPose& pose) {
        const int last = static_cast<int>(pose.X_GE.size()) - 1, e = 1 + pick(last - 1);
        switch (pick(10)) {
            case 0:
                pose.X_GE[last].p = pose.X_GE[0].p;
                break;
            case 1:
                pose.X_GE[0].p = pose.X_GE[e].p;
                break;
            case 2:
                pose.X_GE[e].p = 0.5 * (pose.X_GE[0].p + pose.X_GE[last].p);
                break;  // chord through the center
            case 3:
                pose.X_GE[0].p = pose.X_GE[e] * Vector3(0, 0, 1), pose.X_GE[last].p = pose.X_GE[e] * Vector3(0, 0, -1);
                break;
            case 4:
                pose.X_GE[e] = pose.X_GE[1 + pick(last - 1)];
                break;
            default:
                break;
        }
    }

    std::mt19937 m_random;
    Kinds m_kinds;
};

}  // namespace tautline::testing
