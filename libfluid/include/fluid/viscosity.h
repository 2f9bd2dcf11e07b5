// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "fluid/export.h"
#include "fluid/field.h"

namespace vesiflow::fluid {

/// Viscosity (or any other positive coefficient): a number, or a field at cell centres. A field is shared and not
/// copied: its owner may change the values between two update() calls of a solver.
///
/// Where an operator needs it between cell centres it takes the arithmetic mean of the 2 (faces) or 4 (edges) cells
/// around. At walls these include ghosts, which extend_to_ghosts() sets.
class VESIFLOW_FLUID_EXPORT Viscosity {
 public:
  Viscosity(double value) : value_(value) {}  ///< a number

  /// A field.
  /// \throws std::invalid_argument for a null pointer.
  Viscosity(std::shared_ptr<const Field<Cell>> field);
  /// The same for a field that its owner may change.
  Viscosity(std::shared_ptr<Field<Cell>> field) : Viscosity(std::shared_ptr<const Field<Cell>>(std::move(field))) {}

  bool is_constant() const { return field_ == nullptr; }  ///< whether it is a number

  /// The number, if it is constant.
  double value() const { return value_; }
  /// The field, if it is not.
  const Field<Cell>& field() const { return *field_; }

  /// Smallest and largest value.
  struct Range {
    double min,  ///< smallest value
        max;     ///< largest value
  };
  /// Smallest and largest value, ghosts included.
  /// \throws std::invalid_argument with value and place unless all are finite and > 0.
  Range checked_range() const;

 private:
  double value_ = 0.0;
  std::shared_ptr<const Field<Cell>> field_;
};

/// Sets all ghosts of a coefficient at cell centres: next to walls and mirrors the value of the cell inside, across a
/// periodic axis the cell of the other end.
VESIFLOW_FLUID_EXPORT void extend_to_ghosts(Field<Cell>& field);

/// Samples a function of position at the cell centres, and extends it to the ghosts.
VESIFLOW_FLUID_EXPORT std::shared_ptr<Field<Cell>> sample_viscosity(
    const Grid& grid, const std::function<double(const Vector3& position)>& function);

}  // namespace vesiflow::fluid
