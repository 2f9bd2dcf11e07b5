#pragma once

#include "vesicle/spherical_harmonics.h"

namespace vesiflow::vesicle {

/// Takes fields from one grid to another through their coefficients of degree below the smaller number of latitudes: exact
/// upwards, the projection downwards. Nothing allocates after the first call. One thread at a time.
class Resampling {
 public:
  Resampling(const SphereGrid& from, const SphereGrid& to, int max_fields = 3);

  const SphereGrid& from() const { return analysis_.grid(); }
  const SphereGrid& to() const { return synthesis_.grid(); }

  /// values: shape (from().size(), fields), result: (to().size(), fields).
  /// @throws std::invalid_argument for wrong sizes.
  void apply(const SphericalHarmonics::Input& values, SphericalHarmonics::Output result) const;

 private:
  SphericalHarmonics analysis_, synthesis_;
  mutable Coefficients coefficients_;
};

}  // namespace vesiflow::vesicle
