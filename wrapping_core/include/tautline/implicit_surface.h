#pragma once
/** Everything a Surface must answer, deduced from f(p) = 0 with gradient and Hessian (thesis Cha. 7). */
#include "tautline/geodesic_integrator.h"
#include "tautline/surface.h"

namespace tautline {

/** Value, gradient and Hessian of an implicit surface function at a point; f > 0 outside. */
struct ImplicitValue {
    double f;
    Vec3 gradient;
    Mat3 hessian;
};

namespace detail {

/** Trihedron and curvatures from gradient and Hessian (thesis Sec. 7.1 to 7.3, signs of Eqn. 3.63). */
inline DarbouxFrame calcImplicitFrame(const ImplicitValue& value, const Vec3& p, const Vec3& direction) {
    DarbouxFrame frame;
    const double g = value.gradient.norm();
    frame.x = p;
    frame.N = value.gradient / g;
    frame.t = makeTangent(direction, frame.N);
    frame.B = frame.t.cross(frame.N);
    const Vec3 dN_t = value.hessian * frame.t / g, dN_B = value.hessian * frame.B / g;
    frame.kappaN = -frame.t.dot(dN_t);
    frame.tauG = frame.B.dot(dN_t);
    frame.kappaB = -frame.B.dot(dN_B);
    return frame;
}

/** Geodesic and Jacobi equations on f = 0 (thesis Eqn. 7.19, 4.19, 4.35).
State: p (3), t (3), a, a', r, r'. */
template <class ImplicitFunction>
struct ImplicitGeodesicEquations {
    static constexpr int n = 10;
    using State = Eigen::Matrix<double, n, 1>;

    const ImplicitFunction& surface;
    double size;
    DarbouxFrame frame;  ///< at the last projected state
    double maxKappaN = -kInfinity;
    bool hasConjugatePoint = false;

    void calcDerivative(const State& y, State& slope) const {
        const Vec3 p = y.segment<3>(0), t = y.segment<3>(3);
        const ImplicitValue value = surface.calcImplicit(p);
        const double g2 = value.gradient.squaredNorm();
        const Vec3 Ht = value.hessian * t, B_g = t.cross(value.gradient);  // B_g = |g| B
        const double tHt = t.dot(Ht);
        // K = kappaN kappaB - tauG^2 with B = B_g/|g|: one power of |g|^2 for each factor.
        const double K = (tHt * B_g.dot(value.hessian * B_g) - B_g.dot(Ht) * B_g.dot(Ht)) / (g2 * g2);
        slope.segment<3>(0) = t;
        slope.segment<3>(3) = (-tHt / g2) * value.gradient;  // t' = kappaN N
        slope[6] = y[7];
        slope[7] = -K * y[6];
        slope[8] = y[9];
        slope[9] = -K * y[8];
    }
    void calcErrorWeights(const State& y, State& weights) const {
        weights << Vec3::Constant(1 / size), Vec3::Ones(), 1, size, 1 / size, 1;
        for (int i = 6; i < n; ++i) weights[i] /= std::max(1.0, weights[i] * std::abs(y[i]));
    }
    void project(State& y) {
        const Vec3 p = y.segment<3>(0);
        ImplicitValue value = surface.calcImplicit(p);
        y.segment<3>(0) = p - value.f / value.gradient.squaredNorm() * value.gradient;
        value = surface.calcImplicit(Vec3(y.segment<3>(0)));
        frame = calcImplicitFrame(value, y.segment<3>(0), y.segment<3>(3));
        y.segment<3>(3) = frame.t;
    }
    void watch(const State& y) {
        maxKappaN = std::max(maxKappaN, frame.kappaN);
        if (y[8] * rSign <= 0) hasConjugatePoint = true;
    }
    double rSign = 1;  ///< of r ahead of the start: the sign of the length
};

}  // namespace detail

/** Base of an implicit surface whose function is known at compile time: `Derived` gives
`ImplicitValue calcImplicit(const Vec3& p_S) const`, f > 0 outside, and the integrator calls it inline. */
template <class Derived>
class ImplicitShape : public Surface {
public:
    double calcHeight(const Vec3& p_S, Vec3& N_S) const override {
        const ImplicitValue value = derived().calcImplicit(p_S);
        const double g = value.gradient.norm();
        if (!(g > 0)) {  // the centre of a quadric: as deep as can be, any direction out
            N_S = Vec3::UnitX();
            return -getSize();
        }
        N_S = value.gradient / g;
        return value.f / g;
    }

    SurfacePoint findSurfacePoint(const Vec3& p_S) const override { return {projectToSurface(p_S)}; }

    SurfacePoint calcDisplacedPoint(const SurfacePoint& start, const Vec3& displacement_S) const override {
        return findSurfacePoint(start.p + displacement_S);  // thesis Eqn. 7.22 to 7.24
    }

    DarbouxFrame calcFrame(const SurfacePoint& point, const Vec3& direction_S) const override {
        return detail::calcImplicitFrame(derived().calcImplicit(point.p), point.p, direction_S);
    }

    void shootGeodesic(const GeodesicStart& start, const GeodesicOptions& options, Geodesic& geodesic) const override {
        shootByIntegration(start, options, geodesic);
    }

    /** Shooting by the adaptive integrator, also where a closed form stands in its place. */
    void shootByIntegration(const GeodesicStart& start, const GeodesicOptions& options, Geodesic& geodesic) const {
        using Equations = detail::ImplicitGeodesicEquations<Derived>;
        Equations equations{derived(), getSize(), calcFrame(start.point, start.tangent)};
        geodesic.P = geodesic.Q = equations.frame;
        equations.maxKappaN = geodesic.P.kappaN;
        equations.rSign = start.length < 0 ? -1 : 1;
        typename Equations::State y;
        y << geodesic.P.x, geodesic.P.t, 1, 0, 0, 1;
        const double curvature =
            std::max({std::abs(geodesic.P.kappaN), std::abs(geodesic.P.kappaB), std::abs(geodesic.P.tauG)});
        geodesic.steps =
            integrateGeodesic(equations, y, start.length, calcFirstStep(curvature, options.accuracy), options);
        geodesic.converged = geodesic.steps >= 0;
        geodesic.Q = equations.frame;
        geodesic.endPoint = {geodesic.Q.x};
        geodesic.length = start.length;
        geodesic.a = y[6], geodesic.aDot = y[7], geodesic.r = y[8], geodesic.rDot = y[9];
        geodesic.hasConjugatePoint = equations.hasConjugatePoint;
        geodesic.maxKappaN = equations.maxKappaN;
    }

protected:
    /** Newton steps along the gradient until the height is rounding (thesis Eqn. 7.24), each no longer
    than the surface's size so that a far start does not overshoot. */
    Vec3 projectToSurface(Vec3 p) const {
        constexpr int kMaxIterations = 50;
        const double tolerance = 2e-16 * getSize();
        double previous = kInfinity;
        for (int i = 0; i < kMaxIterations; ++i) {
            Vec3 N;
            const double height = calcHeight(p, N);
            if (!(std::abs(height) > tolerance) ||
                (std::abs(height) < 1e-14 * getSize() && std::abs(height) >= previous))
                break;
            previous = std::abs(height);
            p -= std::max(height, -getSize()) * N;
        }
        return p;
    }

private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

/** An implicit surface of the user's own: override calcImplicit, getSize and getDescription. */
class ImplicitSurface : public ImplicitShape<ImplicitSurface> {
public:
    /** Value, gradient and Hessian of the surface function; f > 0 outside, gradient nonzero near f = 0. */
    virtual ImplicitValue calcImplicit(const Vec3& p_S) const = 0;
};

}  // namespace tautline
