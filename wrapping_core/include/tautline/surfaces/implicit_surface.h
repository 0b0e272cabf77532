// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Everything a Surface must answer, deduced from f(p) = 0 with gradient and Hessian (thesis Cha. 7). */
#include <utility>

#include "tautline/geodesics/geodesic_integrator.h"
#include "tautline/surfaces/surface.h"

namespace tautline {

/** Value, gradient and Hessian of an implicit surface function at a point; f > 0 outside. */
struct ImplicitValue {
    double f;
    Vector3 gradient;
    Matrix3 hessian;
};

/** The same where the Hessian is diagonal everywhere, as that of a quadric about its own axes. */
struct DiagonalImplicitValue {
    double f;
    Vector3 gradient;
    Vector3 hessian;  ///< its diagonal

    operator ImplicitValue() const { return {f, gradient, hessian.asDiagonal()}; }
};

namespace detail {

inline double dot(const Vector3& a, const Vector3& b) {
    return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/** H v for symmetric H, written out: Eigen's product is a call at -O2, and this is half the cost of a geodesic. */
inline Vector3 multiply(const Matrix3& H, const Vector3& v) {
    return {H(0, 0) * v.x() + H(0, 1) * v.y() + H(0, 2) * v.z(), H(0, 1) * v.x() + H(1, 1) * v.y() + H(1, 2) * v.z(),
            H(0, 2) * v.x() + H(1, 2) * v.y() + H(2, 2) * v.z()};
}

inline Vector3 multiply(const Vector3& diagonal, const Vector3& v) {
    return {diagonal.x() * v.x(), diagonal.y() * v.y(), diagonal.z() * v.z()};
}

/** g . adj(H) g: with the gradient for g, the Gaussian curvature times |g|^4 (the determinant of the second fundamental
form, of which adj(H) holds the minors, whatever tangent basis it is written in). */
inline double calcAdjugateForm(const Matrix3& H, const Vector3& g) {
    const double xx = H(1, 1) * H(2, 2) - H(1, 2) * H(1, 2), yy = H(0, 0) * H(2, 2) - H(0, 2) * H(0, 2),
                 zz = H(0, 0) * H(1, 1) - H(0, 1) * H(0, 1), xy = H(0, 2) * H(1, 2) - H(0, 1) * H(2, 2),
                 xz = H(0, 1) * H(1, 2) - H(0, 2) * H(1, 1), yz = H(0, 1) * H(0, 2) - H(0, 0) * H(1, 2);
    return xx * g.x() * g.x() + yy * g.y() * g.y() + zz * g.z() * g.z() +
           2 * (xy * g.x() * g.y() + xz * g.x() * g.z() + yz * g.y() * g.z());
}
inline double calcAdjugateForm(const Vector3& diagonal, const Vector3& g) {
    const double x = diagonal.x(), y = diagonal.y(), z = diagonal.z();
    return y * z * g.x() * g.x() + x * z * g.y() * g.y() + x * y * g.z() * g.z();
}

/** Trihedron and curvatures from gradient and Hessian (thesis Sec. 7.1 to 7.3, signs of Eqn. 3.63). */
template <class Value>
DarbouxFrame calcImplicitFrame(const Value& value, const Vector3& p, const Vector3& direction) {
    DarbouxFrame frame;
    const double g = value.gradient.norm();
    frame.x = p;
    frame.N = value.gradient / g;
    frame.t = makeTangent(direction, frame.N);
    frame.B = frame.t.cross(frame.N);
    const Vector3 dN_t = multiply(value.hessian, frame.t) / g, dN_B = multiply(value.hessian, frame.B) / g;
    frame.kappaN = -frame.t.dot(dN_t);
    frame.tauG = frame.B.dot(dN_t);
    frame.kappaB = -frame.B.dot(dN_B);
    return frame;
}

/** ShotGeodesic and Jacobi equations on f = 0 (thesis Eqn. 7.19, 4.19, 4.35).
State: p (3), t (3), a, a', r, r'. */
template <class ImplicitFunction>
struct ImplicitGeodesicEquations {
    static constexpr int n = 10;
    using State = Eigen::Matrix<double, n, 1>;
    using Value = decltype(std::declval<const ImplicitFunction&>().calcImplicit(Vector3()));

    const ImplicitFunction& surface;
    double size;
    Value value;  ///< at the last projected state
    double maxKappaN = kNaN;

    void calcDerivative(const State& y, State& slope) const {
        calcDerivative(surface.calcImplicit(Vector3(y[0], y[1], y[2])), y, slope);
    }
    /** At the last projected state, without evaluating the surface again. */
    void calcProjectedDerivative(const State& y, State& slope) const { calcDerivative(value, y, slope); }

    void calcDerivative(const Value& at, const State& y, State& slope) const {
        const Vector3 t(y[3], y[4], y[5]), &g = at.gradient;
        const double inverse = 1 / dot(g, g), bend = -dot(t, multiply(at.hessian, t)) * inverse;
        const double K = calcAdjugateForm(at.hessian, g) * inverse * inverse;
        // Written in pairs: the sums over slopes read them so, and would wait for two separate writes to arrive.
        slope.template segment<2>(0) = Vector2(t.x(), t.y());
        slope.template segment<2>(2) = Vector2(t.z(), bend * g.x());  // t' = kappaN N
        slope.template segment<2>(4) = Vector2(bend * g.y(), bend * g.z());
        slope.template segment<2>(6) = Vector2(y[7], -K * y[6]);
        slope.template segment<2>(8) = Vector2(y[9], -K * y[8]);
    }
    void calcErrorWeights(const State& /*y*/, State& weights) const {
        weights.template head<6>() << Vector3::Constant(1 / size), Vector3::Ones();
    }
    void project(State& y) {
        const Vector3 p = y.template segment<3>(0), t = y.template segment<3>(3);
        value = surface.calcImplicit(p);
        const Vector3 onSurface = p - value.f / dot(value.gradient, value.gradient) * value.gradient;
        value = surface.calcImplicit(onSurface);
        const Vector3& g = value.gradient;
        const double g2 = dot(g, g);
        Vector3 tangent = t - dot(t, g) / g2 * g;
        const double length = std::sqrt(dot(tangent, tangent));
        // Left over of a unit vector: anything but small.
        tangent = length > 0.1 ? Vector3(tangent / length) : makeTangent(t, g / std::sqrt(g2));
        y.template segment<3>(0) = onSurface;
        y.template segment<3>(3) = tangent;
        maxKappaN = std::max(maxKappaN, -dot(tangent, multiply(value.hessian, tangent)) / std::sqrt(g2));
    }
};

}  // namespace detail

/** Base of an implicit surface whose function is known at compile time: `Derived` gives
`ImplicitValue calcImplicit(const Vector3& p_S) const`, or that of a DiagonalImplicitValue, f > 0 outside, and the
integrator calls it inline. */
template <class Derived>
class ImplicitShape : public Surface {
public:
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override { return calcFormHeight(p_S, N_S); }

    /** f over the length of its gradient: the height above f = 0, which goes on where the surface has an edge. Where the
    gradient vanishes, on the axis of a capsule, that would be beyond all bounds: no depth is more than kDeepest sizes. */
    double calcFormHeight(const Vector3& p_S, Vector3& N_S) const {
        const auto value = derived().calcImplicit(p_S);
        const double g = value.gradient.norm();
        if (!(g > 0)) {  // the center of a quadric: as deep as a point can be; any direction leads out
            N_S = Vector3::UnitX();
            return -getSize();
        }
        N_S = value.gradient / g;
        return std::max(value.f / g, -kDeepest * getSize());
    }

    SurfacePoint findSurfacePoint(const Vector3& p_S) const override { return {projectToSurface(p_S)}; }

    SurfacePoint calcDisplacedPoint(const SurfacePoint& start, const Vector3& displacement_S) const override {
        return findSurfacePoint(start.p + displacement_S);  // thesis Eqn. 7.22 to 7.24
    }

    DarbouxFrame calcFrame(const SurfacePoint& point, const Vector3& direction_S) const override {
        return detail::calcImplicitFrame(derived().calcImplicit(point.p), point.p, direction_S);
    }

    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override {
        shootByIntegration(start, options, geodesic);
    }

    /** Shooting by the adaptive integrator, also where a closed form stands in its place. */
    void shootByIntegration(const GeodesicStart& start, const ShootingOptions& options, ShotGeodesic& geodesic) const {
        using Equations = detail::ImplicitGeodesicEquations<Derived>;
        const typename Equations::Value value = derived().calcImplicit(start.point.p);
        geodesic.P = detail::calcImplicitFrame(value, start.point.p, start.tangent);
        Equations equations{derived(), getSize(), value};
        typename Equations::State y;
        y.template head<6>() << geodesic.P.x, geodesic.P.t;
        integrateGeodesic(equations, y, start.length, options, geodesic);
        geodesic.Q = detail::calcImplicitFrame(equations.value, y.template segment<3>(0), y.template segment<3>(3));
        geodesic.endPoint = {geodesic.Q.x};
    }

    bool calcImplicitForm(const Vector3& p_S, ImplicitValue& value) const override {
        value = derived().calcImplicit(p_S);
        return true;
    }

protected:
    /** Newton steps along the gradient until the height is rounding (thesis Eqn. 7.24), each no longer
    than the surface's size so that a far start does not overshoot. Beside the domain it is f = 0 that is sought: the
    height leads to the edge. */
    Vector3 projectToSurface(Vector3 p) const {
        constexpr int kMaxIterations = 50;
        const double tolerance = 2e-16 * getSize();
        double previous = kInfinity;
        for (int i = 0; i < kMaxIterations; ++i) {
            Vector3 N;
            const double height = isInDomain({p}) ? calcHeightAndNormal(p, N) : calcFormHeight(p, N);
            if (!(std::abs(height) > tolerance) ||
                (std::abs(height) < 1e-14 * getSize() && std::abs(height) >= previous))
                break;
            previous = std::abs(height);
            p -= std::max(height, -getSize()) * N;
        }
        return p;
    }

private:
    static constexpr double kDeepest = 10;

    const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

/** An implicit surface of the user's own: override calcImplicit, getSize and getDescription. */
class ImplicitSurface : public ImplicitShape<ImplicitSurface> {
public:
    /** Value, gradient and Hessian of the surface function; f > 0 outside, gradient nonzero near f = 0. */
    virtual ImplicitValue calcImplicit(const Vector3& p_S) const = 0;
};

}  // namespace tautline
