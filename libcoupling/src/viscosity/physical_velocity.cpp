// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/physical_velocity.h"

#include <algorithm>

namespace vesiflow::coupling {

void PhysicalVelocity::set(const fluid::FaceVector& scaled, const fluid::Vector3& mean_flow) {
  const auto add = [](const auto& from, double mean, auto& to) {
    if (mean == 0.0)
      std::copy_n(from.data(), from.size(), to.data());
    else
      std::transform(from.data(), from.data() + from.size(), to.data(), [mean](double w) { return w + mean; });
  };
  add(scaled.x, mean_flow[0], velocity_.x);
  add(scaled.y, mean_flow[1], velocity_.y);
  add(scaled.z, mean_flow[2], velocity_.z);
}

void PhysicalVelocity::divide_inside(int component, const GridBand& band, double ratio) {
  const fluid::Grid& grid = velocity_.grid();
  inside_.find(band, grid.spacing(0));
  inside_.multiply(1.0 / ratio, grid, velocity_.points()[static_cast<std::size_t>(component)]);
}

}  // namespace vesiflow::coupling
