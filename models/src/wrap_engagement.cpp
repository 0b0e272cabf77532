// SPDX-License-Identifier: Apache-2.0
#include "wrap_engagement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tautline::models {
namespace {

/** A string over a circle about the origin of the xy plane, turned one way about it. */
struct TurnedString {
    double straightA = 0, arc = 0, straightB = 0;  ///< lengths in the plane; arc < 0: lifted
    double middle = 0;                             ///< angle of the middle of the arc

    /** @param turn   1 from x to y, or -1 */
    TurnedString(double radius, const Vector3& A, const Vector3& B, double turn) {
        const double a = std::hypot(A.x(), A.y()), b = std::hypot(B.x(), B.y());
        const double begin = std::atan2(A.y(), A.x()) + turn * std::acos(radius / a);
        const double end = std::atan2(B.y(), B.x()) - turn * std::acos(radius / b);
        // From a quarter turn back, where it is lifted, to three quarters forth, so that touching is no jump.
        double sweep = std::fmod(turn * (end - begin) + 0.5 * kPi, 2 * kPi);
        if (sweep < 0) sweep += 2 * kPi;
        sweep -= 0.5 * kPi;
        straightA = std::sqrt(a * a - radius * radius), straightB = std::sqrt(b * b - radius * radius);
        arc = radius * sweep;
        middle = begin + 0.5 * turn * sweep;
    }
    double getLength() const { return straightA + arc + straightB; }
};

bool isOutside(const CylinderShape& cylinder, const Vector3& A, const Vector3& B) {
    const double least = cylinder.radius * cylinder.radius;
    return A.head<2>().squaredNorm() > least && B.head<2>().squaredNorm() > least;
}

/** On the side that is asked for, else the shorter way. */
TurnedString layString(const CylinderShape& cylinder, const Vector3& side, const Vector3& A, const Vector3& B) {
    const TurnedString forth(cylinder.radius, A, B, 1), back(cylinder.radius, A, B, -1);
    const auto isOnSide = [&](const TurnedString& string) {
        return side.x() * std::cos(string.middle) + side.y() * std::sin(string.middle) > 0;
    };
    const bool isForth = isOnSide(forth) != isOnSide(back) ? isOnSide(forth) : forth.getLength() < back.getLength();
    return isForth ? forth : back;
}

}  // namespace

Vector3 getActiveSide(Quadrant quadrant) {
    switch (quadrant) {
        case Quadrant::PlusX:
            return Vector3::UnitX();
        case Quadrant::MinusX:
            return -Vector3::UnitX();
        case Quadrant::PlusY:
            return Vector3::UnitY();
        case Quadrant::MinusY:
            return -Vector3::UnitY();
        case Quadrant::PlusZ:
            return Vector3::UnitZ();
        case Quadrant::MinusZ:
            return -Vector3::UnitZ();
        case Quadrant::All:
            break;
    }
    return Vector3::Zero();
}

SegmentInObject::SegmentInObject(const Surface& surface, const Vector3& begin, const Vector3& end)
    : A(begin), length((end - begin).norm()) {
    e = length > 0 ? Vector3((end - begin) / length) : Vector3(Vector3::UnitX());
    lowest = surface.findLowestPoint(A, e, length);
    height = surface.calcHeight(A + lowest * e);
    hasEndInside = surface.calcHeight(begin) < 0 || surface.calcHeight(end) < 0;
}

bool touchesWithinLength(const CylinderShape& cylinder, const Vector3& side, const Vector3& A, const Vector3& B) {
    const double end = 0.5 * cylinder.length;
    if (std::max(std::abs(A.z()), std::abs(B.z())) <= end) return true;  // and so is all between
    if (!isOutside(cylinder, A, B)) return true;
    if (std::min(A.z(), B.z()) > end || std::max(A.z(), B.z()) < -end) return false;
    const TurnedString string = layString(cylinder, side, A, B);
    // Unrolled, the string is straight: z grows evenly along it.
    const double slope = (B.z() - A.z()) / string.getLength();
    const double first = A.z() + slope * string.straightA, last = B.z() - slope * string.straightB;
    return std::abs(first) <= end || std::abs(last) <= end;
}

bool isEngaged(const WrapObject& object, const SegmentInObject& segment) {
    if (segment.hasEndInside) return false;
    const Vector3 D = segment.A + segment.lowest * segment.e, B = segment.getEnd();
    const auto* cylinder = std::get_if<CylinderShape>(&object.shape);
    const Vector3 side = getActiveSide(object.quadrant);
    if (cylinder && !touchesWithinLength(*cylinder, side, segment.A, B)) return false;
    if (segment.isPierced()) return true;
    if (!cylinder || side.isZero()) return false;
    const bool isActiveA = segment.A.dot(side) > 0, isActiveB = B.dot(side) > 0;
    return D.dot(side) < 0 && !(isActiveA && isActiveB);
}

std::optional<std::size_t> findEngagedSegment(const WrapObject& object, const std::vector<SegmentInObject>& segments) {
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < segments.size(); ++s) {
        const SegmentInObject& segment = segments[s];
        if (!isEngaged(object, segment)) continue;
        if (segment.isPierced()) return s;
        // Only cylinders engage on segments that do not meet them.
        const TurnedString string = layString(std::get<CylinderShape>(object.shape), getActiveSide(object.quadrant),
                                              segment.A, segment.getEnd());
        const double dz = segment.getEnd().z() - segment.A.z();
        const double lengthening = std::hypot(string.getLength(), dz) - segment.length;
        if (lengthening < least) least = lengthening, best = s;
    }
    return best;
}

}  // namespace tautline::models
