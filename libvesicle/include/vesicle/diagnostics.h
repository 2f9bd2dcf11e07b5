// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vesicle/export.h"
#include "vesicle/membrane.h"
#include "vesicle/spectrum.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Moments of the enclosed volume, by the divergence theorem, and the ellipsoid that has the same moments.
struct VolumeMoments {
  double volume = 0;                   ///< enclosed volume V
  Vector3 centroid = Vector3::Zero();  ///< centroid c of the enclosed volume

  /// int (x - c)(x - c)^T dV.
  Eigen::Matrix3d second_moments = Eigen::Matrix3d::Zero();
  /// int (|x - c|^2 I - (x - c)(x - c)^T) dV: the moment of inertia about the centroid of a body of unit density.
  Eigen::Matrix3d inertia() const { return second_moments.trace() * Eigen::Matrix3d::Identity() - second_moments; }
  /// Semi-axes of the solid ellipsoid with these second moments scaled by the volume, longest first.
  Vector3 semi_axes = Vector3::Zero();
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();  ///< unit directions of the semi-axes, as columns
};

/// Moments of the volume that a surface encloses.
VESIFLOW_VESICLE_EXPORT VolumeMoments volume_moments(const Surface& surface);

/// Taylor's deformation (L - S)/(L + S) of the ellipsoid with the same moments, L and S its longest and shortest
/// semi-axis: 0 for a sphere, towards 1 for needles and discs.
/// \throws std::invalid_argument unless L is finite and > 0 and S in [0, L].
VESIFLOW_VESICLE_EXPORT double deformation(const VolumeMoments& moments);

/// A/R^2 - 4 pi with R = (3 V/4 pi)^{1/3}: the area beyond that of the sphere of the same volume, 0 for it.
/// \throws std::invalid_argument unless both are finite and > 0.
VESIFLOW_VESICLE_EXPORT double excess_area(double area, double volume);

/// Angle of the longest axis in the xz-plane against the x axis, radians in (-pi/2, pi/2]. NaN if the longest
/// axis is not defined (the two longest agree to 1e-8, e.g. spheres and oblates) or points along y.
VESIFLOW_VESICLE_EXPORT double inclination_angle(const VolumeMoments& moments);

/// Eq. (34): area average of |r x V| / |r|^2, with r from the centroid and V relative to the mean velocity of the
/// membrane, both projected to the xz-plane; markers with |r| < 1e-3 sqrt(A/4 pi) are left out of both sums. NaN if
/// none is left.
/// \param velocity interpolated marker velocity, shape (markers, 3).
/// \throws std::invalid_argument for a wrong size or a centroid that is not finite.
/// \throws std::domain_error if the velocity is not finite.
VESIFLOW_VESICLE_EXPORT double tank_treading_frequency(const Surface& surface, const Vector3& centroid,
                                                       const VectorField& velocity);

/// What is recorded of a membrane at one time. Errors are relative to the initial values. A membrane that has turned
/// inside out has no reduced volume, excess area and deformation: NaN.
struct Diagnostics {
  double area = 0;                                           ///< area A
  double volume = 0;                                         ///< enclosed volume V
  double reduced_volume = 0;                                 ///< see vesicle::reduced_volume()
  double excess_area = 0;                                    ///< see excess_area()
  double area_error = 0;                                     ///< A / A(0) - 1, signed
  double volume_error = 0;                                   ///< V / V(0) - 1, signed
  Vector3 centroid = Vector3::Zero();                        ///< of the enclosed volume
  Eigen::Matrix3d second_moments = Eigen::Matrix3d::Zero();  ///< of the enclosed volume, see VolumeMoments
  Vector3 semi_axes = Vector3::Zero();                       ///< longest first
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();  ///< columns, as semi_axes
  double deformation = 0;                                    ///< see deformation()
  double inclination_angle = 0;                              ///< radians, see inclination_angle()
  double tank_treading_frequency = 0;                        ///< Eq. (34)
  double surface_divergence_max = 0;  ///< max |div_Gamma U~|, of the velocity that strains the membrane
  double max_local_area_error = 0;    ///< max |dA / dA0 - 1| against the target areas
  double max_label_area_error = 0;    ///< max |dA / dA(0) - 1| at the same label: the column of Table 3
  double bending_energy = 0;          ///< (1/2) int (H - H0)^2 dA, without 1/Ca
  double elastic_energy = 0;          ///< energy of the tension and of the penalties that are switched on
  double tension_min = 0;             ///< smallest tension of a marker
  double tension_max = 0;             ///< largest tension of a marker
  double spectrum_tail = 0;           ///< see spectrum_tail()
  Resolution resolution;              ///< how well the mesh resolves the bending force
  double mesh_aspect_ratio = 1;       ///< see MeshQuality
  double mesh_area_ratio = 1;         ///< see MeshQuality
};

/// Measures a membrane at its last geometry.
/// \param marker_velocity the interpolated U, shape (markers, 3), for Eq. (34).
/// \param membrane_velocity the velocity, shape (markers, 3), whose surface divergence is reported (the paper's Table 3
/// uses the filtered one).
/// \throws std::invalid_argument for a wrong size.
/// \throws std::domain_error if a velocity is not finite.
VESIFLOW_VESICLE_EXPORT Diagnostics measure(const Membrane& membrane, const VectorField& marker_velocity,
                                            const VectorField& membrane_velocity);

}  // namespace vesiflow::vesicle
