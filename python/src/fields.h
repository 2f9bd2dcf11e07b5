// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Fields of the staggered grid as arrays that are indexed [i, j, k], x first.
#pragma once

#include <algorithm>
#include <memory>

#include "arrays.h"
#include "fluid/field.h"

namespace vesiflow::python {

/// The points of a field, ghosts left out, without copying.
inline py::array read_only_view(const fluid::ConstView& points, py::handle owner) {
  constexpr py::ssize_t word = sizeof(double);
  return read_only_view(points.data, {points.extent[0], points.extent[1], points.extent[2]},
                        {word, word * points.row_stride, word * points.plane_stride}, owner);
}
inline py::tuple read_only_view(const fluid::FaceVector& u, py::handle owner) {
  return py::make_tuple(read_only_view(u.x.points(), owner), read_only_view(u.y.points(), owner),
                        read_only_view(u.z.points(), owner));
}

/// Copies the values of an array to a view of the same shape.
/// \throws std::invalid_argument for another shape.
inline void copy_to(const Columns& values, const fluid::View& to, const char* name) {
  if (values.ndim() != 3 || values.shape(0) != to.extent[0] || values.shape(1) != to.extent[1] ||
      values.shape(2) != to.extent[2])
    throw std::invalid_argument(std::string(name) + " has the shape " + shape_of(values) + "; it must be (" +
                                std::to_string(to.extent[0]) + ", " + std::to_string(to.extent[1]) + ", " +
                                std::to_string(to.extent[2]) + ")");
  const double* from = values.data();
  for (int k = 0; k < to.extent[2]; ++k)
    for (int j = 0; j < to.extent[1]; ++j, from += to.extent[0]) std::copy_n(from, to.extent[0], to.row(j, k));
}

/// Three numbers that a function of Python has returned.
/// \throws pybind11::type_error for anything else.
inline fluid::Vector3 vector_of(py::handle value, const char* what) {
  const py::sequence sequence = py::reinterpret_borrow<py::sequence>(value);
  if (!PySequence_Check(value.ptr()) || py::len(sequence) != 3)
    throw py::type_error(std::string(what) + " must return three numbers, and has returned " +
                         py::repr(value).cast<std::string>());
  return {sequence[0].cast<double>(), sequence[1].cast<double>(), sequence[2].cast<double>()};
}

/// Calls a function of Python from any thread. Its last copy may go in a thread that does not hold the lock of the interpreter.
class Callback {
 public:
  explicit Callback(py::function function)
      : function_(new py::function(std::move(function)), [](py::function* owned) {
          const py::gil_scoped_acquire lock;
          delete owned;
        }) {}
  /// To be called with the lock held.
  const py::function& function() const { return *function_; }

 private:
  std::shared_ptr<py::function> function_;
};

/// u(x, t) as the libraries call it.
class VectorCallback {
 public:
  VectorCallback(py::function function, const char* what) : callback_(std::move(function)), what_(what) {}
  fluid::Vector3 operator()(const fluid::Vector3& x, double time) const {
    const py::gil_scoped_acquire lock;
    return vector_of(callback_.function()(py::make_tuple(x[0], x[1], x[2]), time), what_);
  }

 private:
  Callback callback_;
  const char* what_;
};

}  // namespace vesiflow::python
