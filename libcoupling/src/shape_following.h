#pragma once

#include <optional>
#include <vector>

#include "gmres.h"
#include "membrane_motion.h"
#include "membrane_response.h"
#include "transfer/mirror_symmetry.h"
#include "vesicle/conservation.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::coupling {

/// time.markers = "shape_following": a mesh that follows the shape of the vesicle and not its material, with the area strain
/// s = ln(dA/dA0) as a field on it. With U the fluid velocity at the membrane and V + Omega x r the rigid motion of its shape
/// (vesicle/rigid_motion.h), the mesh moves with W and the membrane slips over it with w:
///   dX/dt = W = (n.U) n + P (V + Omega x r + lambda d),   ds/dt = div U - w.grad s,   w = U - W,   P = I - n n^T.
/// In tank-treading the mesh then stands still and nothing at all changes: steady states do not depend on the time step. d leads along the
/// membrane down the mesh energy of vesicle/redistribution.h: without it a vesicle that changes its shape presses markers together, and waves
/// that are short for the fluid's grid and long for the mesh grow (relax_mesh).
///
/// A step is BDF2 in the increments d = y^{k+1} - y^k of y = (X, s), forces and velocities being taken at the extrapolated state
/// y* = y^k + r d^k (r = dt over the last dt; a0, a1 the coefficients of BDF2), with a linearly implicit correction:
///   (a0 + Z_n + dt w.grad) d^{k+1} = (a1 + r (Z_n + dt w.grad)) d^k + dt (W, ds/dt)*
/// Z_n is dt times the rate at which a mode of degree n relaxes by tension and bending (MembraneResponse), overestimated on
/// purpose: the recurrence is stable if Z is at least 3/4 of the true rate, and exact to second order for any Z, as Z only meets
/// d^{k+1} - r d^k. Where the mesh is pressed together, at a rim or a tip, waves of degree n are shorter and relax faster: Z_n is no less than
/// dt times the fastest of their rates (fastest_rate). So the step is limited by accuracy, not by sigma0: sigma0 may be so large that strains are negligible.
/// A fluid with inertia, or with a viscosity that is explicit in part, must be told of the velocities that the corrections stand
/// for: the next steps hand it the forces that its terms at old times lack (owed_force). Without them Z meets a fluid that does
/// not remember, and the recurrence grows by up to a half in each step.
///
/// Area and volume are exact after each step: their rates are taken out of W (ConservationProjection::remove_rates; without it the
/// correction that follows, of which Z does not know, makes the scheme first order), and the displacement is corrected along smooth
/// directions (correct_displacement). s is then the Lagrange multiplier of its own equation.
///
/// Near spheres that ends. With the mean strain m, int exp(-s) dA = A exp(-m), all of m that is not ln(A/A0) has been taken off the area by
/// projections. A shape of excess area e (over the sphere's, less 1) can give no more than e, and deviates from a sphere by f, e = 2 f^2 (root mean
/// square, in radii); the tension that holds it in a flow grows like 1/f. So the area is kept
///   - while |m| <= 4 e. Beyond, m = ln(A/A0) + 4 e: the membrane is elastic there, and tends to the elastic sphere, m = ln(A/A0), as e does to 0.
///     There the tension is also soft enough for its mean to be explicit, as a uniform tension acts on the deviation alone;
///   - unless a step of the undisturbed flow moves a sphere by more than f, or the correction would be larger than f.
/// Where the area is not kept the volume is, and a constant is added to ds/dt and to s, so that m and the area stay together: what the
/// membrane leaks, the correction of the volume and the errors of steps are in div U, but not in the area (not with membrane.volume = "none", where
/// nothing is corrected). An area is never farther from A0
/// than some local one. Degrees kept: those the fluid's grid resolves, k h < 0.7 pi, and n < 2N/3; the highest are damped a little
/// (their waves would grow on the slip).
class ShapeFollowing : public MembraneMotion {
 public:
  ShapeFollowing(const SimulationParameters& parameters, const Flow& flow, std::size_t vesicle,
                 const vesicle::Membrane& membrane);

  bool predict(double dt, vesicle::Membrane& membrane) override;
  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override;
  void mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) override;
  const vesicle::VectorField* owed_force() const override { return owes_ ? &owed_force_ : nullptr; }
  std::optional<double> position_error() const override { return position_error_; }

  MotionEntries entries() const override { return entries_; }
  MarkerStatistics statistics() const override { return {steps_, 0, steps_}; }

  std::span<const double> history() const override;
  void restore_history(double dt, std::span<const double> history) override;
  void restart() override;

  /// Degrees of the spherical harmonics that positions and strain keep.
  static int resolved_degrees(const SimulationParameters& parameters, std::size_t vesicle, double radius);

 protected:
  // Columns of a state: X, and s if there is tension.
  using State = Eigen::ArrayXXd;

  // Real and imaginary parts.
  static Eigen::Map<Eigen::VectorXd> as_vector(vesicle::Coefficients& c);

  bool keeps_something() const { return keeps_volume_ || keeps_area_; }
  bool has_tension() const { return sigma0_ > 0.0; }
  int fields() const { return has_tension() ? 4 : 3; }
  double step_ratio(double dt) const { return previous_dt_ > 0.0 ? dt / previous_dt_ : 0.0; }

  void set_units(double length);
  void start(vesicle::Membrane& membrane);
  void find_mesh_velocity(double dt, const vesicle::Surface& surface, const MarkerVelocities& velocities);
  void relax_mesh(double dt, const vesicle::Surface& surface);
  double greatest_compression(const vesicle::Surface& surface) const;
  void find_rates(const vesicle::Surface& surface);
  double normal_force(double wavenumber) const;
  double fastest_rate(int n, double compression) const;
  void find_stiffness(double dt, const vesicle::Surface& surface);
  void solve_increment(double dt);
  void solve_implicit_terms(double dt);
  double largest_held_strain() const;
  bool can_keep_area(double dt, const vesicle::Membrane& membrane) const;
  void keep_rates(const vesicle::Surface& surface, vesicle::VectorField& velocity);
  void keep_displacement(const vesicle::Surface& surface, vesicle::VectorField& displacement);
  bool try_to_keep_area(const vesicle::Surface& surface, vesicle::VectorField& displacement);
  void conserve(const vesicle::Surface& surface);
  void tie_strain_rate(const vesicle::Surface& surface);
  void tie_strain(vesicle::Membrane& membrane);
  void estimate_error(double ratio);
  void finish(double dt, vesicle::Membrane& membrane);
  void keep_corrections();
  void find_owed_force(double dt, const vesicle::Surface& surface);
  void apply_operator(const Gmres::Vector& x, Gmres::Vector& result);

  double sigma0_, bending_, reynolds_number_, radius_;
  double length_ = 1.0;  // effective radius of the scene, the unit of lengths where a tolerance needs one
  std::optional<double> overestimate_;  // Z over the rates of MembraneResponse, if not what a step with a lag needs
  double solved_viscosity_, explicit_viscosity_;  // of the solve of a step, and what its explicit term takes off it
  double remembered_viscosity_ = 0.0;             // of the explicit one, what the fluid is told of
  double lagging_viscosity_ = 0.0;                // what the explicit term adds to the overestimate
  bool has_inertia_, is_thin_, extrapolates_viscosity_, keeps_volume_, keeps_area_ = false, ties_strain_ = false;
  double strain_rate_ = 0.0;  // of the undisturbed flow, where it is known
  double excess_area_ = 0.0;  // of the area to be kept: over that of the sphere of the same volume, less 1
  MirrorSymmetry symmetry_;
  vesicle::SphericalHarmonics harmonics_;
  MembraneResponse response_;
  std::optional<vesicle::ConservationProjection> volume_and_area_, volume_;
  Gmres gmres_{40};
  Gmres::Operator operator_;

  // The state and what its history is made of.
  State state_, increment_;                              // y^k, d^k
  vesicle::VectorField curvature_of_path_, bend_;        // dt^2 d^2X/dt^2 of the last step, and of this
  vesicle::Coefficients correction_, older_correction_;  // of the forces, by the last two steps
  double previous_dt_ = 0.0;
  int corrections_ = 0;
  int smooth_steps_ = 0;  // since a start
  bool knows_state_ = false, knows_strain_ = false;
  long steps_ = 0;
  MotionEntries entries_;
  std::optional<double> position_error_;

  // Work space of a step.
  struct Stiffness {
    double position = 0.0, strain = 0.0;              // Z_n
    double position_force = 0.0, strain_force = 0.0;  // per position and strain
    double damping = 0.0;
  };
  std::vector<Stiffness> stiffness_;
  State predicted_, rates_, theta_, phi_;
  double largest_tension_ = 0.0, largest_speed_ = 0.0, leading_ = 1.0, last_ = 0.0,
         acceleration_ = 0.0;  // a0, a1, Re a0/dt
  vesicle::VectorField positions_, velocity_, mesh_velocity_, vectors_, uncorrected_, owed_force_;
  vesicle::ScalarField strain_, divergence_, normal_velocity_, slip_theta_, slip_phi_;
  vesicle::Coefficients velocity_coefficients_, coefficients_, increment_coefficients_, predicted_coefficients_;
  Gmres::Vector units_, inverse_diagonal_, right_side_, solution_;
  bool owes_ = false, keeps_area_now_ = false;
  mutable std::vector<double> history_;
};

}  // namespace vesiflow::coupling
