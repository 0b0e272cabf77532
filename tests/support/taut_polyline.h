// SPDX-License-Identifier: Apache-2.0
#pragma once
/** A truth of the tests' own for strings on any surface, slow and simple: a polyline of equal springs that is laid
along a course and falls taut, each node outside all bodies; and for the string that lies on one body in one piece its
exact length, by shooting that one arc so that it meets both straight parts tangentially. Nothing here knows of the
path solver. */
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tautline/surfaces/surface.h"

namespace tautline::testing {

struct Body {
    const Surface* surface;
    Pose X_GS;

    double calcHeight(const Vector3& p_G) const { return surface->calcHeight(X_GS.shiftBack(p_G)); }
    /** The nearest surface point, nearly: the foot of the steepest descent, moved along the surface by what is left of
    the way to p that is not normal there. */
    Vector3 findNearestPoint(const Vector3& p_G) const {
        constexpr int kCorrections = 2;
        const Vector3 p = X_GS.shiftBack(p_G);
        Vector3 x = surface->findSurfacePoint(p).p, N;
        for (int i = 0; i < kCorrections; ++i) {
            surface->calcHeightAndNormal(x, N);
            x = surface->findSurfacePoint(p - N.dot(p - x) * N).p;
        }
        return X_GS * x;
    }
};

/** Springs between nodes: no node is ever moved but to where its two springs store less, so that the energy falls until
nothing moves. Springs of equal stiffness end up equally long, and the polyline at a shortest course. */
class TautPolyline {
public:
    static constexpr double kTouching = 1e-6;  ///< in sizes: higher nodes are free
    static constexpr double kSunk = 1e-10;     ///< in sizes: lower ones are lifted

    /** @param course   from the first fixed end to the last, clear of the bodies or nearly so
    @param count    of springs */
    TautPolyline(std::vector<Body> bodies, const std::vector<Vector3>& course, int count)
        : m_bodies(std::move(bodies)) {
        lay(course, count);
    }

    /** @param accuracy   on the largest move of a sweep, in lengths of a spring
    @return true if nothing moves any more */
    bool relax(double accuracy, int maxSweeps) {
        // The best factor of successive overrelaxation for a chain of that many springs (Young 1954).
        const double factor = 2 / (1 + std::sin(kPi / static_cast<double>(m_nodes.size())));
        for (int sweep = 0; sweep < maxSweeps; ++sweep) {
            double largest = 0;
            for (std::size_t i = 1; i + 1 < m_nodes.size(); ++i) largest = std::max(largest, moveNode(i, factor));
            if (largest < accuracy * calcLength() / static_cast<double>(m_nodes.size())) return true;
        }
        return false;
    }

    double calcLength() const {
        double length = 0;
        for (std::size_t i = 0; i + 1 < m_nodes.size(); ++i) length += (m_nodes[i + 1] - m_nodes[i]).norm();
        return length;
    }

    const std::vector<Vector3>& getNodes() const { return m_nodes; }

    /** First and last node of each stretch that lies on a body, in order along the string. */
    std::vector<std::pair<int, int>> findStretches(int body) const {
        std::vector<std::pair<int, int>> stretches;
        const double touching = kTouching * m_bodies[body].surface->getSize();
        for (int i = 1; i + 1 < static_cast<int>(m_nodes.size()); ++i) {
            if (!(m_bodies[body].calcHeight(m_nodes[i]) < touching)) continue;
            if (stretches.empty() || stretches.back().second < i - 1) stretches.emplace_back(i, i);
            stretches.back().second = i;
        }
        return stretches;
    }

private:
    void lay(const std::vector<Vector3>& course, int count) {
        double length = 0;
        for (std::size_t i = 0; i + 1 < course.size(); ++i) length += (course[i + 1] - course[i]).norm();
        const double spring = length / count;
        double passed = 0;
        std::size_t leg = 0;
        m_nodes.push_back(course.front());
        for (int i = 1; i < count; ++i) {
            while (leg + 2 < course.size() && i * spring > passed + (course[leg + 1] - course[leg]).norm()) {
                passed += (course[leg + 1] - course[leg]).norm();
                ++leg;
            }
            const Vector3 direction = (course[leg + 1] - course[leg]).normalized();
            m_nodes.push_back(keepOutside(course[leg] + (i * spring - passed) * direction));
        }
        m_nodes.push_back(course.back());
    }

    /** Onto the surface of the body that it is in; of the next one, if it is then in that. */
    Vector3 keepOutside(Vector3 p) const {
        constexpr int kMaxRounds = 10;
        for (int round = 0; round < kMaxRounds; ++round) {
            bool isOutside = true;
            for (const Body& body : m_bodies) {
                if (!(body.calcHeight(p) < -kSunk * body.surface->getSize())) continue;
                p = body.findNearestPoint(p);
                isOutside = false;
            }
            if (isOutside) break;
        }
        return p;
    }

    /** Towards the middle of its neighbors and beyond it, or only as far where that does not pay. @return the move */
    double moveNode(std::size_t i, double factor) {
        const Vector3 middle = 0.5 * (m_nodes[i - 1] + m_nodes[i + 1]), old = m_nodes[i];
        for (const double part : {factor, 1.0, 0.5, 0.1}) {
            const Vector3 moved = keepOutside(old + part * (middle - old));
            // What two springs store grows with the distance from the middle between their ends.
            if (!((moved - middle).squaredNorm() < (old - middle).squaredNorm())) continue;
            m_nodes[i] = moved;
            return (moved - old).norm();
        }
        return 0;
    }

    std::vector<Body> m_bodies;
    std::vector<Vector3> m_nodes;
};

/** What a string that has fallen taut over one body, in S, came to. */
struct TautString {
    enum class Kind {
        Straight,
        OneArc,
        Elsewise,  ///< it lies on the body in several stretches
        Unknown,   ///< it still slides, or no arc was found to fit it
    };
    Kind kind = Kind::Unknown;
    double length = kNaN;  ///< exact for Straight and OneArc
    Vector3 middle =
        Vector3::Zero();         ///< half way along the arc; of a straight string the surface point it is nearest to
    std::vector<Vector3> nodes;  ///< of the polyline

    bool isSmooth() const { return kind == Kind::Straight || kind == Kind::OneArc; }
};

/** Newton's method, differences for derivatives, on the one arc between two straight parts. */
class OneArc {
public:
    OneArc(const Surface& surface, const Vector3& A, const Vector3& B) : m_surface(surface), m_A(A), m_B(B) {}

    /** @param P, Q      near the arc's ends, `along` the arc's direction at P
    @param length    of the arc, nearly */
    bool fit(const Vector3& P, const Vector3& along, double length) {
        m_start.point = m_surface.findSurfacePoint(P);
        m_start.tangent = m_surface.calcFrame(m_start.point, along).t;
        m_start.length = length;
        double error = calcError(m_start).norm();
        for (int i = 0; i < 60 && error > 1e-12; ++i) {
            const Vector4 step = calcStep();
            double part = 1, next = kNaN;
            for (; part > 1e-4; part /= 2) {
                next = calcError(calcChanged(part * step)).norm();
                if (next < error) break;
            }
            if (!(next < error)) break;
            m_start = calcChanged(part * step);
            error = next;
        }
        return error < 1e-9;
    }

    double getArcLength() const { return m_start.length; }
    double calcLength() const {
        const ShotGeodesic arc = shoot(m_start);
        return (arc.P.x - m_A).norm() + m_start.length + (m_B - arc.Q.x).norm();
    }
    Vector3 calcPoint(double part) const {
        GeodesicStart start = m_start;
        start.length *= part;
        return shoot(start).Q.x;
    }

private:
    ShotGeodesic shoot(const GeodesicStart& start) const {
        ShotGeodesic arc;
        m_surface.shootGeodesic(start, ShootingOptions{}, arc);
        return arc;
    }
    /** Where the straight parts leave the plane of the tangent and the arc's direction: (A: N, B; B: N, B). */
    Vector4 calcError(const GeodesicStart& start) const {
        const ShotGeodesic arc = shoot(start);
        const Vector3 in = (arc.P.x - m_A).normalized(), out = (m_B - arc.Q.x).normalized();
        return {in.dot(arc.P.N), in.dot(arc.P.B), out.dot(arc.Q.N), out.dot(arc.Q.B)};
    }
    /** By (forwards and sideways displacement of the start, turn of its direction, lengthening). */
    GeodesicStart calcChanged(const Vector4& q) const {
        const DarbouxFrame frame = m_surface.calcFrame(m_start.point, m_start.tangent);
        GeodesicStart changed = m_start;
        changed.point = m_surface.calcDisplacedPoint(m_start.point, q[0] * frame.t + q[1] * frame.B);
        changed.tangent = std::cos(q[2]) * frame.t + std::sin(q[2]) * frame.B;
        changed.tangent = m_surface.calcFrame(changed.point, changed.tangent).t;
        changed.length += q[3];
        return changed;
    }
    Vector4 calcStep() const {
        const double size = m_surface.getSize();
        const Vector4 scale(size, size, 1, size);
        Matrix4 jacobian;
        for (int k = 0; k < 4; ++k) {
            const Vector4 h = 1e-5 * scale[k] * Vector4::Unit(k);
            jacobian.col(k) = (calcError(calcChanged(h)) - calcError(calcChanged(-h))) / 2e-5;
        }
        Vector4 step = jacobian.fullPivLu().solve(-calcError(m_start));
        step *= std::min(1.0, 0.3 / step.cwiseAbs().maxCoeff());
        return step.cwiseProduct(scale);
    }

    const Surface& m_surface;
    Vector3 m_A, m_B;
    GeodesicStart m_start;
};

/** Where on the segment it is lowest over the surface, of many samples. @return the height there */
inline double findLowestSample(const Surface& surface, const Vector3& A, const Vector3& B, Vector3& lowest) {
    constexpr int kSamples = 400;
    double least = kInfinity;
    for (int i = 0; i <= kSamples; ++i) {
        const Vector3 p = A + i * (B - A) / kSamples;
        const double height = surface.calcHeight(p);
        if (height < least) least = height, lowest = p;
    }
    return least;
}

/** The point of a convex surface that is nearest to the segment: steps along the surface towards it, from under its
lowest place, which is another one where heights are not distances. */
inline Vector3 findNearestPoint(const Surface& surface, const Vector3& A, const Vector3& B) {
    const auto calcNearestOnSegment = [&](const Vector3& p) {
        return Vector3(A + std::clamp((p - A).dot(B - A) / (B - A).squaredNorm(), 0.0, 1.0) * (B - A));
    };
    Vector3 lowest = A;
    findLowestSample(surface, A, B, lowest);
    Vector3 nearest = surface.findSurfacePoint(lowest).p;
    double distance = (calcNearestOnSegment(nearest) - nearest).norm();
    for (double part = 1; part > 1e-9;) {
        const Vector3 step = calcNearestOnSegment(nearest) - nearest;
        const Vector3 N = surface.calcFrame(surface.findSurfacePoint(nearest), Vector3(1, 2, 3)).N;
        const Vector3 next = surface.findSurfacePoint(nearest + part * (step - N.dot(step) * N)).p;
        const double reached = (calcNearestOnSegment(next) - next).norm();
        if (reached < distance) {
            nearest = next, distance = reached;
            part = std::min(1.0, 2 * part);
        } else {
            part /= 2;
        }
    }
    return nearest;
}

/** The string from A to B that falls taut from the course over one body in its frame S, made of so many springs. */
inline TautString findTautStringOf(int springs, const Surface& surface, const std::vector<Vector3>& course) {
    constexpr double kAccuracy = 3e-6, kClear = -1e-7;  // the last in sizes
    const Vector3 A = course.front(), B = course.back();
    TautPolyline polyline({{&surface, Pose()}}, course, springs);
    TautString string;
    const bool isAtRest = polyline.relax(kAccuracy, 3000);
    string.nodes = polyline.getNodes();
    string.length = polyline.calcLength();
    if (!isAtRest) return string;
    const auto stretches = polyline.findStretches(0);
    Vector3 lowest;
    const double height = findLowestSample(surface, A, B, lowest);
    if (stretches.empty() && height > kClear * surface.getSize() && string.length < (1 + 1e-6) * (B - A).norm()) {
        string.kind = TautString::Kind::Straight;
        string.length = (B - A).norm();
        string.middle = findNearestPoint(surface, A, B);
        return string;
    }
    if (stretches.size() > 1) {
        string.kind = TautString::Kind::Elsewise;
        return string;
    }
    const int first = stretches.empty() ? 0 : stretches[0].first, last = stretches.empty() ? 0 : stretches[0].second;
    const Vector3 P = stretches.empty() ? lowest : string.nodes[first];
    const Vector3 along =
        stretches.empty() ? Vector3(B - A) : Vector3(string.nodes[first + 1] - string.nodes[first - 1]);
    double length = 0;
    for (int i = first; i < last; ++i) length += (string.nodes[i + 1] - string.nodes[i]).norm();
    OneArc arc(surface, A, B);
    if (!arc.fit(P, along, length) || arc.getArcLength() < 0) return string;
    if (std::abs(arc.calcLength() / string.length - 1) > 2e-2) return string;
    const double clear = kClear * surface.getSize();
    if (findLowestSample(surface, A, arc.calcPoint(0), lowest) < clear ||
        findLowestSample(surface, arc.calcPoint(1), B, lowest) < clear) {
        string.kind = TautString::Kind::Elsewise;
        return string;
    }
    string.kind = TautString::Kind::OneArc;
    string.length = arc.calcLength();
    string.middle = arc.calcPoint(0.5);
    return string;
}

/** Whether a string at rest returns when it is pushed sideways: one on a saddle slides off, however slowly it did. */
inline bool isHeld(const Surface& surface, const TautString& string) {
    constexpr double kPush = 0.05, kSame = 1e-4;  // in sizes; of the length
    std::vector<Vector3> pushed = string.nodes;
    const std::size_t last = pushed.size() - 1;
    for (std::size_t i = 1; i < last; ++i) {
        Vector3 N;
        surface.calcHeightAndNormal(string.nodes[i], N);
        const Vector3 across = (string.nodes[i + 1] - string.nodes[i - 1]).cross(N).normalized();
        const double part = static_cast<double>(i) / static_cast<double>(last);
        pushed[i] += kPush * surface.getSize() * std::sin(kPi * part) * across;
    }
    const TautString again = findTautStringOf(static_cast<int>(last), surface, pushed);
    return again.kind == string.kind && std::abs(again.length / string.length - 1) < kSame;
}

/** The same, if it is held; one that does not come to rest may with more springs. */
inline TautString findTautString(const Surface& surface, const std::vector<Vector3>& course, int springs = 120) {
    TautString string;
    for (const double factor : {1.0, 1.4, 2.0}) {
        string = findTautStringOf(static_cast<int>(factor * springs), surface, course);
        if (string.kind != TautString::Kind::Unknown) break;
    }
    if (string.kind == TautString::Kind::OneArc && !isHeld(surface, string)) string.kind = TautString::Kind::Unknown;
    return string;
}

/** Around a body about the z axis, from A out to `radius`, by `turning`, and in to B. */
inline std::vector<Vector3> makeCourseAboutAxis(const Vector3& A, const Vector3& B, double turning, double radius) {
    const int steps = std::max(8, static_cast<int>(std::ceil(std::abs(turning) * 6)));
    std::vector<Vector3> course{A};
    const double from = std::atan2(A.y(), A.x());
    for (int i = 0; i <= steps; ++i) {
        const double part = static_cast<double>(i) / steps, azimuth = from + part * turning;
        course.push_back({radius * std::cos(azimuth), radius * std::sin(azimuth), A.z() + part * (B.z() - A.z())});
    }
    course.push_back(B);
    return course;
}

/** From A out to `radius` from the origin, by great circles over the direction `over`, and in to B. */
inline std::vector<Vector3> makeCourseOver(const Vector3& A, const Vector3& B, const Vector3& over, double radius) {
    constexpr int kSteps = 12;
    const auto addArc = [radius](const Vector3& from, const Vector3& to, std::vector<Vector3>& course) {
        for (int i = 0; i <= kSteps; ++i) {
            const double part = static_cast<double>(i) / kSteps;
            const double angle = std::acos(std::clamp(from.dot(to), -1.0, 1.0));
            const Vector3 mixed = std::sin((1 - part) * angle) * from + std::sin(part * angle) * to;
            course.push_back(radius * mixed.normalized());
        }
    };
    std::vector<Vector3> course{A};
    addArc(A.normalized(), over.normalized(), course);
    addArc(over.normalized(), B.normalized(), course);
    course.push_back(B);
    return course;
}

}  // namespace tautline::testing
