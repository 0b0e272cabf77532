#include "tautline/models/rigid_offset.h"

#include <cmath>

namespace tautline::models {

RigidOffset makeRigidOffset(const Triple& translation, const Triple& bodyFixedXyz) {
    const double cx = std::cos(bodyFixedXyz[0]), sx = std::sin(bodyFixedXyz[0]);
    const double cy = std::cos(bodyFixedXyz[1]), sy = std::sin(bodyFixedXyz[1]);
    const double cz = std::cos(bodyFixedXyz[2]), sz = std::sin(bodyFixedXyz[2]);
    RigidOffset offset;
    offset.rotation = {cy * cz,
                       -cy * sz,
                       sy,
                       cx * sz + sx * sy * cz,
                       cx * cz - sx * sy * sz,
                       -sx * cy,
                       sx * sz - cx * sy * cz,
                       sx * cz + cx * sy * sz,
                       cx * cy};
    offset.translation = translation;
    return offset;
}

RigidOffset compose(const RigidOffset& X_BF, const RigidOffset& X_FC) {
    RigidOffset X_BC;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            double sum = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                sum += X_BF.rotation[3 * row + k] * X_FC.rotation[3 * k + column];
            }
            X_BC.rotation[3 * row + column] = sum;
        }
    }
    X_BC.translation = transformPoint(X_BF, X_FC.translation);
    return X_BC;
}

Triple transformPoint(const RigidOffset& X_BF, const Triple& point_F) {
    Triple point_B = X_BF.translation;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t k = 0; k < 3; ++k) point_B[row] += X_BF.rotation[3 * row + k] * point_F[k];
    }
    return point_B;
}

}  // namespace tautline::models
