// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <utility>

#include "tautline/surfaces/surface_decorator.h"

namespace tautline::testing {

/** A surface as it is, whose heights and geodesics are counted. */
class CountingSurface final : public SurfaceDecorator<Surface, std::shared_ptr<const Surface>> {
public:
    explicit CountingSurface(std::shared_ptr<const Surface> base) : SurfaceDecorator(std::move(base)) {}

    long getNumHeights() const { return m_numHeights; }
    long getNumShots() const { return m_numShots; }

    double calcHeightAndNormal(const Vector3& p_S, Vector3& N_S) const override {
        ++m_numHeights;
        return getBase().calcHeightAndNormal(p_S, N_S);
    }
    SurfacePoint findSurfacePoint(const Vector3& p_S) const override { return getBase().findSurfacePoint(p_S); }
    SurfacePoint calcDisplacedPoint(const SurfacePoint& start, const Vector3& displacement_S) const override {
        return getBase().calcDisplacedPoint(start, displacement_S);
    }
    DarbouxFrame calcFrame(const SurfacePoint& point, const Vector3& direction_S) const override {
        return getBase().calcFrame(point, direction_S);
    }
    void shootGeodesic(const GeodesicStart& start, const ShootingOptions& options,
                       ShotGeodesic& geodesic) const override {
        ++m_numShots;
        getBase().shootGeodesic(start, options, geodesic);
    }

private:
    mutable long m_numHeights = 0, m_numShots = 0;
};

}  // namespace tautline::testing
