#include "vesicle/tension.h"

#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {

TensionForce::TensionForce(double sigma0) : sigma0_(sigma0) {
  check_argument(std::isfinite(sigma0) && sigma0 >= 0, "sigma0", sigma0, "finite and >= 0");
}

void TensionForce::evaluate(const Surface& surface, const ScalarField& target_areas, ScalarField& tension) const {
  check_markers(target_areas, "target_areas", surface.grid().size());
  const ScalarField& areas = surface.area_weight();
  tension = sigma0_ * (target_areas / areas) * (areas / target_areas).log();
}

void TensionForce::add_to(const Surface& surface, const ScalarField& tension, VectorField& force) {
  check_markers(force, "force", surface.grid().size());
  surface.projector_divergence(tension, divergence_);
  force += divergence_;
}

double TensionForce::energy(const Surface& surface, const ScalarField& target_areas) const {
  check_markers(target_areas, "target_areas", surface.grid().size());
  return 0.5 * sigma0_ * ((surface.area_weight() / target_areas).log().square() * target_areas).sum();
}

}  // namespace vesiflow::vesicle
