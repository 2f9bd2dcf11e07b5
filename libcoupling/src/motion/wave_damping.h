// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vesicle/coefficients.h"

namespace vesiflow::coupling {

/// Rate at which the highest degrees of positions and strain decay, as the fluid hardly feels them and they would
/// grow on the slip:
///   16 U/R (n/(p - 1))^8 for degree n of p, U being the speed at which the membrane is swept along.
class WaveDamping {
 public:
  WaveDamping(int degrees, double radius);

  void update(double speed);
  /// rates -= damping of y.
  void subtract_from(vesicle::Coefficients& rates, const vesicle::Coefficients& y) const;
  double operator[](int degree) const { return rates_[static_cast<std::size_t>(degree)]; }

 private:
  double radius_;
  std::vector<double> rates_;
};

}  // namespace vesiflow::coupling
