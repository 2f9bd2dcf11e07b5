// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sampled_surface.h"

/// A surface given by a file of its coefficients (vesicle/surface_file.h).
class CoefficientSurface final : public SampledSurface {
 public:
  /// @throws InputError if the file is not such a file or its surface is not closed, smooth and oriented outward.
  explicit CoefficientSurface(const std::filesystem::path& file);

  vesiflow::vesicle::VectorField sample(const vesiflow::vesicle::SphereGrid& grid) const override;

 private:
  vesiflow::vesicle::Coefficients expansion(int degrees) const override;

  vesiflow::vesicle::Coefficients coefficients_;
};
