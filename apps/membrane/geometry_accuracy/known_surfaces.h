// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "exact_geometry.h"
#include "surface_source.h"

/// A surface given by one formula from the unit vector (sin(theta) cos(phi), sin(theta) sin(phi), cos(theta)) to the
/// position, for numbers and jets alike: its curvatures are exact.
class KnownSurface final : public SurfaceSource {
 public:
  template <class Formula>
  KnownSurface(std::string name, std::string description, const Formula& formula)
      : SurfaceSource(std::move(name), std::move(description)), position_(formula), patch_(formula) {}

  vesiflow::vesicle::VectorField sample(const vesiflow::vesicle::SphereGrid& grid) const override;
  Reference reference(const vesiflow::vesicle::SphereGrid& nodes) const override;

  PointGeometry at(long double theta, long double phi) const;

 private:
  std::function<Point<long double>(const Point<long double>&)> position_;
  std::function<Point<Jet<4>>(const Point<Jet<4>>&)> patch_;
};

/// The names make_known_surface() understands; the first three are those of Table 1.
const std::vector<std::string>& known_surface_names();

/// Null for an unknown name.
std::unique_ptr<KnownSurface> make_known_surface(const std::string& name);
