/** The one place where the parametric shapes are instantiated: their headers declare it extern, so that a user's
code does not compile the integrator again for each. */
#include "tautline/elliptic_cylinder.h"
#include "tautline/elliptic_torus.h"
#include "tautline/paraboloid.h"
#include "tautline/parametric_cylinder.h"
#include "tautline/parametric_ellipsoid.h"
#include "tautline/parametric_sphere.h"
#include "tautline/parametric_torus.h"

namespace tautline {

template class ParametricShape<ParametricSphere>;
template class ParametricTwin<ParametricSphere, Sphere>;
template class ParametricShape<ParametricCylinder>;
template class ParametricTwin<ParametricCylinder, Cylinder>;
template class ParametricShape<ParametricEllipsoid>;
template class ParametricTwin<ParametricEllipsoid, Ellipsoid>;
template class ParametricShape<ParametricTorus>;
template class ParametricTwin<ParametricTorus, Torus>;
template class ParametricShape<ParametricEllipticCylinder>;
template class ParametricTwin<ParametricEllipticCylinder, EllipticCylinder>;
template class ParametricShape<ParametricEllipticTorus>;
template class ParametricTwin<ParametricEllipticTorus, EllipticTorus>;
template class ParametricShape<ParametricParaboloid>;
template class ParametricTwin<ParametricParaboloid, Paraboloid>;

}  // namespace tautline
