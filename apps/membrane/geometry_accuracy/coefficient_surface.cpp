// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coefficient_surface.h"

#include <algorithm>
#include <stdexcept>

#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface_file.h"

using namespace vesiflow::vesicle;

CoefficientSurface::CoefficientSurface(const std::filesystem::path& file)
    : SampledSurface(file.string(), "spherical-harmonic coefficients") {
  try {
    coefficients_ = read_surface_coefficients(file);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
  require_closed_and_outward();
}

VectorField CoefficientSurface::sample(const SphereGrid& grid) const {
  VectorField positions(grid.size(), 3);
  SphericalHarmonics(coefficients_.degrees(), grid).synthesis(coefficients_, positions);
  return positions;
}

Coefficients CoefficientSurface::expansion(int degrees) const {
  Coefficients result(degrees, 3);
  result.set_zero();
  for (int n = 0; n < std::min(degrees, coefficients_.degrees()); ++n)
    for (int m = 0; m <= n; ++m)
      for (int field = 0; field < 3; ++field) result(field, n, m) = coefficients_(field, n, m);
  return result;
}
