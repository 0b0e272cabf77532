// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Length of a string in a plane around circles, each with a sense: closed form, for tests. */
#include <cmath>
#include <vector>

#include "tautline/types.h"

namespace tautline::testing {

/** A circle that the string passes with its center on the left (sense +1) or right (-1); radius 0: a point. */
struct PlanarStop {
    Vector2 center;
    double radius = 0;
    int sense = 1;
};

/** @param turns   arcs in (0, 2 pi) if true; else in (-pi, pi], negative past lift-off */
inline double calcPlanarLength(const std::vector<PlanarStop>& stops, bool turns = true) {
    double length = 0, before = 0;
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        // On the tangent (center - x) . n = sense radius with n to its left.
        const Vector2 D = stops[i + 1].center - stops[i].center;
        const double offset = stops[i + 1].sense * stops[i + 1].radius - stops[i].sense * stops[i].radius;
        const double direction = std::atan2(D.y(), D.x()) - std::asin(offset / D.norm());
        length += std::sqrt(D.squaredNorm() - offset * offset);
        if (i > 0) {
            double arc = std::fmod(stops[i].sense * (direction - before), 2 * kPi);
            const double low = turns ? 0 : -kPi;
            while (arc < low) arc += 2 * kPi;
            while (arc > low + 2 * kPi) arc -= 2 * kPi;
            length += arc * stops[i].radius;
        }
        before = direction;
    }
    return length;
}

}  // namespace tautline::testing
