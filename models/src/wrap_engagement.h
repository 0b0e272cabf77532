// SPDX-License-Identifier: Apache-2.0
#pragma once
/** OpenSim's rules of where a wrap object engages on the straight segments of a path, as far as places decide. Points
are in the frame of the object. */
#include <optional>
#include <vector>

#include "tautline/models/model_description.h"
#include "tautline/surfaces/surface.h"

namespace tautline::models {

/** The axis and sign of a quadrant; a zero vector for all. */
Vector3 getActiveSide(Quadrant quadrant);

/** A straight segment from A to B seen from a wrap object. */
struct SegmentInObject {
    Vector3 A, e;  ///< begin and direction
    double length = 0.0;
    double lowest = 0.0;  ///< coordinate of its lowest point over the surface
    double height = 0.0;  ///< of that point
    bool hasEndInside = false;

    SegmentInObject() = default;
    SegmentInObject(const Surface& surface, const Vector3& begin, const Vector3& end);
    Vector3 getEnd() const { return A + length * e; }
    bool isPierced() const { return height < 0; }
};

/** Whether a string from A to B over a cylinder and over nothing else would touch it within its length, at one end of
its arc at least: beyond that OpenSim lets it wrap no more. Where the string would lift off, the place at which it last
touched decides, so that the answer changes with the place and not with the contact. True if an end is inside.
@param side   on which it passes; zero: the shorter one */
bool touchesWithinLength(const CylinderShape& cylinder, const Vector3& side, const Vector3& A, const Vector3& B);

/** Whether a path wraps on this segment: where the segment meets the object, or, of a cylinder with a quadrant, where
it passes it on the side opposite to the active one. A cylinder counts within its length only. */
bool isEngaged(const WrapObject& object, const SegmentInObject& segment);

/** OpenSim lets an object engage on one segment at a time: the first that meets it, else of those that are engaged the
one that this lengthens least.
@return its index; nothing if none is engaged */
std::optional<std::size_t> findEngagedSegment(const WrapObject& object, const std::vector<SegmentInObject>& segments);

}  // namespace tautline::models
