#include "vesicle/curvature_laplacian.h"

#include "check.h"

namespace vesiflow::vesicle {

class CurvatureLaplacian::Implementation {
 public:
  Implementation(int latitudes, LaplacianForm form)
      : form_(form),
        coarse_grid_(latitudes),
        fine_grid_(2 * latitudes),
        positions_on_fine_(latitudes, fine_grid_),
        fine_(2 * latitudes, fine_grid_),
        // The Cartesian form evaluates all 2N degrees at the markers; the paper truncates to N.
        result_(form == LaplacianForm::cartesian ? 2 * latitudes : latitudes, coarse_grid_),
        fine_geometry_(fine_grid_),
        flux_(fine_grid_.size(), 3),
        theta_(fine_grid_.size()),
        phi_(fine_grid_.size()),
        gradient_theta_(coarse_grid_.size(), 3),
        gradient_phi_(coarse_grid_.size(), 3) {}

  void evaluate(const Surface& surface, ScalarField& result) {
    check_argument(surface.grid().latitudes() == coarse_grid_.latitudes(), "latitudes of the surface",
                   surface.grid().latitudes(), "those of the Laplacian");
    result.resize(coarse_grid_.size());
    fine_geometry_.update(positions_on_fine_, surface.position_coefficients());
    fine_.analysis(fine_geometry_.mean_curvature(), scalar_coefficients_);
    fine_.gradient(scalar_coefficients_, theta_, phi_);
    if (form_ == LaplacianForm::cartesian)
      cartesian_divergence(surface.geometry(), result);
    else
      flux_divergence(result);
  }

 private:
  /// Eq. (11) on the fine grid, Eq. (12) at the markers.
  void cartesian_divergence(const SurfaceGeometry& geometry, ScalarField& result) {
    for (int component = 0; component < 3; ++component)
      flux_.col(component) =
          theta_ * fine_geometry_.dual_theta().col(component) + phi_ * fine_geometry_.dual_phi().col(component);
    fine_.analysis(flux_, vector_coefficients_);
    result_.gradient(vector_coefficients_, gradient_theta_, gradient_phi_);
    result = (gradient_theta_ * geometry.dual_theta() + gradient_phi_ * geometry.dual_phi()).rowwise().sum();
  }

  /// Eq. (14) on the fine grid: the flux W grad H . X^theta, W grad H . X^phi is differentiated component by
  /// component.
  void flux_divergence(ScalarField& result) {
    const VectorField& a = fine_geometry_.dual_theta();
    const VectorField& b = fine_geometry_.dual_phi();
    const ScalarField& w = fine_geometry_.area_element();
    flux_.col(0) = w * (theta_ * a.square().rowwise().sum() + phi_ * (a * b).rowwise().sum());
    flux_.col(1) = w * (theta_ * (a * b).rowwise().sum() + phi_ * b.square().rowwise().sum());
    fine_.analysis(flux_.col(0), scalar_coefficients_);
    fine_.gradient(scalar_coefficients_, theta_, flux_.col(2));
    fine_.analysis(flux_.col(1), scalar_coefficients_);
    fine_.gradient(scalar_coefficients_, flux_.col(2), phi_);
    theta_ = (theta_ + phi_) / w;
    fine_.analysis(theta_, scalar_coefficients_);
    result_.synthesis(scalar_coefficients_, result);
  }

  LaplacianForm form_;
  SphereGrid coarse_grid_, fine_grid_;
  SphericalHarmonics positions_on_fine_, fine_, result_;
  SurfaceGeometry fine_geometry_;
  Coefficients scalar_coefficients_, vector_coefficients_;
  VectorField flux_;
  ScalarField theta_, phi_;
  VectorField gradient_theta_, gradient_phi_;
};

CurvatureLaplacian::CurvatureLaplacian(int latitudes, LaplacianForm form)
    : implementation_(std::make_unique<Implementation>(latitudes, form)) {}
CurvatureLaplacian::~CurvatureLaplacian() = default;
CurvatureLaplacian::CurvatureLaplacian(CurvatureLaplacian&&) noexcept = default;
CurvatureLaplacian& CurvatureLaplacian::operator=(CurvatureLaplacian&&) noexcept = default;

void CurvatureLaplacian::evaluate(const Surface& surface, ScalarField& result) const {
  implementation_->evaluate(surface, result);
}

}  // namespace vesiflow::vesicle
