#include "vesicle/spectrum.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "check.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle {
namespace {

constexpr int largest_latitudes = 512;

double laplacian_symbol(double n) {
  return n * (n + 1);
}

}  // namespace

Spectrum::Spectrum(const Coefficients& coefficients) {
  check_argument(coefficients.degrees() >= 4, "degrees", coefficients.degrees(), ">= 4");
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
  if (!(decay_rate_ > 0)) return std::numeric_limits<double>::infinity();
  // The sum over n >= degrees of a slowly varying factor times exp(-2 r n), by its leading term.
  const double first = laplacian_symbol(degrees) * extrapolated(degrees);
  return first / std::sqrt(-std::expm1(-2 * decay_rate_)) / laplacian_scale_;
}

Spectrum mean_curvature_spectrum(const Surface& surface) {
  Coefficients coefficients;
  surface.harmonics().analysis(surface.mean_curvature(), coefficients);
  return Spectrum(coefficients);
}

Resolution resolution(const Surface& surface, double tolerance) {
  check_argument(tolerance > 0, "tolerance", tolerance, "> 0");
  const Spectrum spectrum = mean_curvature_spectrum(surface);
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
