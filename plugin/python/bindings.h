// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <initializer_list>
#include <string>

#include "tautline/error.h"

namespace tautline::python {

namespace py = pybind11;
/** Numbers as numpy has them, converted and copied if need be. */
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/** @throws InvalidInput unless the array has this shape; -1 for any size */
inline void requireShape(const Numbers& array, const char* name, std::initializer_list<py::ssize_t> shape) {
    bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
    std::string wanted, found;
    int axis = 0;
    for (const py::ssize_t size : shape) {
        wanted += (axis ? ", " : "") + (size < 0 ? std::string("n") : std::to_string(size));
        fits = fits && (size < 0 || array.shape(axis) == size);
        ++axis;
    }
    for (py::ssize_t i = 0; i < array.ndim(); ++i) found += (i ? ", " : "") + std::to_string(array.shape(i));
    require(fits, name, " must have the shape (", wanted, "), but has (", found, ")");
}

/** An array of words, of the shape of nested lists of them. */
template <class Words>
py::object makeWords(const Words& words) {
    return py::module_::import("numpy").attr("array")(words, py::arg("dtype") = "str");
}

void bindSurfaces(py::module_& module);
void bindPaths(py::module_& module);
void bindModels(py::module_& module);

}  // namespace tautline::python
