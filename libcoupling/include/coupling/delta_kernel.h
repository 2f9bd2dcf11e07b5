#pragma once

#include <array>

namespace vesiflow::coupling {

/// Smoothed 4-point delta function of Yang, Zhang, Li & He (J. Comput. Phys. 228, 2009, doi 10.1016/j.jcp.2009.07.023): the
/// 3-point function of Roma, Peskin & Berger averaged over one cell. C^2, even, support |r| < 2, unit sum, zero
/// first moment, second moment 0.3818 for every position of the marker against the grid.
/// \param r distance in grid spacings
double smoothed_delta(double r);

/// Weights of the four grid points around a marker, for points at distances 1 + t, t, 1 - t, 2 - t.
/// All four share one square root and one arcsine.
/// \param t distance to the nearest grid point below, in grid spacings, in [0, 1)
std::array<double, 4> smoothed_delta_weights(double t);

}  // namespace vesiflow::coupling
