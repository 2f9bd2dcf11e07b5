// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fluid/field.h"
#include "fluid/navier_stokes.h"
#include "transfer/sharp_transfer.h"
#include "viscosity/inner_phase.h"
#include "viscosity/inside_points.h"

namespace vesiflow::coupling {

/// Inertia of two phases between sharp membranes, as a force on a fluid that is solved for w = mu u with one viscosity
/// and one acceleration.
///
/// In each phase Re Du/Dt = -grad p + Lap w, so that the term in dw/dt is Re outside of the membranes and Re/ratio
/// inside. The solver has Re_s dw/dt everywhere, with w as the grid has it: at each time of the phase that a point was in
/// then. The force is that less what the two phases ask for,
///     f = Re_s (c0 w^(k+1) + c1 w^k + c2 w^(k-1)) - (1 - sum theta_b) Re A(outer w, 1) - sum theta_b Re/ratio_b A(w of b, ratio_b),
///     A(w, mu) = c0 w^(k+1) + c1 w^k + c2 w^(k-1) + N(w)/mu,
/// with the coefficients c of the solver's time differences and N extrapolated, each phase continued across the membranes
/// at each of its times by the jumps that they had then, and theta_b a smooth step at body b, 1 inside of it. Each body
/// has an inside of its own: next to several, a point is reached by the continuations of all. Where w^(k+1) does
/// not cancel, its extrapolation in the phase that the point is in now is taken. docs/jump_conditions.md.
class PhaseInertia {
 public:
  struct Body {
    const SharpTransfer* sharp;  ///< with the present membrane's bands
    double ratio;                ///< of viscosities, inside over outside
  };

  /// How much further than others the bands must reach, in spacings: continued fields are differenced one point beyond
  /// the membrane's blending zone, to which it has moved in two steps.
  static constexpr double more_reach = 1.5;

  /// Width of theta over that of the step that forces of SharpTransfer have. The jump D of a transfer obeys Lap D = grad
  /// [p], without the difference of the two accelerations. So the equations on the grid hold with that of the phase that
  /// a point is in, theta = 0 or 1, and a step adds an error that grows with the square of its width. But points that
  /// change sides then make noise. docs/jump_conditions.md has the study: errors of 1 are twice those of 0.25 and of 0,
  /// noise is least from 0.25 to 0.5.
  static constexpr double smoothing = 0.25;

  /// Re_s: no phase has more than 2.5 times its acceleration.
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

  /// Outer w of the present time and of the one before.
  std::vector<fluid::FaceVector> outer_state() const;
  /// The same inside of a body, rows of InnerPhase.
  std::array<std::vector<double>, 2> inner_state(std::size_t body) const;
  using InnerState = std::array<std::span<const double>, 2>;
  /// \param inner of all bodies
  /// \throws std::invalid_argument unless the velocities are on this grid and finite, and of as many bodies
  void restore(std::span<const fluid::FaceVector> outer, std::span<const InnerState> inner,
               const fluid::NavierStokes& fluid);

 private:
  struct Level {
    Level(const fluid::Grid& grid, bool convects);
    fluid::FaceVector outer;
    std::vector<fluid::FaceVector> convection;  // of it, if any
  };
  struct Coefficients {
    double c0, c1, c2, r;
  };
  /// What is known of a phase at a point: w^(k+1) extrapolated, and A without it.
  struct Past {
    double next, acceleration;
  };
  /// Of the outer phase; arrays begin at the point (0, 0, 0).
  struct OuterPast {
    Coefficients c;
    const double *velocity, *earlier, *convection, *earlier_convection;
    Past operator()(std::ptrdiff_t at) const;
  };
  /// A point within the smooth step of one body that is inside of another, whose jump counts there for both.
  struct Shared {
    int component;
    std::array<int, 3> point;
    const GridBand* inside;  // of the other one, where the point is at
    std::ptrdiff_t at;
    double factor;  // of the jump, in c0 Re
  };

  static double blend(const Body& body, double distance);
  std::size_t before() const { return (now_ + 2) % 3; }
  static Past past(const Coefficients& c, double velocity, double earlier, double convection, double earlier_convection,
                   double viscosity);
  OuterPast outer_past(int component) const;
  std::optional<Past> inner_past(int component, std::size_t body, const std::array<int, 3>& point) const;
  void prepare_outside(int component, const fluid::NavierStokes& fluid);
  void prepare_inside(int component, std::size_t body, const fluid::NavierStokes& fluid);
  void prepare_next_to(int component, std::size_t body);
  void find_shared(int component, const GridBand::Point& point, double factor);
  // w^(k+1) extrapolated in the phase that each point is in, while a force is prepared: in the place of what the next keep() replaces.
  fluid::FaceVector& next_w() { return levels_[(now_ + 1) % 3].outer; }
  static void convect(Level& level);

  fluid::Grid grid_;
  std::vector<Body> bodies_;
  double reynolds_number_, solved_;
  std::array<Level, 3> levels_;           // in turn
  std::vector<InnerPhase> insides_;       // of the bodies, of the same times
  std::size_t now_ = 0, remembered_ = 0;  // of them; the one of the time before is (now_ + 2) % 3
  Coefficients c_{};
  fluid::FaceVector explicit_;
  InsidePoints inside_;
  std::vector<Shared> shared_;
};

}  // namespace vesiflow::coupling
