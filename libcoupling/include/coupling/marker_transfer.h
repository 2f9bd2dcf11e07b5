#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fluid/field.h"
#include "fluid/grid.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// The two transfers between the markers of one membrane and the staggered grid, with the smoothed delta function
/// delta_h(x) = phi(x/h_x) phi(y/h_y) phi(z/h_z) / (h_x h_y h_z):
///   spread       f(x)   = sum_m F_m dA_m delta_h(x - X_m)            conservative: total force is kept
///   interpolate  U_m    = sum_x u(x) delta_h(x - X_m) h_x h_y h_z    consistent: exact for linear fields
/// (Steps 2 and 4 of the paper). They are discrete adjoints: sum_x f.u h^3 = sum_m F_m dA_m . U_m.
/// Both work inside the bounding box of the markers only, and their results do not depend on the number of threads.
class MarkerTransfer {
 public:
  explicit MarkerTransfer(const fluid::Grid& grid);

  /// Computes the weights for markers at `positions` (markers x 3, in length units).
  /// \throws SimulationStopped when a marker is so near a wall that its support leaves the box
  void update(const Eigen::Ref<const vesicle::VectorField>& positions);

  /// Adds the force density of `force` (per membrane area, markers x 3) times `area_weight` (dA per marker).
  void spread(const vesicle::VectorField& force, const vesicle::ScalarField& area_weight, fluid::FaceVector& density);

  /// Velocity at the markers (markers x 3).
  void interpolate(const fluid::FaceVector& velocity, vesicle::VectorField& marker_velocity) const;

  /// Sets `density` to zero wherever the last `spread` wrote.
  void clear(fluid::FaceVector& density) const;

  /// Distance from a wall, in grid spacings, below which a marker is refused.
  static constexpr double wall_distance = 1.5;

 private:
  // Points of one axis: 0 on faces (multiples of h), 1 at cell centres.
  struct Stencil {
    std::array<std::array<std::int32_t, 2>, 3> first;             // [axis][faces, centres]
    std::array<std::array<std::array<double, 4>, 2>, 3> weights;  // [axis][faces, centres][point]
  };
  struct Box {
    std::array<std::int32_t, 3> first{0, 0, 0}, last{-1, -1, -1};
  };

  template <class Centring>
  void spread_component(int component, const vesicle::VectorField& force, const vesicle::ScalarField& area_weight,
                        fluid::Field<Centring>& density) const;
  template <class Centring>
  void interpolate_component(int component, const fluid::Field<Centring>& velocity,
                             vesicle::VectorField& marker_velocity) const;
  template <class Centring>
  void clear_component(fluid::Field<Centring>& density) const;

  fluid::Grid grid_;
  std::vector<Stencil> stencils_;
  Box box_{};         // of the supports of all markers
  Box spread_box_{};  // that of the last spread; empty before
};

}  // namespace vesiflow::coupling
