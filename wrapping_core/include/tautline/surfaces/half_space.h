// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tautline/surfaces/implicit_surface.h"
#include "tautline/surfaces/parametric_twin.h"

namespace tautline {

/** The half-space z <= 0 of S, as Simbody calls it; N = +z. Geodesics are straight. A taut string never presses on a
plane, so an obstacle of this shape only reports whether the path stays above it. */
class HalfSpace final : public ImplicitShape<HalfSpace> {
public:
    /** @param size   scale of lengths near the plane [m], positive; InvalidInput otherwise */
    explicit HalfSpace(double size);

    double getSize() const override { return m_size; }
    std::string getDescription() const override;
    bool isConvex() const override { return true; }

    DiagonalImplicitValue calcImplicit(const Vector3& p) const { return {p.z(), Vector3::UnitZ(), Vector3::Zero()}; }
    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override {
        N_S = Vector3::UnitZ();
        return p_S.z();
    }
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override { return {Vector3(p_S.x(), p_S.y(), 0)}; }
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override;
    /** Only a line parallel to the plane has critical points: all of its points are. */
    void findLineClearance(const Vector3& A_S, const Vector3& e_S, LineClearance& clearance) const override;
    double findLowestPoint(const Vector3& A_S, const Vector3& e_S, double length) const override;

private:
    double m_size;
};

extern template class ImplicitShape<HalfSpace>;

/** The same half-space with u = x, v = y. */
class ParametricHalfSpace final : public ParametricTwin<ParametricHalfSpace, HalfSpace> {
public:
    explicit ParametricHalfSpace(double size) : ParametricTwin(HalfSpace(size)) {}

    ParametricValue calcParametric(const Vector2& uv, int) const {
        return {{uv[0], uv[1], 0}, Vector3::UnitX(), Vector3::UnitY(),
                Vector3::Zero(),   Vector3::Zero(),  Vector3::Zero()};
    }
    Vector2 calcNearbyParameters(const Vector3& p_S, int) const { return p_S.head<2>(); }
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override {
        getTwin().shootGeodesic({resolve(start.point), start.tangent, start.length}, options, geodesic);
        geodesic.endPoint = calcCoordinates(geodesic.Q.x);
    }
};

extern template class ParametricShape<ParametricHalfSpace>;
extern template class ParametricTwin<ParametricHalfSpace, HalfSpace>;

}  // namespace tautline
