// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/parametric_surface.h"
#include "tautline/surfaces/sine_cosine.h"

namespace tautline {

/** Longitude u and latitude v on an ellipsoid (or sphere) with semi-axes along x, y, z, in three charts whose
poles lie on the z, x and y axis (chart 0, 1, 2):

    (a cos v cos u, b cos v sin u, c sin v)     in chart 0, and with x, y, z turned cyclically in the others.

The chart is chosen by the direction of travel, so that a geodesic stays near the equator of its chart and
no step comes near a pole. */
class EllipsoidCharts {
public:
    explicit EllipsoidCharts(const Vector3& semiAxes) : m_semiAxes(semiAxes) {
        for (int chart = 0; chart < 3; ++chart)
            for (int i = 0; i < 3; ++i) m_turnedAxes[chart][i] = semiAxes[axis(chart, i)];
    }

    ParametricValue calcParametric(const Vector2& uv, int chart) const {
        const ParametricValue s = calcTurned(uv, chart);
        return {place(chart, s.x),   place(chart, s.xu),  place(chart, s.xv),
                place(chart, s.xuu), place(chart, s.xuv), place(chart, s.xvv)};
    }

    /** In the chart's own order of axes: pole last. */
    ParametricValue calcTurned(const Vector2& uv, int chart) const {
        const SineCosine angles(uv);
        const double cu = angles.cosine[0], su = angles.sine[0], cv = angles.cosine[1], sv = angles.sine[1];
        const Vector3& axes = m_turnedAxes[chart];
        const double acu = axes[0] * cu, asu = axes[0] * su, bcu = axes[1] * cu, bsu = axes[1] * su, c = axes[2];
        return {{cv * acu, cv * bsu, c * sv}, {-cv * asu, cv * bcu, 0}, {-sv * acu, -sv * bsu, c * cv},
                {-cv * acu, -cv * bsu, 0},    {sv * asu, -sv * bcu, 0}, {-cv * acu, -cv * bsu, -c * sv}};
    }

    /** Exact on the ellipsoid; elsewhere those of the point on the ray from the center. */
    Vector2 calcNearbyParameters(const Vector3& p, int chart) const {
        const Vector3 q = p.cwiseQuotient(m_semiAxes);
        const double q0 = q[axis(chart, 0)], q1 = q[axis(chart, 1)], q2 = q[axis(chart, 2)];
        return {std::atan2(q1, q0), std::atan2(q2, std::hypot(q0, q1))};
    }

    /** The chart whose pole is farthest: from the great circle that p and t span on the unit sphere onto which
    the ellipsoid is scaled, or from p alone. At worst that circle climbs to 54.7 degrees. */
    int chooseChart(const Vector3& p, const Vector3& t, int current) const {
        const Vector3 q = p.cwiseQuotient(m_semiAxes);
        const Vector3 normal = q.cross(t.cwiseQuotient(m_semiAxes));
        const bool hasDirection = normal.squaredNorm() > 0;
        Eigen::Index pole = 2;
        if (hasDirection)
            normal.cwiseAbs().maxCoeff(&pole);
        else
            q.cwiseAbs().minCoeff(&pole);
        if (current >= 0) {
            const double cosine = hasDirection
                                      ? std::abs(normal[axis(current, 2)]) / normal.norm()
                                      : std::sqrt(1 - q[axis(current, 2)] * q[axis(current, 2)] / q.squaredNorm());
            if (cosine > 0.5) return current;  // below 60 degrees all is well
        }
        return pole == 2 ? 0 : static_cast<int>(pole) + 1;
    }

private:
    static int axis(int chart, int i) { return (i + chart) % 3; }  // chart 1: y, z, x; pole x
    static Vector3 place(int chart, const Vector3& turned) {
        if (chart == 0) return turned;
        return chart == 1 ? Vector3(turned[2], turned[0], turned[1]) : Vector3(turned[1], turned[2], turned[0]);
    }

    Vector3 m_semiAxes;
    Vector3 m_turnedAxes[3];
};

}  // namespace tautline
