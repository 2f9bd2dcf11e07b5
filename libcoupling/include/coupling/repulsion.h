// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "coupling/export.h"
#include "fluid/grid.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// What repulsion depends on.
struct RepulsionParameters {
  double range = 0.2;       ///< R > 0: nothing acts beyond it
  double strength = 100.0;  ///< S >= 0, force per area
  bool walls = true;        ///< whether the walls of the box repel too
};

/// One membrane to repulsion.
struct RepelledMembrane {
  const vesicle::VectorField* positions;    ///< markers x 3
  const vesicle::ScalarField* area_weight;  ///< area per marker
  vesicle::VectorField* force;              ///< force per area, markers x 3, that is added to
};

/// Short-range repulsion between membranes, and from walls. A wall at distance d presses with S (1 - d/R)^2 along its
/// normal, and so do two parallel planes at distance d on each other. Of pair energies psi(r) dA dA' that follows from
///
///     2 pi d psi(d) = S (1 - d/R)^2,   as the pressure between planes is
///     int -psi'(r) (d/r) 2 pi r dr = 2 pi d psi(d):
///     psi(r) = S (1 - r/R)^2 / (2 pi r),   -psi'(r) = S (1/r^2 - 1/R^2) / (2 pi)   for r < R.
///
/// The energy is
///
///     E = sum_{m < n} psi(|X_m - X_n|) dA_m dA_n + sum_m dA_m (S R/3) (1 - d_m/R)^3,
///
/// the first sum over markers of different membranes and of periodic images (and half of it over pairs with images in
/// mirror planes, of membranes that lie on one side of them), the second over walls; F_m dA_m = -dE/dX_m at fixed
/// areas. Pairs act on each other along the line between them: total force and torque of all membranes vanish but for
/// walls.
///
/// Sums stand for integrals well where markers are not farther apart than the membranes: an error of about exp(-2 pi
/// d/s) at marker spacing s.
class VESIFLOW_COUPLING_EXPORT Repulsion {
 public:
  /// \param largest_markers most markers that a membrane has.
  /// \throws std::invalid_argument unless range > 0 and strength >= 0 are finite.
  Repulsion(const fluid::Grid& grid, const RepulsionParameters& parameters, Eigen::Index largest_markers);
  ~Repulsion();

  /// Adds the forces. The result does not depend on the number of threads, and on the order of membranes only by
  /// round-off.
  /// \throws std::invalid_argument for a null array, or arrays of one membrane with different numbers of rows.
  void add_forces(std::span<const RepelledMembrane> membranes);

  /// E; forces are not touched, and may be null.
  /// \throws std::invalid_argument as add_forces().
  double energy(std::span<const RepelledMembrane> membranes);

 private:
  class Pairs;
  std::unique_ptr<Pairs> pairs_;
  fluid::Grid grid_;
  RepulsionParameters parameters_;
};

}  // namespace vesiflow::coupling
