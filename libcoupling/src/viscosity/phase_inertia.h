// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "coupling/phase_splitting.h"
#include "fluid/field.h"
#include "fluid/navier_stokes.h"
#include "transfer/sharp_transfer.h"
#include "viscosity/body_phases.h"
#include "viscosity/inside_points.h"

namespace vesiflow::coupling {

/// Inertia of two phases between sharp membranes, as a force on a fluid that is solved for w = mu u with one viscosity
/// and one acceleration.
///
/// In each phase Re Du/Dt = -grad p + Lap w, so that the term in dw/dt is Re outside of the membranes and Re/ratio
/// inside. The solver has Re_s Dw/Dt everywhere, with w as the grid has it: at each time of the phase that a point was in
/// then. The force is that less what the two phases ask for,
///     f = Re_s A(w, 1) - (1 - sum theta_b) Re A(outer w, 1) - sum theta_b Re/ratio_b A(w of b, ratio_b),
///     A(w, mu) = c0 w^(k+1) + c1 w^k + c2 w^(k-1) + N(w)/mu,
/// with the coefficients c of the solver's time differences and N extrapolated, each phase continued across the membranes
/// at each of its times by the jumps that they had then, and theta_b a smooth step at body b, 1 inside of it. Each body
/// has an inside of its own: next to several, a point is reached by the continuations of all. Where w^(k+1) does
/// not cancel, its extrapolation in the phase that the point is in now is taken. As c0 is of the order of 1/dt, the step is
/// of second order where that is from three times, which is stable for accelerations that differ by a factor of up to 5:
/// phase_splitting(). Away from bodies f vanishes, but for (Re_s - Re) A.
/// docs/jump_conditions.md#the-acceleration-that-is-extrapolated.
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

  /// \param bodies at least one; their transfers live longer than this
  PhaseInertia(const fluid::Grid& grid, double reynolds_number, const PhaseSplitting& splitting,
               std::vector<Body> bodies, bool convects);

  /// Starts from a velocity u of the fluid that no step has made.
  void begin(const fluid::FaceVector& velocity);

  /// Forms the part of the force that a step of length dt from the fluid's state has, whatever it leads to. Returns a,
  /// the factor of w in the solver's acceleration.
  double prepare(const fluid::NavierStokes& fluid, double dt);
  /// Adds the force for the present jumps, at the points that a solver reads.
  void add_to(fluid::FaceVector& density) const;
  /// Sets to zero where add_to() adds.
  void clear(fluid::FaceVector& density) const;

  /// Keeps the phases of the end of a step of length dt: w, of which the bodies know the jumps.
  void keep(const fluid::FaceVector& velocity, double dt);
  /// The present time is what take_back() goes back to, over one keep() at most.
  void remember() { remembered_ = now_; }
  void take_back() { now_ = remembered_; }

  /// Outer w of the present time and of the one before; and w as the grid had it two steps ago where the solver has another
  /// Reynolds number and three times are known.
  std::vector<fluid::FaceVector> outer_state(const fluid::NavierStokes& fluid) const;
  using InnerState = std::vector<std::vector<double>>;
  /// w inside of a body, rows of BodyPhases: of the present time, of the one before and, of both phases, of that before it where
  /// that is known and made use of.
  InnerState inner_state(std::size_t body) const;
  /// From the third of these times to the second; 0 if there are two.
  double earlier_step() const { return known_times() == 3 ? steps_[time(1)] : 0.0; }
  /// \param inner of all bodies
  /// \throws std::invalid_argument unless the velocities are on this grid and finite, of as many bodies and of as many
  /// times as that `earlier_step` has
  void restore(std::span<const fluid::FaceVector> outer, std::span<const InnerState> inner, double earlier_step,
               const fluid::NavierStokes& fluid);

 private:
  using Levels = BodyPhases::Levels;
  struct Coefficients {
    double c0 = 0.0, c1 = 0.0, c2 = 0.0, r = 0.0;
    double next = 0.0, next1 = 0.0, next2 = 0.0;  // of w^k, w^(k-1), w^(k-2) in w^(k+1)
    bool convects = false;
  };
  /// From two or three times to the next.
  struct Extrapolation {
    explicit Extrapolation(const Coefficients& c)
        : c1(c.c1),
          c2(c.c2),
          now(c.next),
          before(c.next1),
          earliest(c.next2),
          n1(c.convects ? 1.0 + c.r : 0.0),
          n2(c.convects ? c.r : 0.0) {}
    double c1, c2, now, before, earliest, n1, n2;

    /// w^(k+1).
    [[gnu::always_inline]] double velocity(const Levels& w, std::ptrdiff_t at) const {
      return now * w.velocity[at] + before * w.earlier[at] + earliest * w.earliest[at];
    }
    /// A without it.
    [[gnu::always_inline]] double past(const Levels& w, double per_viscosity, std::ptrdiff_t at) const {
      return (c1 * w.velocity[at] + c2 * w.earlier[at]) +
             per_viscosity * (n1 * w.convection[at] - n2 * w.earlier_convection[at]);
    }
  };
  /// Points along x that follow each other in the box of a body and in the grid.
  struct Row {
    std::ptrdiff_t in_box, in_shares, in_grid;
    int count;
  };
  /// A component of a body's box while a force is prepared.
  struct BodyPart {
    BodyPhases::AllLevels w{};
    std::vector<Row> rows;
    std::vector<double> share;  // theta, more than 1/2 just inside
  };
  /// A jump that the force has, of a body of which a point is within the smooth step.
  struct JumpPart {
    std::ptrdiff_t in_grid;
    const GridBand* band;
    std::ptrdiff_t at;
    double factor;
  };
  struct Piece {
    std::ptrdiff_t begin, end;
  };
  /// What is known of a component while a force is prepared, and of the force after that.
  struct Component {
    std::vector<BodyPart> bodies;
    std::vector<Piece> pieces;  // where the prepared force is, in order
    std::vector<JumpPart> jumps;
    InsidePoints inside;
  };

  static double blend(const Body& body, double distance);
  std::size_t known_times() const { return splitting_.curvature > 0.0 && steps_[time(1)] > 0.0 ? 3 : 2; }
  std::size_t time(std::size_t back) const { return (now_ - back) % BodyPhases::times; }
  BodyPhases::Times known() const { return {time(0), time(1), time(known_times() - 1)}; }
  bool solves_another() const { return splitting_.solved_reynolds_number != reynolds_number_; }
  Coefficients coefficients(double dt, double last) const;
  void prepare_component(std::size_t component, const fluid::NavierStokes& fluid);
  void find_rows(std::size_t component, std::size_t body);
  void find_shares(std::size_t component, std::size_t body);
  void find_pieces(std::size_t component);
  void list_jumps(std::size_t component, std::size_t body);
  void list_shared(std::size_t component, const GridBand::Point& point, std::ptrdiff_t in_grid, double factor);
  template <class Put>
  void for_jumps_inside(const Put& put);
  void keep_convection(std::size_t back, const fluid::FaceVector& velocity);
  Levels everywhere(std::size_t component, const fluid::NavierStokes& fluid) const;

  fluid::Grid grid_;
  std::vector<Body> bodies_;
  double reynolds_number_;
  PhaseSplitting splitting_;
  std::vector<BodyPhases> phases_;  // of the bodies
  static constexpr std::size_t first_time = 12;
  std::size_t now_ = first_time,
              remembered_ = first_time;  // counts times; of the bodies that is time(0), of lists of three now_ % 3
  std::array<double, BodyPhases::times> steps_{};  // that led to them; 0: none
  Coefficients c_;
  std::array<Component, 3> components_;
  fluid::FaceVector explicit_, next_;  // the prepared force, and w^(k+1) extrapolated in the phase that a point is in
  fluid::FaceVector continuation_;     // zero but within keep()
  // If the solver has another Re, of w on the grid: N of the last times, and w of the time before the last two.
  std::vector<fluid::FaceVector> convection_, earlier_;
};

}  // namespace vesiflow::coupling
