#pragma once

#include <span>

#include "shape_following.h"

namespace vesiflow::coupling {

/// time.markers = "implicit": the equations of ShapeFollowing with forces and velocities at the new state, in increments d
///   a0 d = a1 d^k + dt rates(y^k + d),   rates = (W, ds/dt) - damping y,
/// solved as the fixed point of a map that ShapeFollowing's implicit terms make a contraction, or nearly so:
///   G(d) = d + (a0 + Z_n + dt w.grad)^{-1} [a1 d^k - a0 d + dt rates(y^k + d)].
/// The first evaluation, at d = r d^k, is a step of ShapeFollowing. At the fixed point Z does not matter, the fluid has felt the
/// forces of the new state and nothing is owed to it. The rates of the fluid are found outside (ImplicitStep):
///   predict;  then forces, fluid and advance, which evaluates G, and try_increment, as often as needed;  accept.
/// The unknowns are coefficients of spherical harmonics whose mean square over the sphere is 1 (but for the order m > 0: 1/2),
/// positions in radii R of the membrane, strains times 1 + dt sigma0/4: a strain moves the membrane by its own length
/// until it has relaxed, and the fluid by sigma0/4 of it in unit time.
class ImplicitMotion final : public ShapeFollowing {
 public:
  ImplicitMotion(const SimulationParameters& parameters, const Flow& flow, std::size_t vesicle,
                 const vesicle::Membrane& membrane);

  bool predict(double dt, vesicle::Membrane& membrane) override;
  /// Evaluates G at the increment under trial, for the membrane and its fluid there.
  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override;

  std::size_t unknowns() const { return static_cast<std::size_t>(trial_.size()); }
  /// The increment under trial, after predict() that of the prediction, and G of it after advance().
  void get_trial(std::span<double> increment) const;
  void get_improved(std::span<double> increment) const;
  /// Brings the membrane to y^k + d.
  void try_increment(std::span<const double> increment, vesicle::Membrane& membrane);
  /// Ends the step with it.
  void accept(double dt, std::span<const double> increment, vesicle::Membrane& membrane);

  MarkerStatistics statistics() const override { return {steps_, 0, evaluations_}; }

 private:
  void find_scales(double dt);

  Gmres::Vector trial_, improved_, scales_;               // scales: unknown over coefficient
  Gmres::Vector state_coefficients_, last_coefficients_;  // y^k, d^k
  bool has_stiffness_ = false;                            // of this step
  long evaluations_ = 0;
};

}  // namespace vesiflow::coupling
