// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "coupling/simulation_parameters.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// For each of the markers (markers x 3) the one, maybe itself, that is nearest to its mirror image in the plane where the coordinate
/// of the axis is `plane`. Nothing if one is farther from it than the tolerance.
std::optional<std::vector<Eigen::Index>> mirror_images(const vesicle::VectorField& markers, int axis, double plane,
                                                       double tolerance);

/// Whether the markers are, as a set, their own mirror image.
bool is_symmetric(const vesicle::VectorField& markers, int axis, double plane, double tolerance);

/// Keeps a membrane that lies across planes of symmetry symmetric about them. The fluid of such a box feels the symmetric part of
/// its forces and answers to that alone, so that what round-off adds of the other part would meet no resistance: it grows at 0.55
/// times the shear rate, and ended runs at t = 53 to 85.
class MirrorSymmetry {
 public:
  /// \param markers symmetric about the planes that they lie across, as check() wants them
  MirrorSymmetry(const SimulationParameters& parameters, const vesicle::VectorField& markers);

  /// Takes the mean of a displacement of the markers and of its mirror images. Its rows are markers, its columns x, y, z and any number
  /// of scalars. Does nothing for a membrane that lies across no plane.
  void apply(Eigen::Ref<Eigen::ArrayXXd> displacement) const;

 private:
  struct Plane {
    int axis;
    std::vector<Eigen::Index> images;
  };
  std::vector<Plane> planes_;
};

}  // namespace vesiflow::coupling
