#include "shape_following.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "coupling/flow.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling {
namespace {

using vesicle::Coefficients;
using vesicle::Surface;
using vesicle::VectorField;

// Directions of the conserving displacements; with 16 degrees, what they add to the shape feeds on itself.
constexpr int smooth_degrees = 5;
// The highest degree decays at this many times the rate at which the membrane is swept along, degree n by (n/p)^8 of it: waves
// near the resolution of the grid, which the fluid hardly feels, would otherwise grow. With degrees up to k h = 0.95 pi and 8 here they
// grew at 128^3 by a factor 2 in unit time, from the tips (validation/integrators.md).
constexpr double damping = 16.0;
constexpr double gmres_tolerance = 1e-4, worst_residual = 1e-2;
// Z over the rates of MembraneResponse, without inertia and where inertia dominates the response (seen by trial: 1.5 is unstable there at
// Re = 1). With the correction of the thickness the first is multiplied by the square of the mesh's greatest compression, as waves of a
// degree are so much shorter at the tips and the membrane now answers to them: 1.5 stops at reduced volume 0.65 and 0.7 (h = 0.1),
// 3 at 0.8 off the axis of a Poiseuille flow (h = 0.05, t = 1.7).
constexpr double safety = 1.5, safety_with_inertia = 3.0;
// More where part of the viscosity is explicit: 30 in all at ratio 20, 7 at 5, with half of what the explicit term owes to velocities that
// the fluid never had (viscous_memory). With 10 and all of it fine grids are unstable (noise grows by 1.3 in a step at 128^3, ratio 5,
// dt = 1/24), with 10 and 0.8 of it a tank-treading vesicle of reduced volume 0.8 at ratio 6 stops at t = 13 (h = 0.1, dt = 1/32): surface
// divergence 0.1 to 0.2 there at t = 8, against 0.001 with these. A thin or pointed end has less of the inner fluid around it than the half that the
// model gives it. Price: errors of the step 1.3 to 2 times larger (still of second order).
// Around a thin fluid 9 in all at ratio 0.05, and 0.8 is owed: with half of it ratio 0.05 makes noise at 1/48. What an extrapolated viscosity leaves in the
// fluid decays at 5 times the shear rate there whatever the step, so that short steps see many of their past corrections and small errors of
// the answers feed on themselves: with 3 in all noise grows at 4 to 9 times the shear rate from round-off at steps of 1/96 and 1/192 (stop at
// t = 4 to 7), with 7 at 1.5 times at 1/96, with 9 it falls at 1/48 to 1/384. At 1/24 it falls for ratio 0.2, and grows slowly for 0.05, where the plan
// warns of that step (11 stops there). All of it owed is worse at 1/24, and quiet at 1/96 and 1/192 within 5 % of it only.
constexpr double safety_per_ratio = 3.0, viscous_memory = 0.5, safety_of_thin_fluid = 16.0, memory_of_thin_fluid = 0.8;
// Where a membrane is curved as strongly as its viscous layer (of thickness delta, delta^2 = mu/a) is thick, the fluid remembers less than around
// a plane sheet: 1/(1 + (4 delta H)^2) of it, H being the greatest mean curvature. At sigma0 = 2000 all of it is unstable at the
// rim of an ellipsoid 3:3:1 (Re = 1, 64^3, at any step), 0.6 of it is not; around a prolate of reduced volume 0.9 (Re = 10, 24^3, dt = 1/48)
// noise grows with 0.7 of it.
constexpr double layer_of_curvature = 4.0;

// Of waves that the fluid's grid resolves on a sphere.
int grid_degrees(const SimulationParameters& parameters, double radius) {
  constexpr double largest_kh = 0.7 * std::numbers::pi;
  return static_cast<int>(largest_kh * radius / parameters.spacing());
}

// A correction of the thickness makes the answer that of a thin membrane.
MembraneResponse::SecondMoments thickness(const SimulationParameters& parameters) {
  if (parameters.coupling.thickness_correction) return {};
  return MembraneResponse::second_moments(parameters.coupling.kernel);
}

}  // namespace

Eigen::Map<Eigen::VectorXd> ShapeFollowing::as_vector(Coefficients& c) {
  return {reinterpret_cast<double*>(c.block(0, 0)), Eigen::Index(c.fields()) * c.degrees() * (c.degrees() + 1)};
}

int ShapeFollowing::resolved_degrees(const SimulationParameters& parameters, std::size_t vesicle, double radius) {
  const int latitudes = parameters.latitudes(vesicle);
  const int chosen =
      parameters.mesh.normal_degrees > 0 ? parameters.mesh.normal_degrees : vesicle::two_thirds_degrees(latitudes);
  return std::max(4, std::min(chosen, grid_degrees(parameters, radius)));
}

ShapeFollowing::ShapeFollowing(const SimulationParameters& parameters, const Flow& flow, std::size_t number,
                               const vesicle::Membrane& membrane)
    : sigma0_(membrane.parameters().sigma0),
      bending_(0.25 / membrane.parameters().capillary_number),
      reynolds_number_(parameters.fluid.reynolds_number),
      radius_(std::sqrt(membrane.initial_area() / (4.0 * std::numbers::pi))),
      has_inertia_(parameters.fluid.inertia != fluid::Inertia::none),
      is_thin_(parameters.coupling.thickness_correction),
      extrapolates_viscosity_(parameters.fluid.viscous_treatment == fluid::ViscousTreatment::extrapolated),
      keeps_volume_(parameters.membrane.volume == vesicle::VolumeControl::projection),
      symmetry_(parameters, membrane.positions()),
      harmonics_(resolved_degrees(parameters, number, radius_), membrane.surface().grid(), fields()),
      response_(std::max(harmonics_.degrees(), grid_degrees(parameters, radius_)), radius_, parameters.finest_spacing(),
                thickness(parameters)),
      operator_([this](const Gmres::Vector& x, Gmres::Vector& result) { apply_operator(x, result); }),
      stiffness_(static_cast<std::size_t>(harmonics_.degrees())) {
  const Eigen::Index markers = membrane.positions().rows();
  for (State* field : {&state_, &increment_, &predicted_, &rates_, &theta_, &phi_})
    *field = State::Zero(markers, fields());
  for (VectorField* field :
       {&positions_, &velocity_, &mesh_velocity_, &vectors_, &uncorrected_, &owed_force_, &curvature_of_path_, &bend_})
    *field = VectorField::Zero(markers, 3);
  coefficients_.resize(harmonics_.degrees(), fields());
  correction_ = older_correction_ = increment_coefficients_ = predicted_coefficients_ = coefficients_;
  correction_.set_zero();
  older_correction_.set_zero();
  set_units(parameters.vesicles[number].radius);
  solved_viscosity_ = 0.5 * (1.0 + parameters.viscosity_ratio(number));
  explicit_viscosity_ = 0.0;
  if (parameters.has_viscosity_contrast() && has_inertia_ &&
      parameters.fluid.viscous_treatment != fluid::ViscousTreatment::implicit) {
    double largest = 1.0;
    for (std::size_t i = 0; i < parameters.vesicles.size(); ++i)
      largest = std::max(largest, parameters.viscosity_ratio(i));
    explicit_viscosity_ = largest - solved_viscosity_;
    solved_viscosity_ = largest;
    const double share = explicit_viscosity_ / solved_viscosity_;
    lagging_viscosity_ = safety_per_ratio * share * (solved_viscosity_ - 1.0);
    if (extrapolates_viscosity_ && parameters.viscosity_ratio(number) < 1.0)
      lagging_viscosity_ += safety_of_thin_fluid * share;
    remembered_viscosity_ =
        explicit_viscosity_ * (parameters.viscosity_ratio(number) < 1.0 ? memory_of_thin_fluid : viscous_memory);
  }
  vesicle::Conserved conserved;
  if (keeps_volume_) conserved.volume = membrane.initial_volume();
  strain_rate_ = flow.greatest_gradient;
  const double v = vesicle::reduced_volume(membrane.initial_area(), membrane.initial_volume());
  excess_area_ = std::max(0.0, 1.0 / std::cbrt(v * v) - 1.0);
  ties_strain_ = has_tension() && parameters.membrane.volume != vesicle::VolumeControl::none;
  keeps_area_ = has_tension() || parameters.membrane.area == vesicle::AreaControl::projection;
  volume_.emplace(membrane.surface().grid(), conserved, smooth_degrees);
  if (keeps_area_) conserved.area = membrane.initial_area();
  volume_and_area_.emplace(membrane.surface().grid(), conserved, smooth_degrees);
}

// Positions and strains are solved for together, and what is small of one must not depend on the unit of the other.
void ShapeFollowing::set_units(double length) {
  length_ = length;
  for (int n = 0; n < harmonics_.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < fields(); ++f) {
        const double unit = f < 3 ? length : 1.0;
        coefficients_(f, n, m) = {unit, unit};
      }
  units_ = as_vector(coefficients_);
}

// Takes the membrane's state. Markers that have no history with this motion are new to it: what their shape has in degrees that it does
// not keep would stand in space for good, so that goes, at the right volume and area.
void ShapeFollowing::start(vesicle::Membrane& membrane) {
  membrane.update_geometry();
  const Surface& surface = membrane.surface();
  vectors_ = membrane.positions();
  if (!knows_strain_) {
    if (has_tension()) state_.col(3) = (surface.area_weight() / membrane.target_areas()).log();
    harmonics_.analysis(vectors_, velocity_coefficients_);
    harmonics_.synthesis(velocity_coefficients_, vectors_);
    vectors_ -= membrane.positions();
    keeps_area_now_ = keeps_area_;
    if (keeps_something()) keep_displacement(surface, vectors_);
    vectors_ += membrane.positions();
  }
  state_.leftCols<3>() = vectors_;
  knows_state_ = knows_strain_ = true;
}

// y* = y^k + r d^k.
bool ShapeFollowing::predict(double dt, vesicle::Membrane& membrane) {
  const double r = step_ratio(dt);
  leading_ = (1.0 + 2.0 * r) / (1.0 + r);
  last_ = r * r / (1.0 + r);
  acceleration_ = has_inertia_ ? reynolds_number_ * leading_ / dt : 0.0;
  response_.update(acceleration_, solved_viscosity_);  // of this step: a restart has none of the last
  if (!knows_state_) start(membrane);
  predicted_ = state_ + r * increment_;
  positions_ = predicted_.leftCols<3>();
  strain_ = predicted_.col(fields() - 1);
  if (!has_tension()) strain_.setZero();
  membrane.move_to(positions_, strain_);
  keeps_area_now_ = can_keep_area(dt, membrane);
  find_owed_force(dt, membrane.surface());
  return true;
}

void ShapeFollowing::advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
                             MarkerVelocities& velocities) {
  const Surface& surface = membrane.surface();
  largest_tension_ = std::max(0.0, membrane.tension().maxCoeff());
  velocity_at(surface.positions(), velocities.fluid);
  find_mesh_velocity(dt, surface, velocities);
  velocities.membrane = velocity_;
  find_rates(surface);
  find_stiffness(dt, surface);
  solve_increment(dt);
  finish(dt, membrane);
}

// The end of a step whose increment is known, and its second difference in `theta_`.
void ShapeFollowing::finish(double dt, vesicle::Membrane& membrane) {
  estimate_error(step_ratio(dt));
  conserve(membrane.surface());
  symmetry_.apply(increment_);
  state_ += increment_;
  previous_dt_ = dt;
  ++steps_;
  positions_ = state_.leftCols<3>();
  if (has_tension()) strain_ = state_.col(3);
  membrane.move_to(positions_, strain_);
  if (ties_strain_ && !keeps_area_now_) tie_strain(membrane);
}

// (W, ds/dt) at the predicted state, and the slip w in the coordinates of the mesh. Volume and area are kept by the rates already:
// conserve() alone would add what the implicit terms have not met, unlike the increments of the past, an error of first order.
void ShapeFollowing::find_rates(const Surface& surface) {
  vectors_ = mesh_velocity_;
  if (keeps_something()) keep_rates(surface, vectors_);
  rates_.leftCols<3>() = vectors_;
  slip_theta_ = ((velocity_ - mesh_velocity_) * surface.geometry().dual_theta()).rowwise().sum();
  slip_phi_ = ((velocity_ - mesh_velocity_) * surface.geometry().dual_phi()).rowwise().sum();
  if (!has_tension()) return;
  ++entries_.strain;
  surface.divergence(velocity_, divergence_);
  surface.gradient(strain_, vectors_);
  rates_.col(3) = divergence_ - ((velocity_ - mesh_velocity_) * vectors_).rowwise().sum();
  if (ties_strain_ && !keeps_area_now_) tie_strain_rate(surface);
}

// Per displacement.
double ShapeFollowing::normal_force(double k) const {
  return k * k * (bending_ * k * k + largest_tension_);
}

// The rate at which waves of degree n relax where the mesh is pressed together most: there they are as short as those of up to
// `compression` times the degree on the sphere. A rim that is thinner than the sphere by 1.7 lets a wave that the fluid's grid resolves relax
// up to 1.7^3 times faster, which c = 1.5 alone does not cover: an oblate of reduced volume 0.85 across the flow at h = R/21 then had noise that grew by 1.4 in
// a step of 1/24, whatever sigma0. Three quarters of this rate are needed, and suffice at R/21 and R/32; a half is noisy. Coarser grids damp such waves.
double ShapeFollowing::fastest_rate(int n, double compression) const {
  if (is_thin_ || overestimate_) return 0.0;
  double fastest = 0.0;
  for (int m = n; m < response_.degrees() && m + 0.5 <= compression * (n + 0.5); ++m)
    fastest = std::max(fastest, normal_force(response_.wavenumber(m)) * response_[m].normal.velocity);
  return fastest;
}

void ShapeFollowing::find_stiffness(double dt, const Surface& surface) {
  const double inertia = acceleration_ / (acceleration_ + solved_viscosity_ / (radius_ * radius_));
  const double compression = greatest_compression(surface);
  const double least = is_thin_ ? safety * std::pow(compression, 2) : safety;
  const double lagging = least + std::max(0.0, safety_with_inertia - least) * inertia + lagging_viscosity_;
  const double c = overestimate_.value_or(lagging);
  // A uniform tension is all pressure but for the variation of the curvature, which acts as a force of low degree.
  double variance = 0.0;
  if (has_tension()) {
    const auto& h = surface.mean_curvature();
    const double mean = (h * surface.area_weight()).sum() / surface.area();
    variance = 4.0 * ((h - mean).square() * surface.area_weight()).sum() / surface.area();
  }
  const double top = std::pow(harmonics_.degrees() - 1, 8);
  for (int n = 0; n < harmonics_.degrees(); ++n) {
    const double k = response_.wavenumber(n);
    const MembraneResponse::Mode& mode = response_[n];
    const double force = std::max(c * normal_force(k), fastest_rate(n, compression) / mode.normal.velocity);
    Stiffness& z = stiffness_[static_cast<std::size_t>(n)];
    z.position = dt * force * mode.normal.velocity;
    z.position_force = -force;
    z.strain = dt * c * sigma0_ * (n == 0 ? variance * response_[2].normal.velocity : k * k * mode.along.velocity);
    z.strain_force = c * sigma0_;
    z.damping = damping * largest_speed_ / radius_ * std::pow(n, 8) / top;
  }
}

// Solves for d^{k+1} - r d^k, which is small: the right-hand side is (a1 - a0 r) d^k + dt (rates - damping y*).
void ShapeFollowing::solve_increment(double dt) {
  const double r = step_ratio(dt);
  harmonics_.analysis(predicted_, predicted_coefficients_);
  harmonics_.analysis(increment_, increment_coefficients_);
  harmonics_.analysis(rates_, coefficients_);
  for (int n = 0; n < harmonics_.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < fields(); ++f)
        coefficients_(f, n, m) -= stiffness_[static_cast<std::size_t>(n)].damping * predicted_coefficients_(f, n, m);
  right_side_ = (last_ - leading_ * r) * as_vector(increment_coefficients_) + dt * as_vector(coefficients_);
  solve_implicit_terms(dt);

  as_vector(coefficients_) = solution_;
  if (has_inertia_) keep_corrections();
  harmonics_.synthesis(coefficients_, theta_);
  as_vector(coefficients_) += r * as_vector(increment_coefficients_);
  harmonics_.synthesis(coefficients_, increment_);
}

// Solves (a0 + Z + dt (damping + w.grad)) `solution_` = `right_side_`.
void ShapeFollowing::solve_implicit_terms(double dt) {
  slip_theta_ *= dt;
  slip_phi_ *= dt;
  for (int n = 0; n < harmonics_.degrees(); ++n) {
    const Stiffness& z = stiffness_[static_cast<std::size_t>(n)];
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < fields(); ++f) {
        const double inverse = 1.0 / (leading_ + (f < 3 ? z.position : z.strain) + dt * z.damping);
        coefficients_(f, n, m) = {inverse, inverse};
      }
  }
  inverse_diagonal_ = as_vector(coefficients_);
  right_side_.array() *= inverse_diagonal_.array() / units_.array();
  const Gmres::Report report = gmres_.solve(operator_, right_side_, gmres_tolerance, solution_);
  solution_.array() *= units_.array();
  if (!(report.residual < worst_residual))
    throw std::domain_error(
        "the implicit slip of the mesh was not found: the membrane is swept along by too many of its waves in a "
        "step; reduce time.step");
}

// x + (a0 + Z)^{-1} dt w.grad x.
void ShapeFollowing::apply_operator(const Gmres::Vector& x, Gmres::Vector& result) {
  as_vector(coefficients_) = x;
  harmonics_.gradient(coefficients_, theta_, phi_);
  for (int f = 0; f < fields(); ++f) theta_.col(f) = slip_theta_ * theta_.col(f) + slip_phi_ * phi_.col(f);
  harmonics_.analysis(theta_, coefficients_);
  result = as_vector(coefficients_);
  result.array() *= inverse_diagonal_.array();
  result += x;
}

// That of BDF2 is 2/9 of dt^3 d^3X/dt^3, the third difference of the path; `theta_` holds its second difference.
void ShapeFollowing::estimate_error(double ratio) {
  position_error_.reset();
  // d^{k+1} - r d^k is dt^2 (1 + 1/r)/2 times the second derivative; bend_ is dt^2 times it.
  bend_ = (ratio > 0.0 ? 2.0 * ratio / (1.0 + ratio) : 1.0) * theta_.leftCols<3>();
  if (smooth_steps_ >= 2) {
    const double squares = (bend_ - ratio * ratio * curvature_of_path_).square().sum();
    position_error_ = 2.0 / 9.0 * std::sqrt(squares / static_cast<double>(theta_.rows()));
  }
  curvature_of_path_ = bend_;
  ++smooth_steps_;
}

// What the implicit correction of this step is as a change of the forces: tension, and force per area.
void ShapeFollowing::keep_corrections() {
  std::swap(correction_, older_correction_);
  corrections_ = std::min(2, corrections_ + 1);
  for (int n = 0; n < harmonics_.degrees(); ++n) {
    const Stiffness& z = stiffness_[static_cast<std::size_t>(n)];
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < fields(); ++f)
        correction_(f, n, m) = (f < 3 ? z.position_force : z.strain_force) * coefficients_(f, n, m);
  }
}

// What the terms of the fluid at old times lack: the time derivative Re/dt [(1+r) e^k - r^2/(1+r) e^{k-1}], and the explicit part
// of the viscosity at e^k or extrapolated, of the velocities e that the corrections stand for.
void ShapeFollowing::find_owed_force(double dt, const Surface& surface) {
  owes_ = has_inertia_ && corrections_ > 0;
  if (!owes_) return;
  const double r = step_ratio(dt);
  const double curved = layer_of_curvature * surface.mean_curvature().abs().maxCoeff();
  const double rate = reynolds_number_ / dt / (1.0 + curved * curved * solved_viscosity_ / acceleration_);
  const double inertia = rate * (1.0 + r), older_inertia = rate * r * r / (1.0 + r);
  const double viscosity = remembered_viscosity_ * (extrapolates_viscosity_ ? 1.0 + r : 1.0);
  const double older_viscosity = extrapolates_viscosity_ ? remembered_viscosity_ * r : 0.0;
  for (int n = 0; n < harmonics_.degrees(); ++n)
    for (int f = 0; f < fields(); ++f) {
      const auto& answer = f < 3 ? response_[n].normal : n == 0 ? response_[2].normal : response_[n].along;
      const double now = inertia * answer.inertia + viscosity * answer.viscosity;
      const double before = older_inertia * answer.inertia + older_viscosity * answer.viscosity;
      for (int m = 0; m <= n; ++m)
        coefficients_(f, n, m) = now * correction_(f, n, m) - before * older_correction_(f, n, m);
    }
  harmonics_.synthesis(coefficients_, theta_);
  owed_force_ = theta_.leftCols<3>();
  if (!has_tension()) return;
  divergence_ = theta_.col(3);
  surface.projector_divergence(divergence_, vectors_);
  owed_force_ += vectors_;
}

}  // namespace vesiflow::coupling
