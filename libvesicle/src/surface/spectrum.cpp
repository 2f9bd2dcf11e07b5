// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/spectrum.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

#include "check.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle {
namespace {

constexpr int largest_latitudes = Surface::largest_latitudes;

double laplacian_symbol(double n) {
  return n * (n + 1);
}

/// sum_{k >= 0} [(d + k) (d + k + 1)]^2 exp(-2 r k), from the sums of k^j q^k = q A_j(q) / (1 - q)^{j+1}, A_j Eulerian.
double sum_of_squared_symbols(double d, double r) {
  const double q = std::exp(-2 * r), p = -std::expm1(-2 * r);
  const double power_sum[] = {1 / p, q / std::pow(p, 2), q * (1 + q) / std::pow(p, 3),
                              q * (1 + q * (4 + q)) / std::pow(p, 4),
                              q * (1 + q * (11 + q * (11 + q))) / std::pow(p, 5)};
  const double a = laplacian_symbol(d), b = 2 * d + 1;  // (d + k) (d + k + 1) = a + b k + k^2
  return a * a * power_sum[0] + 2 * a * b * power_sum[1] + (b * b + 2 * a) * power_sum[2] + 2 * b * power_sum[3] +
         power_sum[4];
}

/// Sets the degrees of a mean curvature to zero that hold no more than round-off. Positions are rounded to eps |X|: noise that differs from marker
/// to marker, of sqrt(4 pi (2n+1)/M) eps |X| in degree n for M markers. Of a radial displacement f of degree n a sphere of radius R
/// has the mean curvature (n - 1)(n + 2) f/(2 R^2): so noise grows with n^{5/2}, and looks like a spectrum that does not decay. Seen is
/// once this for shapes that are just made, and five times for one that lies far off the origin.
void drop_round_off(const Surface& surface, Coefficients& mean_curvature) {
  constexpr double steps = 1e4;  // of a simulation, the rounding of each of which adds to the noise like a random walk
  const double rounding = std::numeric_limits<double>::epsilon() * surface.positions().abs().maxCoeff();
  const double square_radius = surface.area() / (4 * std::numbers::pi);
  const double white = std::sqrt(4 * std::numbers::pi * steps / static_cast<double>(surface.grid().size())) * rounding;
  for (int n = 0; n < mean_curvature.degrees(); ++n) {
    const double noise = white * std::sqrt(2.0 * n + 1) * (2 + laplacian_symbol(n)) / (2 * square_radius);
    if (mean_curvature.energy(n, n + 1) > noise * noise) continue;
    for (int m = 0; m <= n; ++m) mean_curvature(0, n, m) = 0;
  }
}

Coefficients mean_curvature_coefficients(const Surface& surface) {
  Coefficients coefficients;
  surface.harmonics().analysis(surface.mean_curvature(), coefficients);
  return coefficients;
}

}  // namespace

Spectrum::Spectrum(const Coefficients& coefficients) {
  check_argument(coefficients.degrees() >= 4, "degrees", coefficients.degrees(), ">= 4");
  const double energy = coefficients.energy(0, coefficients.degrees());
  check_argument(std::isfinite(energy), "sum of the squares of the coefficients", energy, "finite");
  double scale = 0;
  for (int n = 0; n < coefficients.degrees(); ++n) {
    amplitude_.push_back(std::sqrt(coefficients.energy(n, n + 1)));
    scale = std::hypot(scale, (1 + laplacian_symbol(n)) * amplitude_.back());
  }
  laplacian_scale_ = scale;
  fit_tail();
}

void Spectrum::fit_tail() {
  // Round-off of the transforms, and of the curvatures that go into them, does not decay: a shape resolved down to it is
  // judged by the degrees before.
  constexpr double round_off = 1e-13;
  const int p = degrees();
  const double floor = round_off * *std::max_element(amplitude_.begin(), amplitude_.end());
  const auto envelope = [&](int n) { return std::max(amplitude_[n], amplitude_[n - 1]); };
  int last = p;
  while (last > 2 && envelope(last - 1) <= floor) --last;
  const int first = std::max(1, std::min(p / 2, last / 2));
  double count = 0, sum_n = 0, sum_y = 0, sum_nn = 0, sum_ny = 0;
  for (int n = first; n < last; ++n) {
    const double y = std::log(std::max(envelope(n), floor));
    count += 1;
    sum_n += n;
    sum_y += y;
    sum_nn += double(n) * n;
    sum_ny += n * y;
  }
  const double variance = count * sum_nn - sum_n * sum_n;
  if (last == p && variance > 0) {
    decay_rate_ = std::max(0.0, -(count * sum_ny - sum_n * sum_y) / variance);
  } else {
    // Resolved: the law that falls to round-off where the spectrum does.
    decay_rate_ = -std::log(round_off) / last;
    sum_y = std::log(std::max(floor, std::numeric_limits<double>::min()));
    sum_n = last;
    count = 1;
  }
  log_amplitude_ = (sum_y + decay_rate_ * sum_n) / count;
}

double Spectrum::extrapolated(double degree) const {
  return std::exp(log_amplitude_ - decay_rate_ * degree);
}

double Spectrum::laplacian_tail(double degrees) const {
  if (laplacian_scale_ == 0) return 0;
  if (!(decay_rate_ > 0)) return std::numeric_limits<double>::infinity();
  return extrapolated(degrees) * std::sqrt(sum_of_squared_symbols(degrees, decay_rate_)) / laplacian_scale_;
}

Spectrum mean_curvature_spectrum(const Surface& surface) {
  return Spectrum(mean_curvature_coefficients(surface));
}

double spectrum_tail(const Surface& surface) {
  const Coefficients& coefficients = surface.position_coefficients();
  const int degrees = coefficients.degrees();
  return coefficients.energy(two_thirds_degrees(degrees), degrees) / coefficients.energy(1, degrees);
}

Resolution resolution(const Surface& surface, double tolerance) {
  check_argument(tolerance > 0, "tolerance", tolerance, "> 0");
  Coefficients mean_curvature = mean_curvature_coefficients(surface);
  drop_round_off(surface, mean_curvature);
  const Spectrum spectrum(mean_curvature);
  Resolution result;
  result.latitudes = surface.grid().latitudes();
  result.tolerance = tolerance;
  result.unresolved = spectrum.laplacian_tail(result.latitudes);
  constexpr int granule = 8;
  for (int n = granule; n <= largest_latitudes && result.needed_latitudes == 0; n += granule)
    if (spectrum.laplacian_tail(n) <= tolerance) result.needed_latitudes = n;
  return result;
}

std::string resolution_warning(const Resolution& resolution) {
  if (resolution.sufficient()) return {};
  std::ostringstream text;
  text << "the shape needs N_theta >= ";
  if (resolution.needed_latitudes > 0)
    text << resolution.needed_latitudes;
  else
    text << largest_latitudes << " or a smoother mesh";
  text << " (it has " << resolution.latitudes << "): ";
  if (std::isfinite(resolution.unresolved) && resolution.unresolved < 1)
    text << "about " << std::setprecision(2) << 100 * resolution.unresolved
         << " % of the bending force is not resolved";
  else
    text << "the bending force is not resolved";
  return text.str();
}

}  // namespace vesiflow::vesicle
