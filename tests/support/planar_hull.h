// SPDX-License-Identifier: Apache-2.0
#pragma once
/** A truth of the tests' own for strings over a corrugated sheet z = g(x): the hull of the curve between two points,
its tangents and bitangents by Newton's method, its arcs by quadrature. The sheet unrolls into the plane, so that a
string whose ends are `across` apart in y is as long as the hypotenuse over the hull. Nothing here knows of the path
solver. */
#include <cmath>
#include <functional>
#include <vector>

#include "tautline/types.h"

namespace tautline::testing {

/** z = g(x) with its first two derivatives. */
struct SheetCurve {
    std::function<double(double)> g, slope, curvature;

    /** By Simpson's rule. [m] */
    double calcArcLength(double from, double to) const {
        constexpr int kPieces = 2000;
        const double h = (to - from) / kPieces;
        const auto speed = [&](double x) { return std::hypot(1, slope(x)); };
        double sum = speed(from) + speed(to);
        for (int i = 1; i < kPieces; ++i) sum += (i % 2 == 1 ? 4 : 2) * speed(from + i * h);
        return sum * h / 3;
    }
};

class PlanarHull {
public:
    struct Arc {
        double from, to;  ///< x of its ends
    };

    /** @param A, B   (x, z) above the curve, A.x < B.x */
    PlanarHull(const SheetCurve& curve, const Vector2& A, const Vector2& B) : m_curve(curve) {
        findArcs(A, B);
        polish(A, B);
        m_length = calcLength(A, B);
    }

    const std::vector<Arc>& getArcs() const { return m_arcs; }
    double calcLength(double across) const { return std::hypot(m_length, across); }

private:
    Vector2 getPoint(double x) const { return {x, m_curve.g(x)}; }

    /** The upper hull of many points, each neighboring pair of which belongs to an arc. */
    void findArcs(const Vector2& A, const Vector2& B) {
        constexpr int kSamples = 20000;
        std::vector<Vector2> hull;
        std::vector<int> number;
        const auto add = [&](const Vector2& p, int k) {
            const auto isBelow = [&] {
                const Vector2 a = hull[hull.size() - 2], b = hull.back();
                return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() >= 0;
            };
            while (hull.size() >= 2 && isBelow()) hull.pop_back(), number.pop_back();
            hull.push_back(p), number.push_back(k);
        };
        add(A, 0);
        for (int k = 1; k < kSamples; ++k) add(getPoint(A.x() + k * (B.x() - A.x()) / kSamples), k);
        add(B, kSamples);
        for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
            if (!m_arcs.empty() && number[i] == number[i - 1] + 1 && i > 1)
                m_arcs.back().to = hull[i].x();
            else
                m_arcs.push_back({hull[i].x(), hull[i].x()});
        }
    }

    /** Where the line from a point touches the curve. */
    double findTangent(const Vector2& from, double x) const {
        for (int i = 0; i < 50; ++i) {
            const double run = x - from.x();
            x -= (m_curve.slope(x) * run - (m_curve.g(x) - from.y())) / (m_curve.curvature(x) * run);
        }
        return x;
    }

    /** Where one line touches the curve twice. */
    void findBitangent(double& x1, double& x2) const {
        for (int i = 0; i < 50; ++i) {
            const double run = x2 - x1, rise = m_curve.g(x2) - m_curve.g(x1);
            const double s1 = m_curve.slope(x1), s2 = m_curve.slope(x2);
            const Vector2 error(s1 * run - rise, s2 * run - rise);
            // Derivatives: d(error) = [k1 run, s1 - s2; s1 - s2, k2 run] (dx1, dx2).
            const double a = m_curve.curvature(x1) * run, b = s1 - s2, c = m_curve.curvature(x2) * run;
            const double determinant = a * c - b * b;
            x1 -= (c * error[0] - b * error[1]) / determinant;
            x2 -= (a * error[1] - b * error[0]) / determinant;
        }
    }

    void polish(const Vector2& A, const Vector2& B) {
        if (m_arcs.empty()) return;
        m_arcs.front().from = findTangent(A, m_arcs.front().from);
        m_arcs.back().to = findTangent(B, m_arcs.back().to);
        for (std::size_t i = 0; i + 1 < m_arcs.size(); ++i) findBitangent(m_arcs[i].to, m_arcs[i + 1].from);
    }

    double calcLength(const Vector2& A, const Vector2& B) const {
        double length = 0;
        Vector2 last = A;
        for (const Arc& arc : m_arcs) {
            length += (getPoint(arc.from) - last).norm() + m_curve.calcArcLength(arc.from, arc.to);
            last = getPoint(arc.to);
        }
        return length + (B - last).norm();
    }

    const SheetCurve& m_curve;
    std::vector<Arc> m_arcs;
    double m_length = 0;
};

}  // namespace tautline::testing
