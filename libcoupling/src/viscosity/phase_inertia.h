// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fluid/field.h"
#include "fluid/navier_stokes.h"
#include "transfer/sharp_transfer.h"
#include "viscosity/inside_points.h"

namespace vesiflow::coupling {

/// Inertia of two phases between sharp membranes, as a force on a fluid that is solved for w = mu u with one viscosity
/// and one acceleration.
///
/// In each phase Re Du/Dt = -grad p + Lap w, so that the term in dw/dt is Re outside of the membranes and Re/ratio
/// inside. The solver has Re_s dw/dt everywhere, with w as the grid has it: at each time of the phase that a point was in
/// then. The force is that less what the two phases ask for,
///     f = Re_s (c0 w^(k+1) + c1 w^k + c2 w^(k-1)) - (1 - theta) Re A(outer w, 1) - theta Re/ratio A(inner w, ratio),
///     A(w, mu) = c0 w^(k+1) + c1 w^k + c2 w^(k-1) + N(w)/mu,
/// with the coefficients c of the solver's time differences and N extrapolated, each phase continued across the membrane
/// at each of its times by the jumps that the membrane had then, and theta the smooth step of SharpTransfer. Where
/// w^(k+1) does not cancel, its extrapolation in the phase that the point is in now is taken. docs/jump_conditions.md.
class PhaseInertia {
 public:
  struct Body {
    const SharpTransfer* sharp;  ///< with the present membrane's bands
    double ratio;                ///< of viscosities, inside over outside
  };

  /// How much further than others the bands must reach, in spacings: continued fields are differenced one point beyond
  /// the membrane's blending zone, to which it has moved in two steps.
  static constexpr double more_reach = 1.5;

  /// Re_s: no phase has more than twice its acceleration.
  static double solved_reynolds_number(double reynolds_number, double least_ratio);

  /// \param bodies at least one; their transfers live longer than this
  PhaseInertia(const fluid::Grid& grid, double reynolds_number, std::vector<Body> bodies, bool convects);

  /// Starts from a velocity u of the fluid that no step has made.
  void begin(const fluid::FaceVector& velocity);

  /// Forms the part of the force that a step of length dt from the fluid's state has, whatever it leads to. Returns a,
  /// the factor of w in the solver's acceleration.
  double prepare(const fluid::NavierStokes& fluid, double dt);
  /// Adds the force for the present jumps.
  void add_to(fluid::FaceVector& density) const;

  /// Keeps the phases of a step's end: w, of which the bodies know the jumps.
  void keep(const fluid::FaceVector& velocity);
  /// The present time is what take_back() goes back to, over one keep() at most.
  void remember() { remembered_ = now_; }
  void take_back() { now_ = remembered_; }

  /// Outer and inner w of the present time, then of the one before.
  std::vector<fluid::FaceVector> state() const;
  /// \throws std::invalid_argument unless there are four on this grid, finite
  void restore(const std::vector<fluid::FaceVector>& state, const fluid::NavierStokes& fluid);

 private:
  struct Level {
    Level(const fluid::Grid& grid, bool convects);
    fluid::FaceVector outer, inner;
    std::vector<fluid::FaceVector> convection;  // of both, if any
  };
  struct Coefficients {
    double c0, c1, c2, r;
  };

  /// The part of the force at a point of one component; arrays begin at the point (0, 0, 0).
  struct ForceAt {
    Coefficients c;
    double reynolds_number, solved;
    const double *velocity, *before;  // of the solver
    const double *outer, *inner, *outer_before, *inner_before;
    const double *outer_convection = nullptr, *inner_convection = nullptr;
    const double *outer_convection_before = nullptr, *inner_convection_before = nullptr;
    double operator()(std::ptrdiff_t at, bool inside, double theta, double ratio) const;
  };

  static void convect(Level& level);
  ForceAt force_at(int component, const fluid::NavierStokes& fluid) const;

  fluid::Grid grid_;
  std::vector<Body> bodies_;
  double reynolds_number_, solved_;
  std::array<Level, 3> levels_;           // in turn
  std::size_t now_ = 0, remembered_ = 0;  // of them; the one of the time before is (now_ + 2) % 3
  Coefficients c_{};
  fluid::FaceVector explicit_;
  InsidePoints inside_;
};

}  // namespace vesiflow::coupling
