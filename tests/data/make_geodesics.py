#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes geodesics.txt: geodesics with their Jacobi fields to 30 digits, by means that share nothing with
the core: other equations, other integrator, 60-digit decimals of the standard library.

    python3 make_geodesics.py > geodesics.txt        (two minutes)

Ellipsoid: x'' = -(x'.Ax')/|Ax|^2 Ax with A = diag(1/a^2), K = 1/(abc |Ax|^2)^2.
Torus: geodesic equations in its angles (u, v) of thesis Eqn. 3.69, K = cos v/(r (R + r cos v)); sines and
cosines are carried as states, so that both right-hand sides are rational. Integrator: extrapolated midpoint
rule, 16 columns; every number is computed with two step lengths and refused unless both agree to 1e-32."""
from decimal import Decimal as D, getcontext

getcontext().prec = 60
COLUMNS = 16


def extrapolated_midpoint(f, y, length, steps):
    h_big = length / steps
    for _ in range(steps):
        table = []
        for j in range(COLUMNS):
            n = 2 * (j + 1)
            h = h_big / n
            before, now = y, [a + h * b for a, b in zip(y, f(y))]
            for _ in range(n - 1):
                before, now = now, [a + 2 * h * b for a, b in zip(before, f(now))]
            smooth = [(a + b + h * c) / 2 for a, b, c in zip(before, now, f(now))]
            row = [smooth]
            for k in range(1, j + 1):
                ratio = (D(n) / (2 * (j + 1 - k))) ** 2 - 1
                row.append([a + (a - b) / ratio for a, b in zip(row[k - 1], table[j - 1][k - 1])])
            table.append(row)
        y = table[-1][-1]
    return y


def series(x, first):
    """sin (first = 1) or cos (first = 0) by its power series."""
    term, total, k = (x if first else D(1)), D(0), first
    while abs(term) > D(10) ** -58:
        total += term
        term *= -x * x / ((k + 1) * (k + 2))
        k += 2
    return total


def sin(x):
    return series(x, 1)


def cos(x):
    return series(x, 0)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def ellipsoid(axes, s, t, wish, length, steps):
    """Start: the rational point of the unit sphere with stereographic coordinates (s, t), stretched."""
    axes, s, t, wish = [D(v) for v in axes], D(s), D(t), [D(v) for v in wish]
    q = 1 + s * s + t * t
    p = [axes[0] * 2 * s / q, axes[1] * 2 * t / q, axes[2] * (q - 2) / q]
    A = [1 / (a * a) for a in axes]
    n = [a * x for a, x in zip(A, p)]
    tangent = [w - dot(wish, n) / dot(n, n) * x for w, x in zip(wish, n)]
    size = dot(tangent, tangent).sqrt()
    tangent = [x / size for x in tangent]
    volume2 = (axes[0] * axes[1] * axes[2]) ** 2

    def f(y):
        g = [a * x for a, x in zip(A, y[0:3])]
        g2 = dot(g, g)
        factor = -sum(a * v * v for a, v in zip(A, y[3:6])) / g2
        K = 1 / (volume2 * g2 * g2)
        return y[3:6] + [factor * x for x in g] + [y[7], -K * y[6], y[9], -K * y[8]]

    end = extrapolated_midpoint(f, p + tangent + [D(1), D(0), D(0), D(1)], D(length), steps)
    return ["ellipsoid"] + axes + p + tangent + [D(length)] + end


def torus(R, r, u, v, du, dv, length, steps):
    R, r, u, v, du, dv = [D(x) for x in (R, r, u, v, du, dv)]
    rho = R + r * cos(v)
    speed = ((rho * du) ** 2 + (r * dv) ** 2).sqrt()

    def place(cu, su, cv, sv, du, dv):
        rho = R + r * cv
        return [rho * cu, rho * su, r * sv,
                -r * sv * dv * cu - rho * su * du, -r * sv * dv * su + rho * cu * du, r * cv * dv]

    def f(y):
        cu, su, cv, sv, du, dv = y[0:6]
        rho = R + r * cv
        K = cv / (r * rho)
        return [-su * du, cu * du, -sv * dv, cv * dv, 2 * r * sv / rho * du * dv, -rho * sv / r * du * du,
                y[7], -K * y[6], y[9], -K * y[8]]

    start = [cos(u), sin(u), cos(v), sin(v), du / speed, dv / speed]
    end = extrapolated_midpoint(f, start + [D(1), D(0), D(0), D(1)], D(length), steps)
    return ["torus", R, r, D(0)] + place(*start) + [D(length)] + place(*end[0:6]) + end[6:10]


CASES = [
    # thesis Eqn. 3.70, Fig. 3.8, its direction normalized
    lambda k: torus("3", "1", "2.0", "2.0", "0.37", "0.27", "14.5", 60 * k),
    lambda k: torus("3", "1", "0.5", "3.0", "1", "0.05", "4", 30 * k),       # round the inner equator
    lambda k: torus("3", "1", "-1", "0.3", "0", "1", "-7", 40 * k),          # a meridian, backwards
    lambda k: torus("1", "0.9375", "0.2", "2.9", "0.4", "1", "3", 120 * k),  # nearly a horn torus
    lambda k: torus("1", "0.015625", "1.5", "1.5", "0.02", "1", "0.25", 60 * k),  # a thin ring
    lambda k: torus("1", "0.015625", "1.5", "0.1", "1", "0.5", "0.5", 120 * k),
    lambda k: torus("1024", "256", "4", "5", "-1", "0.3", "-1500", 40 * k),  # millimetres
    lambda k: ellipsoid(("1", "1.5", "2"), "0.5", "0.25", ("1", "2", "-1"), "3", 30 * k),
    lambda k: ellipsoid(("0.45", "0.4", "0.9"), "-0.75", "1.25", ("0.3", "1", "1"), "-2", 50 * k),
    lambda k: ellipsoid(("1", "1", "1"), "0.25", "-0.5", ("1", "0", "2"), "3.125", 30 * k),  # a sphere
    lambda k: ellipsoid(("1", "1", "0.125"), "0.5", "1.5", ("-1", "-1.5", "0.5"), "2.5", 500 * k),  # a disc, over its rim
    lambda k: ellipsoid(("0.0625", "0.0625", "1"), "1", "0.25", ("1", "0.5", "0.25"), "0.5", 80 * k),  # a needle
    lambda k: ellipsoid(("0.125", "1", "4"), "1.5", "0.5", ("0", "1", "3"), "5", 1500 * k),
    lambda k: ellipsoid(("128", "64", "320"), "-0.5", "0.5", ("1", "-1", "1"), "400", 60 * k),  # millimetres
    lambda k: ellipsoid(("1", "1.25", "1.5"), "0", "0", ("1", "0", "0"), "2", 30 * k),  # along a principal ellipse
]

print("# Geodesics and their Jacobi fields. Generator: make_geodesics.py (python3, decimal, 60 digits), 2026-11-22.")
print("# kind, three dimensions (torus: R r 0), P, t_P, length, Q, t_Q, a, a', r, r'")
for case in CASES:
    coarse, fine = case(2), case(3)
    size = max(abs(x) for x in fine[1:])
    for a, b in zip(coarse[1:], fine[1:]):
        assert abs(a - b) < D(10) ** -32 * size, (fine[0], fine[1:4], abs(a - b))
    print(fine[0], *["{:.30g}".format(+x) if x else "0" for x in fine[1:]])
