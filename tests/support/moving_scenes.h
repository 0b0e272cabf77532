// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Scenes of one and of several obstacles that move smoothly, chains as a user would place them, a driven drum, and
spheres that overlap: what a continued, a long, a wound and a grooved path have to come to. */
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "support/asked_scenes.h"

namespace tautline::testing {

/** A problem with its poses. */
struct PosedPath {
    PathProblem problem;
    PathPose pose;

    void addPoint(const Vector3& p) {
        problem.addPoint("point" + std::to_string(problem.getNumElements()));
        pose.X_GE.emplace_back(p);
    }
    void addObstacle(std::shared_ptr<const Surface> surface, const Pose& X_GS, const StartHint& hint) {
        problem.addObstacle("obstacle" + std::to_string(problem.getNumElements()), std::move(surface), hint);
        pose.X_GE.push_back(X_GS);
    }
};

/** Obstacles of all kinds in a row along x, one per unit of length and none wider than 0.8, each beside the x axis by
less than its radius, so that the string has to pass it on the other side. */
class UserChain {
public:
    enum class Hints { None, Right };

    UserChain(int count, Hints hints, unsigned seed, double scale = 1) : m_random(seed), m_scale(scale) {
        m_path.addPoint(scale * Vector3(-1, m_random.uniform(-0.2, 0.2), m_random.uniform(-0.2, 0.2)));
        for (int i = 0; i < count; ++i) add(i, hints);
        m_path.addPoint(scale * Vector3(count, m_random.uniform(-0.2, 0.2), m_random.uniform(-0.2, 0.2)));
    }

    const PosedPath& getPath() const { return m_path; }

private:
    void add(int i, Hints hints) {
        const double radius = m_random.uniform(0.2, 0.4);
        const double angle = m_random.flip() ? 0.5 * kPi : -0.5 * kPi, askew = m_random.uniform(-0.5, 0.5);
        const double beside = m_random.uniform(0.2, 0.9) * radius;
        const Vector3 out(0, std::sin(angle + askew), std::cos(angle + askew));
        const Vector3 axis(m_random.uniform(-0.2, 0.2), m_random.uniform(-0.2, 0.2), 1);
        const Matrix3 R_GS = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
        const Pose X_GS(R_GS, m_scale * (Vector3(i, 0, 0) + beside * out));
        // Across the axis, as the quadrants of musculoskeletal models are.
        const Vector3 side = X_GS.rotateBack(-out);
        const StartHint hint =
            hints == Hints::Right ? StartHint(PassOnSide{{side.x(), side.y(), 0}}) : StartHint(std::monostate());
        m_path.addObstacle(makeSurface(radius * m_scale), X_GS, hint);
    }
    std::shared_ptr<const Surface> makeSurface(double radius) {
        const double a = m_random.uniform(0.6, 1) * radius, b = m_random.uniform(0.6, 1) * radius;
        switch (m_random.pick(5)) {
            case 0:
                return std::make_shared<Sphere>(radius);
            case 1:
                return std::make_shared<Ellipsoid>(Vector3(a, b, radius));
            case 2:
                return std::make_shared<Capsule>(a, 0.5 * b, 0.5 * radius);
            case 3:
                return std::make_shared<EllipticCylinder>(a, b);
            default:
                return std::make_shared<Cylinder>(radius);
        }
    }

    SeededRandom m_random;
    double m_scale;
    PosedPath m_path;
};

/** The sides on which a path lies, as a user who knows it would name them: across the axes. */
inline PathProblem addSides(PathProblem problem, const PathSolution& path) {
    for (int e = 0; e < problem.getNumElements(); ++e) {
        if (!path.contacts[e].isTouched) continue;
        const ShotGeodesic& arc = path.contacts[e].geodesic;
        Vector3 side = arc.P.x + arc.Q.x;
        side.z() = 0;
        problem.setHint(e, PassOnSide{side});
    }
    return problem;
}

/** A scene of the asked ones, or a short chain, on a smooth walk: each element to and fro and about by sums of waves.
 */
class WalkedScene {
public:
    explicit WalkedScene(unsigned seed) : m_random(seed) {
        const int kind = static_cast<int>(seed % 6);
        if (kind < 4) {
            const AskedScene scene = AskedSceneMaker(kAskings[kind], seed).getScene();
            m_start = {scene.problem, scene.pose};
            m_size = scene.problem.getElement(1).surface->getSize();
        } else {
            m_start = UserChain(3, kind == 4 ? UserChain::Hints::None : UserChain::Hints::Right, seed, 0.1).getPath();
            m_size = 0.03;
        }
        for (std::size_t e = 0; e < m_start.pose.X_GE.size(); ++e) {
            Wave wave;
            for (Vector3& v : wave.shift) v = m_random.vector(m_size);
            for (Vector3& v : wave.turn) v = m_random.vector(0.5);
            m_waves.push_back(wave);
        }
    }

    const PathProblem& getProblem() const { return m_start.problem; }

    /** @param t   0 at the start; a wave or two to each unit */
    PathPose calcPose(double t) const {
        PathPose pose = m_start.pose;
        for (std::size_t e = 0; e < pose.X_GE.size(); ++e) {
            Vector3 shift = Vector3::Zero(), turn = Vector3::Zero();
            for (std::size_t k = 0; k < kWaves; ++k) {
                const double s = std::sin(2 * kPi * static_cast<double>(k + 1) * t);
                shift += s * m_waves[e].shift[k];
                turn += s * m_waves[e].turn[k];
            }
            pose.X_GE[e].p += shift;
            if (turn.norm() > 0)
                pose.X_GE[e].R = pose.X_GE[e].R * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
        }
        return pose;
    }

private:
    static constexpr std::size_t kWaves = 2;
    struct Wave {
        std::array<Vector3, kWaves> shift, turn;
    };
    SeededRandom m_random;
    PosedPath m_start;
    double m_size = 1;
    std::vector<Wave> m_waves;
};

/** A rope from a fixed point to one tied to a drum, radius 0.1 about z, that turns and winds it up: closed form. */
class DrumScene {
public:
    static constexpr double kRadius = 0.1;

    DrumScene() {
        m_path.addPoint(Vector3(1, 0.1, 0.05));
        m_path.addObstacle(std::make_shared<Cylinder>(kRadius), Pose(), {});
        m_path.addPoint(Vector3::Zero());
    }
    const PathProblem& getProblem() const { return m_path.problem; }
    PathPose calcPose(double turned) const {
        PathPose pose = m_path.pose;
        pose.X_GE[1].R = Eigen::AngleAxisd(turned, Vector3::UnitZ()).toRotationMatrix();
        pose.X_GE[2].p = makeOnCylinder(kRadius, kTiedAt + turned, 0);
        return pose;
    }
    double calcLength(double turned) const {
        const Vector3 A = m_path.pose.X_GE[0].p, tied = makeOnCylinder(kRadius * (1 + 1e-15), kTiedAt, 0);
        return calcStringAboutAxis(kRadius, A, tied, calcShortTurning(A, tied) + turned).length;
    }

private:
    static constexpr double kTiedAt = 2.4;  ///< azimuth [rad]: the rope lies on the drum from the start
    PosedPath m_path;
};

/** Two spheres of radius 0.025 m that overlap at z = 0; a string on their +x side lies in the groove between them. */
struct GrooveScene {
    PosedPath path;

    GrooveScene(const Vector3& origin, const Vector3& insertion) {
        const auto sphere = std::make_shared<Sphere>(0.025);
        path.addPoint(origin);
        for (const double z : {0.018, -0.018})
            path.addObstacle(sphere, Pose(Vector3(0, 0, z)), PassNear{Vector3(0.025, 0, 0)});
        path.addPoint(insertion);
    }
    /** Of the string on the +x side, to 1e-4; NaN where it slides off. */
    double calcLength() const {
        std::vector<Body> bodies;
        for (const int e : {1, 2}) bodies.push_back({path.problem.getElement(e).surface.get(), path.pose.X_GE[e]});
        TautPolyline string(bodies, {path.pose.X_GE[0].p, Vector3(0.05, 0, 0), path.pose.X_GE[3].p}, 200);
        const bool isAtRest = string.relax(1e-4, 5000);
        bool staysThere = false;
        for (const Vector3& p : string.getNodes()) staysThere = staysThere || (std::abs(p.y()) < 0.03 && p.x() > 0);
        return isAtRest && staysThere ? string.calcLength() : kNaN;
    }
};

}  // namespace tautline::testing
