// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <utility>

#include "tautline/surfaces/parametric_surface.h"
#include "tautline/surfaces/surface_decorator.h"

namespace tautline {

/** Base of a parametric surface of which the implicit form `Twin` is known too: whatever needs no
coordinates (heights, feet, domain) is asked of the twin, which is cheaper; `calcNearbyParameters` of Derived must
be exact on the surface. Curvatures and geodesics are the parametric form's own. */
template <class Derived, class Twin>
class ParametricTwin : public SurfaceDecorator<ParametricShape<Derived>, Twin> {
public:
    std::string getDescription() const override { return "parametric " + getTwin().getDescription(); }
    double calcDomainMargin(const SurfacePoint& point) const override {
        return getTwin().calcDomainMargin(point.p.allFinite() ? point : this->resolve(point));
    }
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override {
        return getTwin().calcHeightAndNormal(p_S, N_S);
    }
    double findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const override {
        return getTwin().findLowestPoint(A_S, e_S, length);
    }
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override {
        return calcCoordinates(getTwin().findSurfacePoint(p_S).p);
    }
    void findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const override {
        getTwin().findLineClearance(A_S, e_S, clearance);
        if (clearance.found) clearance.C = calcCoordinates(clearance.C.p);
    }

protected:
    explicit ParametricTwin(Twin twin) : SurfaceDecorator<ParametricShape<Derived>, Twin>(std::move(twin)) {}

    const Twin& getTwin() const { return this->getBase(); }

    /** Adds (u, v) and chart to a point of the surface. */
    SurfacePoint calcCoordinates(const Vector3& p_S) const {
        const Derived& derived = static_cast<const Derived&>(*this);
        const int chart = derived.chooseChart(p_S, Vector3::Zero(), -1);
        const Vector2 uv = derived.calcNearbyParameters(p_S, chart);
        return {derived.calcParametric(uv, chart).x, uv, chart};
    }
};

}  // namespace tautline
