// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fluid/field.h"
#include "transfer/sharp_transfer.h"

namespace vesiflow::coupling {

/// w = mu u inside of one body at three times, continued out of it as far as its bands know the jump. It is held in a
/// box of the grid around the body, so that each body has its own continuation at points that are near several. Indices
/// run on across periodic axes, as those of GridBand do. Other points of the box hold what the grid has there, which is
/// of no meaning.
class InnerPhase {
 public:
  static constexpr std::size_t times = 3;

  /// \param convects whether N = (w . grad)w is computed
  InnerPhase(const fluid::Grid& grid, bool convects) : grid_(grid), convects_(convects) {}

  /// Takes the velocity u of a fluid that no step has made, which is smooth, for all times.
  void begin(const SharpTransfer& body, double ratio, const fluid::FaceVector& velocity);
  /// Takes a step's end in the place of one of the times. \param velocity w \param outer the same, but continued into
  /// all bodies
  void keep(std::size_t time, const SharpTransfer& body, const fluid::FaceVector& velocity,
            const fluid::FaceVector& outer);

  /// Whether the box of that time has the point.
  bool has(std::size_t time, const std::array<int, 3>& point) const;
  /// w and N at a point that it has; N is 0 unless it is computed.
  struct Value {
    double velocity, convection;
  };
  Value at(std::size_t time, int component, const std::array<int, 3>& point) const;

  /// A row of numbers of one time for checkpoints: first point and number of points of the box along each axis, then the
  /// components with their ghosts.
  std::vector<double> state(std::size_t time) const;
  /// Takes two times from such rows.
  /// \throws std::invalid_argument unless they are of that form, alike and finite
  void restore(std::size_t now, std::span<const double> row, std::size_t before, std::span<const double> earlier);

 private:
  struct Box {
    Box(const fluid::Grid& grid, bool convects);
    std::array<int, 3> first{};
    fluid::FaceVector velocity;  // on a grid of its own
    std::optional<fluid::FaceVector> convection;
  };

  void frame(std::size_t time, const SharpTransfer& body);
  void resize(const std::array<int, 3>& points);
  void copy_from(const fluid::FaceVector& whole, Box& box) const;
  static void convect(Box& box);

  fluid::Grid grid_;
  bool convects_;
  std::array<int, 3> points_{};  // of each box along each axis
  std::vector<Box> boxes_;       // of the times, or none yet
};

}  // namespace vesiflow::coupling
