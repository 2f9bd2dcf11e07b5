// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "surface_source.h"
#include "vesicle/coefficients.h"

/// A surface without exact curvatures: its reference is evaluated from an expansion of four times the degrees (256 at
/// least, 512 at most), whose own error is estimated by the difference to one of three quarters of its degrees.
class SampledSurface : public SurfaceSource {
 public:
  using SurfaceSource::SurfaceSource;

  Reference reference(const vesiflow::vesicle::SphereGrid& nodes) const final;

 protected:
  /// Coefficients of X of exactly `degrees` degrees, as good as the source knows them.
  virtual vesiflow::vesicle::Coefficients expansion(int degrees) const;

  /// @throws InputError if the surface has a folded mesh, or does not enclose a positive volume with its outward normal
  /// X_theta x X_phi. For constructors.
  void require_closed_and_outward() const;
};
