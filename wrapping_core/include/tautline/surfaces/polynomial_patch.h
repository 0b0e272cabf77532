// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/patch_shape.h"

namespace tautline {

/** Polynomial patch of orders n in u and m in v (thesis Eqn. 3.71) in scaled coordinates that run from -1 to 1
over the domain, so that high orders stay well conditioned. */
class PolynomialPatch final : public PatchShape<PolynomialPatch> {
public:
    static constexpr int kMaxOrder = 20;

    /** @param domain         finite and not empty; InvalidInput otherwise
    @param orderU, orderV  n, m in [1, kMaxOrder]
    @param coefficients    3 x (n + 1)(m + 1) [m]: column i (m + 1) + j multiplies (scaled u)^i (scaled v)^j
    @param isHeightPatch   true if x = u and y = v
    @param normalSign      +1: outward is xu x xv (up, for a height patch); -1: the other side */
    PolynomialPatch(const ParameterDomain& domain, int orderU, int orderV, const Eigen::Matrix3Xd& coefficients,
                    bool isHeightPatch = false, double normalSign = 1);

    /** The height patch z = sum of p_ij u^i v^j, in plain u = x and v = y.
    @param p   (n + 1) x (m + 1), n, m >= 1 */
    static PolynomialPatch makeHeightPatch(const ParameterDomain& domain, const Eigen::MatrixXd& p,
                                           double normalSign = 1);

    /** The same in scaled u and v, as the constructor has them, which keeps the digits of high orders. */
    static PolynomialPatch makeScaledHeightPatch(const ParameterDomain& domain, const Eigen::MatrixXd& p,
                                                 double normalSign = 1);

    int getOrderU() const { return m_orderU; }
    int getOrderV() const { return m_orderV; }
    const Eigen::Matrix3Xd& getCoefficients() const { return m_coefficients; }
    std::string getDescription() const override;
    void calcPartials(const Vector2& uv, PatchPartials& partials) const;

private:
    int m_orderU, m_orderV;
    Eigen::Matrix3Xd m_coefficients;
    Vector2 m_middle, m_inverseHalf;
};

extern template class ParametricShape<PolynomialPatch>;

}  // namespace tautline
