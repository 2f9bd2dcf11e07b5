#include "mirror_symmetry.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vesiflow::coupling {

bool is_symmetric(const vesicle::VectorField& markers, int axis, double plane, double tolerance) {
  // Sorted along a direction in which hardly any two markers of a regular mesh have the same place.
  const vesicle::Vector3 direction = vesicle::Vector3(0.4472, 0.6180, 0.6465).normalized();
  const auto place_of = [&](const vesicle::Vector3& x) { return x.dot(direction); };
  std::vector<std::pair<double, Eigen::Index>> sorted;
  for (Eigen::Index m = 0; m < markers.rows(); ++m)
    sorted.emplace_back(place_of(markers.row(m).matrix().transpose()), m);
  std::ranges::sort(sorted);
  for (Eigen::Index m = 0; m < markers.rows(); ++m) {
    vesicle::Vector3 image = markers.row(m).matrix().transpose();
    image(axis) = 2.0 * plane - image(axis);
    const double place = place_of(image);
    const auto is_at_image = [&](const std::pair<double, Eigen::Index>& candidate) {
      return (markers.row(candidate.second).matrix().transpose() - image).norm() <= tolerance;
    };
    const auto first = std::ranges::lower_bound(sorted, std::pair{place - tolerance, Eigen::Index{0}});
    const auto last = std::ranges::upper_bound(sorted, std::pair{place + tolerance, markers.rows()});
    if (std::none_of(first, last, is_at_image)) return false;
  }
  return true;
}

}  // namespace vesiflow::coupling
