#include "vesicle/sphere_grid.h"

#include <cmath>
#include <numbers>

#include "check.h"
#include "gauss_legendre.h"

namespace vesiflow::vesicle {

SphereGrid::SphereGrid(int latitudes) : latitudes_(latitudes) {
  check_argument(latitudes >= 4, "latitudes", latitudes, ">= 4");
  const GaussLegendre rule = gauss_legendre(latitudes);
  for (ScalarField* field : {&colatitude_, &sin_, &cos_, &weight_, &parameter_measure_}) field->resize(latitudes);
  const long double spacing = std::numbers::pi_v<long double> / latitudes;
  for (int j = 0; j < latitudes; ++j) {
    // Functions of the unrounded node: the far half of (0, pi) would otherwise lose relative accuracy in the
    // sine.
    const bool north = 2 * j < latitudes;
    const long double from_pole = rule.colatitude[north ? j : latitudes - 1 - j];
    colatitude_[j] = static_cast<double>(rule.colatitude[j]);
    sin_[j] = static_cast<double>(std::sin(from_pole));
    cos_[j] = static_cast<double>(north ? std::cos(from_pole) : -std::cos(from_pole));
    weight_[j] = static_cast<double>(rule.weight[j]);
    parameter_measure_[j] = static_cast<double>(rule.weight[j] * spacing / std::sin(from_pole));
  }
}

double SphereGrid::longitude_spacing() const {
  return std::numbers::pi / latitudes_;
}

}  // namespace vesiflow::vesicle
