#include "coupling/delta_kernel.h"

#include <cmath>
#include <numbers>

namespace vesiflow::coupling {
namespace {

constexpr double root3 = std::numbers::sqrt3;
constexpr double inner_constant = 17.0 / 48.0 + root3 * std::numbers::pi / 108.0;
constexpr double outer_constant = 55.0 / 48.0 - root3 * std::numbers::pi / 108.0;

// The value at |r| = t in [0, 1], given s = sqrt(1 + 12 t - 12 t^2) and a = asin(sqrt(3) (2 t - 1) / 2).
double inner(double t, double s, double a) {
  return inner_constant + 0.25 * t * (1.0 - t) + (1.0 - 2.0 * t) / 16.0 * s - root3 / 12.0 * a;
}

// The value at |r| = 1 + t, with the same s and a.
double outer(double t, double s, double a) {
  const double r = 1.0 + t;
  return outer_constant - 13.0 / 12.0 * r + 0.25 * r * r + (2.0 * t - 1.0) / 48.0 * s + root3 / 36.0 * a;
}

double root(double t) {
  return std::sqrt(1.0 + 12.0 * t * (1.0 - t));
}
double angle(double t) {
  return std::asin(0.5 * root3 * (2.0 * t - 1.0));
}

}  // namespace

double smoothed_delta(double r) {
  const double distance = std::abs(r);
  if (distance < 1.0) return inner(distance, root(distance), angle(distance));
  if (distance < 2.0) return outer(distance - 1.0, root(distance - 1.0), angle(distance - 1.0));
  return 0.0;
}

std::array<double, 4> smoothed_delta_weights(double t) {
  const double s = root(t);
  const double a = angle(t);
  return {outer(t, s, a), inner(t, s, a), inner(1.0 - t, s, -a), outer(1.0 - t, s, -a)};
}

}  // namespace vesiflow::coupling
