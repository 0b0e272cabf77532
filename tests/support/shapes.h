// SPDX-License-Identifier: Apache-2.0
#pragma once
/** The four shapes of the core at several proportions, random geodesics on them, and shooting as a value. */
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/random.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline::testing {

struct Shape {
    std::string name;  ///< of the test case: letters and digits
    std::shared_ptr<const Surface> surface;
    double extent = 1;  ///< half the box in which points are drawn [m]
};

inline void PrintTo(const Shape& shape, std::ostream* out) {
    *out << shape.surface->getDescription();
}

/** All four kinds, `scale` times as large as they stand here. */
inline std::vector<Shape> makeShapes(double scale = 1) {
    return {{"Sphere", std::make_shared<Sphere>(0.7 * scale), 0.8 * scale},
            {"Cylinder", std::make_shared<Cylinder>(0.35 * scale), 0.5 * scale},
            {"Ellipsoid", std::make_shared<Ellipsoid>(Vector3(0.5, 0.9, 1.4) * scale), 1.4 * scale},
            {"FlatEllipsoid", std::make_shared<Ellipsoid>(Vector3(1.0, 0.8, 0.2) * scale), 1.0 * scale},
            {"Torus", std::make_shared<Torus>(3.0 * scale, 1.0 * scale), 3.5 * scale},
            {"ThinTorus", std::make_shared<Torus>(0.5 * scale, 0.05 * scale), 0.5 * scale}};
}

/** A start anywhere on the shape, of length 0: its point and tangent are exact. */
inline GeodesicStart makeRandomStart(const Shape& shape, Random& random) {
    GeodesicStart start;
    start.point = shape.surface->findSurfacePoint(random.vector(shape.extent));
    const DarbouxFrame frame = shape.surface->calcFrame(start.point, random.unitVector());
    start.tangent = frame.t;
    return start;
}

inline ShotGeodesic shoot(const Surface& surface, GeodesicStart start, double length,
                          const ShootingOptions& options = {}) {
    ShotGeodesic geodesic;
    start.length = length;
    surface.shootGeodesic(start, options, geodesic);
    return geodesic;
}

/** Name of a parameterized case. */
inline std::string getShapeName(const ::testing::TestParamInfo<Shape>& info) {
    return info.param.name;
}

}  // namespace tautline::testing
