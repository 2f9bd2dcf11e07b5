// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/viscosity_contrast.h"

#include <algorithm>

#include "fluid/viscosity.h"

namespace vesiflow::coupling {

ViscosityContrast::ViscosityContrast(const SimulationParameters& parameters, const fluid::Grid& grid)
    : indicator_(grid, parameters.vesicles.size(), parameters.coupling.kernel),
      field_(std::make_shared<fluid::Field<fluid::Cell>>(grid)) {
  for (std::size_t i = 0; i < parameters.vesicles.size(); ++i) {
    ratios_.push_back(parameters.viscosity_ratio(i));
    least_ = std::min(least_, ratios_.back());
    greatest_ = std::max(greatest_, ratios_.back());
  }
  field_->fill(1.0);
}

void ViscosityContrast::add(std::size_t vesicle, const vesicle::Surface& surface) {
  indicator_.add(vesicle, surface, ratios_.at(vesicle) - 1.0);
}

void ViscosityContrast::update() {
  fluid::Field<fluid::Cell>& mu = *field_;
  indicator_.solve(mu);
#pragma omp parallel for schedule(static)
  for (int k = 0; k < mu.extent(2); ++k) {
    for (int j = 0; j < mu.extent(1); ++j) {
      double* row = mu.row(j, k);
      for (int i = 0; i < mu.extent(0); ++i) row[i] = std::clamp(1.0 + row[i], least_, greatest_);
    }
  }
  fluid::extend_to_ghosts(mu);
}

void ViscosityContrast::remember() {
  if (!remembered_) remembered_.emplace(field_->grid());
  std::copy_n(field_->data(), field_->size(), remembered_->data());
}

void ViscosityContrast::take_back() {
  indicator_.clear();
  std::copy_n(remembered_->data(), remembered_->size(), field_->data());
}

}  // namespace vesiflow::coupling
