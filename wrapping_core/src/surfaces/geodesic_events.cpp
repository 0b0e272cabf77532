// SPDX-License-Identifier: Apache-2.0
#include "tautline/surfaces/geodesic_events.h"

#include <algorithm>
#include <cmath>

#include "surfaces/arc_walker.h"

namespace tautline {
namespace {

/** A geodesic's state at one place: enough to go on from, and the Jacobi field r since its start. */
struct Station {
    double s = 0;
    SurfacePoint point;
    DarbouxFrame frame;
    double r = 0, rDot = 1;
    double value = kNaN;  ///< of the function whose sign is watched
};

/** Walks along a geodesic and finds the zeros of a function of its stations. */
template <class Function>
class ArcWalk {
public:
    ArcWalk(const Surface& surface, const GeodesicStart& start, const ShootingOptions& options,
            const Function& function)
        : m_surface(surface), m_options(options), m_function(function), m_length(start.length) {
        ShotGeodesic none;
        surface.shootGeodesic({start.point, start.tangent, 0}, options, none);
        m_now.point = none.endPoint, m_now.frame = none.Q;
        m_now.value = function(m_now);
    }

    const Station& getStart() const { return m_now; }

    /** Calls `found(station)` at each change of sign in order, until it returns false. Zero counts as positive. */
    template <class Found>
    void forEachZero(const Found& found) {
        Station before, middle = m_now;  // the last stations but one, and but none
        bool hasBefore = false;
        for (int piece = 0; piece < kMaxPieces && std::abs(middle.s) < std::abs(m_length); ++piece) {
            const double left = m_length - middle.s, spacing = calcSpacing(middle);
            const Station after = calcStation(middle, std::abs(left) <= spacing ? left : std::copysign(spacing, left));
            if (!after.frame.x.allFinite() || std::isnan(after.value)) return;
            if (hasBefore && !differInSign(before, middle) && !differInSign(middle, after)) {
                if (const std::optional<Station> dip = findDip(before, middle, after)) {
                    const bool isEarly = std::abs(dip->s) < std::abs(middle.s);
                    if (!found(findZero(isEarly ? before : middle, *dip))) return;
                    if (!found(findZero(*dip, isEarly ? middle : after))) return;
                }
            }
            if (differInSign(middle, after) && !found(findZero(middle, after))) return;
            before = middle, middle = after, hasBefore = true;
        }
    }

private:
    static constexpr int kMaxPieces = 4000;

    /** An eighth of the local radius of curvature; more where the arc is so long that it would take too many. */
    double calcSpacing(const Station& at) const {
        const DarbouxFrame& f = at.frame;
        const double curvature =
            std::max({1 / m_surface.getSize(), std::abs(f.kappaN), std::abs(f.kappaB), std::abs(f.tauG)});
        return std::max(0.125 / curvature, std::abs(m_length) / (0.5 * kMaxPieces));
    }

    Station calcStation(const Station& from, double distance) const {
        ShotGeodesic piece;
        m_surface.shootGeodesic({from.point, from.frame.t, distance}, m_options, piece);
        Station to;
        to.s = from.s + distance, to.point = piece.endPoint, to.frame = piece.Q;
        to.r = piece.a * from.r + piece.r * from.rDot, to.rDot = piece.aDot * from.r + piece.rDot * from.rDot;
        to.value = piece.converged ? m_function(to) : kNaN;
        return to;
    }

    static bool differInSign(const Station& a, const Station& b) { return (a.value < 0) != (b.value < 0); }

    /** Bisection, steered by regula falsi (Illinois) where the values are finite. @return the station of the zero, on
    the side of `from` */
    Station findZero(Station from, const Station& to) const {
        constexpr int kMaxIterations = 120;
        const Station base = from;
        double end = to.s, endValue = to.value, fromValue = from.value;
        const double tolerance = 4e-16 * std::max(std::abs(end), m_surface.getSize());
        for (int i = 0; i < kMaxIterations && std::abs(end - from.s) > tolerance; ++i) {
            double weight = fromValue / (fromValue - endValue);
            // Every third step halves the bracket, whatever the function is like.
            if (i % 3 == 2 || !(weight > 0 && weight < 1)) weight = 0.5;
            const double s = from.s + weight * (end - from.s);
            if (s == from.s || s == end) break;
            const Station at = calcStation(base, s - base.s);
            if (std::isnan(at.value)) break;
            if (at.value == 0) return at;
            if ((at.value < 0) == (base.value < 0)) {
                from = at, fromValue = at.value, endValue *= 0.5;
            } else {
                end = s, endValue = at.value, fromValue *= 0.5;
            }
        }
        return from;
    }

    /** A station of the other sign between three of one sign, if a parabola through them says that there may be one.
    The search halves by golden sections, which need no smoothness. */
    std::optional<Station> findDip(const Station& a, const Station& b, const Station& c) const {
        constexpr double kGolden = 0.6180339887498949;
        constexpr int kSections = 40;
        const double sign = b.value < 0 ? -1 : 1, ga = sign * a.value, gb = sign * b.value, gc = sign * c.value;
        if (!(gb <= ga && gb <= gc) || !std::isfinite(ga + gc)) return {};
        const double h1 = std::abs(b.s - a.s), h2 = std::abs(c.s - b.s);
        const double bend = 2 * ((ga - gb) / h1 + (gc - gb) / h2) / (h1 + h2);
        const double slope = ((gc - gb) / h2 * h1 - (ga - gb) / h1 * h2) / (h1 + h2);
        const double lowest = bend > 0 ? gb - 0.5 * slope * slope / bend : gb;
        if (!(lowest < 0.5 * gb)) return {};
        double low = 0, high = h1 + h2;
        const double direction = c.s < a.s ? -1 : 1;
        Station left = calcStation(a, direction * (high - kGolden * high)),
                right = calcStation(a, direction * kGolden * high);
        for (int i = 0; i < kSections; ++i) {
            if (sign * left.value < 0) return left;
            if (sign * right.value < 0) return right;
            if (sign * left.value < sign * right.value) {
                high = std::abs(right.s - a.s), right = left;
                left = calcStation(a, direction * (high - kGolden * (high - low)));
            } else {
                low = std::abs(left.s - a.s), left = right;
                right = calcStation(a, direction * (low + kGolden * (high - low)));
            }
        }
        return {};
    }

    const Surface& m_surface;
    const ShootingOptions& m_options;
    const Function& m_function;
    double m_length;
    Station m_now;
};

GeodesicPlace makePlace(const Station& station) {
    return {station.s, station.point};
}

/** A largest value and where it is. */
struct Peak {
    double value, at;
};

/** Of the parabola through values at -1, 0 and 1, the middle one at least as large as the others; else the middle. */
Peak findVertex(double before, double here, double after) {
    const double bend = 2 * here - before - after, slope = 0.5 * (after - before);
    if (!(here >= before && here >= after && bend > 0)) return {here, 0};
    return {here + 0.5 * slope * slope / bend, slope / bend};
}

/** kappa_n at the peak near s: uphill in steps of the spacing, and by ever narrower parabolas. */
double refinePeak(const Surface& surface, const GeodesicStart& start, double spacing, double s) {
    constexpr int kRefinements = 12;
    constexpr double kNarrower = 0.2, kNarrowest = 1e-3;  // of the first spacing
    constexpr ShootingOptions kFine{1e-10, 1000};         // what is next to zero is judged by its sign
    ShotGeodesic arc;
    const auto calc = [&](double at) {
        const double inside = std::clamp(at, std::min(0.0, start.length), std::max(0.0, start.length));
        surface.shootGeodesic({start.point, start.tangent, inside}, kFine, arc);
        return arc.Q.kappaN;
    };
    const double end = spacing * kNarrowest;
    double here = calc(s);
    for (int i = 0; i < kRefinements && std::abs(spacing) > std::abs(end); ++i) {
        const double before = calc(s - spacing), after = calc(s + spacing);
        if (std::max(before, after) > here) {
            s += before > after ? -spacing : spacing;
            here = std::max(before, after);
        } else {
            const double vertex = s + findVertex(before, here, after).at * spacing, there = calc(vertex);
            if (there > here) s = vertex, here = there;
            spacing *= kNarrower;
        }
    }
    return here;
}

/** Normal curvatures along an arc at places of equal spacing, ends included. Of an arc that turns little they are those
of the curve of fifth order that has the ends of the arc, their tangents and their curvatures, on the surface: one
evaluation or two in place of a shot. */
class CurvatureSamples {
public:
    CurvatureSamples(const Surface& surface, const GeodesicStart& start, const ShotGeodesic& geodesic, int pieces)
        : m_surface(surface),
          m_geodesic(geodesic),
          m_pieces(pieces),
          m_point(start.point),
          m_isShort(turnsLittle(surface, start.length, geodesic)),
          m_walker(surface, start, kRoughlyAlong, pieces) {}

    /** Of the next place, the first one after the start. */
    double next() {
        if (++m_at == m_pieces) return m_geodesic.Q.kappaN;
        return m_isShort ? calcOnCurve(static_cast<double>(m_at) / m_pieces) : m_walker.next().Q.kappaN;
    }

private:
    static bool turnsLittle(const Surface& surface, double length, const ShotGeodesic& geodesic) {
        constexpr double kLittle = 1;  // [rad]; the curve is off by less than a thousandth of a radius
        double curvature = 1 / surface.getSize();
        for (const DarbouxFrame* end : {&geodesic.P, &geodesic.Q})
            curvature = std::max({curvature, std::abs(end->kappaN), std::abs(end->kappaB), std::abs(end->tauG)});
        return std::abs(length) > 0 && std::abs(length) * curvature < kLittle;
    }

    /** Hermite interpolation. @param u   part of the length */
    double calcOnCurve(double u) {
        const double l = m_geodesic.length, w = 1 - u;
        Vector3 x = Vector3::Zero(), slope = Vector3::Zero();  // slope: by u, but for its part along N
        // With what belongs to one end, at a distance a from it and b from the other; x' there is turn * l * t.
        const auto add = [&](const DarbouxFrame& end, double a, double b, double turn) {
            x += b * b * b *
                 ((1 + 3 * a + 6 * a * a) * end.x + turn * l * a * (1 + 3 * a) * end.t +
                  0.5 * l * l * a * a * end.kappaN * end.N);
            slope += b * b * (-30 * turn * a * a * end.x + l * (1 - 3 * a) * (1 + 5 * a) * end.t);
        };
        add(m_geodesic.P, u, w, 1);
        add(m_geodesic.Q, w, u, -1);
        m_point = m_surface.calcDisplacedPoint(m_point, x - m_point.p);
        return m_surface.calcFrame(m_point, slope).kappaN;
    }

    const Surface& m_surface;
    const ShotGeodesic& m_geodesic;
    const int m_pieces;
    int m_at = 0;
    SurfacePoint m_point;
    bool m_isShort;
    ArcWalker m_walker;
};

}  // namespace

std::optional<GeodesicPlace> findConjugatePoint(const Surface& surface, const GeodesicStart& start,
                                                const ShootingOptions& options) {
    // r is zero at the start, where r/s is one.
    const auto field = [](const Station& at) { return at.s == 0 ? 1.0 : at.r / at.s; };
    std::optional<GeodesicPlace> place;
    ArcWalk(surface, start, options, field).forEachZero([&](const Station& at) {
        place = makePlace(at);
        return false;
    });
    return place;
}

std::vector<GeodesicPlace> findPressureChanges(const Surface& surface, const GeodesicStart& start,
                                               const ShootingOptions& options) {
    std::vector<GeodesicPlace> places;
    if (surface.isConvex()) return places;
    const auto pressure = [](const Station& at) { return at.frame.kappaN; };
    ArcWalk(surface, start, options, pressure).forEachZero([&](const Station& at) {
        if (at.s != 0) places.push_back(makePlace(at));  // a zero at the start is no change inside
        return true;
    });
    return places;
}

std::optional<GeodesicPlace> findDomainExit(const Surface& surface, const GeodesicStart& start,
                                            const ShootingOptions& options) {
    const auto margin = [&surface](const Station& at) { return surface.calcDomainMargin(at.point); };
    ArcWalk walk(surface, start, options, margin);
    const double first = walk.getStart().value;
    if (!(first >= 0)) return makePlace(walk.getStart());
    std::optional<GeodesicPlace> place;
    if (first == kInfinity) return place;  // no edge anywhere
    walk.forEachZero([&](const Station& at) {
        place = makePlace(at);
        return false;
    });
    return place;
}

double calcLargestNormalCurvature(const Surface& surface, const GeodesicStart& start, const ShotGeodesic& geodesic) {
    constexpr double kMatters = -0.05;  // curvature in sizes below which an estimate between samples is enough
    const double largest = std::max({geodesic.P.kappaN, geodesic.Q.kappaN, geodesic.maxKappaN});
    const int pieces = 2 + static_cast<int>(std::min(500.0, 5 * std::abs(start.length) / surface.getSize()));
    const double spacing = start.length / pieces;
    CurvatureSamples samples(surface, start, geodesic, pieces);
    Peak peak =
        geodesic.P.kappaN > geodesic.Q.kappaN ? Peak{geodesic.P.kappaN, 0.0} : Peak{geodesic.Q.kappaN, start.length};
    double before = geodesic.P.kappaN, here = samples.next();
    for (int i = 1; i < pieces; ++i) {
        const double after = samples.next();
        const Peak vertex = findVertex(before, here, after);
        if (vertex.value > peak.value) peak = {vertex.value, (i + vertex.at) * spacing};
        before = here, here = after;
    }
    if (peak.value * surface.getSize() > kMatters) peak.value = refinePeak(surface, start, 0.5 * spacing, peak.at);
    return std::max(largest, peak.value);
}

}  // namespace tautline
