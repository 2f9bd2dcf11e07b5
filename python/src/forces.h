// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Functions of Python as forces on membranes and on the fluid.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "coupling/simulation.h"
#include "fields.h"
#include "vesicle/surface.h"

namespace vesiflow::python {

/// The surface that a force on a membrane is called with, for as long as the call lasts. Its arrays are copies, which stay.
class BorrowedSurface {
 public:
  explicit BorrowedSurface(const vesicle::Surface& surface) : surface_(&surface) {}
  void end() { surface_ = nullptr; }

  py::array field(const std::string& name) const {
    const vesicle::Surface& surface = here();
    if (name == "positions") return copy_of(surface.positions());
    if (name == "normal") return copy_of(surface.normal());
    if (name == "area_weight") return copy_of(surface.area_weight());
    if (name == "area_element") return copy_of(surface.area_element());
    if (name == "mean_curvature") return copy_of(surface.mean_curvature());
    if (name == "gaussian_curvature") return copy_of(surface.gaussian_curvature());
    throw std::invalid_argument("a surface has no field " + name);
  }
  double area() const { return here().area(); }
  double volume() const { return here().volume(); }

 private:
  const vesicle::Surface& here() const {
    if (surface_ == nullptr)
      throw std::runtime_error("the surface of a force can be read while the force is called only");
    return *surface_;
  }
  const vesicle::Surface* surface_;
};

inline coupling::MembraneForce membrane_force(py::function function) {
  return [callback = Callback(std::move(function))](double time, std::size_t vesicle, const vesicle::Surface& surface,
                                                    vesicle::VectorField& force) {
    const py::gil_scoped_acquire lock;
    const auto borrowed = std::make_shared<BorrowedSurface>(surface);
    struct End {
      BorrowedSurface& surface;
      ~End() { surface.end(); }
    } end{*borrowed};
    const py::object result = callback.function()(time, vesicle, borrowed);
    if (result.is_none()) return;
    const Columns values = Columns::ensure(result);
    if (!values) throw py::error_already_set();
    if (values.ndim() == 1 && values.shape(0) == 3) {  // the same at all markers
      for (int axis = 0; axis < 3; ++axis) force.col(axis) += values.data()[axis];
      return;
    }
    // No std::invalid_argument, which inside a step is a matter of the state.
    if (values.ndim() != 2 || values.shape(0) != force.rows() || values.shape(1) != 3)
      throw py::value_error("a force on a membrane has the shape " + shape_of(values) + "; it must be (" +
                            std::to_string(force.rows()) + ", 3) or (3,)");
    force += vectors_of(values, "a force on a membrane");
  };
}

/// A force on the fluid that is asked for once at each time, of all faces: a function of arrays of x, y and z, and t. The library asks for
/// each face by its position; where that lies on the grid along just one axis, it is a face normal to this.
class FaceForce {
 public:
  FaceForce(py::function function, const fluid::Grid& grid)
      : callback_(std::move(function)), grid_(grid), components_(3) {}

  fluid::Vector3 operator()(const fluid::Vector3& x, double time) {
    if (!(time == time_)) {
      const py::gil_scoped_acquire lock;
      for (std::size_t axis = 0; axis < 3; ++axis) evaluate(axis, time);
      time_ = time;
    }
    fluid::Vector3 force{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const double at = place(x, axis); std::abs(at - std::round(at)) < 0.25)
        force[axis] = components_[axis][index(x, axis)];
    return force;
  }

 private:
  // In units of the spacing, from the lower end.
  double place(const fluid::Vector3& x, std::size_t axis) const {
    return (x[axis] - grid_.lower[axis]) / grid_.spacing(static_cast<int>(axis));
  }
  std::size_t index(const fluid::Vector3& x, std::size_t normal) const {
    const auto extent = fluid::point_extent(grid_, fluid::face_centrings[normal]);
    std::size_t index = 0;
    for (std::size_t axis = 3; axis-- > 0;)
      index = index * static_cast<std::size_t>(extent[axis]) +
              static_cast<std::size_t>(std::lround(place(x, axis) - (axis == normal ? 0.0 : 0.5)));
    return index;
  }
  void evaluate(std::size_t normal, double time) {
    const fluid::Centring centring = fluid::face_centrings[normal];
    const auto extent = fluid::point_extent(grid_, centring);
    const std::array<py::ssize_t, 3> shape{extent[0], extent[1], extent[2]};
    std::vector<Columns> positions;
    for (int axis = 0; axis < 3; ++axis) positions.emplace_back(shape);
    std::size_t n = 0;
    for (int k = 0; k < extent[2]; ++k)
      for (int j = 0; j < extent[1]; ++j)
        for (int i = 0; i < extent[0]; ++i, ++n)
          for (std::size_t axis = 0; axis < 3; ++axis)
            positions[axis].mutable_data()[n] = fluid::point_position(grid_, centring, i, j, k)[axis];
    const py::object result = callback_.function()(positions[0], positions[1], positions[2], time);
    if (!PySequence_Check(result.ptr()) || py::len(result) != 3)
      throw py::type_error("a force on the fluid must return three arrays, and has returned " +
                           py::repr(result).cast<std::string>().substr(0, 200));
    const py::object component = py::reinterpret_borrow<py::sequence>(result)[normal];
    const py::object filled = py::module_::import("numpy").attr("broadcast_to")(component, shape);
    const Columns values = Columns::ensure(filled);
    if (!values) throw py::error_already_set();
    components_[normal].assign(values.data(), values.data() + values.size());
  }

  Callback callback_;
  fluid::Grid grid_;
  std::vector<std::vector<double>> components_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace vesiflow::python
