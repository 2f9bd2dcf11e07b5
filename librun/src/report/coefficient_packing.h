// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "report/real_coefficients.h"

namespace vesiflow::run {

/// How large the coefficients of a field are over all frames of a run, degree by degree: what its packing is chosen by.
class CoefficientExtent {
 public:
  /// The field is `components` columns from `first` on.
  CoefficientExtent(int first, int components) : first_(first), components_(components) {}

  void observe(const RealCoefficients& frame);

  int first() const { return first_; }
  int components() const { return components_; }
  int degrees() const { return static_cast<int>(largest_.size()); }
  /// Largest coefficient of degree n.
  double largest(int n) const { return largest_[static_cast<std::size_t>(n)]; }
  /// Root mean square over the unit sphere of all from degree n on, in the frame where that is largest.
  double tail(int n) const { return tail_[static_cast<std::size_t>(n)]; }

 private:
  int first_, components_;
  std::vector<double> largest_, tail_;
};

/// Coefficients as multiples of one quantum, in so many bytes as each degree needs in all frames: none, one or two for an integer (lowest
/// byte first), four for a float of the coefficient itself where two do not reach. Degrees from `widths.size()` on are zero.
///
/// Half of the squared error that is allowed goes to the degrees that are cut off, the other half to rounding: q^2/12 for each coefficient
/// that is kept.
class CoefficientPacking {
 public:
  /// \param tolerance error of the field, root mean square over the unit sphere, positive
  CoefficientPacking(const CoefficientExtent& extent, double tolerance);

  int degrees() const { return static_cast<int>(widths_.size()); }
  double quantum() const { return quantum_; }
  /// Bytes of each degree, a digit each.
  const std::string& widths() const { return widths_; }
  std::size_t bytes_per_frame() const;

  void append(const RealCoefficients& frame, std::vector<std::uint8_t>& bytes) const;
  /// What append() wrote, as so many degrees; the columns from first on are set.
  void unpack(std::span<const std::uint8_t> bytes, RealCoefficients& frame) const;

 private:
  int first_, components_;
  double quantum_;
  std::string widths_;
};

}  // namespace vesiflow::run
