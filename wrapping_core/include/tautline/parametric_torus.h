#pragma once
#include "tautline/elliptic_torus.h"
#include "tautline/torus.h"

namespace tautline {

/** Ring torus about the z axis of S in ring angle u and tube angle v (thesis Eqn. 3.69). */
class ParametricTorus final : public ParametricTwin<ParametricTorus, Torus> {
public:
    /** @param ringRadius   from the axis to the tube's centre [m]
    @param tubeRadius   [m]; 0 < tubeRadius < ringRadius, InvalidInput otherwise */
    ParametricTorus(double ringRadius, double tubeRadius) : ParametricTwin(Torus(ringRadius, tubeRadius)) {}

    ParametricValue calcParametric(const Vec2& uv, int) const {
        return ParametricEllipticTorus::calcTorus(uv, m_twin.getRingRadius(), m_twin.getTubeRadius(),
                                                  m_twin.getTubeRadius());
    }
    Vec2 calcNearbyParameters(const Vec3& p_S, int) const {
        return ParametricEllipticTorus::calcTorusParameters(p_S, m_twin.getRingRadius(), m_twin.getTubeRadius(),
                                                            m_twin.getTubeRadius());
    }
};

extern template class ParametricShape<ParametricTorus>;
extern template class ParametricTwin<ParametricTorus, Torus>;

}  // namespace tautline
