// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/laplace_beltrami.h"

#include <array>
#include <optional>

#include "check.h"
#include "harmonics/check_grid.h"

namespace vesiflow::vesicle {
namespace {

/// div V = V_theta . X^theta + V_phi . X^phi, Eq. (12).
void cartesian_divergence(const SurfaceGeometry& geometry, const VectorField& theta, const VectorField& phi,
                          ScalarField& result) {
  result = (theta * geometry.dual_theta() + phi * geometry.dual_phi()).rowwise().sum();
}

}  // namespace

/// The surface has N degrees on the grid of its markers; an upsampling factor has p degrees on a fine grid.
class LaplaceBeltrami::Implementation {
 public:
  Implementation(const SphereGrid& grid, const LaplacianOptions& options)
      : options_(options), grid_(grid), theta_(grid.size(), 3), phi_(grid.size(), 3), second_(grid.size(), 3) {
    if (options.upsampling != Upsampling::automatic) level(options.upsampling);
  }

  const LaplacianOptions& options() const { return options_; }
  double last_factor() const { return last_factor_; }

  void apply(const Surface& surface, const ScalarField& scalar, ScalarField& result) {
    check_grid(surface.grid(), "surface", grid_);
    check_markers(scalar, "scalar", grid_.size());
    Level& fine = select(surface);
    surface.harmonics().analysis(scalar, coefficients_);
    const bool christoffel = options_.form == LaplacianForm::christoffel;
    if (!christoffel || options_.truncated)
      fine.geometry.update(fine.surface_degrees, surface.position_coefficients(),
                           christoffel ? GeometryDetail::curvature : GeometryDetail::first_form);
    evaluate(surface, fine, fine.surface_degrees, surface.harmonics(), result);
  }

  void of_mean_curvature(const Surface& surface, ScalarField& result) {
    check_grid(surface.grid(), "surface", grid_);
    Level& fine = select(surface);
    fine.geometry.update(fine.surface_degrees, surface.position_coefficients(), GeometryDetail::curvature);
    fine.all_degrees.analysis(fine.geometry.mean_curvature(), coefficients_);
    evaluate(surface, fine, fine.all_degrees, fine.all_degrees_at_markers, result);
  }

 private:
  struct Level {
    Level(const SphereGrid& coarse, Upsampling upsampling)
        : grid(upsampled_latitudes(coarse.latitudes(), upsampling),
               2 * upsampled_latitudes(coarse.longitudes() / 2, upsampling)),
          surface_degrees(coarse.latitudes(), grid),
          all_degrees(grid.latitudes(), grid),
          all_degrees_at_markers(grid.latitudes(), coarse),
          geometry(grid),
          theta(grid.size(), 3),
          phi(grid.size(), 3),
          second(grid.size(), 3),
          divergence(grid.size()) {}

    SphereGrid grid;
    SphericalHarmonics surface_degrees;         ///< N degrees on the fine grid
    SphericalHarmonics all_degrees;             ///< p degrees on the fine grid
    SphericalHarmonics all_degrees_at_markers;  ///< p degrees at the markers, exactly
    SurfaceGeometry geometry;
    VectorField theta, phi, second;
    ScalarField divergence;
  };

  Level& level(Upsampling upsampling) {
    auto& slot = levels_[static_cast<std::size_t>(upsampling)];
    if (!slot) slot.emplace(grid_, upsampling);
    return *slot;
  }

  Level& select(const Surface& surface) {
    const Upsampling upsampling = options_.upsampling == Upsampling::automatic
                                      ? choose_upsampling(mean_curvature_spectrum(surface))
                                      : options_.upsampling;
    last_factor_ = factor(upsampling);
    return level(upsampling);
  }

  /// Lap of the scalar with the coefficients coefficients_, given its transforms on the fine grid and at the markers.
  void evaluate(const Surface& surface, Level& fine, const SphericalHarmonics& on_fine_grid,
                const SphericalHarmonics& at_markers, ScalarField& result) {
    result.resize(grid_.size());
    switch (options_.form) {
      case LaplacianForm::cartesian:
        cartesian(surface, fine, on_fine_grid, result);
        break;
      case LaplacianForm::christoffel:
        if (options_.truncated)
          christoffel(fine.geometry, on_fine_grid, fine.theta, fine.phi, fine.second, fine.divergence);
        else
          christoffel(surface.geometry_with_curvature(), at_markers, theta_, phi_, second_, result);
        break;
      case LaplacianForm::paper:
        flux_form(fine, on_fine_grid, result);
        break;
    }
    if (options_.truncated) {
      fine.surface_degrees.analysis(fine.divergence, coefficients_);
      surface.harmonics().synthesis(coefficients_, result);
    }
  }

  /// Eqs. (11) and (12).
  void cartesian(const Surface& surface, Level& fine, const SphericalHarmonics& on_fine_grid, ScalarField& result) {
    auto theta = fine.theta.leftCols(1);
    auto phi = fine.phi.leftCols(1);
    on_fine_grid.gradient(coefficients_, theta, phi);
    VectorField& flux = fine.second;
    for (int component = 0; component < 3; ++component)
      flux.col(component) = theta.col(0) * fine.geometry.dual_theta().col(component) +
                            phi.col(0) * fine.geometry.dual_phi().col(component);
    fine.all_degrees.analysis(flux, vector_coefficients_);
    if (options_.truncated) {
      fine.all_degrees.gradient(vector_coefficients_, fine.theta, fine.phi);
      cartesian_divergence(fine.geometry, fine.theta, fine.phi, fine.divergence);
    } else {
      fine.all_degrees_at_markers.gradient(vector_coefficients_, theta_, phi_);
      cartesian_divergence(surface.geometry(), theta_, phi_, result);
    }
  }

  /// g^{ab} (f_ab - Gamma^c_ab f_c) with g^{ab} = X^a . X^b, at the nodes of the geometry.
  void christoffel(const SurfaceGeometry& geometry, const SphericalHarmonics& harmonics, VectorField& theta,
                   VectorField& phi, VectorField& second, ScalarField& result) const {
    auto f_theta = theta.leftCols(1);
    auto f_phi = phi.leftCols(1);
    harmonics.gradient(coefficients_, f_theta, f_phi);
    harmonics.second_derivatives(coefficients_, second.col(0), second.col(1), second.col(2));
    const VectorField& a = geometry.dual_theta();
    const VectorField& b = geometry.dual_phi();
    const auto covariant = [&](const auto& f_ab, const VectorField& x_ab) {
      return f_ab - (x_ab * a).rowwise().sum() * f_theta.col(0) - (x_ab * b).rowwise().sum() * f_phi.col(0);
    };
    result = a.square().rowwise().sum() * covariant(second.col(0), geometry.theta_theta());
    result += 2 * (a * b).rowwise().sum() * covariant(second.col(1), geometry.theta_phi());
    result += b.square().rowwise().sum() * covariant(second.col(2), geometry.phi_phi());
  }

  /// Eq. (14): the flux W grad f . X^theta, W grad f . X^phi is differentiated component by component.
  void flux_form(Level& fine, const SphericalHarmonics& on_fine_grid, ScalarField& result) {
    auto theta = fine.theta.leftCols(1);
    auto phi = fine.phi.leftCols(1);
    on_fine_grid.gradient(coefficients_, theta, phi);
    const VectorField& a = fine.geometry.dual_theta();
    const VectorField& b = fine.geometry.dual_phi();
    const ScalarField& w = fine.geometry.area_element();
    auto flux = fine.second.leftCols(2);
    flux.col(0) = w * (theta.col(0) * a.square().rowwise().sum() + phi.col(0) * (a * b).rowwise().sum());
    flux.col(1) = w * (theta.col(0) * (a * b).rowwise().sum() + phi.col(0) * b.square().rowwise().sum());
    fine.all_degrees.analysis(flux, vector_coefficients_);
    fine.all_degrees.gradient(vector_coefficients_, fine.theta.leftCols(2), fine.phi.leftCols(2));
    fine.divergence = (fine.theta.col(0) + fine.phi.col(1)) / w;
    if (options_.truncated) return;
    if (fine.grid == grid_) {
      result = fine.divergence;
    } else {
      fine.all_degrees.analysis(fine.divergence, coefficients_);
      fine.all_degrees_at_markers.synthesis(coefficients_, result);
    }
  }

  LaplacianOptions options_;
  SphereGrid grid_;
  std::array<std::optional<Level>, 3> levels_;
  Coefficients coefficients_, vector_coefficients_;
  VectorField theta_, phi_, second_;  ///< at the markers
  double last_factor_ = 0;
};

LaplaceBeltrami::LaplaceBeltrami(const SphereGrid& grid, const LaplacianOptions& options)
    : implementation_(std::make_unique<Implementation>(grid, options)) {}
LaplaceBeltrami::~LaplaceBeltrami() = default;
LaplaceBeltrami::LaplaceBeltrami(LaplaceBeltrami&&) noexcept = default;
LaplaceBeltrami& LaplaceBeltrami::operator=(LaplaceBeltrami&&) noexcept = default;

const LaplacianOptions& LaplaceBeltrami::options() const {
  return implementation_->options();
}

void LaplaceBeltrami::apply(const Surface& surface, const ScalarField& scalar, ScalarField& result) const {
  implementation_->apply(surface, scalar, result);
}

void LaplaceBeltrami::of_mean_curvature(const Surface& surface, ScalarField& result) const {
  implementation_->of_mean_curvature(surface, result);
}

double LaplaceBeltrami::last_factor() const {
  return implementation_->last_factor();
}

}  // namespace vesiflow::vesicle
