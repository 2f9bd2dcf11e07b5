// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/buoyancy.h"

#include <stdexcept>
#include <string>

namespace vesiflow::coupling {

void add_buoyancy(const vesicle::Surface& surface, const vesicle::Vector3& weight, vesicle::VectorField& force) {
  const vesicle::VectorField& x = surface.positions();
  if (force.rows() != x.rows())
    throw std::invalid_argument("buoyancy: the force has " + std::to_string(force.rows()) +
                                " rows: must be one per marker, " + std::to_string(x.rows()));
  const vesicle::ScalarField& area = surface.area_weight();
  vesicle::Vector3 centre;
  for (int axis = 0; axis < 3; ++axis) centre(axis) = (x.col(axis) * area).sum() / surface.area();
  for (Eigen::Index m = 0; m < x.rows(); ++m) {
    const double pressure = weight.dot(x.row(m).matrix().transpose() - centre);
    force.row(m) += pressure * surface.normal().row(m);
  }
}

}  // namespace vesiflow::coupling
