// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "motion/membrane_condition.h"
#include "motion/membrane_response.h"
#include "vesicle/coefficients.h"

namespace vesiflow::coupling {

/// The implicit terms Z_n of a step: dt times the rate at which a mode of degree n of positions and strain relaxes by
/// tension and bending, in the approximation of MembraneResponse, overestimated on purpose. With k = (n + 1/2)/R, the
/// forces per displacement and strain are
///   c k^2 (k^2/(4 Ca) + sigma),   c sigma0,
/// sigma the largest tension and c the overestimate. The recurrence of a step is stable if Z is at least 3/4 of the
/// true rate (motion/constants.h), and exact to second order for any Z. Where the mesh is pressed together, at a rim
/// or a tip, waves of degree n are as short as those of up to `compression` times the degree on the sphere and relax
/// faster: Z_n is no less than dt times the fastest of their rates. (A rim that is thinner than the sphere by 1.7
/// lets a wave that the fluid's grid resolves relax up to 1.7^3 times faster, which c alone does not cover: ADR 6.)
class Stiffness {
 public:
  struct Material {
    double sigma0 = 0.0;
    double bending = 0.0;  ///< 1/(4 Ca)
  };

  /// c, from what a step is like.
  struct Overestimate {
    double factor = 1.0;
    bool covers_compression = false;  ///< the factor allows for it, and no faster rates are asked for
  };

  struct Mode {
    double position = 0.0, strain = 0.0;  ///< Z_n
    double position_force = 0.0,
           strain_force = 0.0;  ///< force per area along the normal and tension, per position and strain
  };

  Stiffness(int degrees, const Material& material);

  void find(double dt, const MembraneCondition& condition, const Overestimate& overestimate,
            const MembraneResponse& response);

  std::span<const Mode> modes() const { return modes_; }
  const Mode& operator[](int degree) const { return modes_[static_cast<std::size_t>(degree)]; }

  /// What changes of positions and strain (fields 0 to 2, and 3) are as a change of the forces: force per area, and
  /// tension.
  void find_forces(const vesicle::Coefficients& change, vesicle::Coefficients& forces) const;

 private:
  double normal_force(double wavenumber, double tension) const;

  Material material_;
  std::vector<Mode> modes_;
};

/// The overestimate that a single correction in a step needs for its stability. \param inertia_share and lag of
/// SurroundingFluid
Stiffness::Overestimate overestimate_of_single_correction(bool is_thin_membrane, double compression,
                                                          double inertia_share, double lagging_overestimate);

}  // namespace vesiflow::coupling
