// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "coupling/delta_kernel.h"
#include "coupling/export.h"
#include "fluid/field.h"
#include "fluid/grid.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Per axis whether some of the markers (markers x 3) lie beyond the mirror plane of the grid there: false where it has
/// none.
VESIFLOW_COUPLING_EXPORT std::array<bool, 3> mirrors_crossed(const fluid::Grid& grid,
                                                             const Eigen::Ref<const vesicle::VectorField>& positions);

/// The two transfers between the markers of one membrane and the staggered grid, with a regularized delta function
/// (coupling/delta_kernel.h):
///
///     spread       f(x)   = sum_m F_m dA_m delta_h(x - X_m)            conservative: total force and torque are kept
///     interpolate  U_m    = sum_x u(x) delta_h(x - X_m) h_x h_y h_z    consistent: exact for linear fields
///
/// (Steps 2 and 4 of the paper). They are discrete adjoints: sum_x f.u h_x h_y h_z = sum_m F_m dA_m . U_m.
/// Their results do not depend on the number of threads, and once warmed up no call allocates.
///
/// Each axis of the grid has one of three kinds of ends:
///
/// - Two walls: a marker whose support would leave the box is refused;
/// - Periodic: markers may be anywhere, also several boxes away. Points count once (of the faces the first, not
///   the last, which is the same face);
/// - A mirror plane at its lower end and a wall at the upper (Grid::mirror): the box is one half of a symmetric
///   whole. Velocities are continued beyond the plane by symmetry (the normal component changes its sign). There are
///   two kinds of sets of markers:
///   - across the plane: the markers are those of the whole, on both sides and on it. The force density is the
///     symmetric part of that of the whole, so markers and forces that are symmetric give exactly the half of what they
///     give in the whole, and none normal to the plane on the plane. Half of the power falls on the half box: sum_x f.u
///     h_x h_y h_z = 1/2 sum_m F_m dA_m . U_m, on each such axis;
///   - on the box's side of it: the markers stand for themselves and their mirror images, whose force is spread with
///     theirs as far as it reaches into the box.
///
/// Several membranes may add to one density, each by its own MarkerTransfer.
class VESIFLOW_COUPLING_EXPORT MarkerTransfer {
 public:
  /// \param across per axis with a mirror plane: whether the markers lie across it. Without meaning for the other axes.
  /// \throws std::invalid_argument for an axis that is not of walls and has fewer cells than the kernel has points.
  explicit MarkerTransfer(const fluid::Grid& grid, DeltaKernel kernel = DeltaKernel::smoothed_four_point,
                          const std::array<bool, 3>& across = {true, true, true});
  ~MarkerTransfer();
  MarkerTransfer(MarkerTransfer&&) noexcept;             ///< what is moved from can only be assigned to or destroyed
  MarkerTransfer& operator=(MarkerTransfer&&) noexcept;  ///< takes over the weights of another one

  /// Computes the weights for markers at `positions` (markers x 3, in length units). Their number may change.
  /// \throws SimulationStopped when a marker is so near a wall that its support leaves the box, is beyond a mirror
  /// plane that the markers do not lie across, or is not finite.
  void update(const Eigen::Ref<const vesicle::VectorField>& positions);

  /// Adds the force density of `force` (per membrane area, markers x 3) times `area_weight` (dA per marker).
  /// \throws std::invalid_argument unless both have a row for each marker of the last update and `density` is on the
  /// grid.
  void spread(const vesicle::VectorField& force, const vesicle::ScalarField& area_weight, fluid::FaceVector& density);

  /// Velocity at the markers (markers x 3). Reads points of the box only, no ghosts.
  /// \throws std::invalid_argument unless `marker_velocity` has a row for each marker and `velocity` is on the grid.
  void interpolate(const fluid::FaceVector& velocity, vesicle::VectorField& marker_velocity) const;

  /// Sets `density` to zero in the bounding box of the markers of every `spread` since the last `clear`, including what
  /// other transfers have added there.
  /// \throws std::invalid_argument if `density` is on another grid.
  void clear(fluid::FaceVector& density);

  DeltaKernel kernel() const { return kernel_; }  ///< the kernel

  /// Distance from a wall, in grid spacings, below which a marker is refused.
  double wall_clearance() const { return coupling::wall_clearance(kernel_); }

 private:
  // Along one axis: `count` points from `first` on, on a periodic axis continued at 0.
  struct IndexRange {
    int first = 0, count = 0;
    friend bool operator==(const IndexRange&, const IndexRange&) = default;
  };
  using Box = std::array<IndexRange, 3>;
  class Loops;  // the inner loops, compiled for each kernel
  template <class Functions>
  class KernelLoops;

  void clear_box(const Box& box, const fluid::View& component) const;

  DeltaKernel kernel_;
  fluid::Grid grid_;
  double per_volume_;  // the inverse volume of a cell, halved for each mirror plane that the markers lie across
  std::unique_ptr<Loops> loops_;
  Eigen::Index markers_ = 0;       // of the last update; none while it was refused
  std::vector<Box> spread_boxes_;  // since the last clear
};

}  // namespace vesiflow::coupling
