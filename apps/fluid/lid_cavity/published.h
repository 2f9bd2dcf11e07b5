// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace cavity {

struct PublishedPoint {
  double position, value;
};

/// Published velocities on the centrelines of the cube [0, 1]^3 whose wall y = 1 moves with velocity 1 along x, at Reynolds
/// number 1000: u along (1/2, y, 1/2) and v along (x, 1/2, 1/2).
///
/// S. Albensoeder & H. C. Kuhlmann, Accurate three-dimensional lid-driven cavity flow, J. Comput. Phys. 206 (2005) 536-558,
/// doi:10.1016/j.jcp.2004.12.024, Tables 5 and 6 (aspect ratios 1 and 1, rigid end walls, Chebyshev collocation with 96^3
/// points), five digits. Taken not from the paper itself but from its transcription in tests/validations.py of
/// github.com/tum-pbs/PICT (commit a95d7f9d0713, function lid_driven_cavity_3D). The paper's cube is
/// [-1/2, 1/2]^3 with the wall x = -1/2 moving along y; here y = 1/2 - x, x = y + 1/2, u = v and v = -u of the paper. The
/// walls' values are left out.
namespace albensoeder_kuhlmann {

inline constexpr double reynolds_number = 1000;
inline constexpr const char* reference =
    "Albensoeder & Kuhlmann (2005), doi:10.1016/j.jcp.2004.12.024, Tables 5 and 6 as transcribed in "
    "github.com/tum-pbs/PICT, tests/validations.py";

std::span<const PublishedPoint> u_along_y();
std::span<const PublishedPoint> v_along_x();

}  // namespace albensoeder_kuhlmann
}  // namespace cavity
