// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/offset_surface.h"

#include <algorithm>

#include "surfaces/shape_checks.h"

namespace tautline {

// Declared extern in the header: compiled once, here.
template class ImplicitShape<OffsetSurface>;

namespace {

/** What a shape operator W of the base becomes at the height h: W/(1 + h W), in the base's basis {t, B}. */
struct RaisedShape {
    double determinant;           ///< of 1 + h W
    double kappaN, tauG, kappaB;  ///< of the offset surface

    RaisedShape(const DarbouxFrame& base, double h) {
        const double K = base.calcGaussianCurvature();
        determinant = 1 - h * (base.kappaN + base.kappaB) + h * h * K;
        kappaN = (base.kappaN - h * K) / determinant;
        tauG = base.tauG / determinant;
        kappaB = (base.kappaB - h * K) / determinant;
    }
};

DarbouxFrame raiseFrame(const DarbouxFrame& base, double h) {
    const RaisedShape shape(base, h);
    return {base.x + h * base.N, base.t, base.N, base.B, shape.kappaN, shape.tauG, shape.kappaB};
}

/** What the foot moves by when the point above it moves by `d`: (1 + h W)^-1 d. */
Vector3 calcFootDisplacement(const DarbouxFrame& base, double h, const Vector3& d) {
    const double dt = d.dot(base.t), dB = d.dot(base.B);
    const double M11 = 1 - h * base.kappaN, M12 = h * base.tauG, M22 = 1 - h * base.kappaB;
    const double determinant = M11 * M22 - M12 * M12;
    return ((M22 * dt - M12 * dB) * base.t + (M11 * dB - M12 * dt) * base.B) / determinant;
}

/** ShotGeodesic and Jacobi equations of the offset surface in terms of the foot on the base, t' = kappa_n N and
C' = (1 + h W)^-1 t. State: C (3), u, v, t (3), a, a', r, r'; of C and (u, v) only the one that the base goes by moves.
*/
struct OffsetGeodesicEquations {
    static constexpr int n = 12;
    using State = Eigen::Matrix<double, n, 1>;

    const Surface& base;
    double h, size;
    bool hasCoordinates;
    SurfacePoint foot;      ///< at the last projected state
    DarbouxFrame frame;     ///< of the offset surface there
    Vector2 lengths{1, 1};  ///< |xu|, |xv| there: make errors of u, v lengths
    double maxKappaN = kNaN;

    SurfacePoint calcFoot(const State& y) const {
        return hasCoordinates ? SurfacePoint{Vector3::Constant(kNaN), y.segment<2>(3), foot.chart}
                              : SurfacePoint{y.head<3>()};
    }
    void calcDerivative(const State& y, State& slope) const {
        const SurfacePoint C = calcFoot(y);
        const DarbouxFrame below = base.calcFrame(C, y.segment<3>(5));
        const RaisedShape shape(below, h);
        const Vector3 velocity = calcFootDisplacement(below, h, below.t);
        Vector2 rates = Vector2::Zero();
        if (hasCoordinates) base.calcCoordinateRates(C, velocity, rates);
        const double K = below.calcGaussianCurvature() / shape.determinant;
        if (hasCoordinates)
            slope.head<3>().setZero();
        else
            slope.head<3>() = velocity;
        slope.segment<2>(3) = rates;
        slope.segment<3>(5) = shape.kappaN * below.N;
        slope.tail<4>() << y[9], -K * y[8], y[11], -K * y[10];
    }
    void calcProjectedDerivative(const State& y, State& slope) const { calcDerivative(y, slope); }
    void calcErrorWeights(const State& /*y*/, State& weights) const {
        weights.head<8>() << Vector3::Constant(1 / size), lengths / size, Vector3::Ones();
    }
    /** Back to the base, in the chart that suits, and to unit speed. */
    void project(State& y) {
        const SurfacePoint C = calcFoot(y);
        foot = hasCoordinates ? base.calcDisplacedPoint(C, Vector3::Zero()) : base.findSurfacePoint(C.p);
        place(base.calcFrame(foot, y.segment<3>(5)), y);
        maxKappaN = std::max(maxKappaN, frame.kappaN);
    }
    /** Sets all but the Jacobi fields from the foot and the base's frame there. */
    void place(const DarbouxFrame& below, State& y) {
        frame = raiseFrame(below, h);
        y.segment<3>(5) = frame.t;
        if (!hasCoordinates) {
            y.head<5>() << foot.p, 0, 0;
            return;
        }
        y.head<5>() << Vector3::Zero(), foot.uv;
        Eigen::Matrix2d rates;  // columns: (u', v') along t and B; the inverse has |xu|, |xv| in its columns
        for (int i = 0; i < 2; ++i) {
            Vector2 rate = Vector2::Zero();
            base.calcCoordinateRates(foot, i == 0 ? below.t : below.B, rate);
            rates.col(i) = rate;
        }
        const double determinant = std::abs(rates(0, 0) * rates(1, 1) - rates(0, 1) * rates(1, 0));
        lengths = Vector2(rates.row(1).norm(), rates.row(0).norm()) / determinant;
    }
};

/** Foot of p on the base: Newton's method for (p - C) normal to the base, from a point C of the base.
@return false if none was found: p lies beyond the centers of curvature */
bool refineFoot(const Surface& base, const Vector3& p, SurfacePoint& C, DarbouxFrame& frame) {
    constexpr int kMaxIterations = 30;
    const double size = base.getSize(), enough = 1e-8 * size;  // after such a step its square is left
    Vector3 direction = Vector3::UnitX();                      // any will do
    for (int i = 0; i < kMaxIterations; ++i) {
        frame = base.calcFrame(C, direction);
        direction = frame.t;
        const Vector3 w = p - C.p;
        const double d = w.dot(frame.N), wt = w.dot(frame.t), wB = w.dot(frame.B);
        // (1 + d W) step = tangential part of w, W in {t, B}
        double H11 = 1 - d * frame.kappaN, H12 = d * frame.tauG, H22 = 1 - d * frame.kappaB;
        if (!(H11 > 0 && H11 * H22 - H12 * H12 > 0)) H11 = H22 = 1, H12 = 0;  // not the nearest point yet
        const double determinant = H11 * H22 - H12 * H12;
        Vector2 step((H22 * wt - H12 * wB) / determinant, (H11 * wB - H12 * wt) / determinant);
        const double length = step.norm();
        if (!std::isfinite(length)) return false;
        if (length <= 1e-15 * size) return true;
        if (length > size) step *= size / length;
        C = base.calcDisplacedPoint(C, step[0] * frame.t + step[1] * frame.B);
        if (length > enough) continue;
        frame = base.calcFrame(C, direction);
        return true;
    }
    return false;
}

/** From the base's own guess. */
bool findFoot(const Surface& base, const Vector3& p, SurfacePoint& C, DarbouxFrame& frame) {
    C = base.findSurfacePoint(p);
    return refineFoot(base, p, C, frame);
}

std::shared_ptr<const Surface> requireBase(std::shared_ptr<const Surface> base) {
    require(base != nullptr, "offset surface: needs a base surface");
    return base;
}

}  // namespace

OffsetSurface::OffsetSurface(std::shared_ptr<const Surface> base, double thickness)
    : SurfaceDecorator(requireBase(std::move(base))), m_thickness(thickness) {
    require(std::isfinite(thickness) && thickness >= 0,
            "offset surface: thickness must be finite and not negative, but is ", thickness);
    Vector2 rates;
    m_hasCoordinates = getBase().calcCoordinateRates(getBase().findSurfacePoint(Vector3::Constant(getBase().getSize())),
                                                     Vector3::Zero(), rates);
}

std::string OffsetSurface::getDescription() const {
    return describeShape(getBase().getDescription(), " under a layer of ", m_thickness);
}

ImplicitValue OffsetSurface::calcImplicit(const Vector3& p) const {
    SurfacePoint C;
    DarbouxFrame frame;
    findFoot(getBase(), p, C, frame);
    const double d = (p - C.p).dot(frame.N);
    const RaisedShape shape(frame, d);  // of the parallel surface through p: the Hessian of the distance
    const Matrix3 mixed = frame.t * frame.B.transpose();
    return {d - m_thickness, frame.N,
            shape.tauG * (mixed + mixed.transpose()) - shape.kappaN * frame.t * frame.t.transpose() -
                shape.kappaB * frame.B * frame.B.transpose()};
}

/** The distance itself where p has a foot, else the base's estimate. Beside the domain of the base there is no layer.
 */
double OffsetSurface::calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const {
    const double height = getBase().calcHeightAndNormal(p_S, N_S);
    SurfacePoint C;
    DarbouxFrame frame;
    if (height < -0.5 * getBase().getSize() || !findFoot(getBase(), p_S, C, frame)) return height - m_thickness;
    if (!getBase().isInDomain(C)) return height;
    N_S = frame.N;
    return (p_S - C.p).dot(frame.N) - m_thickness;
}

SurfacePoint OffsetSurface::findSurfacePoint(const Vector3& p_S) const {
    SurfacePoint C;
    DarbouxFrame frame;
    findFoot(getBase(), p_S, C, frame);
    return {C.p + m_thickness * frame.N, C.uv, C.chart};
}

bool OffsetSurface::findFootOfPoint(const SurfacePoint& point, const Vector3& direction, SurfacePoint& C,
                                    DarbouxFrame& frame) const {
    if (m_hasCoordinates) {  // are they those of the foot?
        C = {Vector3::Constant(kNaN), point.uv, point.chart};
        frame = getBase().calcFrame(C, direction);
        C.p = frame.x;
        const Vector3 raised = frame.x + m_thickness * frame.N;
        if (!point.p.allFinite() || (raised - point.p).norm() <= 1e-12 * (getSize() + raised.norm())) return true;
        C = getBase().findSurfacePoint(point.p);
    } else {
        Vector3 N;
        const double height = getBase().calcHeightAndNormal(point.p, N);
        // Near this surface the foot is about h below; elsewhere the base knows better.
        C = getBase().findSurfacePoint(
            std::abs(height - m_thickness) < 0.5 * m_thickness ? Vector3(point.p - m_thickness * N) : point.p);
    }
    if (!refineFoot(getBase(), point.p, C, frame)) return false;
    frame = getBase().calcFrame(C, direction);
    return true;
}

SurfacePoint OffsetSurface::calcDisplacedPoint(const SurfacePoint& start, const Vector3& displacement_S) const {
    SurfacePoint C;
    DarbouxFrame frame;
    findFootOfPoint(start, displacement_S, C, frame);
    C = getBase().calcDisplacedPoint(C, calcFootDisplacement(frame, m_thickness, displacement_S));
    return {C.p + m_thickness * getBase().calcFrame(C, frame.t).N, C.uv, C.chart};
}

DarbouxFrame OffsetSurface::calcFrame(const SurfacePoint& point, const Vector3& direction_S) const {
    SurfacePoint C;
    DarbouxFrame frame;
    findFootOfPoint(point, direction_S, C, frame);
    return raiseFrame(frame, m_thickness);
}

void OffsetSurface::shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                                  ShotGeodesic& geodesic) const {
    SurfacePoint C;
    DarbouxFrame below;
    findFootOfPoint(start.point, start.tangent, C, below);
    OffsetGeodesicEquations equations{getBase(), m_thickness, getSize(), m_hasCoordinates, C, {}};
    OffsetGeodesicEquations::State y;
    equations.place(below, y);
    geodesic.P = equations.frame;
    integrateGeodesic(equations, y, start.length, options, geodesic);
    geodesic.Q = equations.frame;
    geodesic.endPoint = {geodesic.Q.x, equations.foot.uv, equations.foot.chart};
}

/** That of its foot. */
double OffsetSurface::calcDomainMargin(const SurfacePoint& point) const {
    SurfacePoint C;
    DarbouxFrame frame;
    return findFootOfPoint(point, Vector3::UnitX(), C, frame) ? getBase().calcDomainMargin(C) : -kInfinity;
}

}  // namespace tautline
