// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/membrane.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::vesicle {

/// Takes fields from one grid to another through their coefficients of degree below the smaller number of latitudes:
/// exact upwards, the projection downwards. Nothing allocates after the first call. One thread at a time.
class VESIFLOW_VESICLE_EXPORT Resampling {
 public:
  /// Between these two grids.
  /// \param max_fields number of fields for which work space is allocated at once.
  Resampling(const SphereGrid& from, const SphereGrid& to, int max_fields = 3);

  const SphereGrid& from() const { return analysis_.grid(); }  ///< grid that fields are taken from
  const SphereGrid& to() const { return synthesis_.grid(); }   ///< grid that they are taken to

  /// Takes fields to the other grid.
  /// \param values shape (from().size(), fields).
  /// \param result shape (to().size(), fields).
  /// \throws std::invalid_argument for wrong sizes.
  void apply(const SphericalHarmonics::Input& values, SphericalHarmonics::Output result) const;

 private:
  SphericalHarmonics analysis_, synthesis_;
  mutable Coefficients coefficients_;
};

/// A membrane's state on another mesh of the same surface. The strains ln(dA/dA0) and ln(dA/dA(0)) and the fields stay
/// with the material; target areas and initial areas keep their totals and the initial volume is kept, so that errors
/// of area and volume are against the same values as before. As it is if both grids are the same.
/// \throws std::invalid_argument if an array of the state has not the size of the grid it is from.
/// \throws std::domain_error if the surface has no geometry on the new mesh (Surface::update).
VESIFLOW_VESICLE_EXPORT MembraneState resample(const MembraneState& state, const SphereGrid& from,
                                               const SphereGrid& to);

}  // namespace vesiflow::vesicle
