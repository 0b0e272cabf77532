// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/surface_laws.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tautline/error.h"
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_surface.h"

namespace tautline {
namespace {

/** Laws at one sample; `broken` collects the sentences, which begin with `subject`. */
class SampleChecker {
protected:
    SampleChecker(std::string subject, double size, const SurfaceLawSample& sample, const SurfaceLawOptions& options,
                  std::vector<std::string>& broken)
        : m_sample(sample), m_options(options), m_size(size), m_subject(std::move(subject)), m_broken(broken) {}

    /** Notes a broken law unless value <= limit; NaN breaks it. */
    void demand(double value, double limit, const std::string& law) {
        if (value <= limit) return;
        std::ostringstream text;
        text.precision(6);
        text << m_subject << " law " << law << ": " << value << " exceeds " << limit << " at p = ("
             << m_sample.p_S.transpose() << "), direction (" << m_sample.direction_S.transpose() << "), length "
             << m_sample.length;
        m_broken.push_back(text.str());
        m_isBroken = true;
    }
    bool isBroken() const { return m_isBroken; }
    double exact() const { return m_options.exactTolerance; }

    ShotGeodesic shoot(const Surface& surface, const SurfacePoint& point, const Vector3& tangent, double length) const {
        ShotGeodesic geodesic;
        surface.shootGeodesic({point, tangent, length}, m_options.geodesics, geodesic);
        return geodesic;
    }
    /** Difference of two frames as places and directions; curvatures apart. */
    double calcDifference(const DarbouxFrame& a, const DarbouxFrame& b) const {
        return std::max({(a.x - b.x).norm() / m_size, (a.t - b.t).norm(), (a.N - b.N).norm(), (a.B - b.B).norm()});
    }
    /** Largest of 1/size and the curvatures: what curvatures are measured in. */
    double calcUnitCurvature(const DarbouxFrame& f) const {
        return std::max({1 / m_size, std::abs(f.kappaN), std::abs(f.kappaB), std::abs(f.tauG)});
    }
    /** Products of Jacobi fields: how much an error at the start may have grown at the end. */
    double calcGrowth(const ShotGeodesic& g) const {
        return std::max(
            {1.0, std::abs(g.a * g.rDot), std::abs(g.aDot * g.r), std::abs(g.r) / m_size, std::abs(g.aDot) * m_size});
    }

    const SurfaceLawSample& m_sample;
    const SurfaceLawOptions& m_options;
    const double m_size;

private:
    const std::string m_subject;
    std::vector<std::string>& m_broken;
    bool m_isBroken = false;
};

/** Checks one surface at one sample. */
class LawChecker : private SampleChecker {
public:
    LawChecker(const Surface& surface, const SurfaceLawSample& sample, const SurfaceLawOptions& options,
               std::vector<std::string>& broken)
        : SampleChecker(surface.getDescription() + " breaks", surface.getSize(), sample, options, broken),
          m_surface(surface) {}

    void checkAll() {
        m_point = m_surface.findSurfacePoint(m_sample.p_S);
        m_frame = m_surface.calcFrame(m_point, m_sample.direction_S);
        m_curvature = calcUnitCurvature(m_frame);
        checkFrame();
        if (!m_frame.N.allFinite() || !m_frame.t.allFinite()) return;  // said; the rest would only repeat it
        checkProjection();
        checkHeight();
        checkDisplacement();
        checkCurvatures();
        checkShooting();
        checkReversal();
        checkAdditivity();
        checkNeighbors();
        checkZeroLength();
        checkAnyPoint();
        checkImplicitForm();
        checkParametricForm();
    }

private:
    double calcHeight(const Vector3& p) const { return m_surface.calcHeight(p); }

    /** What the height of a surface point is off: it is 0, and beside the domain not negative. */
    double calcHeightError(const SurfacePoint& point) const {
        const double height = calcHeight(point.p);
        return m_surface.isInDomain(point) ? std::abs(height) : std::max(0.0, -height);
    }
    ShotGeodesic shoot(const SurfacePoint& point, const Vector3& tangent, double length) const {
        return SampleChecker::shoot(m_surface, point, tangent, length);
    }
    double calcGrowth() const { return SampleChecker::calcGrowth(m_arc); }

    void checkFrame() {
        const DarbouxFrame& f = m_frame;
        Matrix3 R;
        R << f.t, f.N, f.B;
        demand((R.transpose() * R - Matrix3::Identity()).norm(), 1e-13, "1 (frame orthonormal)");
        demand((f.B - f.t.cross(f.N)).norm(), 1e-13, "1 (frame right-handed, B = t x N)");
        demand((f.x - m_point.p).norm() / m_size, exact(), "1 (frame at its point)");
        demand(m_sample.direction_S.dot(f.B) / m_sample.direction_S.norm(), 1e-12, "1 (t along the direction)");
        demand(-m_sample.direction_S.dot(f.t), 0, "1 (t along the direction, not against it)");
        demand(std::isfinite(f.kappaN + f.tauG + f.kappaB) ? 0 : 1, 0, "1 (curvatures finite)");
    }

    void checkProjection() {
        const SurfacePoint again = m_surface.findSurfacePoint(m_point.p);
        demand((again.p - m_point.p).norm() / m_size, 1e-10, "2 (projection idempotent)");
        demand(calcHeightError(m_point) / m_size, 1e-10, "2 (no height on the surface)");
    }

    void checkHeight() {
        if (!m_surface.isInDomain(m_point)) return;
        Vector3 N;
        m_surface.calcHeightAndNormal(m_point.p, N);
        demand((N - m_frame.N).norm(), 1e-8, "3 (ascent of the height on the surface is N)");
        const double step = 1e-4 * std::min(m_size, 1 / m_curvature);
        const double above = m_surface.calcHeightAndNormal(m_point.p + step * m_frame.N, N),
                     below = calcHeight(m_point.p - step * m_frame.N);
        demand(std::abs(N.norm() - 1), 1e-12, "3 (N_S unit)");
        demand(-above, 0, "3 (height positive outside)");
        demand(below, 0, "3 (height negative inside)");
        demand(std::abs((above - below) / (2 * step) - 1), m_options.differenceTolerance, "3 (slope of height is 1)");
    }

    void checkDisplacement() {
        const double step = 0.02 / m_curvature;
        for (const Vector3& direction : {m_frame.t, m_frame.B}) {
            for (const double distance : {step, -step}) {
                const Vector3 target = m_point.p + distance * direction;
                const SurfacePoint there = m_surface.calcDisplacedPoint(m_point, distance * direction);
                demand(calcHeightError(there) / m_size, 1e-10, "4 (displaced point on the surface)");
                // In curvature^-1 the square of the step; a normal section alone misses half of it.
                demand((there.p - target).norm() * m_curvature, 3 * 0.02 * 0.02,
                       "4 (displacement first-order correct)");
            }
        }
    }

    void checkCurvatures() {
        const DarbouxFrame& f = m_frame;
        const double step = m_options.differenceStep * std::min(m_size, 1 / m_curvature);
        const auto calcSlope = [&](const Vector3& direction) {
            return Vector3((shoot(m_point, direction, step).Q.N - shoot(m_point, direction, -step).Q.N) / (2 * step));
        };
        const double limit = m_options.differenceTolerance * m_curvature;
        const Vector3 dN_t = calcSlope(f.t), dN_B = calcSlope(f.B);
        demand(std::abs(f.kappaN + f.t.dot(dN_t)), limit, "5 (kappaN = -t . dN(t))");
        demand(std::abs(f.tauG - f.B.dot(dN_t)), limit, "5 (tauG = B . dN(t))");
        demand(std::abs(f.tauG - f.t.dot(dN_B)), limit, "5 (dN symmetric)");
        demand(std::abs(f.kappaB + f.B.dot(dN_B)), limit, "5 (kappaB = -B . dN(B))");
    }

    void checkShooting() {
        m_arc = shoot(m_point, m_frame.t, m_sample.length);
        const DarbouxFrame& Q = m_arc.Q;
        demand(m_arc.converged ? 0 : 1, 0, "6 (geodesic converged)");
        demand(calcDifference(m_arc.P, m_frame), exact(), "6 (begins in the frame of its start)");
        demand(std::abs(m_arc.P.kappaN - m_frame.kappaN) / m_curvature, exact(), "6 (curvature at the start)");
        demand(calcHeightError(m_arc.endPoint) / m_size, 1e-10, "6 (end on the surface)");
        demand((m_arc.endPoint.p - Q.x).norm() / m_size, 1e-12, "6 (endPoint is where Q is)");
        const DarbouxFrame there = m_surface.calcFrame(m_arc.endPoint, Q.t);
        demand(calcDifference(there, Q), exact(), "6 (end has the frame of calcFrame)");
        m_endCurvature = std::max(m_curvature, calcUnitCurvature(there));
        demand(std::max({std::abs(there.kappaN - Q.kappaN), std::abs(there.tauG - Q.tauG),
                         std::abs(there.kappaB - Q.kappaB)}) /
                   m_endCurvature,
               exact(), "6 (end has the curvatures of calcFrame)");
        demand(m_arc.length == m_sample.length ? 0 : 1, 0, "6 (length is the one asked for)");
        demand((Q.x - m_frame.x).norm() / m_sample.length, 1 + exact(), "6 (unit speed: chord no longer than arc)");
        demand(std::abs(m_arc.a * m_arc.rDot - m_arc.aDot * m_arc.r - 1), exact() * calcGrowth(), "9 (Wronskian)");
    }

    void checkReversal() {
        const ShotGeodesic back = shoot(m_arc.endPoint, -m_arc.Q.t, m_sample.length);
        DarbouxFrame reversed = back.Q;
        reversed.t = -reversed.t, reversed.B = -reversed.B;
        demand(calcDifference(reversed, m_frame), exact() * calcGrowth(), "7 (shot back from its end)");
        demand(std::max(
                   {std::abs(back.r - m_arc.r) / m_size, std::abs(back.a - m_arc.rDot), std::abs(back.rDot - m_arc.a)}),
               exact() * calcGrowth(), "7 (Jacobi fields of the reversed arc: r the same, a and r' exchanged)");
        const ShotGeodesic negative = shoot(m_arc.endPoint, m_arc.Q.t, -m_sample.length);
        demand(calcDifference(negative.Q, m_frame), exact() * calcGrowth(), "7 (shot over the negative length)");
    }

    void checkAdditivity() {
        const ShotGeodesic first = shoot(m_point, m_frame.t, 0.4 * m_sample.length);
        const ShotGeodesic second = shoot(first.endPoint, first.Q.t, 0.6 * m_sample.length);
        demand(calcDifference(second.Q, m_arc.Q), exact() * calcGrowth(), "8 (two parts make the whole)");
        const double a = second.a * first.a + second.r * first.aDot, r = second.a * first.r + second.r * first.rDot;
        const double aDot = second.aDot * first.a + second.rDot * first.aDot;
        const double rDot = second.aDot * first.r + second.rDot * first.rDot;
        demand(std::max({std::abs(a - m_arc.a), std::abs(r - m_arc.r) / m_size, std::abs(aDot - m_arc.aDot) * m_size,
                         std::abs(rDot - m_arc.rDot)}),
               exact() * calcGrowth(), "8 (Jacobi fields of two parts make those of the whole)");
    }

    /** By geodesics turned about N, and by geodesics whose starts lie along B with t carried parallel. */
    void checkNeighbors() {
        const DarbouxFrame &P = m_frame, &Q = m_arc.Q;
        const double growth = calcGrowth();
        const double angle = m_options.differenceStep / std::sqrt(growth),
                     step = angle * std::min(m_size, 1 / m_curvature);
        const auto turned = [&](double by) {
            return shoot(m_point, std::cos(by) * P.t + std::sin(by) * P.B, m_sample.length).Q;
        };
        const auto moved = [&](double by) {
            const ShotGeodesic aside = shoot(m_point, P.B, by);  // its binormal is -t, carried parallel
            return shoot(aside.endPoint, -aside.Q.B, m_sample.length).Q;
        };
        // The field at Q is along B, and its derivative is the B part of what t changes by.
        const auto compare = [&](const DarbouxFrame& plus, const DarbouxFrame& minus, double by, double field,
                                 double rate, double unit, const char* law) {
            const Vector3 dx = (plus.x - minus.x) / (2 * by), dt = (plus.t - minus.t) / (2 * by);
            const double limit = m_options.differenceTolerance * growth * unit;
            demand((dx - field * Q.B).norm() / m_size, limit, law);
            demand(std::abs(dt.dot(Q.B) - rate), limit, law);
        };
        compare(turned(angle), turned(-angle), angle, m_arc.r, m_arc.rDot, 1,
                "10 (r, r' are differences of geodesics)");
        compare(moved(step), moved(-step), step, m_arc.a, m_arc.aDot, m_curvature,
                "10 (a, a' are differences of geodesics)");
    }

    void checkZeroLength() {
        const ShotGeodesic none = shoot(m_point, m_frame.t, 0);
        demand(calcDifference(none.Q, m_frame), 1e-12, "11 (zero length)");
        demand(std::abs(none.a - 1) + std::abs(none.r) / m_size, 1e-12, "11 (zero length: a = 1, r = 0)");
    }

    void checkAnyPoint() {
        for (const double far : {0.0, 0.3, 3.0, 1e4}) {
            Vector3 N;
            const Vector3 p =
                m_point.p + far * m_size * m_sample.direction_S.normalized() - (far < 1 ? far * m_size : 0) * m_frame.N;
            const double height = m_surface.calcHeightAndNormal(p, N);
            demand(std::isfinite(height) && std::abs(N.norm() - 1) < 1e-9 ? 0 : 1, 0,
                   "12 (height finite, N_S unit anywhere)");
            demand(m_surface.findSurfacePoint(p).p.allFinite() ? 0 : 1, 0, "12 (surface point finite anywhere)");
        }
        Vector3 N;
        const bool isFinite = std::isfinite(m_surface.calcHeightAndNormal(Vector3::Zero(), N)) && N.allFinite() &&
                              m_surface.findSurfacePoint(Vector3::Zero()).p.allFinite();
        demand(isFinite ? 0 : 1, 0, "12 (the origin too)");
    }

    void checkImplicitForm() {
        ImplicitValue at, plus, minus;
        if (!m_surface.calcImplicitForm(m_point.p, at)) return;
        const double step = m_options.differenceStep * std::min(m_size, 1 / m_curvature);
        const double limit = m_options.differenceTolerance * at.gradient.norm();
        const auto entry = [](const char* of, int i, int j) {
            return std::string("13 (") + of + "d" + "xyz"[i] + (j < 0 ? "" : std::string("d") + "xyz"[j]);
        };
        for (int i = 0; i < 3; ++i) {
            m_surface.calcImplicitForm(m_point.p + step * Vector3::Unit(i), plus);
            m_surface.calcImplicitForm(m_point.p - step * Vector3::Unit(i), minus);
            demand(std::abs(at.gradient[i] - (plus.f - minus.f) / (2 * step)), limit,
                   entry("df/", i, -1) + " is the difference of f)");
            const Vector3 column = (plus.gradient - minus.gradient) / (2 * step);
            for (int j = 0; j < 3; ++j)
                demand(std::abs(at.hessian(j, i) - column[j]), limit * m_curvature,
                       entry("d2f/", i, j) + " is the difference of the gradient)");
            const int j = (i + 1) % 3;
            demand(std::abs(at.hessian(i, j) - at.hessian(j, i)), 1e-12 * at.hessian.norm(),
                   entry("d2f/", i, j) + ": Hessian symmetric)");
        }
    }

    void checkParametricForm() {
        ParametricValue at, plus, minus;
        if (!m_surface.calcParametricForm(m_point, at)) return;
        const double step = m_options.differenceStep * std::min(m_size, 1 / m_curvature);
        const Vector3* const first[] = {&at.xu, &at.xv};
        const Vector3* const second[2][2] = {{&at.xuu, &at.xuv}, {&at.xuv, &at.xvv}};
        for (int i = 0; i < 2; ++i) {
            const double speed = first[i]->norm(), h = step / speed;
            const auto move = [&](double by, ParametricValue& value) {
                SurfacePoint there = m_point;
                there.uv[i] += by;
                m_surface.calcParametricForm(there, value);
            };
            move(h, plus), move(-h, minus);
            const std::string name(1, "uv"[i]);
            demand((*first[i] - (plus.x - minus.x) / (2 * h)).norm(), m_options.differenceTolerance * speed,
                   "13 (dx/d" + name + " is the difference of x)");
            for (int j = 0; j < 2; ++j) {
                const Vector3 difference = j == 0 ? Vector3(plus.xu - minus.xu) : Vector3(plus.xv - minus.xv);
                const double unit = std::max(speed * first[j]->norm() * m_curvature, second[i][j]->norm());
                demand((*second[i][j] - difference / (2 * h)).norm(), m_options.differenceTolerance * unit,
                       "13 (d2x/d" + name + "d" + "uv"[j] + " is the difference of dx/d" + "uv"[j] + ")");
            }
        }
    }

    const Surface& m_surface;
    double m_curvature = 0, m_endCurvature = 0;
    SurfacePoint m_point;
    DarbouxFrame m_frame;
    ShotGeodesic m_arc;
};

/** Checks at one sample whether two surfaces are the same one. */
class SamenessChecker : private SampleChecker {
public:
    SamenessChecker(const Surface& first, const Surface& second, const SurfaceLawSample& sample,
                    const SurfaceLawOptions& options, std::vector<std::string>& broken)
        : SampleChecker(first.getDescription() + " and " + second.getDescription() + " are not the same: they break",
                        first.getSize(), sample, options, broken),
          m_first(first),
          m_second(second) {}

    void checkAll() {
        checkPoints();
        if (isBroken()) return;
        m_firstFrame = m_first.calcFrame(m_firstPoint, m_sample.direction_S);
        m_secondFrame = m_second.calcFrame(m_secondPoint, m_sample.direction_S);
        checkHeights();
        demand((m_firstFrame.N - m_secondFrame.N).norm(), exact(), "16 (outward normals equal)");
        if (isBroken()) return;
        checkCurvatures(m_firstFrame, m_secondFrame, exact(), "17 (", " equal)");
        checkGeodesics();
    }

private:
    void checkPoints() {
        m_firstPoint = m_first.findSurfacePoint(m_sample.p_S);
        m_secondPoint = m_second.findSurfacePoint(m_firstPoint.p);
        demand((m_firstPoint.p - m_secondPoint.p).norm() / m_size, exact(),
               "14 (points of the first lie on the second)");
        const Vector3 p = m_second.findSurfacePoint(m_sample.p_S).p;
        demand((p - m_first.findSurfacePoint(p).p).norm() / m_size, exact(),
               "14 (points of the second lie on the first)");
    }

    /** Heights are the same to first order only, so what is even in the distance from the surface is left free. */
    void checkHeights() {
        const auto calcPair = [&](const Vector3& p) { return Vector2(m_first.calcHeight(p), m_second.calcHeight(p)); };
        const auto demandOneSign = [&](const Vector2& pair) {
            const bool isOnSurface = pair.cwiseAbs().maxCoeff() <= exact() * m_size;
            demand(isOnSurface ? 0 : -pair[0] * pair[1], 0, "15 (heights of one sign)");
        };
        const double step = m_options.differenceStep * std::min(m_size, 1 / calcUnitCurvature(m_firstFrame));
        const Vector2 above = calcPair(m_firstFrame.x + step * m_firstFrame.N),
                      below = calcPair(m_firstFrame.x - step * m_firstFrame.N), slopes = (above - below) / (2 * step);
        demandOneSign(above), demandOneSign(below), demandOneSign(calcPair(m_sample.p_S));
        demand(std::abs(slopes[0] - slopes[1]), m_options.differenceTolerance, "15 (slopes of the heights equal)");
    }

    void checkCurvatures(const DarbouxFrame& a, const DarbouxFrame& b, double tolerance, const std::string& law,
                         const std::string& suffix) {
        const double limit = tolerance * calcUnitCurvature(a);
        demand(std::abs(a.kappaN - b.kappaN), limit, law + "kappaN" + suffix);
        demand(std::abs(a.tauG - b.tauG), limit, law + "tauG" + suffix);
        demand(std::abs(a.kappaB - b.kappaB), limit, law + "kappaB" + suffix);
    }

    void checkGeodesics() {
        const ShotGeodesic g = shoot(m_first, m_firstPoint, m_firstFrame.t, m_sample.length);
        const ShotGeodesic h = shoot(m_second, m_secondPoint, m_firstFrame.t, m_sample.length);
        const double limit = exact() * calcGrowth(g);
        demand(g.converged && h.converged ? 0 : 1, 0, "18 (both geodesics converged)");
        demand((g.Q.x - h.Q.x).norm() / m_size, limit, "18 (geodesics end at the same place)");
        demand(calcDifference(g.Q, h.Q), limit, "18 (geodesics end in the same frame)");
        checkCurvatures(g.Q, h.Q, limit, "18 (", " at the ends of geodesics equal)");
        demand(std::abs(g.a - h.a), limit, "19 (a equal)");
        demand(std::abs(g.aDot - h.aDot) * m_size, limit, "19 (a' equal)");
        demand(std::abs(g.r - h.r) / m_size, limit, "19 (r equal)");
        demand(std::abs(g.rDot - h.rDot), limit, "19 (r' equal)");
        // With r = 0 at the end it is rounding that tells whether the conjugate point lies before it.
        const bool isConjugateEnd = std::abs(g.r) <= limit * m_size;
        demand(g.hasConjugatePoint == h.hasConjugatePoint || isConjugateEnd ? 0 : 1, 0, "19 (conjugate point)");
    }

    const Surface &m_first, &m_second;
    SurfacePoint m_firstPoint, m_secondPoint;  ///< the same point
    DarbouxFrame m_firstFrame, m_secondFrame;
};

void requireUsable(const SurfaceLawSample& sample) {
    require(sample.p_S.allFinite() && sample.direction_S.allFinite() && sample.length > 0,
            "surface laws: a sample needs a finite point and direction and a positive length");
}

}  // namespace

std::vector<std::string> checkSurfaceLaws(const Surface& surface, const std::vector<SurfaceLawSample>& samples,
                                          const SurfaceLawOptions& options) {
    std::vector<std::string> broken;
    for (const SurfaceLawSample& sample : samples) {
        requireUsable(sample);
        LawChecker(surface, sample, options, broken).checkAll();
    }
    return broken;
}

std::vector<std::string> checkSameSurface(const Surface& first, const Surface& second,
                                          const std::vector<SurfaceLawSample>& samples,
                                          const SurfaceLawOptions& options) {
    std::vector<std::string> broken;
    for (const SurfaceLawSample& sample : samples) {
        requireUsable(sample);
        SamenessChecker(first, second, sample, options, broken).checkAll();
    }
    return broken;
}

}  // namespace tautline
