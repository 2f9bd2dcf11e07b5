// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Between NumPy's arrays and those of the libraries: views that copy nothing, and copies.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace vesiflow::python {

namespace py = pybind11;

using Columns = py::array_t<double, py::array::f_style | py::array::forcecast>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// An array over memory of `owner`, which lives as long as the array does. It can only be read: what it shows is the library's.
inline py::array read_only_view(const double* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                                py::handle owner) {
  py::array view(py::dtype::of<double>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

/// The same of an array of Eigen: one value (markers) or one vector (markers, 3) per marker.
template <class Array>
py::array read_only_view(const Array& array, py::handle owner) {
  constexpr py::ssize_t word = sizeof(double);
  if constexpr (Array::ColsAtCompileTime == 1) {
    return read_only_view(array.data(), {array.rows()}, {word}, owner);
  } else {
    return read_only_view(array.data(), {array.rows(), array.cols()}, {word, word * array.rows()}, owner);
  }
}

/// A new array with the values of one of Eigen.
template <class Array>
py::array copy_of(const Array& array) {
  if constexpr (Array::ColsAtCompileTime == 1) {
    py::array_t<double> copy(array.rows());
    Eigen::Map<Eigen::ArrayXd>(copy.mutable_data(), array.rows()) = array;
    return copy;
  } else {
    Columns copy({array.rows(), array.cols()});
    Eigen::Map<Eigen::ArrayXXd>(copy.mutable_data(), array.rows(), array.cols()) = array;
    return copy;
  }
}

inline std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t d = 0; d < array.ndim(); ++d) text += (d > 0 ? ", " : "") + std::to_string(array.shape(d));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// One vector per row.
/// \throws std::invalid_argument unless the shape is (any, 3).
inline Eigen::Array<double, Eigen::Dynamic, 3> vectors_of(const Columns& array, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw std::invalid_argument(std::string(name) + " has the shape " + shape_of(array) + "; it must be (markers, 3)");
  return Eigen::Map<const Eigen::Array<double, Eigen::Dynamic, 3>>(array.data(), array.shape(0), 3);
}

/// One number per entry.
/// \throws std::invalid_argument unless the array has one axis.
inline Eigen::ArrayXd numbers_of(const Numbers& array, const char* name) {
  if (array.ndim() != 1)
    throw std::invalid_argument(std::string(name) + " has the shape " + shape_of(array) + "; it must be (markers,)");
  return Eigen::Map<const Eigen::ArrayXd>(array.data(), array.shape(0));
}

}  // namespace vesiflow::python
