// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "motion/mean_strain.h"
#include "vesicle/conservation.h"
#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// Keeps volume and area of a membrane whose mesh follows its shape, exactly and in every step. Their rates are taken
/// out of the velocity of the mesh (without it the correction of the displacement, of which the implicit terms do not
/// know, makes the scheme first order), and the displacement of a step is corrected along smooth directions
/// (vesicle/conservation.h). The strain is then the Lagrange multiplier of its own equation.
///
/// Near spheres the area is not kept in a step whose mean strain cannot be held (MeanStrain), in which the
/// undisturbed flow moves a sphere by more than the shape deviates from one, or whose correction would be larger than
/// that deviation. The volume is.
class ShapeConservation {
 public:
  struct Parameters {
    bool keeps_volume = true, keeps_area = true;
    bool has_tension = true;
    double radius = 1.0;       ///< of the sphere of the area that is to be kept
    double excess_area = 0.0;  ///< of that area over the sphere of the same volume, less 1
    double strain_rate = 0.0;  ///< of the undisturbed flow; 0 where it is not known
  };

  /// For a membrane at the start of its run: its initial volume and area are kept.
  ShapeConservation(const Parameters& parameters, const vesicle::Membrane& membrane);

  /// Decides whether the area is kept in the step of length dt from the membrane's predicted state.
  void begin_step(double dt, const vesicle::Membrane& membrane);
  /// The same for markers without a history: it is, if ever.
  void begin_run() { keeps_area_now_ = parameters_.keeps_area; }
  bool keeps_area() const { return keeps_area_now_; }
  /// Whether it ever changes anything.
  bool keeps_something() const { return parameters_.keeps_volume || parameters_.keeps_area; }

  /// Velocity and displacement of the markers, shape (markers, 3), from that surface: changed so that what is kept
  /// has no rate, and is what it was at first. The second may find that the area cannot be kept.
  /// \throws std::domain_error if the volume cannot be kept either
  void remove_rates(const vesicle::Surface& surface, vesicle::VectorField& velocity);
  void correct(const vesicle::Surface& surface, vesicle::VectorField& displacement);

  /// How often one of the two was done.
  std::int64_t entries() const { return entries_; }

 private:
  bool try_to_keep_area(const vesicle::Surface& surface, vesicle::VectorField& displacement);

  Parameters parameters_;
  MeanStrain mean_strain_;
  vesicle::ConservationProjection volume_, volume_and_area_;
  vesicle::VectorField uncorrected_;
  bool keeps_area_now_ = false;
  std::int64_t entries_ = 0;
};

}  // namespace vesiflow::coupling
