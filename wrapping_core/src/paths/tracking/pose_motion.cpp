// SPDX-License-Identifier: Apache-2.0
#include "paths/tracking/pose_motion.h"

#include <cmath>

namespace tautline {
namespace {

Matrix3 calcCrossMatrix(const Vector3& w) {
    Matrix3 result;
    result << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    return result;
}

/** What a unit of v comes to while its frame turns by w (the left Jacobian of the rotation). */
Matrix3 calcTranslationMatrix(const Vector3& w) {
    constexpr double kSmall = 1e-4;  // [rad]: the terms left out are below rounding
    const double angle = w.norm(), square = angle * angle;
    const double half = angle > 0 ? std::sin(0.5 * angle) / angle : 0.5;
    const double a = 2 * half * half;
    const double b = angle < kSmall ? 1.0 / 6 - square / 120 : (angle - std::sin(angle)) / (square * angle);
    const Matrix3 W = calcCrossMatrix(w);
    return Matrix3::Identity() + a * W + b * W * W;
}

Matrix3 calcRotation(const Vector3& w) {
    const double angle = w.norm();
    if (!(angle > 0)) return Matrix3::Identity();
    return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Pose invert(const Pose& X) {
    return {X.R.transpose(), -X.rotateBack(X.p)};
}

SpatialVelocity scale(const SpatialVelocity& V, double factor) {
    return {factor * V.w, factor * V.v};
}

}  // namespace

Pose calcScrew(const SpatialVelocity& displacement) {
    return {calcRotation(displacement.w), calcTranslationMatrix(displacement.w) * displacement.v};
}

SpatialVelocity calcScrewDisplacement(const Pose& X) {
    const Eigen::AngleAxisd turn(X.R);
    const Vector3 w = turn.angle() * turn.axis();
    // Regular for all turns below 2 pi; that of an AngleAxis is at most pi.
    return {w, calcTranslationMatrix(w).inverse() * X.p};
}

void PoseMotion::set(const PathPose& from, const std::vector<SpatialVelocity>& V_GE, double duration,
                     const PathPose& to) {
    m_to = &to;
    m_elements.resize(to.X_GE.size());
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        ElementMotion& element = m_elements[e];
        element.X_G0 = from.X_GE[e];
        element.foretold = {};
        if (!V_GE.empty())
            element.foretold = {duration * element.X_G0.rotateBack(V_GE[e].w),
                                duration * element.X_G0.rotateBack(V_GE[e].v)};
        element.rest = calcScrewDisplacement(invert(calcScrew(element.foretold)) * (invert(element.X_G0) * to.X_GE[e]));
    }
}

double PoseMotion::calcTurnBound(int a, int b) const {
    const ElementMotion &A = m_elements[a], &B = m_elements[b];
    const Vector3 relative = A.X_G0.rotate(A.foretold.w) - B.X_G0.rotate(B.foretold.w);
    return relative.norm() + A.rest.w.norm() + B.rest.w.norm();
}

void PoseMotion::calcPose(double share, PathPose& pose) const {
    pose = *m_to;
    if (share >= 1) return;
    for (std::size_t e = 0; e < m_elements.size(); ++e) {
        const ElementMotion& element = m_elements[e];
        pose.X_GE[e] = element.X_G0 * calcScrew(scale(element.foretold, share)) * calcScrew(scale(element.rest, share));
    }
}

}  // namespace tautline
