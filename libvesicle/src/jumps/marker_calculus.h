// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "jumps/triple.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// What surface derivatives need of the geometry, at the markers, with a, b, c = theta, phi:
/// the normal n, the dual tangents X^a, S X^a with S = grad_s n (so that S X_a = n_a), the Christoffel symbols
/// Gamma^c_ab = X^c . X_ab, kappa = tr S = 2 H and |S|^2 = S : S = 4 H^2 - 2 K.
class MarkerCalculus {
 public:
  explicit MarkerCalculus(const SphereGrid& grid);

  /// Takes the geometry of a surface on that grid.
  void update(const Surface& surface);

  /// Of one marker, in registers.
  struct Local {
    Triple normal, dual_theta, dual_phi, curved_theta, curved_phi;
    // Gamma^theta and Gamma^phi, of theta theta, theta phi, phi phi
    double theta[3], phi[3];
    double trace, square;

    /// grad_s of a scalar from its derivatives.
    Triple gradient(double f_theta, double f_phi) const { return f_theta * dual_theta + f_phi * dual_phi; }
    /// S grad_s of a scalar.
    Triple curved_gradient(double f_theta, double f_phi) const { return f_theta * curved_theta + f_phi * curved_phi; }
    /// div_s of a vector.
    double divergence(const Triple& v_theta, const Triple& v_phi) const {
      return dot(v_theta, dual_theta) + dot(v_phi, dual_phi);
    }
    /// S : grad_s of a vector.
    double curved_divergence(const Triple& v_theta, const Triple& v_phi) const {
      return dot(v_theta, curved_theta) + dot(v_phi, curved_phi);
    }
    /// (grad_s v . n)_i = n_j d_i v_j.
    Triple gradient_of_normal_part(const Triple& v_theta, const Triple& v_phi) const {
      return gradient(dot(v_theta, normal), dot(v_phi, normal));
    }
    /// Covariant second derivative f_ab - Gamma^c_ab f_c of a scalar or, component by component, of a vector; `which` is 0
    /// for theta theta, 1 for theta phi, 2 for phi phi.
    template <class Value>
    Value covariant(int which, const Value& f_ab, const Value& f_theta, const Value& f_phi) const {
      return f_ab - theta[which] * f_theta - phi[which] * f_phi;
    }
    /// Lap_s from the covariant second derivatives.
    template <class Value>
    Value laplacian(const Value& tt, const Value& tp, const Value& pp) const {
      return dot(dual_theta, dual_theta) * tt + (2 * dot(dual_theta, dual_phi)) * tp + dot(dual_phi, dual_phi) * pp;
    }
    /// S : of the covariant second derivatives.
    template <class Value>
    Value curved_laplacian(const Value& tt, const Value& tp, const Value& pp) const {
      return dot(dual_theta, curved_theta) * tt + (2 * dot(dual_theta, curved_phi)) * tp +
             dot(dual_phi, curved_phi) * pp;
    }
    /// grad_s div_s of a vector, from its first and covariant second derivatives: X^b (X^a . v_;ab) - S X^a (n . v_a), as
    /// X^a turns by -(n . X^a_b) with the surface.
    Triple gradient_of_divergence(const Triple& v_theta, const Triple& v_phi, const Triple& tt, const Triple& tp,
                                  const Triple& pp) const {
      return gradient(divergence(tt, tp), divergence(tp, pp)) -
             curved_gradient(dot(v_theta, normal), dot(v_phi, normal));
    }
  };

  /// Plain pointers to all of it, for fused loops over markers.
  class View {
   public:
    explicit View(const MarkerCalculus& calculus);
    Local operator[](Eigen::Index k) const {
      return {normal_[k],
              dual_theta_[k],
              dual_phi_[k],
              curved_theta_[k],
              curved_phi_[k],
              {theta_tt_[k], theta_tp_[k], theta_pp_[k]},
              {phi_tt_[k], phi_tp_[k], phi_pp_[k]},
              trace_[k],
              square_[k]};
    }

   private:
    ConstTriples normal_, dual_theta_, dual_phi_, curved_theta_, curved_phi_;
    const double *theta_tt_, *theta_tp_, *theta_pp_, *phi_tt_, *phi_tp_, *phi_pp_, *trace_, *square_;
  };

  const ScalarField& trace() const { return trace_; }  ///< kappa, shape (markers)

 private:
  VectorField normal_, dual_theta_, dual_phi_, curved_theta_, curved_phi_;
  Eigen::Array<double, Eigen::Dynamic, 3> christoffel_theta_, christoffel_phi_;  // of theta theta, theta phi, phi phi
  ScalarField trace_, square_;
};

}  // namespace vesiflow::vesicle
