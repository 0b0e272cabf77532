#pragma once
#include "tautline/surface.h"

namespace tautline {

struct ObstacleContact;
struct StraightSegment;

/** How a path goes through an obstacle's hole, between the fixed points or touched obstacles beside it. */
struct HolePassage {
    int count = 0;                  ///< along +z of S less against it
    int from = -1, to = -1;         ///< elements beside: where this portion of the path begins and ends
    Vec3 A_S = Vec3::Zero();        ///< where it begins
    Vec3 B_S = Vec3::Zero();        ///< where it ends
    Vec3 through_S = Vec3::Zero();  ///< where it last went through, if it does

    bool isKnown() const { return from >= 0; }
};

/** True if the z axis of S goes through a hole of the surface. */
bool hasHole(const Surface& surface);

/** Counts the passages of a solved path. @param in, out   the segments before and after the contact; the same one
while the obstacle is lifted */
HolePassage calcHolePassage(const Surface& surface, const Pose& X_GS, const ObstacleContact& contact,
                            const StraightSegment& in, const StraightSegment& out);

/** True if a string cannot have come from `before` to `after` without the ring going through it: the two, closed
by the straight ways of their ends, are linked with the ring. False where the portions are not comparable. */
bool hasLeftHole(const Surface& surface, const HolePassage& before, const HolePassage& after);

}  // namespace tautline
