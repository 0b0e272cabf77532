// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Everything a Surface must answer, deduced from x(u, v) with its first and second derivatives (thesis
Sec. 3.2 to 3.4, 4.5). */
#include <mutex>
#include <vector>

#include "tautline/geodesics/geodesic_integrator.h"
#include "tautline/surfaces/surface.h"

namespace tautline {

/** Position of a parametric surface and its partial derivatives at (u, v), in S. */
struct ParametricValue {
    Vector3 x, xu, xv, xuu, xuv, xvv;
};

/** Rectangle of surface coordinates. */
struct ParameterDomain {
    Vector2 min = Vector2::Constant(-kInfinity), max = Vector2::Constant(kInfinity);

    bool contains(const Vector2& uv) const {
        return (uv.array() >= min.array()).all() && (uv.array() <= max.array()).all();
    }
    /** Distance from the nearest side, over the domain's width if that is finite; negative outside. Rounding of the
    coordinates is forgiven: 1e-12 of the width beyond a side is still inside. */
    double calcMargin(const Vector2& uv) const {
        constexpr double kRounding = 1e-12;
        double margin = kInfinity;
        for (int i = 0; i < 2; ++i) {
            const double width = max[i] - min[i], unit = std::isfinite(width) ? width : 1;
            const double inside = std::min(uv[i] - min[i], max[i] - uv[i]) / unit + kRounding;
            if (!(inside >= margin)) margin = inside;  // NaN: outside
        }
        return margin;
    }
    Vector2 clamp(const Vector2& uv) const { return uv.cwiseMax(min).cwiseMin(max); }
};

namespace detail {

/** Coefficients of the first fundamental form (thesis Eqn. 3.14 to 3.16). */
struct Metric {
    double E, F, G;

    explicit Metric(const ParametricValue& s) : E(s.xu.squaredNorm()), F(s.xu.dot(s.xv)), G(s.xv.squaredNorm()) {}
    double calcDeterminant() const { return E * G - F * F; }
    /** Rates of (u, v) along a tangent vector: the metric tensor's inverse on its products with xu, xv (Eqn. 4.60). */
    Vector2 calcRates(const ParametricValue& s, const Vector3& tangent) const {
        const double tu = s.xu.dot(tangent), tv = s.xv.dot(tangent), determinant = calcDeterminant();
        return {(G * tu - F * tv) / determinant, (E * tv - F * tu) / determinant};
    }
};

/** Trihedron and curvatures from both fundamental forms (thesis Eqn. 3.22, 3.64, signs of 3.63).
@param normalSign   +1 if xu x xv points outward, else -1 */
inline DarbouxFrame calcParametricFrame(const ParametricValue& s, double normalSign, const Vector3& direction) {
    DarbouxFrame frame;
    const Metric metric(s);
    frame.x = s.x;
    frame.N = normalSign * s.xu.cross(s.xv).normalized();
    frame.t = makeTangent(direction, frame.N);
    frame.B = frame.t.cross(frame.N);
    const double L = s.xuu.dot(frame.N), M = s.xuv.dot(frame.N), N = s.xvv.dot(frame.N);  // Eqn. 3.23 to 3.25
    const Vector2 t = metric.calcRates(s, frame.t), B = metric.calcRates(s, frame.B);
    frame.kappaN = L * t[0] * t[0] + 2 * M * t[0] * t[1] + N * t[1] * t[1];
    frame.tauG = -(L * t[0] * B[0] + M * (t[0] * B[1] + t[1] * B[0]) + N * t[1] * B[1]);
    frame.kappaB = L * B[0] * B[0] + 2 * M * B[0] * B[1] + N * B[1] * B[1];
    return frame;
}

/** ShotGeodesic and Jacobi equations in surface coordinates (thesis Eqn. 3.46, 3.47, 4.19, 4.35).
State: u, v, u', v', a, a', r, r'. The chart may change between steps, never inside one. */
template <class ParametricFunction>
struct ParametricGeodesicEquations {
    static constexpr int n = 8;
    using State = Eigen::Matrix<double, n, 1>;

    const ParametricFunction& surface;
    double size;
    int chart;
    DarbouxFrame frame{};                 ///< at the last projected state
    double lengthOfU = 1, lengthOfV = 1;  ///< |xu|, |xv| there: make errors of u, v lengths
    double maxKappaN = kNaN;

    void calcDerivative(const State& y, State& slope) const {
        const ParametricValue s = surface.calcTurned(Vector2(y[0], y[1]), chart);
        const Metric metric(s);
        // x'' = bend + xu u'' + xv v'' is normal to the surface: the Christoffel symbols in one vector.
        const Vector3 bend = y[2] * y[2] * s.xuu + 2 * y[2] * y[3] * s.xuv + y[3] * y[3] * s.xvv;
        const double bu = s.xu.dot(bend), bv = s.xv.dot(bend);
        const double inverse = 1 / metric.calcDeterminant();
        const Vector3 n_W = s.xu.cross(s.xv);  // its square is the determinant
        const double M = s.xuv.dot(n_W);
        const double K = (s.xuu.dot(n_W) * s.xvv.dot(n_W) - M * M) * inverse * inverse;  // Eqn. 3.30
        slope[0] = y[2];
        slope[1] = y[3];
        slope[2] = (metric.F * bv - metric.G * bu) * inverse;
        slope[3] = (metric.F * bu - metric.E * bv) * inverse;
        slope[4] = y[5];
        slope[5] = -K * y[4];
        slope[6] = y[7];
        slope[7] = -K * y[6];
    }
    void calcProjectedDerivative(const State& y, State& slope) const { calcDerivative(y, slope); }
    void calcErrorWeights(const State& /*y*/, State& weights) const {
        weights.template head<4>() << lengthOfU / size, lengthOfV / size, lengthOfU, lengthOfV;
    }
    /** Back to unit speed (Eqn. 3.54), and on to the chart that suits the direction of travel. */
    void project(State& y) {
        const ParametricValue s = surface.calcParametric(Vector2(y[0], y[1]), chart);
        const Vector3 t = y[2] * s.xu + y[3] * s.xv;
        const int next = surface.chooseChart(s.x, t, chart);
        if (next != chart) {
            chart = next;
            y.template segment<2>(0) = surface.calcNearbyParameters(s.x, chart);
            place(surface.calcParametric(Vector2(y[0], y[1]), chart), t, y);
        } else {
            place(s, t, y);
        }
        maxKappaN = std::max(maxKappaN, frame.kappaN);
    }
    /** Sets u', v' of a state whose u, v are set, and the frame there. */
    void place(const ParametricValue& s, const Vector3& direction, State& y) {
        frame = calcParametricFrame(s, surface.getNormalSign(), direction);
        const Metric metric(s);
        y.template segment<2>(2) = metric.calcRates(s, frame.t);  // Eqn. 4.65, of unit speed (4.66)
        lengthOfU = std::sqrt(metric.E);
        lengthOfV = std::sqrt(metric.G);
    }
};

}  // namespace detail

/** Base of a parametric surface whose x(u, v) is known at compile time. `Derived` gives

    ParametricValue calcParametric(const Vector2& uv, int chart) const
    Vector2 calcNearbyParameters(const Vector3& p_S, int chart) const   (u, v) of a surface point near p_S: where
Newton's method starts; exact on the surface if there are several charts

and may replace getDomain, getNormalSign, chooseChart and calcTurned. No call of these is virtual.

A surface with a domain is a sheet that ends at the domain's edges. Inside are the points that are below the sheet,
however deep, and whose foot lies in the domain. Beside the domain x(u, v) goes on smoothly, so that a search may pass
there, but nothing is inside. A coordinate that goes round needs a domain of more than one turn. */
template <class Derived>
class ParametricShape : public Surface {
public:
    /** Where the surface is defined. */
    ParameterDomain getDomain() const { return {}; }

    /** +1 if xu x xv points outward, -1 if inward. */
    double getNormalSign() const { return 1; }

    /** The same as calcParametric but for one rotation of all vectors, which may depend on the chart: enough for
    the geodesic equations, and cheaper where charts differ only by the order of the axes. */
    ParametricValue calcTurned(const Vector2& uv, int chart) const { return derived().calcParametric(uv, chart); }

    /** Chart to use at p_S when going along t_S (zero: no direction known). `current`, the chart in use,
    is worth keeping while it is sound; -1: none. */
    int chooseChart(const Vector3& /*p_S*/, const Vector3& /*t_S*/, int /*current*/) const { return 0; }

    /** Signed distance from the nearest point, of the domain or beside it. There it is no less than the way of the foot
    to the domain, and leads away from that: a bound of the distance from the sheet and from what lies below it. */
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override {
        const SurfacePoint foot = findNearest(p_S);
        const ParametricValue s = derived().calcParametric(foot.uv, foot.chart);
        N_S = derived().getNormalSign() * s.xu.cross(s.xv).normalized();
        const double height = N_S.dot(p_S - s.x);
        const ParameterDomain domain = derived().getDomain();
        if (domain.calcMargin(foot.uv) >= 0) return height;
        const Vector3 aside = s.x - derived().calcParametric(domain.clamp(foot.uv), foot.chart).x;
        const double way = aside.norm();
        if (!(way > height)) return height;
        N_S = aside / way;
        return way;
    }

    SurfacePoint findSurfacePoint(const Vector3& p_S) const override { return findNearest(p_S); }

    /** The point nearest to start + displacement, sought from the first-order point (thesis Eqn. 4.60, 4.61). */
    SurfacePoint calcDisplacedPoint(const SurfacePoint& start, const Vector3& displacement_S) const override {
        ParametricValue s;
        const SurfacePoint from = resolve(start, s);
        const Vector3 target = s.x + displacement_S;
        const int chart = derived().chooseChart(target, Vector3::Zero(), from.chart);
        if (chart != from.chart) return refineNearest(target, derived().calcNearbyParameters(target, chart), chart);
        const Vector2 uv = from.uv + detail::Metric(s).calcRates(s, displacement_S);
        return refineNearest(target, uv, chart);
    }

    DarbouxFrame calcFrame(const SurfacePoint& point, const Vector3& direction_S) const override {
        ParametricValue s;
        resolve(point, s);
        return detail::calcParametricFrame(s, derived().getNormalSign(), direction_S);
    }

    bool calcCoordinateRates(const SurfacePoint& point, const Vector3& velocity_S, Vector2& uvRates) const override {
        ParametricValue s;
        resolve(point, s);
        uvRates = detail::Metric(s).calcRates(s, velocity_S);
        return true;
    }

    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override {
        shootByIntegration(start, options, geodesic);
    }

    /** Shooting by the adaptive integrator, also where a closed form stands in its place. */
    void shootByIntegration(const GeodesicStart& start, const ShootingOptions& options, ShotGeodesic& geodesic) const {
        using Equations = detail::ParametricGeodesicEquations<Derived>;
        ParametricValue s;
        SurfacePoint from = resolve(start.point, s);
        const int chart = derived().chooseChart(from.p, start.tangent, -1);
        if (chart != from.chart) {
            from.uv = derived().calcNearbyParameters(from.p, chart);
            s = derived().calcParametric(from.uv, chart);
        }
        Equations equations{derived(), getSize(), chart};
        typename Equations::State y;
        y.template head<4>() << from.uv, 0, 0;
        equations.place(s, start.tangent, y);
        geodesic.P = equations.frame;
        integrateGeodesic(equations, y, start.length, options, geodesic);
        geodesic.Q = equations.frame;
        geodesic.endPoint = {geodesic.Q.x, Vector2(y[0], y[1]), equations.chart};
    }

    bool calcParametricForm(const SurfacePoint& point, ParametricValue& value) const override {
        value = derived().calcParametric(point.uv, point.chart);
        return true;
    }

    /** The same point with (u, v) that belong to its p: points given by p alone get them here. */
    SurfacePoint resolve(const SurfacePoint& point) const {
        ParametricValue s;
        return resolve(point, s);
    }

protected:
    /** @param s   the surface at that point */
    SurfacePoint resolve(const SurfacePoint& point, ParametricValue& s) const {
        s = derived().calcParametric(point.uv, point.chart);
        // Rounding of x(u, v) is far below this, and a mistaken (u, v) almost surely far above.
        if (!point.p.allFinite() || (s.x - point.p).norm() <= 1e-9 * (getSize() + s.x.norm()))
            return {s.x, point.uv, point.chart};
        SurfacePoint found = findSurfacePoint(point.p);
        s = derived().calcParametric(found.uv, found.chart);
        return found;
    }

    SurfacePoint findNearest(const Vector3& p_S) const {
        const int chart = derived().chooseChart(p_S, Vector3::Zero(), -1);
        return refineNearest(p_S, derived().calcNearbyParameters(p_S, chart), chart);
    }

    /** Newton's method for the least |x(u, v) - p|; steps no longer than the surface's size and halved until
    the distance does not grow. Quadratic: usually 3 to 5 evaluations. */
    SurfacePoint refineNearest(const Vector3& p_S, Vector2 uv, int chart) const {
        constexpr int kMaxIterations = 50, kMaxHalvings = 10;
        const double size = getSize(), enough = 1e-8 * size;  // after such a step its square is left: rounding
        ParametricValue s = derived().calcParametric(uv, chart);
        if (!s.x.allFinite()) {  // a start beyond a pole, where coordinates end
            uv = derived().calcNearbyParameters(p_S, chart);
            s = derived().calcParametric(uv, chart);
        }
        for (int i = 0; i < kMaxIterations; ++i) {
            const Vector3 fromTarget = s.x - p_S;
            Vector2 step = calcNearestStep(s, fromTarget);
            const double length = (s.xu * step[0] + s.xv * step[1]).norm();
            if (!std::isfinite(length) || length == 0) break;
            if (length > size) step *= size / length;
            const double distance = fromTarget.norm();
            bool isCloser = false;
            for (int halving = 0; halving < kMaxHalvings && !isCloser; ++halving, step /= 2) {
                const ParametricValue trial = derived().calcParametric(uv + step, chart);
                isCloser = (trial.x - p_S).norm() <= distance * (1 + 1e-14) + 1e-15 * size;
                if (!isCloser) continue;
                uv += step;
                s = trial;
            }
            if (!isCloser || length < enough) break;
        }
        return {s.x, uv, chart};
    }

private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }

    /** Newton step of the squared distance; with the metric alone for its Hessian where that is not positive. */
    static Vector2 calcNearestStep(const ParametricValue& s, const Vector3& fromTarget) {
        const detail::Metric metric(s);
        double H11 = metric.E + fromTarget.dot(s.xuu), H12 = metric.F + fromTarget.dot(s.xuv);
        double H22 = metric.G + fromTarget.dot(s.xvv), determinant = H11 * H22 - H12 * H12;
        if (!(H11 > 0 && determinant > 1e-3 * metric.calcDeterminant()))
            H11 = metric.E, H12 = metric.F, H22 = metric.G, determinant = metric.calcDeterminant();
        const double gu = fromTarget.dot(s.xu), gv = fromTarget.dot(s.xv);
        return {(H12 * gv - H22 * gu) / determinant, (H12 * gu - H11 * gv) / determinant};
    }
};

/** Grid of surface points, searched for the one nearest to a given point: a start for Newton's method on
surfaces that know no better. */
class NearbyGrid {
public:
    /** @param position   callable Vector3(const Vector2& uv) @param domain   finite */
    template <class Position>
    void build(const ParameterDomain& domain, const Position& position) {
        constexpr int kCells = 16;
        m_uv.clear();
        m_points.resize(3, (kCells + 1) * (kCells + 1));
        for (int i = 0; i <= kCells; ++i)
            for (int j = 0; j <= kCells; ++j) {
                const Vector2 at(double(i) / kCells, double(j) / kCells);
                m_uv.push_back(domain.min + at.cwiseProduct(domain.max - domain.min));
                m_points.col(m_uv.size() - 1) = position(m_uv.back());
            }
    }
    Vector2 findNearest(const Vector3& p) const {
        Eigen::Index nearest = 0;
        (m_points.colwise() - p).colwise().squaredNorm().minCoeff(&nearest);
        return m_uv[nearest];
    }

private:
    Eigen::Matrix3Xd m_points;
    std::vector<Vector2> m_uv;
};

/** A parametric surface of the user's own: override calcParametric, getDomain, getSize and getDescription.
With only one chart, the first argument of calcParametric says it all; coordinates beyond the domain must
still give a smooth surface, since iterates may pass there before isInDomain judges the answer. */
class ParametricSurface : public ParametricShape<ParametricSurface> {
public:
    /** Position and derivatives at (u, v); xu x xv points outward unless getNormalSign says otherwise. */
    virtual ParametricValue calcParametric(const Vector2& uv, int chart) const = 0;

    /** Where the surface is defined; infinite sides allowed only if calcNearbyParameters is overridden. */
    virtual ParameterDomain getDomain() const = 0;

    /** By default the nearest of 17 x 17 points of the domain, laid on first use. */
    virtual Vector2 calcNearbyParameters(const Vector3& p_S, int /*chart*/) const {
        std::call_once(m_gridFlag, [this] {
            m_grid.build(getDomain(), [this](const Vector2& uv) { return calcParametric(uv, 0).x; });
        });
        return m_grid.findNearest(p_S);
    }
    virtual double getNormalSign() const { return 1; }
    virtual int chooseChart(const Vector3& /*p_S*/, const Vector3& /*t_S*/, int /*current*/) const { return 0; }

    double calcDomainMargin(const SurfacePoint& point) const override {
        return getDomain().calcMargin(resolve(point).uv);
    }

private:
    mutable std::once_flag m_gridFlag;
    mutable NearbyGrid m_grid;
};

}  // namespace tautline
