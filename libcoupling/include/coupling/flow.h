// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "coupling/export.h"
#include "coupling/simulation_parameters.h"
#include "fluid/boundary.h"

namespace vesiflow::coupling {

/// Kinds of extensional flow, see extension_flow().
enum class Extension {
  planar,   ///< u = rate (x, 0, -z)
  uniaxial  ///< u = rate (x, -y/2, -z/2)
};
/// What the fluid does at t = 0.
enum class FlowStart {
  flow,  ///< the undisturbed flow
  rest   ///< no flow
};

/// A flow without vesicles: what the walls do, what drives it, and where it starts from.
struct Flow {
  fluid::BoundaryVelocity velocity;  ///< u(x, t), on the walls and, undisturbed, inside; one thread at a time
  fluid::WallMotion motion = fluid::WallMotion::steady;  ///< whether velocity depends on time
  std::array<bool, 3> may_be_periodic{};                 ///< along which axes it repeats
  std::array<bool, 3> may_be_mirrored{};  ///< on which axes it is symmetric about the plane of the box's lower end

  /// Uniform force density -dp/dx that takes the place of the pressure drop where axis 0 is periodic: mu_o Lap u.
  double driving_force = 0.0;
  /// Greatest gradient of a velocity component along an axis, anywhere in the box at any time; 0 if not known.
  double greatest_gradient = 0.0;
  std::optional<double> greatest_speed{};  ///< greatest velocity component, likewise; none if not known
  double angular_frequency = 0.0;          ///< omega of an oscillating flow; 0 for others
  std::string description;                 ///< one line, for people
  FlowStart start = FlowStart::flow;       ///< what the fluid does at t = 0
};

/// No flow: u = 0. This and those that follow are the flows of the paper and some more, in a domain. x is from the
/// middle of the box (of the whole, where the box is one side of a mirror plane) for plane Poiseuille and duct flow,
/// and as it is for the others.
VESIFLOW_COUPLING_EXPORT Flow flow_at_rest();
/// Shear flow u = (rate z, 0, 0).
VESIFLOW_COUPLING_EXPORT Flow shear_flow(double rate, const SimulationParameters::Domain& domain);
/// Oscillating shear flow u = (rate cos(omega t) z, 0, 0); inside exact where Re omega H^2 << 1, the walls being H
/// apart.
VESIFLOW_COUPLING_EXPORT Flow oscillating_shear_flow(double rate, double angular_frequency,
                                                     const SimulationParameters::Domain& domain);
/// Extensional flow: planar u = rate (x, 0, -z), uniaxial u = rate (x, -y/2, -z/2).
VESIFLOW_COUPLING_EXPORT Flow extension_flow(double rate, Extension kind, const SimulationParameters::Domain& domain);
/// Plane Poiseuille flow u = (u_max (1 - (z/H)^2), 0, 0) between walls z = -H, H.
VESIFLOW_COUPLING_EXPORT Flow plane_poiseuille_flow(double peak_velocity, const SimulationParameters::Domain& domain);
/// Flow in a duct: u_max times fluid::DuctSeries(y, z) (Eq. (35) of the paper).
VESIFLOW_COUPLING_EXPORT Flow duct_flow(double peak_velocity, const SimulationParameters::Domain& domain);
/// A flow of one's own. Nothing is known of it, so nothing of it is checked.
VESIFLOW_COUPLING_EXPORT Flow custom_flow(const fluid::BoundaryVelocity& velocity, fluid::WallMotion motion);

}  // namespace vesiflow::coupling
