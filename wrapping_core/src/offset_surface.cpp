#include "tautline/offset_surface.h"

#include "shape_checks.h"

namespace tautline {
namespace {

/** Foot of p on the base: Newton's method for (p - C) normal to the base, from the base's own guess.
@return false if none was found: p lies beyond the centres of curvature */
bool findFoot(const Surface& base, const Vec3& p, SurfacePoint& C, DarbouxFrame& frame) {
    constexpr int kMaxIterations = 30;
    const double size = base.getSize(), enough = 1e-8 * size;  // after such a step its square is left
    C = base.findSurfacePoint(p);
    Vec3 N;
    base.calcHeight(C.p, N);
    Vec3 direction = N.unitOrthogonal();  // any will do, if it is not along N
    for (int i = 0; i < kMaxIterations; ++i) {
        frame = base.calcFrame(C, direction);
        direction = frame.t;
        const Vec3 w = p - C.p;
        const double d = w.dot(frame.N), wt = w.dot(frame.t), wB = w.dot(frame.B);
        // (1 + d W) step = tangential part of w, W in {t, B}
        double H11 = 1 - d * frame.kappaN, H12 = d * frame.tauG, H22 = 1 - d * frame.kappaB;
        if (!(H11 > 0 && H11 * H22 - H12 * H12 > 0)) H11 = H22 = 1, H12 = 0;  // not the nearest point yet
        const double determinant = H11 * H22 - H12 * H12;
        Vec2 step((H22 * wt - H12 * wB) / determinant, (H11 * wB - H12 * wt) / determinant);
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

}  // namespace

OffsetSurface::OffsetSurface(std::shared_ptr<const Surface> base, double thickness)
    : m_base(std::move(base)), m_thickness(thickness) {
    require(m_base != nullptr, "offset surface: needs a base surface");
    require(std::isfinite(thickness) && thickness >= 0,
            "offset surface: thickness must be finite and not negative, but is ", thickness);
}

std::string OffsetSurface::getDescription() const {
    return describeShape(m_base->getDescription(), " under a layer of ", m_thickness);
}

ImplicitValue OffsetSurface::calcImplicit(const Vec3& p) const {
    SurfacePoint C;
    DarbouxFrame frame;
    findFoot(*m_base, p, C, frame);
    const double d = (p - C.p).dot(frame.N);
    // W/(1 + d W) of the 2 x 2 shape operator W = [-kappaN, tauG; tauG, -kappaB] in {t, B}
    const double W11 = -frame.kappaN, W12 = frame.tauG, W22 = -frame.kappaB, K = W11 * W22 - W12 * W12;
    const double determinant = 1 + d * (W11 + W22) + d * d * K;
    const double H11 = (W11 + d * K) / determinant, H12 = W12 / determinant, H22 = (W22 + d * K) / determinant;
    const Mat3 mixed = frame.t * frame.B.transpose();
    return {
        d - m_thickness, frame.N,
        H11 * frame.t * frame.t.transpose() + H12 * (mixed + mixed.transpose()) + H22 * frame.B * frame.B.transpose()};
}

/** The distance itself where p has a foot, else the base's estimate. */
double OffsetSurface::calcHeight(const Vec3& p_S, Vec3& N_S) const {
    const double height = m_base->calcHeight(p_S, N_S);
    SurfacePoint C;
    DarbouxFrame frame;
    if (height < -0.5 * m_base->getSize() || !findFoot(*m_base, p_S, C, frame)) return height - m_thickness;
    N_S = frame.N;
    return (p_S - C.p).dot(frame.N) - m_thickness;
}

SurfacePoint OffsetSurface::findSurfacePoint(const Vec3& p_S) const {
    SurfacePoint C;
    DarbouxFrame frame;
    findFoot(*m_base, p_S, C, frame);
    return {C.p + m_thickness * frame.N};
}

/** Lowest over the base is near enough to the lowest over the offset to start from, and refined from there. */
double OffsetSurface::findLowestPoint(const Vec3& A_S, const Vec3& e_S, double length) const {
    constexpr int kRefinements = 6;
    double s = m_base->findLowestPoint(A_S, e_S, length);
    for (int i = 0; i < kRefinements; ++i) {  // Newton on the slope of f along the line
        const ImplicitValue value = calcImplicit(A_S + s * e_S);
        const double curvature = e_S.dot(value.hessian * e_S);
        if (!(curvature > 0)) break;
        s = std::clamp(s - value.gradient.dot(e_S) / curvature, 0.0, length);
    }
    return s;
}

/** Where its foot is. */
bool OffsetSurface::isInDomain(const SurfacePoint& point) const {
    SurfacePoint C;
    DarbouxFrame frame;
    return findFoot(*m_base, point.p, C, frame) && m_base->isInDomain(C);
}

}  // namespace tautline
