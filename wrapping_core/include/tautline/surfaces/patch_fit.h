// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Least-squares fits of patches to clouds of points (thesis Sec. 3.5, Fig. 3.9). */
#include "tautline/surfaces/bspline_patch.h"
#include "tautline/surfaces/fit_report.h"
#include "tautline/surfaces/polynomial_patch.h"

namespace tautline {

/** Which terms u^i v^j a polynomial has. */
enum class PolynomialTerms {
    Tensor,       ///< i <= n and j <= m
    TotalDegree,  ///< i + j <= max(n, m), i <= n, j <= m
};

struct PolynomialFit {
    PolynomialPatch patch;
    FitReport report;
};
struct BSplineFit {
    BSplinePatch patch;
    FitReport report;
};

/** Fits x(u, v) to points with known surface coordinates.
@param uv, points   as many of each, at least as many as there are terms, and not all on a curve that one of the terms
                    misses; InvalidInput otherwise
@param domain       of the patch, such as findDomain(uv) */
PolynomialFit fitPolynomialPatch(const std::vector<Vector2>& uv, const std::vector<Vector3>& points, int orderU,
                                 int orderV, PolynomialTerms terms, const ParameterDomain& domain,
                                 double normalSign = 1);

/** Fits heights z(x, y): a height patch over the rectangle that holds all (x, y). */
PolynomialFit fitPolynomialHeights(const std::vector<Vector3>& points, int orderU, int orderV, PolynomialTerms terms,
                                   double normalSign = 1);

/** The same with B-splines of numU by numV control points (>= 4 each). Control points that the data leave open are
those of least norm. */
BSplineFit fitBSplinePatch(const std::vector<Vector2>& uv, const std::vector<Vector3>& points, int numU, int numV,
                           const ParameterDomain& domain, double normalSign = 1);
BSplineFit fitBSplineHeights(const std::vector<Vector3>& points, int numU, int numV, double normalSign = 1);

/** The same, with points left out that lie off the patch by more than 3.5 standard deviations, as the median of the
residuals tells them (Rousseeuw and Leroy, "Robust regression and outlier detection", 1987): the fit is repeated until
it has the points that it leaves. Less than half of the points may be outliers. The domain is that of the others.
@param kept   the numbers of the points that are left, to which the residuals belong; may be null */
PolynomialFit fitPolynomialHeightsRobustly(const std::vector<Vector3>& points, int orderU, int orderV,
                                           PolynomialTerms terms, std::vector<int>* kept = nullptr);
BSplineFit fitBSplineHeightsRobustly(const std::vector<Vector3>& points, int numU, int numV,
                                     std::vector<int>* kept = nullptr);

/** The rectangle that holds all coordinates. */
ParameterDomain findDomain(const std::vector<Vector2>& uv);

}  // namespace tautline
