#include "vesicle/bending.h"

#include "check.h"

namespace vesiflow::vesicle {

double bending_energy(const Surface& surface) {
  return 0.5 * (surface.mean_curvature().square() * surface.area_weight()).sum();
}

BendingForce::BendingForce(int latitudes, double capillary_number, LaplacianForm form)
    : stiffness_(0.5 / capillary_number), laplacian_(latitudes, form) {
  check_argument(capillary_number > 0, "capillary_number", capillary_number, "> 0");
}

void BendingForce::add_to(const Surface& surface, VectorField& force) {
  check_markers(force, "force", surface.grid().size());
  laplacian_.evaluate(surface, normal_force_);
  const ScalarField& h = surface.mean_curvature();
  const ScalarField& k = surface.gaussian_curvature();
  normal_force_ = stiffness_ * (normal_force_ + 2 * h * (h.square() - k));
  for (int component = 0; component < 3; ++component)
    force.col(component) += normal_force_ * surface.normal().col(component);
}

}  // namespace vesiflow::vesicle
