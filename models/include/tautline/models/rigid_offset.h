#pragma once
#include <array>

namespace tautline::models {

using Triple = std::array<double, 3>;

/** The pose of a frame F in a frame B: a point with coordinates p_F has R p_F + translation in B.
 */
struct RigidOffset {
    /** R_BF, row by row. */
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
    Triple translation{};
};

/** Rotation by body-fixed x-y-z angles, R = Rx(angles[0]) Ry(angles[1]) Rz(angles[2]). */
RigidOffset makeRigidOffset(const Triple& translation, const Triple& bodyFixedXyz);

/** The pose X_BC of a frame C that stands at X_FC in a frame F, which stands at X_BF in B. */
RigidOffset compose(const RigidOffset& X_BF, const RigidOffset& X_FC);

/** The coordinates in B of a point given in F. */
Triple transformPoint(const RigidOffset& X_BF, const Triple& point_F);

}  // namespace tautline::models
