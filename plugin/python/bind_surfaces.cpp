// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "bindings.h"
#include "parallel_work.h"
#include "tautline/surfaces/capsule.h"
#include "tautline/surfaces/cone.h"
#include "tautline/surfaces/cylinder.h"
#include "tautline/surfaces/ellipsoid.h"
#include "tautline/surfaces/elliptic_cylinder.h"
#include "tautline/surfaces/elliptic_torus.h"
#include "tautline/surfaces/function_surface.h"
#include "tautline/surfaces/half_space.h"
#include "tautline/surfaces/paraboloid.h"
#include "tautline/surfaces/sphere.h"
#include "tautline/surfaces/surface_laws.h"
#include "tautline/surfaces/torus.h"

namespace tautline::python {
namespace {

/** A Python function that Ctrl-C ends, between two calls. */
template <class Result, class Argument>
std::function<Result(Argument)> makeStoppable(std::function<Result(Argument)> function) {
    if (!function) return nullptr;
    return [function = std::move(function)](Argument argument) {
        throwIfStopped();
        return function(argument);
    };
}

/** A class of the library with its constructor. pybind11 holds surfaces as if they could be changed; nothing here does.
 */
template <class Shape, class... Arguments, class... Names>
void bindShape(py::module_& module, const char* name, const char* doc, Names... names) {
    py::class_<Shape, Surface, std::shared_ptr<Shape>>(module, name, doc).def(py::init<Arguments...>(), names...);
}

std::shared_ptr<ImplicitFunctionSurface> makeImplicit(const std::string& description, double size,
                                                      ImplicitFunctionSurface::ValueFunction value,
                                                      ImplicitFunctionSurface::GradientFunction gradient,
                                                      ImplicitFunctionSurface::HessianFunction hessian, bool isConvex) {
    auto surface = std::make_shared<ImplicitFunctionSurface>(description, size, makeStoppable(value),
                                                             makeStoppable(gradient), makeStoppable(hessian));
    surface->setConvex(isConvex);
    return surface;
}

std::shared_ptr<ParametricFunctionSurface> makeParametric(const std::string& description, double size,
                                                          const Vector2& min, const Vector2& max,
                                                          ParametricFunctionSurface::PositionFunction position,
                                                          double normalSign) {
    return std::make_shared<ParametricFunctionSurface>(ParametricFunctionSurface::fromPosition(
        description, size, ParameterDomain{min, max}, makeStoppable(position), normalSign));
}

/** Rows of points and directions as samples. */
std::vector<std::string> checkLaws(const Surface& surface, const Numbers& points, const Numbers& directions,
                                   double length) {
    requireShape(points, "points", {-1, 3});
    requireShape(directions, "directions", {points.shape(0), 3});
    std::vector<SurfaceLawSample> samples;
    for (py::ssize_t i = 0; i < points.shape(0); ++i)
        samples.push_back({Vector3(points.data(i, 0)), Vector3(directions.data(i, 0)), length});
    const py::gil_scoped_release released;
    return checkSurfaceLaws(surface, samples);
}

Numbers calcHeights(const Surface& surface, const Numbers& points) {
    requireShape(points, "points", {-1, 3});
    Numbers heights(points.shape(0));
    for (py::ssize_t i = 0; i < points.shape(0); ++i)
        *heights.mutable_data(i) = surface.calcHeight(Vector3(points.data(i, 0)));
    return heights;
}

}  // namespace

void bindSurfaces(py::module_& module) {
    py::class_<Surface, std::shared_ptr<Surface>>(module, "Surface",
                                                  "A smooth surface that paths wrap over, in its frame S.")
        .def_property_readonly("size", &Surface::getSize, "Characteristic length [m].")
        .def_property_readonly("description", &Surface::getDescription)
        .def_property_readonly("is_convex", &Surface::isConvex)
        .def("height", &calcHeights, py::arg("points"),
             "Signed heights [m] of points in S, (n, 3), to first order near the surface: positive outside. Returns "
             "(n,).")
        .def("check_laws", &checkLaws, py::arg("points"), py::arg("directions"), py::arg("length"),
             "Checks the invariants of a surface at points near it, (n, 3), with directions along it, (n, 3), and "
             "geodesics\n"
             "of a length [m]. Returns a sentence for each law that is broken: a wrong derivative by its entry.")
        .def("__repr__", [](const Surface& surface) { return "<tautline surface: " + surface.getDescription() + ">"; });

    using py::arg;
    bindShape<Cylinder, double>(module, "Cylinder", "A cylinder about the z axis without end. radius [m]",
                                arg("radius"));
    bindShape<Sphere, double>(module, "Sphere", "A sphere. radius [m]", arg("radius"));
    bindShape<Ellipsoid, const Vector3&>(module, "Ellipsoid", "An ellipsoid. semi_axes (3,) [m]", arg("semi_axes"));
    bindShape<Torus, double, double>(module, "Torus", "A ring about the z axis. ring_radius, tube_radius [m]",
                                     arg("ring_radius"), arg("tube_radius"));
    bindShape<EllipticTorus, double, double, double>(
        module, "EllipticTorus", "A ring about the z axis whose tube has an elliptic section. Lengths in m.",
        arg("ring_radius"), arg("radial_semi_axis"), arg("axial_semi_axis"));
    bindShape<EllipticCylinder, double, double>(module, "EllipticCylinder",
                                                "An elliptic cylinder about the z axis without end. Lengths in m.",
                                                arg("semi_axis_x"), arg("semi_axis_y"));
    bindShape<Paraboloid, double, double>(module, "Paraboloid", "z = x^2/a + y^2/b; paths run below it. a, b [m]",
                                          arg("a"), arg("b"));
    bindShape<HalfSpace, double>(
        module, "HalfSpace", "The half-space below the plane z = 0, outward along z. size: a length of the scene [m]",
        arg("size"));
    bindShape<Cone, double, double, double>(module, "Cone",
                                            "A cone about the z axis. half_angle [rad]; radius and edge_radius [m]",
                                            arg("half_angle"), arg("radius"), arg("edge_radius") = 0.0);
    bindShape<Capsule, double, double>(module, "Capsule", "A cylinder about the z axis with caps. radius, length [m]",
                                       arg("radius"), arg("length"));

    py::class_<ImplicitFunctionSurface, Surface, std::shared_ptr<ImplicitFunctionSurface>>(
        module, "ImplicitSurface",
        "A surface f(p) = 0 of your own, f > 0 outside. Each call takes Python's lock, so it is slow.")
        .def(py::init(&makeImplicit), arg("description"), arg("size"), arg("value"), arg("gradient") = py::none(),
             arg("hessian") = py::none(), arg("convex") = false,
             "description   for messages\n"
             "size          characteristic length [m]\n"
             "value         function of p, (3,) in S, that returns f\n"
             "gradient      that returns df/dp, (3,); None: differences\n"
             "hessian       that returns the second derivatives, (3, 3); None: differences\n"
             "convex        a promise that the solid is convex: some checks are then skipped");
    py::class_<ParametricFunctionSurface, Surface, std::shared_ptr<ParametricFunctionSurface>>(
        module, "ParametricSurface", "A surface x(u, v) of your own over a rectangle. Slow, like ImplicitSurface.")
        .def(py::init(&makeParametric), arg("description"), arg("size"), arg("min"), arg("max"), arg("position"),
             arg("normal_sign") = 1.0,
             "min, max      ends of the domain, (2,) each\n"
             "position      function of uv, (2,), that returns x, (3,) in S; defined a little beyond the domain\n"
             "normal_sign   1 if dx/du x dx/dv points outward, else -1");
}

}  // namespace tautline::python
