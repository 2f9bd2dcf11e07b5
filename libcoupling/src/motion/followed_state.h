// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "motion/bdf2.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// State y = (X, s) of a membrane whose mesh follows its shape, and the last step to it: positions X (markers, 3)
/// and, where there is tension, the strain s = ln(dA/dA0), as columns of one array.
///
/// The positions are the membrane's, and are taken from it where a run starts or goes on; strain and last increment
/// are a history that goes with them.
class FollowedState {
 public:
  using Fields = Eigen::ArrayXXd;

  FollowedState(Eigen::Index markers, bool has_strain);

  bool has_strain() const { return now_.cols() > 3; }
  int fields() const { return static_cast<int>(now_.cols()); }
  /// Whether all of the state is known, or its strain only, of a history.
  bool is_known() const { return knows_positions_; }
  bool knows_strain() const { return knows_strain_; }

  const Fields& now() const { return now_; }                        ///< y^k
  const Fields& last_increment() const { return last_increment_; }  ///< d^k
  double last_dt() const { return last_dt_; }                       ///< of the step that made it; 0 if there is none
  Bdf2 scheme(double dt) const { return Bdf2::of(dt, last_dt_); }
  /// y* = y^k + r d^k, of the shape of y.
  void extrapolate(const Bdf2& scheme, Fields& y) const { y = now_ + scheme.ratio * last_increment_; }

  /// Sets what is not known: all of it, or the positions.
  void start(const vesicle::VectorField& positions, const vesicle::ScalarField& strain);
  void start(const vesicle::VectorField& positions);

  /// y^{k+1} = y^k + d.
  void advance(double dt, const Fields& increment);
  /// Adds a constant to the strain at the end of the last step.
  void shift_strain(double shift);

  /// y of columns as positions and strain; zero where there is none.
  static void split(const Fields& y, vesicle::VectorField& positions, vesicle::ScalarField& strain);

  /// What a continued run needs beside the positions: strain and last increment.
  std::span<const double> strain() const;
  std::span<const double> increment() const;
  void restore(double last_dt, std::span<const double> strain, std::span<const double> increment);
  void restart();

 private:
  Fields now_, last_increment_;
  double last_dt_ = 0.0;
  bool knows_positions_ = false, knows_strain_ = false;
};

}  // namespace vesiflow::coupling
