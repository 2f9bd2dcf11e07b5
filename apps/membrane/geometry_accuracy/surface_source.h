// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "vesicle/sphere_grid.h"
#include "vesicle/types.h"

/// The command line or a surface file asks for something that cannot be done. The message names option or file, key,
/// value and what is allowed.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// H, K and Lap_Gamma H, one value per node.
struct Curvatures {
  vesiflow::vesicle::ScalarField mean, gaussian, laplacian;
};

/// Largest value over the nodes of the difference of two Curvatures.
struct CurvatureErrors {
  double mean = 0, gaussian = 0, laplacian = 0;
};

CurvatureErrors max_difference(const Curvatures& a, const Curvatures& b);

/// What the computed curvatures are compared with.
struct Reference {
  Curvatures values;
  int degrees = 0;           ///< of the expansion it was evaluated from; 0 for closed forms
  CurvatureErrors estimate;  ///< of its own error; zero for closed forms
};

/// A closed surface whose curvatures are known better than they are computed from samples.
class SurfaceSource {
 public:
  SurfaceSource(std::string name, std::string description)
      : name_(std::move(name)), description_(std::move(description)) {}
  virtual ~SurfaceSource() = default;

  const std::string& name() const { return name_; }
  const std::string& description() const { return description_; }

  /// Positions at the nodes of a grid.
  /// @throws InputError if one is not finite.
  virtual vesiflow::vesicle::VectorField sample(const vesiflow::vesicle::SphereGrid& grid) const = 0;

  virtual Reference reference(const vesiflow::vesicle::SphereGrid& nodes) const = 0;

 private:
  std::string name_, description_;
};
