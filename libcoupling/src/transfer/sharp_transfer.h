// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "coupling/marker_transfer.h"
#include "fluid/field.h"
#include "transfer/fine_surface.h"
#include "transfer/grid_band.h"
#include "vesicle/membrane_jumps.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// The two transfers between a membrane without thickness and the staggered grid: what a force on the membrane is to the
/// difference equations of the fluid, and the velocity of the membrane.
///
/// Let the velocity inside be that outside, continued, less D = [u] + d [u_n] + ..., at the distance d from the
/// membrane, chi the indicator of the inside at points of the grid and M(u, p) = Lap u - grad p the difference operator.
/// Then the field on the grid obeys the equations of the fluid with the force and the source
///     f = M(chi D) - theta M(D),   div u = r,   r = -div(chi D) + theta div D,
/// where theta(d) is a smooth step from 1 inside to 0 outside within `smoothing`: D obeys the equations to the order of
/// the differences, so that theta M(D) is small, and with it f changes smoothly as points of the grid change sides. (An
/// immersed interface method: LeVeque & Li 1994, 1997; docs/jump_conditions.md.) All is next to the membrane. Total
/// force and torque of f are those of the membrane: what lacks, of second order in h, is spread by a delta function.
///
/// The velocity of the membrane is interpolated by 4 x 4 x 4 points of Lagrange from the mean of both sides, u + D/2
/// inside and u - D/2 outside.
///
/// Membranes lie across a mirror plane of the grid or on one side of it, as those of MarkerTransfer do. One across it is
/// symmetric: f and r are those of the whole at the points of the grid, and markers beyond the plane have the velocity
/// of their mirror images. One on one side stands for its image too: what it puts beyond the plane is put at the mirror
/// images of these points.
class SharpTransfer {
 public:
  struct Parameters {
    int degrees = 0;  ///< degrees of forces that the grid resolves; 0: all
    /// In spacings. Where theta varies, what D lacks of obeying the equations is force: the less the narrower, while points
    /// that change sides do so more suddenly. docs/jump_conditions.md#how-wide-the-step-is.
    double smoothing = 0.5;
    /// How much further than forces need it points of the velocity know their jumps at most, in spacings.
    double more_reach = 0.0;
    /// Per axis with a mirror plane: whether the membrane lies across it.
    std::array<bool, 3> across{true, true, true};
  };

  SharpTransfer(const fluid::Grid& grid, const vesicle::SphereGrid& markers, const Parameters& parameters);

  const fluid::Grid& grid() const { return grid_; }

  /// Takes a membrane's shape. Jumps, forces and velocities that follow are on it.
  /// \param has_neighbours whether markers of others may read inside it
  /// \param more_reach where less than the parameter is enough, in spacings
  void update(const vesicle::Surface& surface, bool has_neighbours = false,
              double more_reach = std::numeric_limits<double>::infinity());
  /// How far points of the velocity know their jumps if more_reach is 0, in spacings.
  static constexpr double least_reach = 2.0;
  /// How far from a membrane its markers read, along each axis.
  double reading_reach() const { return 0.5 * GridBand::read_points * spacing_; }
  /// Whether the axis has a mirror plane that the membrane is on one side of: then its mirror image is a membrane too.
  bool has_image(int axis) const { return grid_.mirror[axis] && !across_[axis]; }

  /// Takes its force per area on the fluid (markers x 3). \param velocity_jump [u] (markers x 3), none if null
  void set_force(const vesicle::VectorField& force, const vesicle::VectorField* velocity_jump = nullptr);

  /// Adds f and r; what lacks of force and torque goes by `delta`, which knows the markers.
  void add_to(fluid::FaceVector& density, fluid::Field<fluid::Cell>& source, MarkerTransfer& delta);

  /// Another membrane is near, which has its force: markers read at points inside it what is outside, continued. Until the next
  /// set_force().
  void read_past(const SharpTransfer& other);

  /// Sets to zero where add_to() has added since the last clear().
  void clear(fluid::FaceVector& density, fluid::Field<fluid::Cell>& source);

  /// Velocity at the markers (markers x 3) of the last update.
  void interpolate(const fluid::FaceVector& velocity, vesicle::VectorField& marker_velocity) const;

  /// What the integral of the velocity that has been solved for is more than the sum over the points of the grid times
  /// their volume, which counts points inside as a whole. Without mirror planes. docs/jump_conditions.md#the-mean-flow.
  Eigen::Vector3d integral_beyond_sum() const;

  /// The points of a component of the velocity, 0 to 2, that are near the membrane of the last update.
  const GridBand& band(int component) const { return bands_[static_cast<std::size_t>(component)]; }

  /// theta at a signed distance.
  double blend(double distance) const;

  /// Force that lacked of the total, over the sum of the sizes of the forces: a measure of the error.
  double lacking_force() const { return lacking_force_; }

 private:
  /// Of a force, about the origin.
  struct Moments {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  };
  struct Box {
    std::array<int, 3> first, extent;
    friend bool operator==(const Box&, const Box&) = default;
  };

  double force_reach() const;
  double source_reach() const;
  static double corrected(const GridBand& band, std::ptrdiff_t at, double theta);
  double momentum_at(int component, const GridBand::Point& point) const;
  double source_at(const GridBand::Point& point) const;
  template <class Add>
  static void for_points_within(double reach, const GridBand& band, const Add& add);
  void add_component(int component, const fluid::View& density, Moments& moments) const;
  void add_source(const fluid::View& source) const;
  void spread_rest(const Moments& put, MarkerTransfer& delta, fluid::FaceVector& density);
  void clear_box(const Box& box, const fluid::View& view) const;
  double mean_of_sides(const GridBand& band, const fluid::ConstView& velocity, Eigen::Index marker) const;

  fluid::Grid grid_;
  double smoothing_;  // width
  double spacing_;    // the largest
  double more_reach_;
  std::array<bool, 3> across_;  // per axis: a mirror plane
  std::array<double, 3> per_spacing_;
  vesicle::MembraneJumps jumps_;
  FineSurface fine_;
  std::vector<GridBand> bands_;  // of the components, then of the pressure
  vesicle::VectorField positions_, force_, rest_;
  vesicle::VectorField readers_;  // the markers, those beyond mirror planes at their mirror images
  vesicle::ScalarField area_weight_;
  double lacking_force_ = 0.0;
  std::array<std::vector<Box>, 4> touched_;
};

}  // namespace vesiflow::coupling
