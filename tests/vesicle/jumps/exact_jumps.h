// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "jumps/stokes_flows.h"
#include "vesicle/membrane_jumps.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle::testing {

/// A jump by its first column and its number of columns.
struct JumpName {
  const char* name;
  int column, columns;
};
inline constexpr std::array<JumpName, 7> jump_names{{{"[p]", JumpColumns::pressure, 1},
                                                     {"[p_n]", JumpColumns::pressure_normal, 1},
                                                     {"[p_nn]", JumpColumns::pressure_second_normal, 1},
                                                     {"[u_n]", JumpColumns::velocity_normal, 3},
                                                     {"[u_nn]", JumpColumns::velocity_second_normal, 3},
                                                     {"[u_nnn]", JumpColumns::velocity_third_normal, 3},
                                                     {"[u]", JumpColumns::velocity, 3}}};

/// Two flows that meet at a surface: what the membrane must do to the fluid there, and the jumps.
struct ExactJumps {
  ExactJumps(const Surface& surface, const Flow& inside, const Flow& outside)
      : force(surface.grid().size(), 3),
        velocity_jump(surface.grid().size(), 3),
        columns(surface.grid().size(), JumpColumns::with_velocity_jump) {
    for (Eigen::Index k = 0; k < force.rows(); ++k) {
      const Vector3 x = surface.positions().row(k).matrix().transpose(),
                    n = surface.normal().row(k).matrix().transpose();
      const FlowValue in = inside(line(x, n)), out = outside(line(x, n));
      force.row(k) = (traction(inside, x, n) - traction(outside, x, n)).transpose().array();
      for (int d = 0; d < 3; ++d)
        columns(k, JumpColumns::pressure + d) = out.pressure.derivative(d) - in.pressure.derivative(d);
      for (int i = 0; i < 3; ++i) {
        const Taylor jump = out.velocity[std::size_t(i)] - in.velocity[std::size_t(i)];
        columns(k, JumpColumns::velocity + i) = velocity_jump(k, i) = jump.derivative(0);
        columns(k, JumpColumns::velocity_normal + i) = jump.derivative(1);
        columns(k, JumpColumns::velocity_second_normal + i) = jump.derivative(2);
        columns(k, JumpColumns::velocity_third_normal + i) = jump.derivative(3);
      }
    }
  }

  VectorField force, velocity_jump;
  Eigen::ArrayXXd columns;  ///< in the order of JumpColumns
};

/// Largest error of each jump, relative to the largest value of the jump.
inline std::array<double, jump_names.size()> errors(const Eigen::ArrayXXd& found, const Eigen::ArrayXXd& exact) {
  std::array<double, jump_names.size()> result{};
  for (std::size_t i = 0; i < jump_names.size(); ++i) {
    const JumpName& jump = jump_names[i];
    if (jump.column >= found.cols()) continue;
    const auto wanted = exact.middleCols(jump.column, jump.columns);
    result[i] = (found.middleCols(jump.column, jump.columns) - wanted).abs().maxCoeff() / wanted.abs().maxCoeff();
  }
  return result;
}

}  // namespace vesiflow::vesicle::testing
