// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

namespace tautline {

/** A point of a curve with the slope there. */
struct CurvePoint {
    double x = 0, y = 0, slope = 0;
};

/** A smooth curve y(x) of quintic Bezier corners, as Millard's muscle curves are (Millard et al. 2013, J. Biomech. Eng.
135:021005, appendix). Between two neighboring points the control polygon runs along their tangents towards the
tangents' intersection: (P, M, M, N, N, Q), where M and N are the share `curviness` of the way from P and Q to it. Twice
continuously differentiable. Before the first and beyond the last point it goes on straight. */
class SmoothCurve {
public:
    /** @param points        ascending in x; between any two the tangents must meet in a corner, not in an S
    @param curviness     of the corner behind each point but the last, in [0, 1]
    @param name          for messages
    @throws InvalidInput naming the curve and the points */
    SmoothCurve(const std::vector<CurvePoint>& points, const std::vector<double>& curviness, const char* name);

    double calcValue(double x) const;
    double calcDerivative(double x) const;
    /** Integral of y from the first point to x; negative before it. */
    double calcIntegral(double x) const;
    /** The x at which yScale y(x) + xScale x = value, for an ascending y and scales not negative: solved within one
    corner at once, without searching x(u) inside a search for x. What would be beyond +-limit is that. */
    double findArgument(double yScale, double xScale, double value, double limit) const;

private:
    struct Corner {
        std::array<double, 6> x, y;
        double integralBefore = 0;  ///< of all corners before this one
    };
    const Corner& findCorner(double x) const;

    std::vector<Corner> m_corners;
    CurvePoint m_first, m_last;
    double m_integral = 0;  ///< from the first to the last point
};

}  // namespace tautline
