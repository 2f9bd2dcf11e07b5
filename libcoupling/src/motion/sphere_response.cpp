// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/sphere_response.h"

#include <array>
#include <cmath>
#include <numbers>

#include "motion/constants.h"

namespace vesiflow::coupling {
namespace {

// Of phi(r) in one direction, tabulated, for wavenumbers times h.
class FourierTransform {
 public:
  FourierTransform(DeltaKernel kernel, Direction direction) {
    constexpr int points_per_spacing = constants::transform_points_per_spacing;
    const int points = support_width(kernel, direction) * points_per_spacing / 2;
    std::vector<double> phi;
    for (int j = 0; j < points; ++j) phi.push_back(delta(kernel, (j + 0.5) / points_per_spacing, direction));
    for (int i = 0; i * spacing <= constants::largest_sphere_wavenumber + 2.0 * spacing; ++i) {
      // cos((j + 1/2) a) by its recurrence in j.
      const double a = i * spacing / points_per_spacing, twice = 2.0 * std::cos(a);
      double cosine = std::cos(0.5 * a), before = cosine, sum = 0.0;
      for (const double value : phi) {
        sum += value * cosine;
        const double next = twice * cosine - before;
        before = cosine;
        cosine = next;
      }
      values_.push_back(2.0 * sum / points_per_spacing);
    }
  }

  double operator()(double wavenumber) const {
    const double place = wavenumber / spacing;
    const auto i = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(i);
    return (1.0 - t) * values_[i] + t * values_[i + 1];
  }

 private:
  static constexpr double spacing = constants::transform_spacing;
  std::vector<double> values_;
};

struct Shell {
  double transverse = 0.0, along = 0.0;
};

// Mean of q^2 S over all directions of q: those of an octant, by midpoint rules in cos(theta) and phi.
Shell mean_over_directions(const FourierTransform& normal, const FourierTransform& tangential, double q) {
  constexpr int points = constants::directions_per_octant;
  Shell mean;
  for (int i = 0; i < points; ++i) {
    const double z = (i + 0.5) / points, s = std::sqrt(1.0 - z * z);
    for (int j = 0; j < points; ++j) {
      const double angle = (j + 0.5) / points * std::numbers::pi / 2.0;
      const std::array<double, 3> direction{s * std::cos(angle), s * std::sin(angle), z};
      std::array<double, 3> n, t, d;
      double laplacian = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        n[k] = normal(q * direction[k]);
        t[k] = tangential(q * direction[k]);
        d[k] = 2.0 * std::sin(0.5 * q * direction[k]);
        laplacian += d[k] * d[k];
      }
      double trace = 0.0, square = 0.0, divergence = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double phi = n[k] * t[(k + 1) % 3] * t[(k + 2) % 3];
        trace += phi * phi * (1.0 - d[k] * d[k] / laplacian);
        square += std::pow(phi * direction[k], 2);
        divergence += phi * direction[k] * d[k];
      }
      const double along = square - divergence * divergence / laplacian;
      mean.along += along / laplacian;
      mean.transverse += 0.5 * (trace - along) / laplacian;
    }
  }
  mean.along *= q * q / (points * points);
  mean.transverse *= q * q / (points * points);
  return mean;
}

}  // namespace

SphereResponse::SphereResponse(DeltaKernel kernel, double radius, double spacing) : radius_(radius) {
  constexpr double largest = constants::largest_sphere_wavenumber;
  const int steps = static_cast<int>(std::ceil(constants::steps_per_radian * largest * radius / spacing));
  step_ = largest / (spacing * steps);
  const FourierTransform normal(kernel, Direction::normal), tangential(kernel, Direction::tangential);
  for (int i = 0; i < steps; ++i) {
    const Shell shell = mean_over_directions(normal, tangential, (i + 0.5) * step_ * spacing);
    transverse_.push_back(shell.transverse);
    along_.push_back(shell.along);
  }
}

SphereResponse::Answer SphereResponse::exact(int degree) const {
  const double n = degree;
  return {radius_ * n / ((2.0 * n + 1.0) * (2.0 * n + 3.0)), radius_ * (n + 1.0) / ((2.0 * n + 1.0) * (2.0 * n - 1.0)),
          0.0};
}

SphereResponse::Answer SphereResponse::immersed(int degree) const {
  const double n = degree, t = n / (2.0 * n + 1.0), l = 1.0 - t;  // squares of the components of t
  Answer sum;
  for (std::size_t i = 0; i < transverse_.size(); ++i) {
    const double x = (static_cast<double>(i) + 0.5) * step_ * radius_;
    const double plus = std::sph_bessel(static_cast<unsigned>(degree + 1), x);
    const double minus = -std::sph_bessel(static_cast<unsigned>(degree - 1), x);
    sum.plus += plus * plus * (transverse_[i] * t + along_[i] * l);
    sum.minus += minus * minus * (transverse_[i] * l + along_[i] * t);
    sum.mixed += plus * minus * (transverse_[i] - along_[i]) * std::sqrt(t * l);
  }
  const double scale = 2.0 * radius_ * radius_ * step_ / std::numbers::pi;
  return {scale * sum.plus, scale * sum.minus, scale * sum.mixed};
}

double SphereResponse::normal(int degree, const Answer& answer) {
  const double n = degree;
  return ((n + 1.0) * answer.plus + n * answer.minus - 2.0 * std::sqrt(n * (n + 1.0)) * answer.mixed) / (2.0 * n + 1.0);
}

}  // namespace vesiflow::coupling
