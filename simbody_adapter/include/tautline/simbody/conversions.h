// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Between SimTK's types and the core's: plain copies, no computing. */
#include <SimTKcommon.h>

#include "tautline/types.h"

namespace tautline {

inline Vector3 toEigen(const SimTK::Vec3& v) {
    return {v[0], v[1], v[2]};
}
inline SimTK::Vec3 toSimTK(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}

inline Matrix3 toEigen(const SimTK::Mat33& m) {
    Matrix3 result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result(i, j) = m(i, j);
    return result;
}
inline SimTK::Mat33 toSimTK(const Matrix3& m) {
    SimTK::Mat33 result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result(i, j) = m(i, j);
    return result;
}

inline Pose toPose(const SimTK::Transform& X) {
    return {toEigen(X.R().asMat33()), toEigen(X.p())};
}
/** The rotation matrix is taken as it is: no re-orthogonalization. */
inline SimTK::Transform toTransform(const Pose& X) {
    return {SimTK::Rotation(toSimTK(X.R), true), toSimTK(X.p)};
}

/** A SpatialVec of velocities is (angular, linear), of forces (moment, force). */
inline SpatialVelocity toSpatialVelocity(const SimTK::SpatialVec& V) {
    return {toEigen(V[0]), toEigen(V[1])};
}
inline SimTK::SpatialVec toSpatialVec(const SpatialVelocity& V) {
    return {toSimTK(V.w), toSimTK(V.v)};
}
inline SpatialForce toSpatialForce(const SimTK::SpatialVec& F) {
    return {toEigen(F[0]), toEigen(F[1])};
}
inline SimTK::SpatialVec toSpatialVec(const SpatialForce& F) {
    return {toSimTK(F.moment), toSimTK(F.force)};
}

}  // namespace tautline
