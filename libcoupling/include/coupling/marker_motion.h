// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace vesiflow::coupling {

/// Ways in which markers move through a step; docs/time_integration.md compares them. The first four follow the material, by a
/// MarkerIntegrator; the meshes of the last two follow the shape.
enum class MarkerMotion { euler, ab2, arkode, strain_relaxation, shape_following, implicit };
inline constexpr std::array<std::string_view, 6> marker_motion_names{
    "euler", "ab2", "arkode", "strain_relaxation", "shape_following", "implicit"};
inline std::string_view name(MarkerMotion motion) {
  return marker_motion_names.at(static_cast<std::size_t>(motion));
}

}  // namespace vesiflow::coupling
