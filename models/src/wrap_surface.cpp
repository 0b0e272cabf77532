// SPDX-License-Identifier: Apache-2.0
#include "wrap_surface.h"

#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/elliptic_torus.h"
#include "tautline/surfaces/paraboloid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/torus.h"

namespace tautline::models {
namespace {

using SurfacePointer = std::shared_ptr<const Surface>;

/** What has been made already is as it is. */
struct MadeSurface {
    SurfacePointer operator()(const MeshShape& s) { return s.surface; }
    SurfacePointer operator()(const ExtensionShape& s) { return s.surface; }
};

struct ImplicitMaker : MadeSurface {
    using MadeSurface::operator();
    SurfacePointer operator()(const CylinderShape& s) { return std::make_shared<Cylinder>(s.radius); }
    SurfacePointer operator()(const SphereShape& s) { return std::make_shared<Sphere>(s.radius); }
    SurfacePointer operator()(const EllipsoidShape& s) { return std::make_shared<Ellipsoid>(s.semiAxes); }
    SurfacePointer operator()(const TorusShape& s) { return std::make_shared<Torus>(s.ringRadius, s.tubeRadius); }
    SurfacePointer operator()(const ParaboloidShape& s) { return std::make_shared<Paraboloid>(s.a, s.b); }
    SurfacePointer operator()(const EllipticTorusShape& s) {
        return std::make_shared<EllipticTorus>(s.ringRadius, s.radialSemiAxis, s.axialSemiAxis);
    }
};

struct ParametricMaker : MadeSurface {
    using MadeSurface::operator();
    SurfacePointer operator()(const CylinderShape& s) { return std::make_shared<ParametricCylinder>(s.radius); }
    SurfacePointer operator()(const SphereShape& s) { return std::make_shared<ParametricSphere>(s.radius); }
    SurfacePointer operator()(const EllipsoidShape& s) { return std::make_shared<ParametricEllipsoid>(s.semiAxes); }
    SurfacePointer operator()(const TorusShape& s) {
        return std::make_shared<ParametricTorus>(s.ringRadius, s.tubeRadius);
    }
    SurfacePointer operator()(const ParaboloidShape& s) { return std::make_shared<ParametricParaboloid>(s.a, s.b); }
    SurfacePointer operator()(const EllipticTorusShape& s) {
        return std::make_shared<ParametricEllipticTorus>(s.ringRadius, s.radialSemiAxis, s.axialSemiAxis);
    }
};

}  // namespace

std::shared_ptr<const Surface> makeSurface(const WrapObject& object) {
    return object.form == SurfaceForm::Parametric ? std::visit(ParametricMaker(), object.shape)
                                                  : std::visit(ImplicitMaker(), object.shape);
}

}  // namespace tautline::models
