// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/followed_shape.h"
#include "motion/membrane_response.h"
#include "motion/stiffness.h"
#include "motion/surrounding_fluid.h"

namespace vesiflow::coupling {

/// What ShapeFollowing and ImplicitMotion must know of a membrane and its fluid.
struct FollowingParameters {
  FollowedShape::Parameters shape;
  Stiffness::Material material;
  SurroundingFluid fluid;
  struct Grid {
    int degrees = 0;       ///< of waves that the grid of the fluid resolves on the sphere of the membrane's area
    double spacing = 0.0;  ///< the finest
    MembraneResponse::SecondMoments thickness;  ///< of the membrane as the fluid feels it
    bool is_corrected = false;                  ///< the membrane answers as a thin one, by a correction
    bool is_sharp = false;                      ///< it is one
    bool is_thin() const { return is_corrected || is_sharp; }
  } grid;
  bool corrects_fluid = false;  ///< the fluid is told of the implicit terms at once, and not in the next steps
  double unit_of_length = 1.0;  ///< the effective radius of the vesicle

  /// That of the coming steps.
  MembraneResponse response() const;
};

/// Degrees of waves that the fluid's grid resolves on a sphere, k h < 0.7 pi; and of those the ones that a motion
/// keeps, where `chosen` is what the mesh is fine enough for.
int grid_degrees(double radius, double spacing);
int resolved_degrees(int chosen, double radius, double spacing);
/// Degrees of forces that the grid resolves of a sharp membrane, n h/R < 1.5.
int sharp_degrees(double radius, double spacing);

}  // namespace vesiflow::coupling
