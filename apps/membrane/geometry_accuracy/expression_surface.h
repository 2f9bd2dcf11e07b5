// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "sampled_surface.h"

/// A surface given by a TOML file of expressions in theta and phi: either the radius, r = "...", or the coordinates,
/// x = "...", y = "...", z = "..."; with constants for them in [constants], and pi. Expressions are those of muParser, in
/// double precision.
class ExpressionSurface final : public SampledSurface {
 public:
  /// @throws InputError if the file is not such a file or its surface is not finite, closed, smooth and oriented outward.
  explicit ExpressionSurface(const std::filesystem::path& file);
  ~ExpressionSurface() override;

  vesiflow::vesicle::VectorField sample(const vesiflow::vesicle::SphereGrid& grid) const override;

 private:
  class Expressions;

  std::unique_ptr<Expressions> expressions_;
};
