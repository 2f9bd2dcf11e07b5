#include "vesicle/resampling.h"

#include <algorithm>

namespace vesiflow::vesicle {

Resampling::Resampling(const SphereGrid& from, const SphereGrid& to, int max_fields)
    : analysis_(std::min(from.latitudes(), to.latitudes()), from, max_fields),
      synthesis_(analysis_.degrees(), to, max_fields),
      coefficients_(analysis_.degrees(), max_fields) {}

void Resampling::apply(const SphericalHarmonics::Input& values, SphericalHarmonics::Output result) const {
  analysis_.analysis(values, coefficients_);
  synthesis_.synthesis(coefficients_, result);
}

}  // namespace vesiflow::vesicle
