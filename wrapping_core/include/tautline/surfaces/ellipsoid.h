// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/central_quadric.h"
#include "tautline/surfaces/ellipsoid_charts.h"
#include "tautline/surfaces/parametric_twin.h"

namespace tautline {

/** Ellipsoid about the origin of S with semi-axes along x, y, z. */
class Ellipsoid final : public CentralQuadric<Ellipsoid> {
public:
    /** @param semiAxes   [m], each positive; InvalidInput otherwise */
    explicit Ellipsoid(const Vector3& semiAxes);

    const Vector3& getSemiAxes() const { return m_semiAxes; }
    std::string getDescription() const override;

private:
    Vector3 m_semiAxes;
};

extern template class ImplicitShape<Ellipsoid>;

/** Ellipsoid in longitude and latitude, three charts; see EllipsoidCharts. */
class ParametricEllipsoid final : public ParametricTwin<ParametricEllipsoid, Ellipsoid> {
public:
    /** @param semiAxes   [m], each positive; InvalidInput otherwise */
    explicit ParametricEllipsoid(const Vector3& semiAxes) : ParametricTwin(Ellipsoid(semiAxes)), m_charts(semiAxes) {}

    ParametricValue calcParametric(const Vector2& uv, int chart) const { return m_charts.calcParametric(uv, chart); }
    ParametricValue calcTurned(const Vector2& uv, int chart) const { return m_charts.calcTurned(uv, chart); }
    Vector2 calcNearbyParameters(const Vector3& p_S, int chart) const {
        return m_charts.calcNearbyParameters(p_S, chart);
    }
    int chooseChart(const Vector3& p_S, const Vector3& t_S, int current) const {
        return m_charts.chooseChart(p_S, t_S, current);
    }

private:
    EllipsoidCharts m_charts;
};

extern template class ParametricShape<ParametricEllipsoid>;
extern template class ParametricTwin<ParametricEllipsoid, Ellipsoid>;

}  // namespace tautline
