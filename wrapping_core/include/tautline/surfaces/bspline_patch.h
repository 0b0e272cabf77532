// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/patch_shape.h"

namespace tautline {

/** Bicubic tensor-product B-spline over equal cells of the domain: twice continuously differentiable, so
that curvature is continuous and geodesics have continuous third derivatives. */
class BSplinePatch final : public PatchShape<BSplinePatch> {
public:
    /** @param domain         finite and not empty; InvalidInput otherwise
    @param numU, numV      control points in each direction, at least 4: there are numU - 3 by numV - 3 cells
    @param controlPoints   3 x numU numV [m]; column i numV + j
    @param isHeightPatch   true if x = u and y = v
    @param normalSign      +1: outward is xu x xv (up, for a height patch); -1: the other side */
    BSplinePatch(const ParameterDomain& domain, int numU, int numV, const Eigen::Matrix3Xd& controlPoints,
                 bool isHeightPatch = false, double normalSign = 1);

    /** Through a grid of points at equal steps of u and v, ends included; the third derivative is continuous at the
    knots next to the edges, so that cubic data are reproduced.
    @param points   3 x numU numV, column i numV + j; numU, numV >= 4 */
    static BSplinePatch interpolate(const ParameterDomain& domain, int numU, int numV, const Eigen::Matrix3Xd& points,
                                    bool isHeightPatch = false, double normalSign = 1);

    /** Through heights z(i, j) at x = u_i, y = v_j. */
    static BSplinePatch interpolateHeights(const ParameterDomain& domain, const Eigen::MatrixXd& heights,
                                           double normalSign = 1);

    /** The height patch whose control points have these heights. @param heights   numU x numV [m] */
    static BSplinePatch makeHeightPatch(const ParameterDomain& domain, const Eigen::MatrixXd& heights,
                                        double normalSign = 1);

    int getNumU() const { return m_numU; }
    int getNumV() const { return m_numV; }
    const Eigen::Matrix3Xd& getControlPoints() const { return m_controlPoints; }
    std::string getDescription() const override;
    void calcPartials(const Vector2& uv, PatchPartials& partials) const;

    /** The four B-splines that live on the cell of a coordinate, with their first and second derivatives. */
    struct Basis {
        int first;                          ///< index of the first
        Eigen::Matrix<double, 3, 4> value;  ///< row k: k-th derivatives
    };
    static Basis calcBasis(double coordinate, double min, double max, int numControls);

private:
    int m_numU, m_numV;
    Eigen::Matrix3Xd m_controlPoints;
};

extern template class ParametricShape<BSplinePatch>;

}  // namespace tautline
