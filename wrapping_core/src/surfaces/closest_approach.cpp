// SPDX-License-Identifier: Apache-2.0
#include "surfaces/closest_approach.h"

#include <algorithm>
#include <cmath>

namespace tautline {
namespace {

constexpr double kFirst = 1e-3;  ///< of a step from an end, in sizes: a segment may dip just beyond its tangent point
constexpr double kRounding = 1e-9;  ///< of the length, so that a step is one
constexpr int kPatience = 100;      ///< steps after which the least one becomes twice as long
constexpr double kLevel = 1e-9;     ///< slopes that count as none: what tangency leaves

/** A point of the line: its height and, within the accuracy of heights, the slope of that along the line. */
struct Sample {
    double s, height, slope;
};

class LineHeights {
public:
    LineHeights(const Surface& surface, const Vector3& A_S, const Vector3& e_S)
        : m_surface(surface), m_A(A_S), m_e(e_S) {}

    Sample operator()(double s) const {
        Vector3 N;
        const double height = m_surface.calcHeightAndNormal(m_A + s * m_e, N);
        return {s, height, N.dot(m_e)};
    }

    /** Between a sample where the line goes down and one where it comes up again: regula falsi (Illinois). */
    ClosestApproach findMinimum(Sample down, Sample up) const {
        constexpr int kMaxIterations = 60;
        const double tolerance = 1e-9 * m_surface.getSize();
        double slopeDown = down.slope, slopeUp = up.slope;
        bool wasDown = false, wasUp = false;
        for (int i = 0; i < kMaxIterations && up.s - down.s > tolerance; ++i) {
            const double s = (down.s * slopeUp - up.s * slopeDown) / (slopeUp - slopeDown);
            const Sample middle = (*this)(std::clamp(s, down.s, up.s));
            const bool isDown = middle.slope < 0;
            if (isDown) {
                down = middle, slopeDown = middle.slope;
                if (wasDown) slopeUp /= 2;
            } else {
                up = middle, slopeUp = middle.slope;
                if (wasUp) slopeDown /= 2;
            }
            wasDown = isDown, wasUp = !isDown;
            if (std::abs(middle.slope) < 1e-3 * kLevel) break;
        }
        const Sample& lower = down.height < up.height ? down : up;
        return {lower.s, lower.height};
    }

private:
    const Surface& m_surface;
    const Vector3 m_A, m_e;
};

}  // namespace

std::optional<ClosestApproach> findClosestApproach(const Surface& surface, const Vector3& A_S, const Vector3& e_S,
                                                   double length, double bound) {
    const LineHeights calc(surface, A_S, e_S);
    const double size = surface.getSize();
    double leastStep = size / 4;
    int numSteps = 0;
    std::optional<ClosestApproach> lowest;
    std::optional<Sample> down;  // the last sample from which the line goes down
    for (Sample here = calc(0);;) {
        if (here.slope < -kLevel) down = here;
        if (here.slope > kLevel && down) {
            const bool mayBeLower = (down->height + here.height) / 2 - (here.s - down->s) < bound;
            const ClosestApproach place = mayBeLower ? calc.findMinimum(*down, here) : ClosestApproach{here.s, bound};
            if (place.height < bound) lowest = place, bound = place.height;
            down.reset();
        }
        if (!(here.s < length)) return lowest;
        if (++numSteps % kPatience == 0) leastStep *= 2;
        const double fromEnd = std::max({kFirst * size, kRounding * length, 0.5 * std::min(here.s, length - here.s)});
        const double step = std::max({std::min(leastStep, fromEnd), here.height / 4, (here.height - bound) / 2});
        here = calc(std::min(length, here.s + step));
    }
}

}  // namespace tautline
