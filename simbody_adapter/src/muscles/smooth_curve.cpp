// SPDX-License-Identifier: Apache-2.0
#include "tautline/muscles/smooth_curve.h"

#include <algorithm>
#include <cmath>

#include "tautline/error.h"

namespace tautline {
namespace {

using Polygon = std::array<double, 6>;

/** A point of the quintic with its derivative by u. */
struct Evaluation {
    double value = 0, derivative = 0;
};

Evaluation evaluate(const Polygon& c, double u) {
    const double v = 1 - u, u2 = u * u, v2 = v * v;
    Evaluation e;
    e.value = v2 * v2 * (v * c[0] + 5 * u * c[1]) + 10 * u2 * v2 * (v * c[2] + u * c[3]) +
              u2 * u2 * (5 * v * c[4] + u * c[5]);
    e.derivative = 5 * (v2 * v2 * (c[1] - c[0]) + u2 * u2 * (c[5] - c[4])) +
                   20 * u * v * (v2 * (c[2] - c[1]) + u2 * (c[4] - c[3])) + 30 * u2 * v2 * (c[3] - c[2]);
    return e;
}

/** u in [0, 1] at which an ascending quintic is `value`: Newton's method, kept in the bracket. */
double findParameter(const Polygon& c, double value) {
    constexpr int kMaxIterations = 80;
    constexpr double kRounding = 4e-16;
    double low = 0, high = 1;
    double u = std::clamp((value - c[0]) / (c[5] - c[0]), 0.0, 1.0);
    for (int i = 0; i < kMaxIterations && high - low > kRounding; ++i) {
        const Evaluation e = evaluate(c, u);
        const double excess = e.value - value;
        if (excess == 0) return u;
        (excess > 0 ? high : low) = u;
        const double next = e.derivative > 0 ? u - excess / e.derivative : -1;
        const double kept = next > low && next < high ? next : 0.5 * (low + high);
        if (std::abs(kept - u) < kRounding) return kept;
        u = kept;
    }
    return u;
}

Polygon addScaled(double a, const Polygon& p, double b, const Polygon& q) {
    Polygon sum;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = a * p[i] + b * q[i];
    return sum;
}

/** Integral of y dx from 0 to u. The integrand has degree 9, for which Gauss's rule of five points is exact. */
double integrate(const Polygon& x, const Polygon& y, double u) {
    constexpr double kNodes[] = {0, 0.53846931010568309, 0.90617984593866399};
    constexpr double kWeights[] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
    const auto calcIntegrand = [&](double node) {
        const double at = 0.5 * u * (1 + node);
        return evaluate(y, at).value * evaluate(x, at).derivative;
    };
    double sum = kWeights[0] * calcIntegrand(0);
    for (int i = 1; i < 3; ++i) sum += kWeights[i] * (calcIntegrand(kNodes[i]) + calcIntegrand(-kNodes[i]));
    return 0.5 * u * sum;
}

/** Where the tangents at two points meet; between the points if they are parallel. */
CurvePoint intersect(const CurvePoint& p, const CurvePoint& q) {
    constexpr double kParallel = 1.5e-8;
    CurvePoint corner;
    const double turn = p.slope - q.slope;
    corner.x = std::abs(turn) > kParallel ? (q.y - p.y - q.x * q.slope + p.x * p.slope) / turn : 0.5 * (p.x + q.x);
    corner.y = q.y + (corner.x - q.x) * q.slope;
    return corner;
}

double calcDistance(const CurvePoint& p, const CurvePoint& q) {
    return std::hypot(p.x - q.x, p.y - q.y);
}

}  // namespace

SmoothCurve::SmoothCurve(const std::vector<CurvePoint>& points, const std::vector<double>& curviness,
                         const char* name) {
    require(points.size() >= 2 && curviness.size() + 1 == points.size(), name, ": ", points.size(), " points and ",
            curviness.size(), " corners");
    m_first = points.front(), m_last = points.back();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const CurvePoint &p = points[i], &q = points[i + 1], corner = intersect(p, q);
        const double side = calcDistance(p, q), share = curviness[i];
        require(
            q.x > p.x && share >= 0 && share <= 1 && side > calcDistance(p, corner) && side > calcDistance(q, corner),
            name, ": between (", p.x, ", ", p.y, ") with slope ", p.slope, " and (", q.x, ", ", q.y, ") with slope ",
            q.slope, " there is no smooth corner of curviness ", share);
        const double xM = p.x + share * (corner.x - p.x), xN = q.x + share * (corner.x - q.x);
        const double yM = p.y + share * (corner.y - p.y), yN = q.y + share * (corner.y - q.y);
        m_corners.push_back({{p.x, xM, xM, xN, xN, q.x}, {p.y, yM, yM, yN, yN, q.y}, m_integral});
        m_integral += integrate(m_corners.back().x, m_corners.back().y, 1);
    }
}

const SmoothCurve::Corner& SmoothCurve::findCorner(double x) const {
    std::size_t i = 0;
    while (i + 1 < m_corners.size() && x > m_corners[i].x.back()) ++i;
    return m_corners[i];
}

double SmoothCurve::calcValue(double x) const {
    if (x <= m_first.x) return m_first.y + m_first.slope * (x - m_first.x);
    if (x >= m_last.x) return m_last.y + m_last.slope * (x - m_last.x);
    const Corner& corner = findCorner(x);
    return evaluate(corner.y, findParameter(corner.x, x)).value;
}

double SmoothCurve::calcDerivative(double x) const {
    if (x <= m_first.x) return m_first.slope;
    if (x >= m_last.x) return m_last.slope;
    const Corner& corner = findCorner(x);
    const double u = findParameter(corner.x, x);
    return evaluate(corner.y, u).derivative / evaluate(corner.x, u).derivative;
}

double SmoothCurve::calcIntegral(double x) const {
    const auto integrateLine = [x](const CurvePoint& p) { return (x - p.x) * (p.y + 0.5 * p.slope * (x - p.x)); };
    if (x <= m_first.x) return integrateLine(m_first);
    if (x >= m_last.x) return m_integral + integrateLine(m_last);
    const Corner& corner = findCorner(x);
    return corner.integralBefore + integrate(corner.x, corner.y, findParameter(corner.x, x));
}

double SmoothCurve::findArgument(double yScale, double xScale, double value, double limit) const {
    const auto calcSum = [&](double x, double y) { return yScale * y + xScale * x; };
    const auto continueLine = [&](const CurvePoint& p) {
        const double slope = yScale * p.slope + xScale, excess = value - calcSum(p.x, p.y);
        if (excess == 0) return p.x;
        return std::clamp(slope > 0 ? p.x + excess / slope : std::copysign(limit, excess), -limit, limit);
    };
    if (value <= calcSum(m_first.x, m_first.y)) return continueLine(m_first);
    if (value >= calcSum(m_last.x, m_last.y)) return continueLine(m_last);
    std::size_t i = 0;
    while (value > calcSum(m_corners[i].x.back(), m_corners[i].y.back())) ++i;
    const Corner& corner = m_corners[i];
    return evaluate(corner.x, findParameter(addScaled(yScale, corner.y, xScale, corner.x), value)).value;
}

}  // namespace tautline
