// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>

namespace vesiflow::coupling {

/// The evaluations allowed did not suffice.
class NoFixedPoint : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// Solves x = G(x) by the fixed-point iteration with Anderson acceleration (KINSOL of SUNDIALS): each iterate is the
/// combination of the last ones whose G(x) - x is smallest. Every solve starts afresh.
class FixedPoint {
 public:
  using Map = std::function<void(std::span<const double> x, std::span<double> result)>;

  struct Limits {
    double tolerance = 1e-6;  ///< largest change of an entry of x from one iterate to the next
    int evaluations = 100;    ///< most of G
  };

  virtual ~FixedPoint() = default;

  /// Replaces `x`, the first iterate, by the last. What G throws comes through, x is then lost.
  /// \throws NoFixedPoint, and std::domain_error for other failures of the solver
  virtual void solve(const Map& map, std::span<double> x) = 0;
};

/// For x of that size.
/// \throws std::invalid_argument in a build without SUNDIALS
std::unique_ptr<FixedPoint> make_fixed_point(std::size_t size, const FixedPoint::Limits& limits);

}  // namespace vesiflow::coupling
