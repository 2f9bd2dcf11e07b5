// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "coupling/export.h"

namespace vesiflow::coupling {

/// Regularized delta functions delta_h(x) = phi(x/h_x) phi(y/h_y) phi(z/h_z) / (h_x h_y h_z). The first four take one
/// phi in every direction; a composite B-spline takes for each component of a vector one phi along the component
/// (normal to its faces) and another one, an order lower, across it (tangential). docs/coupling.md compares their
/// moments, costs and errors.
enum class DeltaKernel {
  three_point,          ///< Roma, Peskin & Berger, J. Comput. Phys. 153 (1999), doi 10.1006/jcph.1999.6293
  four_point,           ///< Peskin, Acta Numerica 11 (2002), doi 10.1017/S0962492902000077
  smoothed_four_point,  ///< Yang, Zhang, Li & He, J. Comput. Phys. 228 (2009), doi 10.1016/j.jcp.2009.07.023
  six_point,            ///< Bao, Kaye & Peskin, J. Comput. Phys. 316 (2016), doi 10.1016/j.jcp.2016.04.024

  /// quadratic normal, linear tangential B-spline: Gruninger & Griffith, J. Comput. Phys. 546 (2025), doi
  /// 10.1016/j.jcp.2025.114472
  composite_bspline_32,
  composite_bspline_43,  ///< cubic normal, quadratic tangential B-spline of theirs
  composite_bspline_54   ///< quartic normal, cubic tangential B-spline of theirs
};

/// Every kernel.
inline constexpr std::array<DeltaKernel, 7> delta_kernels{
    DeltaKernel::three_point,          DeltaKernel::four_point,
    DeltaKernel::smoothed_four_point,  DeltaKernel::six_point,
    DeltaKernel::composite_bspline_32, DeltaKernel::composite_bspline_43,
    DeltaKernel::composite_bspline_54,
};
/// The names of the kernels, in the order of the enumeration.
inline constexpr std::array<std::string_view, delta_kernels.size()> delta_kernel_names{
    "roma3", "peskin4", "smoothed4", "bao6", "bspline32", "bspline43", "bspline54"};

/// The name of a kernel.
constexpr std::string_view name(DeltaKernel kernel) {
  return delta_kernel_names[static_cast<std::size_t>(kernel)];
}

/// The kernel of that name.
/// \throws std::invalid_argument for any other name.
VESIFLOW_COUPLING_EXPORT DeltaKernel delta_kernel(std::string_view name);

/// What a kernel makes of a staggered field whose discrete divergence (that of the cells) is zero.
enum class Interpolation {
  /// The divergence of the interpolated field is an error of the kernel, and so is the change of an enclosed volume
  /// that moves with it.
  plain,
  /// The interpolated divergence is the discrete one, smoothed by the tangential phi in all directions, hence zero at
  /// every point: markers as dense as one likes keep their volume.
  divergence_preserving
};
/// Which of the two interpolations a kernel makes.
VESIFLOW_COUPLING_EXPORT Interpolation interpolation(DeltaKernel kernel);

/// A direction against the faces of a component.
enum class Direction {
  normal,     ///< along the component
  tangential  ///< across it
};

/// Number of grid points under phi along one direction: the support is |r| < width / 2 grid spacings.
VESIFLOW_COUPLING_EXPORT int support_width(DeltaKernel kernel, Direction direction = Direction::normal);

/// Distance from a wall, in grid spacings, from which on the supports of a marker lie within the box.
VESIFLOW_COUPLING_EXPORT double wall_clearance(DeltaKernel kernel);

/// phi(r): even, not negative, zero outside the support, sum 1 and first moment 0 over the grid for every position.
/// \param r distance in grid spacings.
VESIFLOW_COUPLING_EXPORT double delta(DeltaKernel kernel, double r, Direction direction = Direction::normal);

/// phi at the `width` points around a marker, which lie at the signed distances (marker minus point) width/2 - 1 + t -
/// j, j = 0 .. width - 1. All of them share square roots.
/// \param t in [0, 1): the fraction of the marker's position above a point (even width) or half way between two (odd).
/// \throws std::invalid_argument if `weights` has not `width` elements.
VESIFLOW_COUPLING_EXPORT void delta_weights(DeltaKernel kernel, double t, std::span<double> weights,
                                            Direction direction = Direction::normal);

/// c = E|r - r'|/2 for r, r' independently distributed as the tangential phi, in grid spacings. A force per area F
/// spread from a plane, tangential to it, drives a flow with a kink; interpolated back to the plane it is low by c h
/// F/mu: an error of first order in h, as of a membrane of finite thickness. The grid's own sum of w_i w_j |i - j| / 2
/// is 0.03 to 0.07 smaller and depends on the plane's position; docs/coupling.md has both.
VESIFLOW_COUPLING_EXPORT double thickening(DeltaKernel kernel);

}  // namespace vesiflow::coupling
