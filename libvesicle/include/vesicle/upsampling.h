// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/spectrum.h"

namespace vesiflow::vesicle {

/// Latitudes of the grid on which products of derivatives are formed, as a multiple of those of the surface.
enum class Upsampling {
  none,          ///< 1
  three_halves,  ///< 1.5, rounded up to an integer number of latitudes
  twice,         ///< 2
  automatic,     ///< the smallest of these that the decay of the curvature's spectrum allows
};

/// 1, 1.5 or 2.
/// \throws std::invalid_argument for automatic.
VESIFLOW_VESICLE_EXPORT double factor(Upsampling upsampling);

/// round_up(factor * latitudes).
VESIFLOW_VESICLE_EXPORT int upsampled_latitudes(int latitudes, Upsampling upsampling);

/// The smallest factor whose fine grid leaves out less than `tolerance` of the Laplacian of the mean curvature H,
/// judged by extrapolating the spectrum of H; twice if none does. A function of the spectrum alone: same shape, same
/// choice.
/// \throws std::invalid_argument unless tolerance > 0.
VESIFLOW_VESICLE_EXPORT Upsampling choose_upsampling(const Spectrum& mean_curvature, double tolerance = 1e-8);

}  // namespace vesiflow::vesicle
