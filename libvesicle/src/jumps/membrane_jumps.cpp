// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/membrane_jumps.h"

#include <cmath>
#include <stdexcept>

#include "check.h"
#include "harmonics/check_grid.h"
#include "jumps/marker_calculus.h"
#include "surface/checked_grid.h"
#include "vesicle/scale_degrees.h"

namespace vesiflow::vesicle {
namespace {

const JumpParameters& checked(const JumpParameters& parameters, const SphereGrid& grid) {
  const auto check = [&](int degrees, const char* name) {
    check_argument(degrees >= 0 && degrees <= grid.latitudes(), name, degrees, "in [0, latitudes]");
  };
  check(parameters.degrees, "degrees");
  check(parameters.jump_degrees, "jump_degrees");
  return parameters;
}

int first_given(int degrees, int otherwise) {
  return degrees > 0 ? degrees : otherwise;
}

/// The smooth cut. At the first degree that is not kept it is exp(-36), of the size of rounding.
double taper(int n, int degrees) {
  constexpr double strength = 36;
  constexpr int order = 8;
  return std::exp(-strength * std::pow(double(n) / degrees, order));
}

/// First and covariant second derivatives of several fields, columns of the same arrays.
struct Derivatives {
  Derivatives(Eigen::Index size, int fields)
      : theta(size, fields), phi(size, fields), tt(size, fields), tp(size, fields), pp(size, fields) {}

  void evaluate(const SphericalHarmonics& harmonics, const Coefficients& coefficients) {
    const int n = coefficients.fields();
    harmonics.derivatives(coefficients, theta.leftCols(n), phi.leftCols(n), tt.leftCols(n), tp.leftCols(n),
                          pp.leftCols(n));
  }

  Eigen::ArrayXXd theta, phi, tt, tp, pp;
};

/// Plain pointers to the derivatives of a vector field: three columns from `first` on.
struct VectorDerivatives {
  explicit VectorDerivatives(const Derivatives& d, int first = 0)
      : theta(d.theta, first), phi(d.phi, first), tt(d.tt, first), tp(d.tp, first), pp(d.pp, first) {}

  ConstTriples theta, phi, tt, tp, pp;
};

/// The same of a scalar: one column.
struct ScalarDerivatives {
  explicit ScalarDerivatives(const Derivatives& d, int column = 0)
      : theta(d.theta.col(column).data()),
        phi(d.phi.col(column).data()),
        tt(d.tt.col(column).data()),
        tp(d.tp.col(column).data()),
        pp(d.pp.col(column).data()) {}

  const double *theta, *phi, *tt, *tp, *pp;
};

}  // namespace

/// In two stages, each a transform and a loop over the markers: from F and the derivatives of q the primary jumps,
/// [p], [u_n] and the part e of [p_n] that has q; from their derivatives all others.
class MembraneJumps::Implementation {
 public:
  Implementation(const SphereGrid& grid, const JumpParameters& parameters)
      : grid_(checked(grid)),
        parameters_(checked(parameters, grid)),
        of_fields_(first_given(parameters.degrees, grid.latitudes()), grid),
        of_jumps_(first_given(parameters.jump_degrees, of_fields_.degrees()), grid),
        all_(grid.latitudes(), grid),
        calculus_(grid),
        primary_(grid.size(), primary_fields),
        jumps_(Eigen::ArrayXXd::Zero(grid.size(), JumpColumns::with_velocity_jump)),
        force_(grid.size(), 3),
        derivatives_(grid.size(), primary_fields) {}

  const SphereGrid& grid() const { return grid_; }
  const JumpParameters& parameters() const { return parameters_; }
  bool has_velocity_jump() const { return columns_ == JumpColumns::with_velocity_jump; }
  const Coefficients& coefficients() const { return coefficients_; }
  Eigen::Ref<const Eigen::ArrayXXd> at_markers() const { return jumps_.leftCols(columns_); }

  void update(const Surface& surface) {
    check_grid(surface.grid(), "surface", grid_);
    calculus_.update(surface);
    has_shape_ = true;
    has_trace_gradient_ = false;
  }

  void compute(const VectorField& force) {
    check(force, "force", "a force");
    columns_ = JumpColumns::without_velocity_jump;
    primary_jumps(filtered(force));
    derive<false>();
    expand(of_jumps_, jumps_.leftCols(columns_), coefficients_);
  }

  void compute(const VectorField& force, const VectorField& velocity_jump) {
    check(force, "force", "a force");
    check(velocity_jump, "velocity_jump", "a velocity jump");
    columns_ = JumpColumns::with_velocity_jump;
    differentiate(velocity_jump);
    find_trace_gradient();
    primary_jumps_with_velocity(filtered(force));
    derive<true>();
    expand(of_jumps_, jumps_.leftCols(columns_), coefficients_);
  }

 private:
  static constexpr int pressure_field = 0, velocity_field = 1, rest_field = 4, primary_fields = 5;

  void check(const VectorField& field, const char* name, const char* value) const {
    check_markers(field, name, grid_.size());
    check_finite(field, value);
    if (!has_shape_) throw std::logic_error("MembraneJumps::compute() before update()");
  }

  /// Coefficients of the degrees that are kept.
  void expand(const SphericalHarmonics& kept, const SphericalHarmonics::Input& values,
              Coefficients& coefficients) const {
    kept.analysis(values, coefficients);
    if (kept.degrees() < grid_.latitudes() && parameters_.cut == DegreeCut::smooth)
      scale_degrees(coefficients, [&](int n) { return taper(n, kept.degrees()); });
  }

  const VectorField& filtered(const VectorField& force) {
    if (parameters_.degrees == 0) return force;
    expand(of_fields_, force, field_coefficients_);
    of_fields_.synthesis(field_coefficients_, force_);
    return force_;
  }

  /// Writes [u] and takes the derivatives of q.
  void differentiate(const VectorField& velocity_jump) {
    auto values = jumps_.middleCols<3>(JumpColumns::velocity);
    expand(of_fields_, velocity_jump, field_coefficients_);
    if (parameters_.degrees == 0)
      values = velocity_jump;
    else
      of_fields_.synthesis(field_coefficients_, values);
    derivatives_.evaluate(of_fields_, field_coefficients_);
  }

  void find_trace_gradient() {
    if (has_trace_gradient_) return;
    trace_derivatives_.resize(grid_.size(), 2);
    all_.analysis(calculus_.trace(), trace_coefficients_);
    all_.gradient(trace_coefficients_, trace_derivatives_.col(0), trace_derivatives_.col(1));
    has_trace_gradient_ = true;
  }

  /// [p] and [u_n] for q = 0.
  void primary_jumps(const VectorField& force) {
    const MarkerCalculus::View calculus(calculus_);
    const ConstTriples f(force);
    double* const p = primary_.col(pressure_field).data();
    const Triples u_n(primary_, velocity_field);
    const Eigen::Index size = grid_.size();
#pragma GCC ivdep
    for (Eigen::Index k = 0; k < size; ++k) {
      const Triple n = calculus[k].normal;
      p[k] = dot(f[k], n);
      u_n.set(k, p[k] * n - f[k]);
    }
  }

  /// [p], [u_n], the part of [p_n] that is not -div_s [u_n], and what q adds to [u_nn] and [u_nnn].
  void primary_jumps_with_velocity(const VectorField& force) {
    const MarkerCalculus::View calculus(calculus_);
    const VectorDerivatives q(derivatives_);
    const ConstTriples f(force);
    const double* const trace_theta = trace_derivatives_.col(0).data();
    const double* const trace_phi = trace_derivatives_.col(1).data();
    double* const p = primary_.col(pressure_field).data();
    double* const rest = primary_.col(rest_field).data();
    const Triples u_n(primary_, velocity_field);
    const Triples u_nn(jumps_, JumpColumns::velocity_second_normal), u_nnn(jumps_, JumpColumns::velocity_third_normal);
    const Eigen::Index size = grid_.size();
#pragma GCC ivdep
    for (Eigen::Index k = 0; k < size; ++k) {
      const MarkerCalculus::Local c = calculus[k];
      const Triple n = c.normal, q_theta = q.theta[k], q_phi = q.phi[k];
      const Triple tt = c.covariant(0, q.tt[k], q_theta, q_phi);
      const Triple tp = c.covariant(1, q.tp[k], q_theta, q_phi);
      const Triple pp = c.covariant(2, q.pp[k], q_theta, q_phi);
      const Triple laplacian = c.laplacian(tt, tp, pp);
      const double divergence = c.divergence(q_theta, q_phi), normal_force = dot(f[k], n);
      p[k] = normal_force - 2 * divergence;
      u_n.set(k, (normal_force - divergence) * n - f[k] - c.gradient_of_normal_part(q_theta, q_phi));
      rest[k] = c.curved_divergence(q_theta, q_phi) - c.trace * divergence + dot(n, laplacian);
      u_nn.set(k, -laplacian);
      // -grad kappa . grad q + 2 div (S grad q), with div S = grad kappa on the surface (Codazzi)
      const Triple trace_gradient = c.gradient(trace_theta[k], trace_phi[k]);
      u_nnn.set(k, dot(trace_gradient, c.dual_theta) * q_theta + dot(trace_gradient, c.dual_phi) * q_phi +
                       2 * c.curved_laplacian(tt, tp, pp));
    }
  }

  /// All jumps from the primary ones.
  template <bool velocity_jump>
  void derive() {
    all_.analysis(primary_.leftCols(velocity_jump ? primary_fields : rest_field), primary_coefficients_);
    derivatives_.evaluate(all_, primary_coefficients_);
    const MarkerCalculus::View calculus(calculus_);
    const ScalarDerivatives dp(derivatives_, pressure_field), de(derivatives_, rest_field);
    const VectorDerivatives da(derivatives_, velocity_field);
    const double* const pressure = primary_.col(pressure_field).data();
    const double* const rest = primary_.col(rest_field).data();
    const ConstTriples velocity_normal(primary_, velocity_field);
    double* const p = jumps_.col(JumpColumns::pressure).data();
    double* const p_n = jumps_.col(JumpColumns::pressure_normal).data();
    double* const p_nn = jumps_.col(JumpColumns::pressure_second_normal).data();
    const Triples u_n(jumps_, JumpColumns::velocity_normal);
    const Triples u_nn(jumps_, JumpColumns::velocity_second_normal), u_nnn(jumps_, JumpColumns::velocity_third_normal);
    const Eigen::Index size = grid_.size();
#pragma GCC ivdep
    for (Eigen::Index k = 0; k < size; ++k) {
      const MarkerCalculus::Local c = calculus[k];
      const Triple a = velocity_normal[k], a_theta = da.theta[k], a_phi = da.phi[k];
      const Triple tt = c.covariant(0, da.tt[k], a_theta, a_phi);
      const Triple tp = c.covariant(1, da.tp[k], a_theta, a_phi);
      const Triple pp = c.covariant(2, da.pp[k], a_theta, a_phi);
      const double pressure_laplacian = c.laplacian(c.covariant(0, dp.tt[k], dp.theta[k], dp.phi[k]),
                                                    c.covariant(1, dp.tp[k], dp.theta[k], dp.phi[k]),
                                                    c.covariant(2, dp.pp[k], dp.theta[k], dp.phi[k]));
      double first = -c.divergence(a_theta, a_phi);
      Triple first_gradient = -c.gradient_of_divergence(a_theta, a_phi, tt, tp, pp);
      if constexpr (velocity_jump) {
        first += rest[k];
        first_gradient = first_gradient + c.gradient(de.theta[k], de.phi[k]);
      }
      const double second = -c.trace * first - pressure_laplacian;
      Triple second_velocity = first * c.normal + c.gradient(dp.theta[k], dp.phi[k]) - c.trace * a;
      if constexpr (velocity_jump) second_velocity = second_velocity + u_nn[k];
      Triple third_velocity = second * c.normal + first_gradient - c.curved_gradient(dp.theta[k], dp.phi[k]) -
                              c.trace * second_velocity + c.square * a - c.laplacian(tt, tp, pp);
      if constexpr (velocity_jump) third_velocity = third_velocity + u_nnn[k];
      p[k] = pressure[k];
      p_n[k] = first;
      p_nn[k] = second;
      u_n.set(k, a);
      u_nn.set(k, second_velocity);
      u_nnn.set(k, third_velocity);
    }
  }

  SphereGrid grid_;
  JumpParameters parameters_;
  SphericalHarmonics of_fields_;  // of the degrees of F and q that are kept
  SphericalHarmonics of_jumps_;   // of those of the jumps
  SphericalHarmonics all_;
  MarkerCalculus calculus_;
  bool has_shape_ = false;
  bool has_trace_gradient_ = false;  // only q needs it
  Eigen::ArrayXXd trace_derivatives_;
  Eigen::ArrayXXd primary_;  // [p], [u_n] and the rest of [p_n]
  Eigen::ArrayXXd jumps_;
  int columns_ = JumpColumns::without_velocity_jump;
  VectorField force_;
  Derivatives derivatives_;
  Coefficients field_coefficients_, primary_coefficients_, trace_coefficients_, coefficients_;
};

MembraneJumps::MembraneJumps(const SphereGrid& grid, const JumpParameters& parameters)
    : implementation_(std::make_unique<Implementation>(grid, parameters)) {}
MembraneJumps::~MembraneJumps() = default;
MembraneJumps::MembraneJumps(MembraneJumps&&) noexcept = default;
MembraneJumps& MembraneJumps::operator=(MembraneJumps&&) noexcept = default;

const SphereGrid& MembraneJumps::grid() const {
  return implementation_->grid();
}
const JumpParameters& MembraneJumps::parameters() const {
  return implementation_->parameters();
}

void MembraneJumps::update(const Surface& surface) {
  implementation_->update(surface);
}

void MembraneJumps::compute(const VectorField& force) {
  implementation_->compute(force);
}

void MembraneJumps::compute(const VectorField& force, const VectorField& velocity_jump) {
  implementation_->compute(force, velocity_jump);
}

bool MembraneJumps::has_velocity_jump() const {
  return implementation_->has_velocity_jump();
}

const Coefficients& MembraneJumps::coefficients() const {
  return implementation_->coefficients();
}

Eigen::Ref<const Eigen::ArrayXXd> MembraneJumps::at_markers() const {
  return implementation_->at_markers();
}

}  // namespace vesiflow::vesicle
