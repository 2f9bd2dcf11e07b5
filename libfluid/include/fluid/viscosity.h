// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Viscosity (or any other positive coefficient): a number, or a field at cell centres.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "fluid/export.h"
#include "fluid/field.h"

namespace vesiflow::fluid {

// A field is shared and not copied: its owner may change the values between two update() calls of a solver.
//
// Where an operator needs it between cell centres it takes the arithmetic mean of the 2 (faces) or 4 (edges) cells
// around. At walls these include ghosts, which extend_to_ghosts() sets.
class VESIFLOW_FLUID_EXPORT Viscosity {
 public:
  Viscosity(double value) : value_(value) {}
  // Throws std::invalid_argument for a null pointer.
  Viscosity(std::shared_ptr<const Field<Cell>> field);
  Viscosity(std::shared_ptr<Field<Cell>> field) : Viscosity(std::shared_ptr<const Field<Cell>>(std::move(field))) {}

  bool is_constant() const { return field_ == nullptr; }
  // The number, if it is constant.
  double value() const { return value_; }
  // The field, if it is not.
  const Field<Cell>& field() const { return *field_; }

  struct Range {
    double min, max;
  };
  // Smallest and largest value, ghosts included. Throws std::invalid_argument, with value and place, unless all are
  // finite and > 0.
  Range checked_range() const;

 private:
  double value_ = 0.0;
  std::shared_ptr<const Field<Cell>> field_;
};

// Sets all ghosts of a coefficient at cell centres: next to walls and mirrors the value of the cell inside, across a
// periodic axis the cell of the other end.
VESIFLOW_FLUID_EXPORT void extend_to_ghosts(Field<Cell>& field);

// Samples a function of position at the cell centres, and extends it to the ghosts.
VESIFLOW_FLUID_EXPORT std::shared_ptr<Field<Cell>> sample_viscosity(
    const Grid& grid, const std::function<double(const Vector3& position)>& function);

}  // namespace vesiflow::fluid
