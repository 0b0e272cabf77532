// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Vectors, matrices and rigid poses shared by the whole core. Nothing here computes wrapping. */
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace tautline {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;
using Matrix3 = Eigen::Matrix3d;
using Matrix4 = Eigen::Matrix4d;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kPi = 3.14159265358979323846;

/** Rigid pose X_FG of frame G in frame F: p_F = R * p_G + p. Products with one vector are written out: Eigen's are
calls at -O2, and a warm step of a path makes many of them. */
struct Pose {
    Matrix3 R = Matrix3::Identity();
    Vector3 p = Vector3::Zero();

    Pose() = default;
    Pose(const Matrix3& rotation, const Vector3& translation) : R(rotation), p(translation) {}
    explicit Pose(const Vector3& translation) : p(translation) {}

    Vector3 operator*(const Vector3& point) const { return rotate(point) + p; }
    Pose operator*(const Pose& other) const { return {R * other.R, R * other.p + p}; }
    Vector3 shiftBack(const Vector3& point) const { return rotateBack(point - p); }

    /** A direction, from G to F and from F to G. */
    Vector3 rotate(const Vector3& v) const { return v.x() * R.col(0) + v.y() * R.col(1) + v.z() * R.col(2); }
    Vector3 rotateBack(const Vector3& v) const { return {R.col(0).dot(v), R.col(1).dot(v), R.col(2).dot(v)}; }
};

/** Angular velocity and velocity of a frame's origin, both in ground: w [rad/s], v [m/s]. */
struct SpatialVelocity {
    Vector3 w = Vector3::Zero();
    Vector3 v = Vector3::Zero();
};

/** Velocity of the material point of frame E that is at a ground point. */
inline Vector3 calcStationVelocity(const Pose& X_GE, const SpatialVelocity& V_GE, const Vector3& point_G) {
    return V_GE.v + V_GE.w.cross(point_G - X_GE.p);
}

/** A force and its moment about a frame's origin, both in ground: moment [N m], force [N]. */
struct SpatialForce {
    Vector3 moment = Vector3::Zero();
    Vector3 force = Vector3::Zero();
};

}  // namespace tautline
