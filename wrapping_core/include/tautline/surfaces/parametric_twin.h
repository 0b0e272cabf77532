// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <utility>

#include "tautline/surfaces/parametric_surface.h"

namespace tautline {

/** Base of a parametric surface of which the implicit form `Twin` is known too: whatever needs no
coordinates (heights, feet, domain) is asked of the twin, which is cheaper; `calcNearbyParameters` of Derived must
be exact on the surface. Curvatures and geodesics are the parametric form's own. */
template <class Derived, class Twin>
class ParametricTwin : public ParametricShape<Derived> {
public:
    const Twin& getImplicitTwin() const { return m_twin; }

    std::string getDescription() const override { return "parametric " + m_twin.getDescription(); }
    double getSize() const override { return m_twin.getSize(); }
    bool isConvex() const override { return m_twin.isConvex(); }
    double calcDomainMargin(const SurfacePoint& point) const override {
        return point.p.allFinite() ? m_twin.calcDomainMargin(point) : m_twin.calcDomainMargin(this->resolve(point));
    }
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override { return m_twin.calcHeight(p_S, N_S); }
    double findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const override {
        return m_twin.findLowestPoint(A_S, e_S, length);
    }
    int countHoleCrossings(const Vec3& A_S, const Vec3& B_S) const override {
        return m_twin.countHoleCrossings(A_S, B_S);
    }
    Vec3 getHoleAxis() const override { return m_twin.getHoleAxis(); }
    SurfacePoint findSurfacePoint(const Vec3& p_S) const override {
        return calcCoordinates(m_twin.findSurfacePoint(p_S).p);
    }
    void findLineClearance(const Vec3& A_S, const Vec3& e_S, LineClearance& clearance) const override {
        m_twin.findLineClearance(A_S, e_S, clearance);
        if (clearance.found) clearance.C = calcCoordinates(clearance.C.p);
    }

protected:
    explicit ParametricTwin(Twin twin) : m_twin(std::move(twin)) {}

    /** Adds (u, v) and chart to a point of the surface. */
    SurfacePoint calcCoordinates(const Vec3& p_S) const {
        const Derived& derived = static_cast<const Derived&>(*this);
        const int chart = derived.chooseChart(p_S, Vec3::Zero(), -1);
        const Vec2 uv = derived.calcNearbyParameters(p_S, chart);
        return {derived.calcParametric(uv, chart).x, uv, chart};
    }

    Twin m_twin;
};

}  // namespace tautline
