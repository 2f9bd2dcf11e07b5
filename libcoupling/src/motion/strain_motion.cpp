// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/strain_motion.h"

namespace vesiflow::coupling {

StrainMotion::StrainMotion(Eigen::Index markers)
    : gradient_(vesicle::VectorField::Zero(markers, 3)),
      divergence_(vesicle::ScalarField::Zero(markers)),
      rate_(vesicle::ScalarField::Zero(markers)) {}

const vesicle::ScalarField& StrainMotion::find_rate(const vesicle::Surface& surface,
                                                    const vesicle::VectorField& membrane,
                                                    const vesicle::VectorField& mesh,
                                                    const vesicle::ScalarField& strain) {
  ++entries_;
  surface.divergence(membrane, divergence_);
  surface.gradient(strain, gradient_);
  rate_ = divergence_ - ((membrane - mesh) * gradient_).rowwise().sum();
  return rate_;
}

double StrainMotion::missing_rate(const vesicle::Surface& surface, const vesicle::VectorField& velocity,
                                  const vesicle::ScalarField& strain) {
  surface.divergence(velocity, divergence_);
  const auto unstrained = surface.area_weight() * (-strain).exp();
  return ((divergence_ - rate_) * unstrained).sum() / unstrained.sum();
}

}  // namespace vesiflow::coupling
