// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "tautline/types.h"

namespace tautline {

/** A hole through a surface, as that of a ring. A flat disc about the origin of S spans it: an ellipse whose rim lies
inside the tube. */
class Hole {
public:
    /** Spanned by the disc rho < radius in the plane z = 0. */
    explicit Hole(double radius) : m_toUnitDisc(Matrix3::Identity() / radius) {}

    /** The hole of the surface under the linear map whose inverse is given. */
    Hole mappedBy(const Matrix3& inverse) const { return Hole(Matrix3(m_toUnitDisc * inverse)); }

    /** Unit normal of the disc. */
    Vector3 getAxis() const { return m_toUnitDisc.row(2).transpose().normalized(); }

    /** How often the segment A B passes the hole: 1 along the axis, -1 against it, else 0. */
    int countCrossings(const Vector3& A_S, const Vector3& B_S) const {
        const Vector3 a = m_toUnitDisc * A_S, b = m_toUnitDisc * B_S;
        const bool isAbove = a.z() > 0;
        if (isAbove == (b.z() > 0)) return 0;
        const Vector3 crossing = a + a.z() / (a.z() - b.z()) * (b - a);
        if (!(crossing.head<2>().squaredNorm() < 1)) return 0;
        return isAbove ? -1 : 1;
    }

    /** Whether a point lies over or under the disc, by less than half of its radius. */
    bool isBeside(const Vector3& p_S) const {
        const Vector3 p = m_toUnitDisc * p_S;
        return p.head<2>().squaredNorm() < 1 && std::abs(p.z()) < 0.5;
    }

    /** Where the straight line through A and B meets the plane of the disc; not finite if it runs along that. */
    Vector3 calcPlaneCrossing(const Vector3& A_S, const Vector3& B_S) const {
        const Vector3 axis = getAxis(), step = B_S - A_S;
        return A_S - axis.dot(A_S) / axis.dot(step) * step;
    }

private:
    explicit Hole(const Matrix3& toUnitDisc) : m_toUnitDisc(toUnitDisc) {}

    Matrix3 m_toUnitDisc;  ///< to coordinates in which the disc is rho < 1 in the plane z = 0
};

}  // namespace tautline
