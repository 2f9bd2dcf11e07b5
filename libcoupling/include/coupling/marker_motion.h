// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace vesiflow::coupling {

/// Ways in which markers move through a step; docs/time_integration.md compares them. The first four follow the
/// material, by a MarkerIntegrator; the meshes of the last two follow the shape.
enum class MarkerMotion {
  euler,              ///< explicit Euler steps
  ab2,                ///< two-step Adams-Bashforth
  arkode,             ///< explicit Runge-Kutta with sub-steps of its own choice
  strain_relaxation,  ///< explicit Euler steps with a tension that follows the strain slowly
  shape_following,    ///< the mesh follows the shape, the strain is a field of its own
  implicit            ///< the same, in fully implicit steps
};
/// The names of the motions, in the order of the enumeration.
inline constexpr std::array<std::string_view, 6> marker_motion_names{
    "euler", "ab2", "arkode", "strain_relaxation", "shape_following", "implicit"};
/// The name of a motion.
inline std::string_view name(MarkerMotion motion) {
  return marker_motion_names.at(static_cast<std::size_t>(motion));
}

}  // namespace vesiflow::coupling
