// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Velocity on the walls of the box: sampled from a function, checked, and imposed on staggered fields, together with
/// the repetition across periodic axes and the reflection at mirrors.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fluid/export.h"
#include "fluid/field.h"
#include "fluid/grid.h"

namespace vesiflow::fluid {

/// Velocity of the walls (dimensionless) at a position on a wall and a time.
using BoundaryVelocity = std::function<Vector3(const Vector3& position, double time)>;

/// Whether the velocity of the walls depends on the time.
enum class WallMotion {
  steady,   ///< it is sampled once, at time zero
  unsteady  ///< it is sampled at each call of evaluate() with a new time
};

/// The Dirichlet data of the fluid velocity u on the walls: two for every axis that is not periodic, or one if it has a
/// mirror.
///
/// A component normal to a wall has faces on it and takes the wall's value there. A tangential component has
/// points half a cell away on either side: its ghost is 2 * wall - interior. Ghosts beyond normal faces follow
/// the same line, 2 * wall face - inner face, and so do edges and corners, so that a linear flow is continued
/// exactly. Across a periodic axis ghosts are the points of the other end. The component normal to a mirror is zero on
/// the faces there and minus the inner face in the ghost; tangential components have the point inside as their ghost.
class VESIFLOW_FLUID_EXPORT WallVelocity {
 public:
  /// Samples the function at time zero.
  /// \throws std::invalid_argument as evaluate(), and for an empty function (which is right only if there are no
  /// walls).
  WallVelocity(const Grid& grid, BoundaryVelocity velocity, WallMotion motion = WallMotion::steady);

  /// Samples the function at the given time, unless it is steady. An incompressible fluid needs zero net flux through
  /// the walls. Data that has it is sampled at face centres with an error O(h^2); such a remainder is spread evenly
  /// over all the walls' normal velocity. With mirrors the function is called in the computed part of the box only:
  /// that the rest is its reflection is taken on trust.
  /// \throws std::invalid_argument with the flux if it is more than max_relative_flux of the flux of |u.n|, if a value
  /// is not finite, if the function differs at the two ends of a periodic axis, or if its component normal to a mirror
  /// is not zero there; the data is then what it was before.
  void evaluate(double time);
  /// Largest net flux, as a fraction of the flux of |u.n|, that is taken for an error of sampling.
  static constexpr double max_relative_flux = 0.01;

  bool steady() const { return motion_ == WallMotion::steady; }  ///< whether the velocity does not depend on the time
  double time() const { return time_; }                          ///< time of the sampled data

  /// Net outward flux of the sampled data, before the remainder was taken out.
  double net_flux() const { return net_flux_; }

  /// Sets the faces on walls and mirrors, and on periodic axes the last face, which is the first.
  /// \throws std::invalid_argument for a field on another grid. So do the two that follow.
  void set_normal_faces(FaceVector& u) const;
  /// Sets all ghosts from the walls, the mirrors and the points inside; the faces of set_normal_faces() must have been
  /// set.
  void fill_ghosts(FaceVector& u) const;
  /// Adds mu times the part of the 7-point Laplacian of each component that comes from the walls to the
  /// unknowns of rhs: what the homogeneous operator of EllipticProblem leaves out.
  void add_diffusion(double mu, FaceVector& rhs) const;
  /// The same for the change of the data by the last evaluate(): nothing if they are steady.
  void add_diffusion_of_change(double mu, FaceVector& rhs) const;

 private:
  // Values of one velocity component on one wall, at the positions of that component's points projected on
  // the wall, one ghost position on every side included (continued linearly, repeated or reflected).
  struct Plane {
    int component, axis, side;
    std::array<int, 2> extent;  // points along the two other axes, in increasing order
    std::vector<double> values;
    double& at(int a, int b) { return values[static_cast<std::size_t>((b + 1) * (extent[0] + 2) + a + 1)]; }
    double at(int a, int b) const { return values[static_cast<std::size_t>((b + 1) * (extent[0] + 2) + a + 1)]; }
  };
  const Plane& plane(int component, int axis, int side) const { return planes_[component * 6 + axis * 2 + side]; }
  void sample_all();
  struct Deviations;
  void sample(Plane& plane, Deviations& found) const;
  double sampled_at(const Vector3& position, int component, Deviations& found) const;
  void compare_periods(const Plane& plane, Deviations& found) const;
  void refuse(const Deviations& found) const;
  void balance_flux();
  template <class Value>
  void add_wall_diffusion(const Plane& wall, double mu, FaceVector& rhs, const Value& value) const;
  void fill_wall_ghosts(const Plane& wall, const View& field) const;

  Grid grid_;
  BoundaryVelocity velocity_;
  WallMotion motion_;
  double time_ = 0.0;
  double net_flux_ = 0.0;
  std::vector<Plane> spare_planes_;  // of the time before, if they change
  std::vector<Plane> planes_;        // those on walls are sampled, the others empty
};

}  // namespace vesiflow::fluid
