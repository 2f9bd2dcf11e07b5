#pragma once

#include <array>
#include <string>

#include "coupling/scene.h"
#include "fluid/boundary.h"

namespace vesiflow::coupling {

/// A flow without vesicles: what the walls do, what drives it, and where it starts from. With x from the middle of the box (of the
/// whole, where the box is one side of a mirror plane) for plane_poiseuille and duct, and as it is for the others:
///   rest               u = 0
///   shear              u = (rate z, 0, 0)
///   oscillating_shear  u = (rate cos(omega t) z, 0, 0); inside exact where Re omega H^2 << 1, the walls being H apart
///   extension          planar u = rate (x, 0, -z), uniaxial u = rate (x, -y/2, -z/2)
///   plane_poiseuille   u = (u_max (1 - (z/H)^2), 0, 0) between walls z = -H, H
///   duct               u = u_max times fluid::DuctSeries(y, z) (Eq. (35) of the paper)
struct Flow {
  fluid::BoundaryVelocity velocity;       ///< u(x, t), on the walls and, undisturbed, inside; one thread at a time
  bool steady = true;                     ///< velocity does not depend on time
  std::array<bool, 3> may_be_periodic{};  ///< along which axes it repeats
  std::array<bool, 3> may_be_mirrored{};  ///< on which axes it is symmetric about the plane of the box's lower end
  /// Uniform force density -dp/dx that takes the place of the pressure drop where axis 0 is periodic: mu_o Lap u.
  double driving_force = 0.0;
  double greatest_gradient = 0.0;  ///< of a velocity component along an axis, anywhere in the box at any time
  double greatest_speed = 0.0;     ///< of a velocity component, likewise; 0 if not known
  double angular_frequency = 0.0;
  std::string description;  ///< one line, for people
};

/// The flow that the scene names.
/// \throws SceneError for flow.type = "custom", which only a program can give
Flow flow_of(const Scene& scene);

/// A flow of one's own. Nothing is known of it, so nothing of it is checked.
Flow custom_flow(const fluid::BoundaryVelocity& velocity, bool steady);

/// Largest time step at which the explicit convection of the scene's flow is stable (fluid::stable_convection_step); infinite without
/// inertia, and where nothing is known of the flow.
double stable_convection_step(const Scene& scene);

}  // namespace vesiflow::coupling
