// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The "weave": a path from (-1, 0, 0) to (n, 0, 0) over the even and under the odd ones of n moving obstacles
at (i, c_i, 0). Shared by tests and benchmarks; described with its mean lengths in peers.md of the reference
data. Cylinders stand at c_i = +-0.25, on the side where the path passes; ellipsoids and spheres on the other,
so that the path is held and cannot slip off. */
#include <cmath>
#include <string>
#include <vector>

#include "tautline/paths/path_problem.h"
#include "tautline/paths/path_solution.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"

namespace tautline::testing {

class WeaveScene {
public:
    enum class Kind { Cylinders, Ellipsoids, Spheres };
    static constexpr double kTimeStep = 0.02;  // [s]

    /** @param surface   in place of the kind's own, of the same shape; null: that */
    WeaveScene(Kind kind, int count, std::shared_ptr<const Surface> surface = nullptr) : m_kind(kind), m_count(count) {
        if (!surface) surface = makeSurface();
        m_problem.addPoint("origin");
        for (int i = 0; i < count; ++i)
            m_problem.addObstacle("obstacle" + std::to_string(i), surface, Vector3(0, 0.4 * getSide(i), 0));
        m_problem.addPoint("insertion");
    }

    const PathProblem& getProblem() const { return m_problem; }

    void calcPose(double t, PathPose& pose) const {
        pose.X_GE.resize(m_count + 2);
        pose.X_GE.front() = Pose(Vector3(-1, 0, 0));
        pose.X_GE.back() = Pose(Vector3(m_count, 0, 0));
        for (int i = 0; i < m_count; ++i) {
            const double phi = kPhase * i, w = kOmega;
            const double center = (m_kind == Kind::Cylinders ? 0.25 : -0.25) * getSide(i);
            const double a = 0.1 * std::sin(w * t + phi), b = 0.1 * std::sin(1.1 * w * t + 2 * phi);
            const Matrix3 R =
                (Eigen::AngleAxisd(a, Vector3::UnitX()) * Eigen::AngleAxisd(b, Vector3::UnitY())).toRotationMatrix();
            const Vector3 p(i + 0.05 * std::sin(w * t + phi), center + 0.05 * std::sin(1.3 * w * t + 2 * phi),
                            0.05 * std::sin(0.7 * w * t + 3 * phi));
            pose.X_GE[i + 1] = Pose(R, p);
        }
    }

    void calcVelocity(double t, std::vector<SpatialVelocity>& V_GE) const {
        V_GE.assign(m_count + 2, SpatialVelocity());
        for (int i = 0; i < m_count; ++i) {
            const double phi = kPhase * i, w = kOmega;
            const double a = 0.1 * std::sin(w * t + phi);
            const double aDot = 0.1 * w * std::cos(w * t + phi), bDot = 0.11 * w * std::cos(1.1 * w * t + 2 * phi);
            V_GE[i + 1].w = Vector3(aDot, std::cos(a) * bDot, std::sin(a) * bDot);  // a' x + b' Rx y
            V_GE[i + 1].v = 0.05 * w *
                            Vector3(std::cos(w * t + phi), 1.3 * std::cos(1.3 * w * t + 2 * phi),
                                    0.7 * std::cos(0.7 * w * t + 3 * phi));
        }
    }

    /** A start near the path, made without the solver: an arc of half a turn or less over the middle of each
    obstacle's side. For so many obstacles that a cold start would take too long. */
    PathSolution makeGuess() const {
        PathSolution path;
        path.contacts.resize(m_count + 2);
        // Half the angle by which the path turns at an obstacle of the planar scene at rest, rounded.
        const double half = m_kind == Kind::Cylinders ? 1.2 : 0.3;
        for (int i = 0; i < m_count; ++i) {
            GeodesicStart& start = path.contacts[i + 1].start;
            path.contacts[i + 1].isTouched = true;
            start.point.p = 0.4 * Vector3(-std::sin(half), getSide(i) * std::cos(half), 0);
            start.tangent = Vector3(std::cos(half), getSide(i) * std::sin(half), 0);
            start.length = 2 * half * 0.4;
        }
        return path;
    }

private:
    static constexpr double kPhase = 0.7, kOmega = 1.5;

    static int getSide(int i) { return i % 2 == 0 ? 1 : -1; }  // +y for even ones

    std::shared_ptr<const Surface> makeSurface() const {
        if (m_kind == Kind::Cylinders) return std::make_shared<Cylinder>(0.4);
        if (m_kind == Kind::Spheres) return std::make_shared<Sphere>(0.4);
        return std::make_shared<Ellipsoid>(Vector3(0.45, 0.4, 0.9));
    }

    Kind m_kind;
    int m_count;
    PathProblem m_problem;
};

}  // namespace tautline::testing
