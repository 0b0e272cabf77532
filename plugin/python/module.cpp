// SPDX-License-Identifier: Apache-2.0
/** The Python module tautline._tautline; plugin/python/tautline/__init__.py is what users see. */
#include "bindings.h"
#include "tautline/models/model_error.h"
#include "tautline/version.h"

PYBIND11_MODULE(_tautline, module) {
    namespace py = pybind11;
    module.attr("__version__") = TAUTLINE_VERSION;
    py::register_exception<tautline::InvalidInput>(module, "InvalidInput", PyExc_ValueError).doc() =
        "Bad input: the message names the value, the thing and the limit.";
    py::register_exception<tautline::models::ModelError>(module, "ModelError", PyExc_ValueError).doc() =
        "A model file that cannot be read or built: the message names file, line and element.";
    tautline::python::bindSurfaces(module);
    tautline::python::bindPaths(module);
    tautline::python::bindModels(module);
}
