// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "coupling/export.h"
#include "coupling/marker_transfer.h"
#include "fluid/elliptic_solver.h"
#include "fluid/field.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// A quantity that has a value of its own inside each closed membrane and is zero outside of all of them,
///
///     c(x) = sum_v c_v I_v(x),    I_v = 1 inside membrane v, 0 outside,
///
/// smoothed over the width of the delta function: the solution of
///
///     -Lap c = div g,   g(x) = sum_v c_v int n delta(x - X) dA   (n outward; paper, section 3.3, Step 3)
///
/// with the gradient and divergence of the staggered grid, and one solve for all membranes.
///
/// Walls are Neumann, as g is zero there; the constant that this leaves free follows from int c = sum_v c_v V_v. The
/// discrete equation knows this volume: multiplied by |x|^2/6 and summed by parts it says, with V = (1/3) sum X.n dA to
/// round-off,
///
///     sum c h_x h_y h_z = sum_v c_v V_v + surface terms at the walls,
///
/// so the condition is the same as a mean of zero on the walls, weighted with x.n, and it holds in periodic boxes too.
/// (Dirichlet conditions, zero half a cell off the walls, miss the volume; tests/coupling/indicator_test.cpp compares
/// the two.)
///
/// In a box with mirror planes, a membrane is across a plane if some of its markers are beyond it when it is first
/// added, and then half of its volume is in the box.
///
/// c passes a little over and under the values that it goes between, near the membrane: see docs/viscosity_contrast.md
/// for how much.
class VESIFLOW_COUPLING_EXPORT Indicator {
 public:
  /// \param membranes their number.
  Indicator(const fluid::Grid& grid, std::size_t membranes, DeltaKernel kernel = DeltaKernel::smoothed_four_point);

  /// Adds a membrane, with its geometry as it is, to what the next solve() is of; nothing if the value is 0.
  /// \throws SimulationStopped when a marker is too near to a wall.
  void add(std::size_t membrane, const vesicle::Surface& surface, double value);

  /// Sets `field`, ghosts not included, to c of the membranes added since the last time. Allocates nothing after the
  /// first time; the same bits for any number of threads.
  /// \throws std::invalid_argument if the field is on another grid.
  void solve(fluid::Field<fluid::Cell>& field);

  /// Forgets the membranes added since the last time.
  void clear();

 private:
  struct Membrane {
    std::optional<MarkerTransfer> transfer;
    double share = 1.0;  // of its volume, in the box
    vesicle::ScalarField weight;
    bool added = false;
  };

  DeltaKernel kernel_;
  std::vector<Membrane> membranes_;
  fluid::FaceVector jump_;  // g; zero but between add() and solve()
  std::unique_ptr<fluid::EllipticSolver> solver_;
  double content_ = 0.0;  // sum c_v V_v, of the parts in the box
};

}  // namespace vesiflow::coupling
