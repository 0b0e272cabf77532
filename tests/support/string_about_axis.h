// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Taut strings about an infinite cylinder in closed form, and which of them a hint asks for: known without a solver.

Unrolled, a string about a cylinder is a straight line, so that it is given by the angle by which it turns about the
axis: its homotopy class in space without the axis. Between two points that angle is known up to full turns; for each
value there is one taut string. Two of them turn by less than a full turn: the short way round and the long way. */
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tautline/types.h"

namespace tautline::testing {

/** About the z axis, positive from x to y [rad]. */
struct StringAboutAxis {
    double turning = 0;
    bool isTouching = false;
    double length = 0;                 ///< [m]
    Vector3 P, Q;                      ///< ends of the arc; while it does not touch, both the point nearest to the axis
    Vector3 middle = Vector3::Zero();  ///< of the arc, or the point nearest to the axis
};

/** From the azimuth of A to that of B, in (-pi, pi]: the short way round. */
inline double calcShortTurning(const Vector3& A, const Vector3& B) {
    return std::atan2(A.x() * B.y() - A.y() * B.x(), A.x() * B.x() + A.y() * B.y());
}

inline Vector3 makeOnCylinder(double radius, double azimuth, double z) {
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/** The point of the segment A B nearest to the z axis. */
inline Vector3 findNearestToAxis(const Vector3& A, const Vector3& B) {
    const Vector2 step = (B - A).head<2>();
    const double along = step.squaredNorm() > 0 ? -A.head<2>().dot(step) / step.squaredNorm() : 0.0;
    return A + std::clamp(along, 0.0, 1.0) * (B - A);
}

/** The taut string that turns by `turning`, which leads from A to B and is below pi where the string is straight.
@param A, B   outside the cylinder of this radius about z */
inline StringAboutAxis calcStringAboutAxis(double radius, const Vector3& A, const Vector3& B, double turning) {
    const double rA = A.head<2>().norm(), rB = B.head<2>().norm(), rise = B.z() - A.z();
    const double toTangentA = std::acos(radius / rA), toTangentB = std::acos(radius / rB);
    const double arc = std::abs(turning) - toTangentA - toTangentB, sense = turning < 0 ? -1 : 1;
    StringAboutAxis string;
    string.turning = turning;
    string.isTouching = arc > 0;
    if (!string.isTouching) {
        string.length = (B - A).norm();
        string.P = string.Q = string.middle = findNearestToAxis(A, B);
        return string;
    }
    const double before = std::sqrt(rA * rA - radius * radius), after = std::sqrt(rB * rB - radius * radius);
    const double planar = before + radius * arc + after;
    const auto onArc = [&](double angle) {
        const double azimuth = std::atan2(A.y(), A.x()) + sense * (toTangentA + angle);
        return makeOnCylinder(radius, azimuth, A.z() + rise * (before + radius * angle) / planar);
    };
    string.length = std::hypot(planar, rise);
    string.P = onArc(0);
    string.Q = onArc(arc);
    string.middle = onArc(0.5 * arc);
    return string;
}

/** The short way round first. */
inline std::array<StringAboutAxis, 2> calcBothWays(double radius, const Vector3& A, const Vector3& B) {
    const double turning = calcShortTurning(A, B);
    return {calcStringAboutAxis(radius, A, B, turning),
            calcStringAboutAxis(radius, A, B, turning - std::copysign(2 * kPi, turning))};
}

/** PassOnSide: of the two ways round, the shorter one whose middle lies on the side; none, where neither does. The part
of the direction along the axis does not count: along it, one place is as good as another. */
inline std::optional<StringAboutAxis> findStringOnSide(double radius, const Vector3& A, const Vector3& B,
                                                       const Vector3& side) {
    for (const StringAboutAxis& way : calcBothWays(radius, A, B))
        if (side.head<2>().dot(way.middle.head<2>()) >= 0) return way;
    return std::nullopt;
}

/** WindAround: the string whose turning is the one nearest to so many full turns. */
inline StringAboutAxis calcWoundString(double radius, const Vector3& A, const Vector3& B, double turns) {
    const double direct = calcShortTurning(A, B);
    return calcStringAboutAxis(radius, A, B, direct + 2 * kPi * std::round(turns - direct / (2 * kPi)));
}

inline double calcDistanceToSegment(const Vector3& p, const Vector3& A, const Vector3& B) {
    const double length2 = (B - A).squaredNorm();
    const double along = length2 > 0 ? std::clamp((p - A).dot(B - A) / length2, 0.0, 1.0) : 0.0;
    return (p - A - along * (B - A)).norm();
}

/** How near the string from A to B passes a point. */
inline double calcDistanceToString(const StringAboutAxis& string, double radius, const Vector3& A, const Vector3& B,
                                   const Vector3& p) {
    constexpr int kSteps = 200;
    double nearest = std::min(calcDistanceToSegment(p, A, string.P), calcDistanceToSegment(p, string.Q, B));
    if (!string.isTouching) return nearest;
    const double from = std::atan2(string.P.y(), string.P.x());
    const double arc = string.turning - calcShortTurning(A, string.P) - calcShortTurning(string.Q, B);
    for (int i = 0; i <= kSteps; ++i) {
        const double part = static_cast<double>(i) / kSteps;
        const double z = string.P.z() + part * (string.Q.z() - string.P.z());
        nearest = std::min(nearest, (makeOnCylinder(radius, from + part * arc, z) - p).norm());
    }
    return nearest;
}

}  // namespace tautline::testing
