// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <memory>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// A field f at the nodes of a grid or one of its partial derivatives with respect to theta and phi.
enum class Derivative {
  value,        ///< f
  theta,        ///< f_theta
  phi,          ///< f_phi
  theta_theta,  ///< f_theta_theta
  theta_phi,    ///< f_theta_phi
  phi_phi       ///< f_phi_phi
};

/// Scalar spherical-harmonic transforms of several real fields at once, Eqs. (23)-(30) of the paper in the
/// fully normalised complex convention
///
///     f(theta, phi) = sum_{n<p} [ f_n^0 Y_n^0 + 2 Re sum_{m=1}^n f_n^m Y_n^m ],
///     Y_n^m = P_n^m(cos theta) exp(i m phi),  int |Y_n^m|^2 = 1 over the unit sphere,
///
/// with P_n^m > 0 next to the north pole for all m >= 0 (no Condon-Shortley phase), so Y_0^0 = 1/sqrt(4 pi).
///
/// Fields are columns of arrays of shape (grid.size(), fields); derivatives are plain partial derivatives
/// with respect to theta and phi at the grid nodes. Derivatives of P_n^m use
///
///     dP_n^m/dtheta = 1/2 [ sqrt((n+m)(n-m+1)) P_n^{m-1} - sqrt((n-m)(n+m+1)) P_n^{m+1} ]
///
/// (once or twice) and so never divide by sin(theta). Tables are built in extended precision.
///
/// The number of degrees p is free of the grid:
/// - p <= latitudes: analysis is exact for fields of degree < p, and is the inverse of synthesis;
/// - p > latitudes: synthesis and derivatives are still the exact values of the expansion at the nodes (orders beyond
///   the longitudes' Nyquist order are folded onto the Fourier mode they equal there); analysis is refused.
/// Coefficients of more than p degrees may be given: the transform reads those with n < p, which makes it a
/// sharp low-pass filter.
///
/// Adjoints are those of the real inner products sum over nodes and fields of f g, and Coefficients::dot.
///
/// FFTW plans are made by estimate and not by measurement: measured plans differ from process to process and
/// a restarted run would then not repeat the uninterrupted one bit for bit.
///
/// A transform owns its work space and must not be used by two threads at once; different transforms may, and those
/// of equal degrees and latitudes share their tables. It allocates on the first use of each function and when it
/// first meets a larger number of fields, never again; nothing at all is allocated for what prepare() was told of.
///
/// Large transforms use OpenMP threads, as many as OpenMP offered when the work space was made and at most one per
/// processor; inside a parallel region they are serial. The bits do not depend on the number of threads.
class VESIFLOW_VESICLE_EXPORT SphericalHarmonics {
 public:
  using Input = Eigen::Ref<const Eigen::ArrayXXd>;  ///< fields to read, as columns
  using Output = Eigen::Ref<Eigen::ArrayXXd>;       ///< fields to write, as columns

  /// Degrees 0 <= n < degrees on the given grid; work space for max_fields fields is allocated at once.
  /// \throws std::invalid_argument unless degrees >= 1 and max_fields >= 1.
  SphericalHarmonics(int degrees, const SphereGrid& grid, int max_fields = 3);
  ~SphericalHarmonics();
  SphericalHarmonics(SphericalHarmonics&&) noexcept;  ///< what is moved from can only be assigned to or destroyed
  SphericalHarmonics& operator=(SphericalHarmonics&&) noexcept;  ///< takes over tables and work space of another one

  int degrees() const;             ///< p
  const SphereGrid& grid() const;  ///< the grid of the nodes

  /// The functions that will be called; `derivatives` stands for all that return derivatives and for evaluate().
  struct Uses {
    bool analysis = false;     ///< analysis()
    bool synthesis = false;    ///< synthesis()
    bool gradient = false;     ///< gradient()
    bool derivatives = false;  ///< derivatives(), second_derivatives() and evaluate()
    bool adjoints = false;     ///< the adjoints of those above
  };

  /// Makes the tables and the work space of these functions for up to `fields` fields, after which they do not
  /// allocate.
  /// \throws std::invalid_argument unless fields >= 1.
  void prepare(const Uses& uses, int fields);

  /// Coefficients of `values`, Eqs. (24)-(25); resizes `coefficients` to (degrees, fields).
  /// \throws std::invalid_argument if values has not grid.size() rows.
  /// \throws std::logic_error if degrees > latitudes.
  void analysis(const Input& values, Coefficients& coefficients) const;

  /// Values at the nodes, Eq. (23).
  /// \throws std::invalid_argument if an output is not (grid().size(), fields) or the coefficients have too few
  /// degrees. So do the functions below.
  void synthesis(const Coefficients& coefficients, Output values) const;

  /// First derivatives, Eqs. (26)-(27).
  void gradient(const Coefficients& coefficients, Output theta, Output phi) const;

  /// Second derivatives, Eqs. (28)-(30).
  void second_derivatives(const Coefficients& coefficients, Output theta_theta, Output theta_phi, Output phi_phi) const;

  /// First and second derivatives, from three sets of Legendre sums instead of five.
  void derivatives(const Coefficients& coefficients, Output theta, Output phi, Output theta_theta, Output theta_phi,
                   Output phi_phi) const;

  /// One derivative that evaluate() is asked for.
  struct Request {
    Derivative derivative;  ///< which one
    Output values;          ///< where it goes, shape (grid().size(), fields)
  };
  /// Any of the derivatives, for as few Legendre sums: those of {value, phi, phi_phi}, {theta, theta_phi} and
  /// {theta_theta} are shared.
  /// \throws std::invalid_argument if a derivative is asked for twice.
  void evaluate(const Coefficients& coefficients, std::initializer_list<Request> requests) const;

  /// values = w_j dphi times the synthesis.
  /// \throws std::logic_error if degrees > latitudes.
  void analysis_adjoint(const Coefficients& coefficients, Output values) const;

  /// f_n^m = sum over the nodes of f conj(Y_n^m); resizes `coefficients` to (degrees, fields).
  /// \throws std::invalid_argument if an input is not (grid().size(), fields). So do the functions below.
  void synthesis_adjoint(const Input& values, Coefficients& coefficients) const;
  /// Adjoint of gradient(); resizes `coefficients` to (degrees, fields).
  void gradient_adjoint(const Input& theta, const Input& phi, Coefficients& coefficients) const;
  /// Adjoint of second_derivatives(); resizes `coefficients` to (degrees, fields).
  void second_derivatives_adjoint(const Input& theta_theta, const Input& theta_phi, const Input& phi_phi,
                                  Coefficients& coefficients) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vesiflow::vesicle
