// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/marker_transfer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "coupling/errors.h"
#include "transfer/shares.h"
#include "transfer/transfer_axis.h"
#include "transfer/transfer_loops.h"

namespace vesiflow::coupling {
namespace {

constexpr const char* axis_name[] = {"x", "y", "z"};

[[noreturn]] void refuse_marker(Eigen::Index marker, int axis, double position, double wall_clearance,
                                const fluid::Grid& grid) {
  const std::string where =
      "marker " + std::to_string(marker) + " is at " + axis_name[axis] + " = " + std::to_string(position);
  if (!std::isfinite(position))
    throw SimulationStopped(where, "the state is no longer finite: a smaller time step, or a finer mesh");
  if (grid.mirror[axis] && position < grid.lower[axis])
    throw SimulationStopped(where + ", beyond the plane of symmetry at " + std::to_string(grid.lower[axis]),
                            "a vesicle on one side of the plane stands for itself and its mirror image, which have met "
                            "here: a finer mesh or "
                            "grid, a smaller time step, or repulsion (repulsion.range)");
  throw SimulationStopped(where + ", nearer than " + std::to_string(wall_clearance) +
                              " grid spacings to the wall (box " + std::to_string(grid.lower[axis]) + " to " +
                              std::to_string(grid.upper[axis]) + ")",
                          "move the vesicle away from the wall or enlarge the box (domain.lower, domain.upper)");
}

TransferAxis transfer_axis(const fluid::Grid& grid, int axis, bool across, DeltaKernel kernel) {
  const bool periodic = grid.periodic[axis], mirrored = grid.mirror[axis];
  const int width = std::max(support_width(kernel, Direction::normal), support_width(kernel, Direction::tangential));
  if ((periodic || mirrored) && grid.cells[axis] < width)
    throw std::invalid_argument("marker transfer: " + std::to_string(grid.cells[axis]) + " cells along " +
                                axis_name[axis] + "; the kernel \"" + std::string(coupling::name(kernel)) +
                                "\" needs at least " + std::to_string(width) + " on a periodic or mirrored axis");
  return {grid.cells[axis],      periodic, mirrored, !across, grid.lower[axis], 1.0 / grid.spacing(axis),
          wall_clearance(kernel)};
}

void check_size(const char* array, Eigen::Index size, Eigen::Index markers) {
  if (size == markers) return;
  throw std::invalid_argument("marker transfer: " + std::string(array) + " has " + std::to_string(size) +
                              " rows: must be one per marker of the last update, " + std::to_string(markers));
}

void check_grid(const char* field, const fluid::FaceVector& values, const fluid::Grid& grid) {
  if (values.x.grid() == grid && values.y.grid() == grid && values.z.grid() == grid) return;
  throw std::invalid_argument("marker transfer: " + std::string(field) + " is on another grid");
}

}  // namespace

std::array<bool, 3> mirrors_crossed(const fluid::Grid& grid, const Eigen::Ref<const vesicle::VectorField>& positions) {
  std::array<bool, 3> crossed{};
  for (int axis = 0; axis < 3; ++axis)
    crossed[axis] = grid.mirror[axis] && (positions.col(axis) < grid.lower[axis]).any();
  return crossed;
}

MarkerTransfer::MarkerTransfer(const fluid::Grid& grid, DeltaKernel kernel, const std::array<bool, 3>& across)
    : kernel_(kernel), grid_(grid), per_volume_(1.0 / grid.cell_volume()) {
  std::array<TransferAxis, 3> axes{};
  for (int axis = 0; axis < 3; ++axis) {
    axes[axis] = transfer_axis(grid, axis, across[axis], kernel);
    if (grid.mirror[axis] && across[axis]) per_volume_ *= 0.5;
  }
  loops_ = with_functions_of(kernel, [&](auto functions) -> std::unique_ptr<Loops> {
    return std::make_unique<KernelLoops<decltype(functions)>>(axes);
  });
}

MarkerTransfer::~MarkerTransfer() = default;
MarkerTransfer::MarkerTransfer(MarkerTransfer&&) noexcept = default;
MarkerTransfer& MarkerTransfer::operator=(MarkerTransfer&&) noexcept = default;

void MarkerTransfer::update(const Eigen::Ref<const vesicle::VectorField>& positions) {
  markers_ = 0;
  const Loops::Refusal refusal = loops_->update(positions);
  if (refusal.marker >= 0)
    refuse_marker(refusal.marker, refusal.axis, positions(refusal.marker, refusal.axis), wall_clearance(), grid_);
  markers_ = positions.rows();
}

void MarkerTransfer::spread(const vesicle::VectorField& force, const vesicle::ScalarField& area_weight,
                            fluid::FaceVector& density) {
  check_size("the force", force.rows(), markers_);
  check_size("the area weight", area_weight.rows(), markers_);
  check_grid("the force density", density, grid_);
  const Box& box = loops_->box();
  if (std::ranges::find(spread_boxes_, box) == spread_boxes_.end()) spread_boxes_.push_back(box);
  loops_->spread(force, area_weight, per_volume_, density.points());
}

void MarkerTransfer::interpolate(const fluid::FaceVector& velocity, vesicle::VectorField& marker_velocity) const {
  check_size("the marker velocity", marker_velocity.rows(), markers_);
  check_grid("the velocity", velocity, grid_);
  loops_->interpolate(velocity.points(), marker_velocity);
}

void MarkerTransfer::clear(fluid::FaceVector& density) {
  check_grid("the force density", density, grid_);
  for (const fluid::View& component : density.points())
    for (const Box& box : spread_boxes_) clear_box(box, component);
  spread_boxes_.clear();
}

void MarkerTransfer::clear_box(const Box& box, const fluid::View& component) const {
  const auto wrapped = [&](int axis, int i) {
    return grid_.periodic[axis] && i >= grid_.cells[axis] ? i - grid_.cells[axis] : i;
  };
  const int first = box[0].first, count = box[0].count;
  const int beyond = grid_.periodic[0] ? std::max(0, first + count - grid_.cells[0]) : 0;
  in_shares(box[2].count, [&](Eigen::Index begin, Eigen::Index end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
      for (int j = 0; j < box[1].count; ++j) {
        double* row = component.row(wrapped(1, box[1].first + j), wrapped(2, box[2].first + k));
        std::fill_n(row + first, count - beyond, 0.0);
        std::fill_n(row, beyond, 0.0);
      }
  });
}

}  // namespace vesiflow::coupling
