// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/mirror_symmetry.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace vesiflow::coupling {

std::optional<std::vector<Eigen::Index>> mirror_images(const vesicle::VectorField& markers, int axis, double plane,
                                                       double tolerance) {
  // Sorted along a direction in which hardly any two markers of a regular mesh have the same place.
  const vesicle::Vector3 direction = vesicle::Vector3(0.4472, 0.6180, 0.6465).normalized();
  const auto place_of = [&](const vesicle::Vector3& x) { return x.dot(direction); };
  std::vector<std::pair<double, Eigen::Index>> sorted;
  for (Eigen::Index m = 0; m < markers.rows(); ++m)
    sorted.emplace_back(place_of(markers.row(m).matrix().transpose()), m);
  std::ranges::sort(sorted);
  std::vector<Eigen::Index> images;
  for (Eigen::Index m = 0; m < markers.rows(); ++m) {
    vesicle::Vector3 image = markers.row(m).matrix().transpose();
    image(axis) = 2.0 * plane - image(axis);
    const double place = place_of(image);
    const auto first = std::ranges::lower_bound(sorted, std::pair{place - tolerance, Eigen::Index{0}});
    const auto last = std::ranges::upper_bound(sorted, std::pair{place + tolerance, markers.rows()});
    Eigen::Index nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (auto candidate = first; candidate != last; ++candidate) {
      const double distance = (markers.row(candidate->second).matrix().transpose() - image).norm();
      if (distance < least) std::tie(least, nearest) = std::pair{distance, candidate->second};
    }
    if (!(least <= tolerance)) return std::nullopt;
    images.push_back(nearest);
  }
  return images;
}

bool is_symmetric(const vesicle::VectorField& markers, int axis, double plane, double tolerance) {
  return mirror_images(markers, axis, plane, tolerance).has_value();
}

MirrorSymmetry::MirrorSymmetry(const SimulationParameters& parameters, const vesicle::VectorField& markers) {
  for (int axis = 0; axis < 3; ++axis) {
    const double plane = parameters.domain.lower[axis];
    if (!parameters.domain.mirror[axis] || !(markers.col(axis) < plane).any()) continue;
    constexpr double tolerance = 1e-9;  // of the size: ten times that of check()
    const double size = (markers.rowwise() - markers.row(0)).abs().maxCoeff();
    std::optional<std::vector<Eigen::Index>> images = mirror_images(markers, axis, plane, tolerance * size);
    if (!images)
      throw std::invalid_argument("a membrane lies across a plane of symmetry and is not symmetric about it");
    planes_.push_back({axis, std::move(*images)});
  }
}

void MirrorSymmetry::apply(Eigen::Ref<Eigen::ArrayXXd> displacement) const {
  for (const Plane& plane : planes_)
    for (Eigen::Index column = 0; column < displacement.cols(); ++column) {
      const double sign = column == plane.axis ? -1.0 : 1.0;
      for (Eigen::Index m = 0; m < displacement.rows(); ++m) {
        const Eigen::Index image = plane.images[static_cast<std::size_t>(m)];
        if (image < m) continue;
        const double mean = 0.5 * (displacement(m, column) + sign * displacement(image, column));
        displacement(m, column) = mean;
        displacement(image, column) = sign * mean;
      }
    }
}

}  // namespace vesiflow::coupling
