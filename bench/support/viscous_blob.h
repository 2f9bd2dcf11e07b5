// A body of another viscosity that moves as told, with forces on its surface: the part of a vesicle that the fluid sees.
#pragma once

#include <cmath>
#include <numbers>

#include "fluid/field.h"
#include "fluid/grid.h"
#include "fluid/viscosity.h"

namespace vesiflow::bench {

// An ellipsoid with semi-axes 1.25, 1, 0.8 whose centre is at (0.3 t, 0, 0.1 t) and which turns about y at rate 1/2.
struct ViscousBlob {
  double ratio;  // of the viscosity inside to that outside, 1
  double h;      // mesh width: the viscosity changes over about two cells

  // Distance from the surface to first order, negative inside.
  double distance(const fluid::Vector3& r, double t) const {
    const double x = r[0] - 0.3 * t;
    const double z = r[2] - 0.1 * t;
    const double c = std::cos(0.5 * t);
    const double s = std::sin(0.5 * t);
    const fluid::Vector3 body{(c * x - s * z) / 1.25, r[1], (s * x + c * z) / 0.8};
    const double level = std::hypot(body[0], body[1], body[2]);
    const double slope = std::hypot(body[0] / 1.25, body[1], body[2] / 0.8);
    return slope > 0.1 ? level * (level - 1.0) / slope : -0.8;
  }

  double viscosity(const fluid::Vector3& r, double t) const {
    return 1.0 + 0.5 * (ratio - 1.0) * (1.0 - std::tanh(distance(r, t) / h));
  }

  // Force density, spread over four cells, along and across the normal, with a strength of about one per area.
  fluid::Vector3 force(const fluid::Vector3& r, double t) const {
    const double width = 2.0 * h;
    const double d = distance(r, t) / width;
    if (std::abs(d) >= 1.0) return {0.0, 0.0, 0.0};
    const double delta = 0.5 / width * (1.0 + std::cos(std::numbers::pi * d));
    const double x = r[0] - 0.3 * t;
    const double z = r[2] - 0.1 * t;
    const double normal = 1.0 + x * z;
    return {delta * (normal * x + r[1] * r[1]), delta * (normal * r[1] + 0.3 * z), delta * (normal * z + 0.3 * x)};
  }
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

// The blob's force at a time, times a strength, at all faces.
inline void set_force(const ViscousBlob& blob, double t, double strength, fluid::FaceVector& f) {
  const auto component = [&](int c) {
    return [&blob, t, strength, c](const fluid::Vector3& r) { return strength * blob.force(r, t)[c]; };
  };
  sample(f.x, component(0));
  sample(f.y, component(1));
  sample(f.z, component(2));
}

inline void set_viscosity(const ViscousBlob& blob, double t, fluid::Field<fluid::Cell>& mu) {
  sample(mu, [&](const fluid::Vector3& r) { return blob.viscosity(r, t); });
  fluid::extend_to_ghosts(mu);
}

}  // namespace vesiflow::bench
