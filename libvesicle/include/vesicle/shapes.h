// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include <Eigen/Core>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Size, orientation and position of an initial shape: x = centre + rotation (scaled shape). The volume is
/// (4/3) pi effective_radius^3.
struct Placement {
  double effective_radius = 1;                             ///< radius > 0 of the sphere of the same volume
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< proper rotation
  Vector3 centre = Vector3::Zero();                        ///< where the centroid is, but for perturbed_sphere()
};

/// Initial shapes: marker positions of shape (grid.size(), 3). Axes of symmetry are the polar axis z of the mesh before
/// rotation. The ellipsoids are
///
///     X = (a sin(theta) cos(phi), b sin(theta) sin(phi), c cos(theta)).
///
/// This one is the sphere.
/// \throws std::invalid_argument naming the value and the allowed range for bad arguments. So do all of the shapes
/// below.
VESIFLOW_VESICLE_EXPORT VectorField sphere(const SphereGrid& grid, const Placement& placement = {});

/// Semi-axes in the given proportions, all in [1e-100, 1e100], e.g. (3, 3, 1) or (1, 2, 4); scaled to the effective
/// radius.
VESIFLOW_VESICLE_EXPORT VectorField ellipsoid(const SphereGrid& grid, const Vector3& proportions,
                                              const Placement& placement = {});

/// Spheroid with polar over equatorial semi-axis `aspect_ratio` > 0: prolate above 1, oblate below.
VESIFLOW_VESICLE_EXPORT VectorField spheroid(const SphereGrid& grid, double aspect_ratio,
                                             const Placement& placement = {});

/// Prolate spheroid of reduced volume 6 sqrt(pi) V / A^{3/2} in (0, 1].
VESIFLOW_VESICLE_EXPORT VectorField prolate(const SphereGrid& grid, double reduced_volume,
                                            const Placement& placement = {});
/// Oblate spheroid of that reduced volume, in (0, 1].
VESIFLOW_VESICLE_EXPORT VectorField oblate(const SphereGrid& grid, double reduced_volume,
                                           const Placement& placement = {});

/// Red-cell discocyte of E. Evans and Y. C. Fung, Microvasc. Res. 4 (1972) 335, doi:10.1016/0026-2862(72)90069-6: at
/// the distance rho = sin(theta) from the axis, in units of the radius of the disc,
///
///     z = cos(theta)/2 (c0 + c1 rho^2 + c2 rho^4),  c0 = 0.207161, c1 = 2.002558, c2 = -1.122762.
///
/// Its reduced volume is 0.6444.
VESIFLOW_VESICLE_EXPORT VectorField biconcave_disc(const SphereGrid& grid, const Placement& placement = {});

/// A term amplitude * Re Y_n^m for m >= 0, amplitude * Im Y_n^{|m|} for m < 0, with the fully normalised Y_n^m of
/// SphericalHarmonics: the integral of |Y_n^m|^2 over all directions is 1, so that of (Re Y_n^m)^2 is 1/2 for m > 0.
struct Harmonic {
  int degree = 0;        ///< n in [0, latitudes - 2]: the mesh resolves r(d) d, which has one degree more
  int order = 0;         ///< m in [-n, n]
  double amplitude = 0;  ///< of the term, relative to the radius 1 of the sphere
};

/// X = r(d) d over the directions d of the grid, r = 1 + sum of the terms, then scaled to the effective radius: a
/// common factor changes nothing. The centre of the directions, not the centroid, lies at the centre.
/// \throws std::invalid_argument as sphere(), and when r is not > 0 (looked at in about eight points per wavelength of
/// the highest degree, and on the grid).
VESIFLOW_VESICLE_EXPORT VectorField perturbed_sphere(const SphereGrid& grid, std::span<const Harmonic> terms,
                                                     const Placement& placement = {});

/// The surface with the given coefficients of three fields, of any number of degrees, at the nodes of the grid. It is
/// scaled to the effective radius, turned about the centroid of its volume, and the centroid is put at the centre.
/// \throws std::invalid_argument as sphere(), and unless the coefficients are finite with three fields.
/// \throws std::domain_error unless the enclosed volume is > 0: it is negative where X_theta x X_phi points inward.
VESIFLOW_VESICLE_EXPORT VectorField shape_from_coefficients(const SphereGrid& grid, const Coefficients& coefficients,
                                                            const Placement& placement = {});

/// Reduced volume of the spheroid of that aspect ratio, in closed form.
VESIFLOW_VESICLE_EXPORT double spheroid_reduced_volume(double aspect_ratio);

/// Polar over equatorial semi-axis, >= 1, of the prolate spheroid of a reduced volume in (0, 1].
VESIFLOW_VESICLE_EXPORT double prolate_aspect_ratio(double reduced_volume);
/// Polar over equatorial semi-axis, <= 1, of the oblate spheroid of a reduced volume in (0, 1].
VESIFLOW_VESICLE_EXPORT double oblate_aspect_ratio(double reduced_volume);

/// Reduced volume 6 sqrt(pi) V / A^{3/2}: 1 for the sphere.
/// \throws std::invalid_argument unless both are finite and > 0.
VESIFLOW_VESICLE_EXPORT double reduced_volume(double area, double volume);

}  // namespace vesiflow::vesicle
