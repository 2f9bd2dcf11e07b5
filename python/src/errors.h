// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Exceptions of the libraries as those of vesiflow.errors.
#pragma once

#include <pybind11/pybind11.h>

namespace vesiflow::python {

/// Makes an exception of vesiflow/errors.py the one that Python sees.
template <class... Arguments>
void set_error(const char* name, Arguments&&... arguments) {
  namespace py = pybind11;
  const py::object type = py::module_::import("vesiflow.errors").attr(name);
  const py::object error = type(std::forward<Arguments>(arguments)...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace vesiflow::python
