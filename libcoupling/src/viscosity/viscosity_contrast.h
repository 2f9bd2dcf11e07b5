// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "coupling/indicator.h"
#include "coupling/simulation_parameters.h"
#include "fluid/field.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// The viscosity of the fluid where some vesicle holds another one than 1:
///   mu = 1 + sum_v (lambda_v - 1) I_v,
/// with one Indicator for the sum, and limited to the range of 1 and all lambda_v: the indicator passes beyond its values
/// near the membrane, and a viscosity must be positive.
class ViscosityContrast {
 public:
  /// Viscosity 1 everywhere, until the first update.
  ViscosityContrast(const SimulationParameters& parameters, const fluid::Grid& grid);

  /// The field, ghosts set: shared with the fluid, which reads it in every step.
  const std::shared_ptr<fluid::Field<fluid::Cell>>& field() const { return field_; }

  /// add() every vesicle with its geometry as it is, then update() the field.
  void add(std::size_t vesicle, const vesicle::Surface& surface);
  void update();

  /// take_back() brings the field of the last remember() back, and forgets what has been added since the last update().
  void remember();
  void take_back();
  /// Gives the memory of remember() back.
  void forget() { remembered_.reset(); }

 private:
  std::vector<double> ratios_;
  double least_ = 1.0, greatest_ = 1.0;
  Indicator indicator_;
  std::shared_ptr<fluid::Field<fluid::Cell>> field_;
  std::optional<fluid::Field<fluid::Cell>> remembered_;
};

}  // namespace vesiflow::coupling
