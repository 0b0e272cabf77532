// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Vectors, matrices and rigid poses shared by the whole core. Nothing here computes wrapping. */
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace tautline {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kPi = 3.14159265358979323846;

/** Rigid pose X_FG of frame G in frame F: p_F = R * p_G + p. Products with one vector are written out: Eigen's are
calls at -O2, and a warm step of a path makes many of them. */
struct Pose {
    Mat3 R = Mat3::Identity();
    Vec3 p = Vec3::Zero();

    Pose() = default;
    Pose(const Mat3& rotation, const Vec3& translation) : R(rotation), p(translation) {}
    explicit Pose(const Vec3& translation) : p(translation) {}

    Vec3 operator*(const Vec3& point) const { return rotate(point) + p; }
    Pose operator*(const Pose& other) const { return {R * other.R, R * other.p + p}; }
    Vec3 shiftBack(const Vec3& point) const { return rotateBack(point - p); }

    /** A direction, from G to F and from F to G. */
    Vec3 rotate(const Vec3& v) const { return v.x() * R.col(0) + v.y() * R.col(1) + v.z() * R.col(2); }
    Vec3 rotateBack(const Vec3& v) const { return {R.col(0).dot(v), R.col(1).dot(v), R.col(2).dot(v)}; }
};

/** Angular velocity and velocity of a frame's origin, both in ground: w [rad/s], v [m/s]. */
struct SpatialVelocity {
    Vec3 w = Vec3::Zero();
    Vec3 v = Vec3::Zero();
};

/** Velocity of the material point of frame E that is at a ground point. */
inline Vec3 calcStationVelocity(const Pose& X_GE, const SpatialVelocity& V_GE, const Vec3& point_G) {
    return V_GE.v + V_GE.w.cross(point_G - X_GE.p);
}

/** A force and its moment about a frame's origin, both in ground: moment [N m], force [N]. */
struct SpatialForce {
    Vec3 moment = Vec3::Zero();
    Vec3 force = Vec3::Zero();
};

}  // namespace tautline
