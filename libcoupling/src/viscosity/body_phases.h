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

/// w = mu u about one body at four times, of which one is about to be replaced, in a box of the grid around it: as the grid has it, and that of the phases
/// outside and inside of the body, each continued across its membrane as far as its bands know the jump. Each body has its
/// own continuation at points that are near several. Indices run on across periodic axes, as those of GridBand do. Beyond
/// where it is continued, a phase holds what the grid has there, which is of no meaning.
class BodyPhases {
 public:
  static constexpr std::size_t times = 4;
  /// The present one, that a step before, and that before or again the second.
  using Times = std::array<std::size_t, 3>;

  /// \param convects whether N = (w . grad)w is computed
  BodyPhases(const fluid::Grid& grid, bool convects) : grid_(grid), convects_(convects) {}

  /// Takes the velocity u of a fluid that no step has made, which is smooth, for all times.
  void begin(const SharpTransfer& body, double ratio, const fluid::FaceVector& velocity);
  /// Takes a step's end in the place of one of the times. \param velocity w \param continuation what is to be added to w
  /// to continue it into all bodies
  void keep(std::size_t time, const SharpTransfer& body, const fluid::FaceVector& velocity,
            const fluid::FaceVector& continuation);

  /// Points with all that differences there take in. Those known at all these times, or none: boxes may have grown since.
  struct Points {
    std::array<int, 3> first, extent;
    bool any() const { return extent[0] > 0 && extent[1] > 0 && extent[2] > 0; }
    bool contains(int i, int j, int k) const {
      return i >= first[0] && i < first[0] + extent[0] && j >= first[1] && j < first[1] + extent[1] && k >= first[2] &&
             k < first[2] + extent[2];
    }
  };
  Points points_of(const Times& of) const;

  /// A component of w at these times, and of N at the first two, at the first of points_of(). N is w unless it is computed.
  struct Levels {
    const double *velocity, *earlier, *earliest, *convection, *earlier_convection;
    Levels from(std::ptrdiff_t at) const {
      return {velocity + at, earlier + at, earliest + at, convection + at, earlier_convection + at};
    }
  };
  struct AllLevels {
    Levels whole, outer, inner;  ///< as the grid has it, and of the phases
    std::ptrdiff_t row_stride, plane_stride;
  };
  AllLevels levels(std::size_t component, const Times& of) const;

  /// Puts w outside of the body, continued, into a field of the grid, where the box has points.
  void put_outer(std::size_t time, fluid::FaceVector& velocity) const;

  /// A row of numbers of one time for checkpoints: first point and number of points of the box along each axis and of
  /// those that are known, then the components of w inside with their ghosts and, if asked for, those of w outside.
  std::vector<double> state(std::size_t time, bool has_outer = false) const;
  /// What a time is restored from.
  struct Saved {
    std::size_t time;
    std::span<const double> inner;              ///< a row of state()
    const fluid::FaceVector *velocity, *outer;  ///< w, and as put_outer() gives it; null: the row has what is outside
  };
  /// Takes some times; one that has what is outside in its row has no convection and nothing as the grid has it.
  /// \throws std::invalid_argument unless the rows are of that form, alike and finite
  void restore(std::span<const Saved> saved);

 private:
  struct Phase {
    Phase(const fluid::Grid& grid, bool convects);
    fluid::FaceVector velocity;
    std::optional<fluid::FaceVector> convection;
  };
  struct Box {
    Box(const fluid::Grid& grid, bool convects) : whole(grid, convects), outer(grid, convects), inner(grid, convects) {}
    std::array<int, 3> first{};
    Phase whole, outer, inner;             // on a grid of its own
    std::array<int, 3> known{}, extent{};  // of the points that are known: the box as it was when it was filled
  };
  /// Where along an axis a field of the grid holds a point, and the factor of its value: beyond a mirror plane that of its
  /// image, for the component normal to the plane with the other sign.
  struct Held {
    static constexpr int nowhere = -2;  // ghosts are at -1
    int place = nowhere;
    double factor = 1.0;
  };
  using HeldAlong = std::array<std::vector<Held>, 3>;

  void frame(std::size_t time, const SharpTransfer& body);
  void resize(const std::array<int, 3>& points);
  Held held_at(int point, std::size_t axis, std::size_t component, int extent) const;
  void find_held(const Box& box, std::size_t component, const fluid::ConstView& field);
  void copy_from(const fluid::ConstView& field, const fluid::View& to) const;
  void continue_inner(Box& box, std::size_t component, const GridBand& band) const;
  static void convect(Box& box);

  fluid::Grid grid_;
  bool convects_;
  std::array<int, 3> points_{};  // of each box along each axis
  std::vector<Box> boxes_;       // of the times, or none yet
  HeldAlong held_;               // of one component of a box, its ghosts first
};

}  // namespace vesiflow::coupling
