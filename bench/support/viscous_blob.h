// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A body of another viscosity that moves as told, with forces on its surface: the part of a vesicle that the fluid sees.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/field.h"
#include "fluid/grid.h"
#include "fluid/viscosity.h"

namespace vesiflow::bench {

// At one time: an ellipsoid with semi-axes 1.25, 1, 0.8 whose centre is at (0.3 t, 0, 0.1 t) and which turns about y at
// rate 1/2.
class ViscousBlob {
 public:
  // ratio: of the viscosity inside to that outside, 1. h: the mesh width; the viscosity goes from 10 to 90 % within two.
  ViscousBlob(double ratio, double h, double t)
      : ratio_(ratio),
        width_(2.0 * h),
        centre_{0.3 * t, 0.0, 0.1 * t},
        cosine_(std::cos(0.5 * t)),
        sine_(std::sin(0.5 * t)) {}

  // From the surface to first order, negative inside.
  double distance(const fluid::Vector3& r) const {
    const double x = r[0] - centre_[0];
    const double z = r[2] - centre_[2];
    const fluid::Vector3 body{(cosine_ * x - sine_ * z) / 1.25, r[1], (sine_ * x + cosine_ * z) / 0.8};
    const double level = length(body);
    const double slope = length({body[0] / 1.25, body[1], body[2] / 0.8});
    return slope > 0.1 ? level * (level - 1.0) / slope : -0.8;
  }

  double viscosity(const fluid::Vector3& r) const {
    if (is_far(r)) return 1.0;
    const double d = std::clamp(distance(r) / width_, -1.0, 1.0);
    return 1.0 + 0.5 * (ratio_ - 1.0) * (1.0 - d - std::sin(std::numbers::pi * d) / std::numbers::pi);
  }

  // Force density, spread over four cells, along and across the normal, with a strength of about one per area.
  fluid::Vector3 force(const fluid::Vector3& r) const {
    if (is_far(r)) return {0.0, 0.0, 0.0};
    const double d = distance(r) / width_;
    if (std::abs(d) >= 1.0) return {0.0, 0.0, 0.0};
    const double delta = 0.5 / width_ * (1.0 + std::cos(std::numbers::pi * d));
    const double x = r[0] - centre_[0];
    const double z = r[2] - centre_[2];
    const double normal = 1.0 + x * z;
    return {delta * (normal * x + r[1] * r[1]), delta * (normal * r[1] + 0.3 * z), delta * (normal * z + 0.3 * x)};
  }

 private:
  static double length(const fluid::Vector3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
  bool is_far(const fluid::Vector3& r) const {
    return length({r[0] - centre_[0], r[1], r[2] - centre_[2]}) > 1.25 + 1.25 * width_;
  }

  double ratio_, width_;
  fluid::Vector3 centre_;
  double cosine_, sine_;
};

// field = function(position), at the unknowns.
template <class Tag, class Function>
void sample(fluid::Field<Tag>& field, Function&& function) {
  for (int k = 0; k < field.extent(2); ++k) {
    for (int j = 0; j < field.extent(1); ++j) {
      for (int i = 0; i < field.extent(0); ++i) field(i, j, k) = function(field.position(i, j, k));
    }
  }
}

// The blob's force, times a strength, at all faces.
inline void set_force(const ViscousBlob& blob, double strength, fluid::FaceVector& f) {
  const auto component = [&](int c) {
    return [&blob, strength, c](const fluid::Vector3& r) { return strength * blob.force(r)[c]; };
  };
  sample(f.x, component(0));
  sample(f.y, component(1));
  sample(f.z, component(2));
}

inline void set_viscosity(const ViscousBlob& blob, fluid::Field<fluid::Cell>& mu) {
  sample(mu, [&](const fluid::Vector3& r) { return blob.viscosity(r); });
  fluid::extend_to_ghosts(mu);
}

}  // namespace vesiflow::bench
