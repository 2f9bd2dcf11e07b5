#pragma once

#include <Eigen/Core>

#include "vesicle/sphere_grid.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Size, orientation and position of an initial shape: x = centre + rotation (scaled shape). The volume is
/// (4/3) pi effective_radius^3.
struct Placement {
  double effective_radius = 1;                             ///< > 0
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< proper rotation
  Vector3 centre = Vector3::Zero();
};

/// Initial shapes: marker positions of shape (grid.size(), 3) with
///   X = (a sin(theta) cos(phi), b sin(theta) sin(phi), c cos(theta))
/// before rotation, so the axis of a spheroid is the polar axis z of the mesh.
/// All throw std::invalid_argument, naming the value and the allowed range, for bad arguments.

VectorField sphere(const SphereGrid& grid, const Placement& placement = {});

/// Semi-axes in the given proportions, all > 0, e.g. (3, 3, 1) or (1, 2, 4); scaled to the effective radius.
VectorField ellipsoid(const SphereGrid& grid, const Vector3& proportions, const Placement& placement = {});

/// Spheroid with polar over equatorial semi-axis `aspect_ratio` > 0: prolate above 1, oblate below.
VectorField spheroid(const SphereGrid& grid, double aspect_ratio, const Placement& placement = {});

/// Spheroids of reduced volume 6 sqrt(pi) V / A^{3/2} in (0, 1].
VectorField prolate(const SphereGrid& grid, double reduced_volume, const Placement& placement = {});
VectorField oblate(const SphereGrid& grid, double reduced_volume, const Placement& placement = {});

/// Closed form for the spheroid of that aspect ratio.
double spheroid_reduced_volume(double aspect_ratio);

/// Polar over equatorial semi-axis of the prolate (>= 1) or oblate (<= 1) spheroid of a reduced volume in (0,
/// 1].
double prolate_aspect_ratio(double reduced_volume);
double oblate_aspect_ratio(double reduced_volume);

/// Reduced volume 6 sqrt(pi) V / A^{3/2}: 1 for the sphere.
double reduced_volume(double area, double volume);

}  // namespace vesiflow::vesicle
