// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Random scenes of one obstacle and one hint, with the path that the hint asks for: about cylinders in closed form
(string_about_axis.h), over other surfaces by a polyline (taut_polyline.h). A seed gives the same scene everywhere.

What is asked:
- PassOnSide: of all taut strings that turn by less than a full turn, the shortest one whose middle lies on that side:
  half way along the arc, or where a straight string is nearest to the surface. About a surface with an axis the part of
  the direction along the axis does not count. Where no taut string is there, nothing answers the hint.
- PassNear: the taut string nearest to the point, or another one on the same side: outward at its middle is outward at
  the point, less than 90 degrees off. (The scenes leave no doubt which is the nearest.) None where even that one passes
  on the opposite side of the body.
- WindAround: the taut string that turns about the axis by the angle nearest to the hint's.
- ThreadHole: the taut string that goes through the hole so many times; none, if it would lie on the ring in several
  stretches. */
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "support/seeded_random.h"
#include "support/string_about_axis.h"
#include "support/taut_polyline.h"
#include "tautline/paths/path_kinematics.h"
#include "tautline/paths/path_solver.h"
#include "tautline/paths/path_verification.h"
#include "tautline/surfaces/capsule.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/elliptic_cylinder.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline::testing {

enum class Asking { Near, Side, Winding, Hole };
inline constexpr Asking kAskings[] = {Asking::Near, Asking::Side, Asking::Winding, Asking::Hole};
inline const char* getName(Asking asking) {
    constexpr const char* kNames[] = {"near", "side", "winding", "hole"};
    return kNames[static_cast<int>(asking)];
}

struct AskedScene {
    std::string kind;  ///< of the surface
    PathProblem problem;
    PathPose pose;
    Vector3 A_S, B_S;
    bool isKnown = true;           ///< false: the truth was not found, and nothing is judged
    std::optional<double> length;  ///< of the path that is asked for, if there is one
    std::string description;
    /** Whether a minimum other than that path is as asked as well. */
    std::function<bool(const std::vector<Vector3>& nodes_S)> isAsAsked = [](const auto&) { return false; };
};

/** What a solve came to. */
enum class Outcome {
    Found,    ///< solved, the path that is asked for
    Another,  ///< solved, another minimum that is as asked
    Missed,   ///< there is such a path; another answer, which says so
    Said,     ///< there is none, and the answer says so
    Silent,   ///< solved elsewhere than asked, without a word
    Unknown,  ///< the truth is not known
};
inline constexpr int kNumOutcomes = 6;
inline const char* getName(Outcome outcome) {
    constexpr const char* kNames[] = {"found", "another", "missed", "said", "silent", "unknown"};
    return kNames[static_cast<int>(outcome)];
}

/** Points along the path, in the frame of its obstacle. */
inline std::vector<Vector3> calcNodes(const AskedScene& scene, const PathSolution& path) {
    std::vector<Vector3> points;
    calcDrawingPoints(path, scene.problem, scene.pose, 0.02 * scene.problem.getElement(1).surface->getSize(), points);
    for (Vector3& p : points) p = scene.pose.X_GE[1].shiftBack(p);
    return points;
}

inline Outcome judge(const AskedScene& scene, const PathSolution& path) {
    constexpr double kSameLength = 1e-6;
    if (!scene.isKnown) return Outcome::Unknown;
    const bool isSolved = path.status == PathStatus::Solved;
    const bool isSame = scene.length && std::abs(path.length / *scene.length - 1) < kSameLength;
    if (isSolved && isSame) return Outcome::Found;
    if (!isSolved || !path.followsHints()) return scene.length ? Outcome::Missed : Outcome::Said;
    const bool isMinimum = verifyPath(scene.problem, scene.pose, path).isMinimum();
    return isMinimum && scene.isAsAsked(calcNodes(scene, path)) ? Outcome::Another : Outcome::Silent;
}

inline double calcTurning(const std::vector<Vector3>& nodes) {
    double turning = 0;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) turning += calcShortTurning(nodes[i], nodes[i + 1]);
    return turning;
}

class AskedSceneMaker {
public:
    AskedSceneMaker(Asking asking, unsigned seed) : m_random(seed * 4 + static_cast<unsigned>(asking)) { make(asking); }

    const AskedScene& getScene() const { return m_scene; }

private:
    void make(Asking asking) {
        if (asking == Asking::Hole) return makeHole();
        const bool isCylinder = m_random.flip();
        if (asking == Asking::Near) return isCylinder ? makeCylinderNear() : makeBodyNear();
        if (asking == Asking::Side) return isCylinder ? makeCylinderSide() : makeBodySide();
        return isCylinder ? makeCylinderWinding() : makeBodyWinding();
    }

    // About cylinders.
    void makeCylinder() {
        m_radius = m_random.logUniform(0.01, 1);
        m_scene.kind = "cylinder";
        m_surface = std::make_shared<Cylinder>(m_radius);
        m_scene.A_S = makePlaceAbout(m_radius);
        m_scene.B_S = makePlaceAbout(m_radius);
    }
    Vector3 makePlaceAbout(double radius) {
        const double rho = radius * m_random.logUniform(1.02, 10), azimuth = m_random.uniform(-kPi, kPi);
        return makeOnCylinder(rho, azimuth, m_random.uniform(-3, 3) * radius);
    }
    void makeCylinderSide() {
        makeCylinder();
        Vector3 side = m_random.unitVector();
        if (m_random.pick(3) > 0) side.z() = 0;
        finish(PassOnSide{side}, toLength(findStringOnSide(m_radius, m_scene.A_S, m_scene.B_S, side)), "side", side);
    }
    void makeCylinderNear() {
        // Until there is no doubt.
        for (;;) {
            makeCylinder();
            const auto ways = calcBothWays(m_radius, m_scene.A_S, m_scene.B_S);
            const int wanted = m_random.pick(2);
            const Vector3 point = ways[wanted].middle + m_random.vector(0.3 * m_radius);
            const auto toPoint = [&](int i) {
                return calcDistanceToString(ways[i], m_radius, m_scene.A_S, m_scene.B_S, point);
            };
            if (toPoint(1 - wanted) < 2 * toPoint(wanted)) continue;
            judgeByOutward(point);
            return finish(PassNear{point}, ways[wanted].length,
                          wanted == 0 ? "near the short way" : "near the long way", point);
        }
    }
    void makeCylinderWinding() {
        makeCylinder();
        const double turns = m_random.uniform(-1, 1) * m_random.logUniform(0.5, 12);
        finish(WindAround{turns}, calcWoundString(m_radius, m_scene.A_S, m_scene.B_S, turns).length, "turns",
               Vector3(turns, 0, 0));
    }

    // Over other bodies.
    void makeBody() {
        const double size = m_random.logUniform(0.01, 1);
        const auto axis = [&] { return size * m_random.uniform(0.4, 1.6); };
        const double a = axis(), b = axis(), c = axis();
        switch (m_random.pick(4)) {
            case 0:
                setBody("sphere", std::make_shared<Sphere>(size), size);
                break;
            case 1:
                setBody("ellipsoid", std::make_shared<Ellipsoid>(Vector3(a, b, c)), std::max({a, b, c}));
                break;
            case 2:
                setBody("capsule", std::make_shared<Capsule>(a, b, c), std::max(a, 0.5 * b + c));
                break;
            default:
                setBody("elliptic cylinder", std::make_shared<EllipticCylinder>(a, b), std::max(a, b));
        }
    }
    void setBody(const std::string& kind, std::shared_ptr<const Surface> surface, double radius) {
        m_scene.kind = kind;
        m_surface = std::move(surface);
        m_radius = radius;
        m_hasAxis = kind == "elliptic cylinder";
        m_scene.A_S = makePlaceOutside();
        m_scene.B_S = makePlaceOutside();
    }
    Vector3 makePlaceOutside() {
        Vector3 p;
        do p = m_radius * m_random.logUniform(0.5, 5) * m_random.unitVector();
        while (m_surface->calcHeight(p) < 0.03 * m_surface->getSize());
        return p;
    }
    /** The taut strings that turn by less than a full turn; no string twice. */
    std::vector<TautString> findStrings(const Vector3& over) {
        const Vector3 &A = m_scene.A_S, &B = m_scene.B_S;
        std::vector<std::vector<Vector3>> courses;
        if (m_hasAxis) {
            const double turning = calcShortTurning(A, B);
            for (const double t : {turning, turning - std::copysign(2 * kPi, turning)})
                courses.push_back(makeCourseAboutAxis(A, B, t, 1.5 * m_radius));
        } else {
            const Vector3 along = (B - A).normalized();
            const Vector3 up = (over - over.dot(along) * along).normalized(), across = along.cross(up);
            for (const Vector3& v : {up, Vector3(-up), across, Vector3(-across)})
                courses.push_back(makeCourseOver(A, B, v, 1.5 * m_radius));
        }
        std::vector<TautString> strings;
        for (const auto& course : courses) {
            const TautString string = findTautString(*m_surface, course);
            const auto isSame = [&](const TautString& other) {
                return other.kind == string.kind && std::abs(other.length / string.length - 1) < 1e-7 &&
                       (other.middle - string.middle).norm() < 1e-3 * m_radius;
            };
            if (std::none_of(strings.begin(), strings.end(), isSame)) strings.push_back(string);
        }
        std::sort(strings.begin(), strings.end(), [](const auto& a, const auto& b) { return a.length < b.length; });
        return strings;
    }
    static bool areSmooth(const std::vector<TautString>& strings) {
        return std::all_of(strings.begin(), strings.end(), [](const TautString& s) { return s.isSmooth(); });
    }
    Vector3 calcAcross(Vector3 direction) const {
        if (m_hasAxis) direction.z() = 0;
        return direction;
    }
    /** Half way along what touches, or the surface point nearest to the straight string. */
    Vector3 findMiddle(const std::vector<Vector3>& nodes) const {
        std::vector<Vector3> touching;
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
            for (int k = 0; k < 20; ++k) {
                const Vector3 p = nodes[i] + 0.05 * k * (nodes[i + 1] - nodes[i]);
                if (m_surface->calcHeight(p) < 1e-3 * m_surface->getSize()) touching.push_back(p);
            }
        return touching.empty() ? findNearestPoint(*m_surface, nodes.front(), nodes.back())
                                : m_surface->findSurfacePoint(touching[touching.size() / 2]).p;
    }
    Vector3 calcOutward(const Vector3& p) const {
        return m_surface->calcFrame(m_surface->findSurfacePoint(p), Vector3(1, 2, 3)).N;
    }
    void judgeByOutward(const Vector3& point) {
        m_scene.isAsAsked = [maker = *this, point](const std::vector<Vector3>& nodes) {
            return maker.calcOutward(maker.findMiddle(nodes)).dot(maker.calcOutward(point)) >= 0;
        };
    }
    void makeBodySide() {
        makeBody();
        const Vector3 side = m_random.unitVector();
        const std::vector<TautString> strings = findStrings(side);
        m_scene.isKnown = areSmooth(strings);
        std::optional<double> length;
        for (const TautString& string : strings)
            if (!length && calcAcross(side).dot(string.middle) >= 0) length = string.length;
        m_scene.isAsAsked = [maker = *this, side](const std::vector<Vector3>& nodes) {
            return maker.calcAcross(side).dot(maker.findMiddle(nodes)) >= 0;
        };
        finish(PassOnSide{side}, length, "side", side);
    }
    static double calcDistance(const TautString& string, const Vector3& p) {
        double nearest = kInfinity;
        for (std::size_t i = 0; i + 1 < string.nodes.size(); ++i)
            nearest = std::min(nearest, calcDistanceToSegment(p, string.nodes[i], string.nodes[i + 1]));
        return nearest;
    }
    void makeBodyNear() {
        for (;;) {
            makeBody();
            const std::vector<TautString> strings = findStrings(m_random.unitVector());
            const TautString& wanted = strings[m_random.pick(static_cast<int>(strings.size()))];
            const Vector3 point = wanted.middle + m_random.vector(0.2 * m_surface->getSize());
            const double distance = calcDistance(wanted, point);
            bool isClear = true;
            for (const TautString& other : strings)
                isClear = isClear && (&other == &wanted || calcDistance(other, point) > 2 * distance);
            m_scene.isKnown = areSmooth(strings);
            if (m_scene.isKnown && !isClear) continue;
            judgeByOutward(point);
            if (m_scene.kind == "sphere" && wanted.kind == TautString::Kind::OneArc && m_random.pick(4) == 0)
                return finish(PassNear{-point}, std::nullopt, "near the far side", -point);
            return finish(PassNear{point}, wanted.length, strings.size() > 1 ? "near one of several" : "near the one",
                          point);
        }
    }
    void makeBodyWinding() {
        makeBody();
        const double turns = m_hasAxis ? m_random.uniform(-4, 4) : m_random.uniform(-1.3, 1.3);
        const double direct = calcShortTurning(m_scene.A_S, m_scene.B_S);
        const double turning = direct + 2 * kPi * std::round(turns - direct / (2 * kPi));
        const int springs = static_cast<int>(120 + 20 * std::abs(turning));
        const auto course = makeCourseAboutAxis(m_scene.A_S, m_scene.B_S, turning, 1.5 * m_radius);
        const TautString string = findTautString(*m_surface, course, springs);
        const auto turnsSo = [turning](const auto& nodes) { return std::abs(calcTurning(nodes) - turning) < 0.1; };
        m_scene.isKnown = string.isSmooth();
        m_scene.isAsAsked = turnsSo;
        finish(WindAround{turns}, turnsSo(string.nodes) ? std::optional(string.length) : std::nullopt, "turns",
               Vector3(turns, 0, 0));
    }

    // Through rings.
    void makeHole() {
        const double ring = m_random.logUniform(0.01, 1), hole = m_random.logUniform(0.02, 0.9) * ring;
        m_scene.kind = "torus";
        m_surface = std::make_shared<Torus>(ring, ring - hole);
        m_radius = 2 * ring - hole;
        do {
            m_scene.A_S = m_radius * m_random.logUniform(1.2, 5) * m_random.unitVector();
            m_scene.B_S = m_radius * m_random.logUniform(1.2, 5) * m_random.unitVector();
        } while ((m_scene.A_S - m_scene.B_S).norm() < 0.3 * m_radius);
        if (m_random.pick(4) == 0) return makeNearHole(hole);
        const int passages = m_random.pick(5) == 0 ? 0 : (m_random.flip() ? 1 : -1);
        finishThreaded(ThreadHole{passages}, passages, hole, "passages", Vector3(passages, 0, 0));
    }
    /** A point in the hole, between ends on both sides of it. */
    void makeNearHole(double hole) {
        if (m_scene.A_S.z() * m_scene.B_S.z() > 0) m_scene.B_S.z() *= -1;
        const int passages = m_scene.B_S.z() > 0 ? 1 : -1;
        const Vector3 point = m_random.vector(0.3 * hole);
        finishThreaded(PassNear{point}, passages, hole, "near the middle of the hole", point);
    }
    void finishThreaded(const StartHint& hint, int passages, double hole, const std::string& what,
                        const Vector3& given) {
        const TautString string = findTautString(*m_surface, makeCourseThrough(passages), countSprings(hole));
        const auto goesSo = [surface = m_surface, passages](const std::vector<Vector3>& nodes) {
            int count = 0;
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
                count += surface->getHole()->countCrossings(nodes[i], nodes[i + 1]);
            return count == passages;
        };
        m_scene.isKnown = string.kind != TautString::Kind::Unknown && goesSo(string.nodes);
        m_scene.isAsAsked = goesSo;
        finish(hint, toLength(string), what, given);
    }
    int countSprings(double hole) const {
        return static_cast<int>(std::clamp(3 * m_radius / (0.2 * hole), 120.0, 400.0));
    }
    std::vector<Vector3> makeCourseThrough(int passages) const {
        const double radius = 1.15 * m_radius;
        const Vector3 aside = (m_scene.A_S.normalized() + m_scene.B_S.normalized());
        const Vector3 outwards = Vector3(aside.x(), aside.y(), 0).normalized();
        if (passages == 0) return makeCourseOver(m_scene.A_S, m_scene.B_S, outwards, radius);
        const Vector3 enter(0, 0, -radius * passages), leave = -enter;
        std::vector<Vector3> course =
            makeCourseOver(m_scene.A_S, enter, (m_scene.A_S.normalized() + enter / radius), radius);
        const std::vector<Vector3> out =
            makeCourseOver(leave, m_scene.B_S, (m_scene.B_S.normalized() + leave / radius), radius);
        course.insert(course.end(), out.begin(), out.end());
        return course;
    }

    static std::optional<double> toLength(const std::optional<StringAboutAxis>& string) {
        return string ? std::optional(string->length) : std::nullopt;
    }
    static std::optional<double> toLength(const TautString& string) {
        return string.isSmooth() ? std::optional(string.length) : std::nullopt;
    }

    void finish(const StartHint& hint, std::optional<double> length, const std::string& what, const Vector3& given) {
        const Pose X_GS = m_random.pose(1);
        m_scene.length = length;
        m_scene.problem = PathProblem();
        m_scene.problem.addPoint("origin");
        m_scene.problem.addObstacle("obstacle", m_surface, hint);
        m_scene.problem.addPoint("insertion");
        m_scene.pose.X_GE = {Pose(X_GS * m_scene.A_S), X_GS, Pose(X_GS * m_scene.B_S)};
        const Eigen::IOFormat row(12, Eigen::DontAlignCols, " ", " ", "", "", "(", ")");
        std::ostringstream text;
        text.precision(12);
        text << m_surface->getDescription() << ", A " << m_scene.A_S.format(row) << ", B " << m_scene.B_S.format(row)
             << ", " << what << " " << given.format(row) << ": ";
        if (length)
            text << *length;
        else
            text << "no such path";
        m_scene.description = text.str();
    }

    SeededRandom m_random;
    AskedScene m_scene;
    std::shared_ptr<const Surface> m_surface;
    double m_radius = 0;  ///< of the cylinder, or about the body
    bool m_hasAxis = false;
};

}  // namespace tautline::testing
