#pragma once
/** Surfaces stretched along the axes of S: p = diag(sx, sy, sz) q with q on the base surface. */
#include <utility>

#include "tautline/error.h"
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_surface.h"

namespace tautline {
namespace detail {

/** Scale factors, their check, and what both forms share. */
template <class Base>
class Scaling {
public:
    Scaling(Base base, const Vec3& factors) : m_base(std::move(base)), m_factors(factors) {
        for (int i = 0; i < 3; ++i)
            require(std::isfinite(factors[i]) && factors[i] > 0, "scaled surface: factor ", "xyz"[i],
                    " must be positive and finite, but is ", factors[i]);
        m_inverse = factors.cwiseInverse();
    }
    /** A height of the base is a function whose gradient there is unit: first order, and exact in sign. */
    double calcHeight(const Vec3& p, Vec3& N) const {
        const double height = m_base.calcHeight(m_inverse.cwiseProduct(p), N);
        N = m_inverse.cwiseProduct(N).eval();
        const double slope = N.norm();
        N /= slope;
        return height / slope;
    }
    std::string describe() const {
        std::ostringstream text;
        text << m_base.getDescription() << " scaled by (" << m_factors.x() << ", " << m_factors.y() << ", "
             << m_factors.z() << ")";
        return text.str();
    }
    double calcSize() const { return m_base.getSize() * m_factors.minCoeff(); }

    Base m_base;
    Vec3 m_factors, m_inverse;
};

}  // namespace detail

/** An implicit surface stretched: f(diag(s)^-1 p). `Base` is an ImplicitShape (Sphere, Torus, ...), by value. */
template <class Base>
class ScaledImplicitSurface : public ImplicitShape<ScaledImplicitSurface<Base>> {
public:
    /** @param factors   along x, y, z of S, positive; InvalidInput otherwise */
    ScaledImplicitSurface(Base base, const Vec3& factors) : m_scaling(std::move(base), factors) {}

    double getSize() const override { return m_scaling.calcSize(); }
    std::string getDescription() const override { return m_scaling.describe(); }
    bool isConvex() const override { return m_scaling.m_base.isConvex(); }
    double calcDomainMargin(const SurfacePoint& point) const override {
        return m_scaling.m_base.calcDomainMargin({m_scaling.m_inverse.cwiseProduct(point.p)});
    }
    int countHoleCrossings(const Vec3& A_S, const Vec3& B_S) const override {
        return m_scaling.m_base.countHoleCrossings(m_scaling.m_inverse.cwiseProduct(A_S),
                                                   m_scaling.m_inverse.cwiseProduct(B_S));
    }
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override { return m_scaling.calcHeight(p_S, N_S); }

    /** By the chain rule; f stays a length by the least factor. */
    ImplicitValue calcImplicit(const Vec3& p) const {
        const Vec3& w = m_scaling.m_inverse;
        const double least = m_scaling.m_factors.minCoeff();
        const ImplicitValue base = m_scaling.m_base.calcImplicit(w.cwiseProduct(p));
        return {least * base.f, least * w.cwiseProduct(base.gradient),
                least * (w.asDiagonal() * base.hessian * w.asDiagonal())};
    }

private:
    detail::Scaling<Base> m_scaling;
};

/** A parametric surface stretched: diag(s) x(u, v). `Base` is a ParametricShape, by value. */
template <class Base>
class ScaledParametricSurface : public ParametricShape<ScaledParametricSurface<Base>> {
public:
    /** @param factors   along x, y, z of S, positive; InvalidInput otherwise */
    ScaledParametricSurface(Base base, const Vec3& factors) : m_scaling(std::move(base), factors) {}

    double getSize() const override { return m_scaling.calcSize(); }
    std::string getDescription() const override { return m_scaling.describe(); }
    bool isConvex() const override { return m_scaling.m_base.isConvex(); }
    double calcDomainMargin(const SurfacePoint& point) const override {
        return m_scaling.m_base.calcDomainMargin({m_scaling.m_inverse.cwiseProduct(point.p), point.uv, point.chart});
    }
    int countHoleCrossings(const Vec3& A_S, const Vec3& B_S) const override {
        return m_scaling.m_base.countHoleCrossings(m_scaling.m_inverse.cwiseProduct(A_S),
                                                   m_scaling.m_inverse.cwiseProduct(B_S));
    }
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override { return m_scaling.calcHeight(p_S, N_S); }

    ParametricValue calcParametric(const Vec2& uv, int chart) const {
        const Vec3& f = m_scaling.m_factors;
        const ParametricValue s = m_scaling.m_base.calcParametric(uv, chart);
        return {f.cwiseProduct(s.x),   f.cwiseProduct(s.xu),  f.cwiseProduct(s.xv),
                f.cwiseProduct(s.xuu), f.cwiseProduct(s.xuv), f.cwiseProduct(s.xvv)};
    }
    Vec2 calcNearbyParameters(const Vec3& p_S, int chart) const {
        return m_scaling.m_base.calcNearbyParameters(m_scaling.m_inverse.cwiseProduct(p_S), chart);
    }
    double getNormalSign() const { return m_scaling.m_base.getNormalSign(); }
    int chooseChart(const Vec3& p_S, const Vec3& t_S, int current) const {
        return m_scaling.m_base.chooseChart(m_scaling.m_inverse.cwiseProduct(p_S),
                                            m_scaling.m_inverse.cwiseProduct(t_S), current);
    }

private:
    detail::Scaling<Base> m_scaling;
};

}  // namespace tautline
